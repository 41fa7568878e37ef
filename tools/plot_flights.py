#!/usr/bin/env python3
"""Draws the ways flown by `fly --log DIR` from above and from the side, coloured by the navigator's state.

    ingress plot flights LOG_DIR OUT.png [--opening W,H] [--wall-thickness M]

Axes are those of the window: the wall lies at x = 0, the vehicle comes from x < 0.
"""
import argparse
import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from ingress_tools.flight_data import STATE_COLOURS as COLOURS  # noqa: E402


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def runs_of_states(rows):
    """Consecutive rows of one state, each run joined to the next one's first row."""
    start = 0
    for i in range(1, len(rows) + 1):
        if i == len(rows) or rows[i]["state"] != rows[start]["state"]:
            yield rows[start]["state"], rows[start:min(i + 1, len(rows))]
            start = i


def draw_wall(axes, half_gap, thickness, reach):
    for side in (-1, 1):
        axes.fill_between([0, thickness], side * half_gap, side * reach, color="0.5")


def draw(axes, flights, column, label):
    for rows in flights:
        for state, part in runs_of_states(rows):
            axes.plot([float(r["x_m"]) for r in part], [float(r[column]) for r in part], color=COLOURS[state], lw=0.9)
        last = rows[-1]
        mark = "o" if last["state"] == "PASSED" else "x"
        axes.plot(float(last["x_m"]), float(last[column]), mark, color=COLOURS[last["state"]], ms=4)
    axes.set_xlabel("x [m], into the opening")
    axes.set_ylabel(label)
    axes.set_aspect("equal")
    axes.grid(alpha=0.3)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("log_dir", type=pathlib.Path)
    parser.add_argument("output")
    parser.add_argument("--opening", default="1.2,1.0", help="width,height [m]")
    parser.add_argument("--wall-thickness", type=float, default=0.25, help="[m]")
    arguments = parser.parse_args()
    files = sorted(arguments.log_dir.glob("flight_*.csv"))
    flights = [rows for rows in map(read, files) if rows]
    if not flights:
        sys.exit(f"{arguments.log_dir}: no flight_*.csv with rows; make them with fly --log")
    width, height = map(float, arguments.opening.split(","))
    figure, (top, side) = plt.subplots(2, 1, figsize=(11, 11), gridspec_kw={"height_ratios": [2.2, 1]})
    draw(top, flights, "y_m", "y [m], left")
    draw(side, flights, "z_m", "z [m], up")
    draw_wall(top, width / 2, arguments.wall_thickness, 3.5)
    draw_wall(side, height / 2, arguments.wall_thickness, 1.4)
    top.legend(handles=[plt.Line2D([], [], color=c, label=s) for s, c in COLOURS.items()], loc="upper left", ncol=3)
    top.set_title(f"{len(flights)} flights, from above (below: from the side)")
    figure.tight_layout()
    figure.savefig(arguments.output, dpi=110)


if __name__ == "__main__":
    main()
