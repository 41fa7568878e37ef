#!/usr/bin/env python3
"""Draws the output of `survey_pose --draws N`: how near the estimator and OpenCV's methods come to the Cramer-Rao
bound. Prints the comparison as a Markdown table.

Writes pose_bound.png and pose_methods.png. --noise selects the noise of methods and table; --doc writes the table into
FILE.md, between its marks.
"""
import math
import os
import pathlib
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from ingress_tools.command_line import Parser, rows_of  # noqa: E402
from ingress_tools.plotting import plt  # noqa: E402

METHODS = {
    "ours": ("ours", "black", "o"), "ours_attitude": ("ours, attitude known to 0.02 rad", "tab:green", "D"),
    "iterative": ("solvePnP ITERATIVE", "tab:blue", "s"), "ippe": ("solvePnP IPPE", "tab:orange", "^"),
    "homography": ("homography, decomposed", "tab:red", "v"),
}
BEGIN, END = "<!-- methods: begin -->", "<!-- methods: end -->"


def read(folder):
    return [{key: float(value) for key, value in row.items()} for row in rows_of(pathlib.Path(folder) / "cells.csv")]


def ratio(cell, method):
    return cell[f"{method}_yaw_rmse_deg"] / cell["yaw_bound_deg"]


def values(cells, key):
    return sorted({cell[key] for cell in cells})


def draw_bound(cells, path):
    """One panel per noise: distance by yaw, RMSE over bound in each cell; grey where the sign cannot be known."""
    noises, distances, yaws = (values(cells, key) for key in ("sample_sigma_px", "distance_m", "yaw_deg"))
    figure, panels = plt.subplots(1, len(noises), figsize=(3.0 * len(noises), 2.9), sharey=True, squeeze=False)
    for axes, noise in zip(panels[0], noises):
        grid = [[math.nan] * len(distances) for _ in yaws]
        for cell in cells:
            if cell["sample_sigma_px"] == noise:
                x, y = distances.index(cell["distance_m"]), yaws.index(cell["yaw_deg"])
                grid[y][x] = ratio(cell, "ours")
                colour = "black" if cell["decidable"] else "0.45"
                axes.text(x, y, f"{grid[y][x]:.2f}", ha="center", va="center", fontsize=7.5, color=colour)
        picture = axes.imshow(grid, origin="lower", aspect="auto", cmap="RdYlGn_r", vmin=0.8, vmax=1.4, alpha=0.75)
        axes.set_xticks(range(len(distances)))
        axes.set_xticklabels([f"{value:g}" for value in distances])
        axes.set_yticks(range(len(yaws)))
        axes.set_yticklabels([f"{value:g}" for value in yaws])
        axes.set_title(f"{noise:g} px a sample", fontsize=9)
        axes.set_xlabel("distance m")
    panels[0][0].set_ylabel("yaw from the line of sight, deg")
    figure.suptitle("yaw RMSE / Cramér-Rao bound (grey: the sign cannot be known, sigma_u > yaw / 3)", fontsize=10)
    figure.tight_layout(rect=(0, 0, 0.94, 0.97))
    figure.colorbar(picture, ax=panels[0].tolist(), shrink=0.9, fraction=0.02, pad=0.01)
    figure.savefig(path, dpi=90)


def draw_methods(cells, noise, path):
    cells = [cell for cell in cells if cell["sample_sigma_px"] == noise]
    distances = values(cells, "distance_m")
    figure, panels = plt.subplots(1, len(distances), figsize=(2.6 * len(distances), 3.4), sharey=True, squeeze=False)
    for axes, distance in zip(panels[0], distances):
        here = sorted((c for c in cells if c["distance_m"] == distance), key=lambda c: c["yaw_deg"])
        for method, (name, colour, marker) in METHODS.items():
            axes.plot([c["yaw_deg"] for c in here], [ratio(c, method) for c in here], color=colour, marker=marker,
                      markersize=4, linewidth=1.2, label=name)
        axes.axhline(1.0, color="0.6", linewidth=0.8, zorder=0)
        axes.set_yscale("log")
        axes.set_yticks([1, 2, 5, 10, 20])
        axes.set_yticklabels(["1", "2", "5", "10", "20"])
        axes.set_title(f"{distance:g} m", fontsize=9)
        axes.set_xlabel("yaw deg")
    panels[0][0].set_ylabel(f"yaw RMSE / bound, {noise:g} px a sample")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="lower center", ncol=len(METHODS), fontsize=8, frameon=False)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    figure.savefig(path, dpi=90)


def table(cells, noise):
    head = ["m", "deg", "bound deg", "sigma_u deg", "sign trusted %"] + [name for name, _, _ in METHODS.values()]
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    for cell in cells:
        if cell["sample_sigma_px"] != noise:
            continue
        row = [f"{cell['distance_m']:g}", f"{cell['yaw_deg']:g}", f"{cell['yaw_bound_deg']:.3f}", f"{cell['sigma_u_deg']:.2f}",
               f"{100 * cell['trusted'] / cell['draws']:.0f}"]
        lines.append("| " + " | ".join(row + [f"{ratio(cell, method):.2f}" for method in METHODS]) + " |")
    return lines


def write_doc(path, lines):
    text = pathlib.Path(path).read_text()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        sys.exit(f"plot_pose: {path}: {BEGIN} and {END} must each appear exactly once")
    before, rest = text.split(BEGIN)
    pathlib.Path(path).write_text(before + BEGIN + "\n" + "\n".join(lines) + "\n" + END + rest.split(END)[1])


def main():
    parser = Parser(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--output")
    parser.add_argument("--noise", type=float)
    parser.add_argument("--doc")
    arguments = parser.parse_args()
    try:
        cells = read(arguments.folder)
    except (OSError, KeyError, ValueError) as error:
        print(f"plot_pose: {arguments.folder}: no cells.csv of survey_pose: {error}", file=sys.stderr)
        sys.exit(2)
    noises = values(cells, "sample_sigma_px")
    noise = min(noises, key=lambda value: abs(value - (arguments.noise or 0.3)))
    output = pathlib.Path(arguments.output or arguments.folder)
    draw_bound(cells, output / "pose_bound.png")
    draw_methods(cells, noise, output / "pose_methods.png")
    lines = table(cells, noise)
    print("\n".join(lines))
    if arguments.doc:
        write_doc(arguments.doc, lines)


if __name__ == "__main__":
    main()
