#!/usr/bin/env python3
"""Draws a flight as a short animation: its path from the side and from above, coloured by the navigator's state.

    scripts/run fly --scenario config/scenarios/nominal.yaml --seeds 20 --output out/fly --log out/log
    scripts/draw_flight_gif.py --log out/log/flight_20.csv --scenario config/scenarios/nominal.yaml --output doc/flight.gif

Needs ffmpeg.
"""
import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np
import yaml

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from flight_data import STATE_COLOURS  # noqa: E402

WIDTH, HEIGHT = 240, 180  # of each half [px]
METRE_PX, PLANE = 30.0, (176, 96)  # of the path: scale, and where the opening's centre is
FONT = cv2.FONT_HERSHEY_SIMPLEX


def run(*command):
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def path_panel(steps, now, scenario, from_the_side):
    """The path so far, from above or from the side, the vehicle's nose with it."""
    panel = np.full((HEIGHT, WIDTH, 3), 255, np.uint8)
    name, size = ("z_m", "height_m") if from_the_side else ("y_m", "width_m")

    def at(step):
        return (int(PLANE[0] + METRE_PX * float(step["x_m"])), int(PLANE[1] - METRE_PX * float(step[name])))

    half = int(0.5 * METRE_PX * scenario["window"][size])
    for top, bottom in ((0, PLANE[1] - half), (PLANE[1] + half, HEIGHT)):
        cv2.rectangle(panel, (PLANE[0], top), (PLANE[0] + 8, bottom), (150, 150, 150), cv2.FILLED)
    for before, after in zip(steps[:now], steps[1:now + 1]):
        cv2.line(panel, at(before), at(after), colour(after), 2, cv2.LINE_AA)
    nose = float(steps[now]["heading_rad"])
    tip = at(steps[now])
    rise = 0.0 if from_the_side else math.sin(nose)
    end = (int(tip[0] + 14 * math.cos(nose)), int(tip[1] - 14 * rise))
    cv2.arrowedLine(panel, tip, end, (40, 40, 40), 2, cv2.LINE_AA, tipLength=0.4)
    cv2.circle(panel, tip, 5, colour(steps[now]), cv2.FILLED, cv2.LINE_AA)
    text = "from the side" if from_the_side else f"{float(steps[now]['time_s']):4.1f} s  {steps[now]['state']}"
    cv2.putText(panel, text, (6, 172), FONT, 0.45, (90, 90, 90) if from_the_side else colour(steps[now]), 1, cv2.LINE_AA)
    return panel


def colour(step):
    text = STATE_COLOURS[step["state"]].lstrip("#")
    return tuple(int(text[i:i + 2], 16) for i in (4, 2, 0))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--log", required=True, type=pathlib.Path, help="flight_N.csv of fly --log")
    parser.add_argument("--scenario", required=True, type=pathlib.Path)
    parser.add_argument("--rate", type=float, default=6.0, help="images a second")
    parser.add_argument("--colours", type=int, default=64)
    parser.add_argument("--output", required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    scenario = yaml.safe_load(arguments.scenario.read_text())
    with open(arguments.log, encoding="utf-8") as file:
        steps = [step for step in csv.DictReader(file) if step["state"] != "IDLE"]
    times = [float(step["time_s"]) for step in steps]
    chosen = [int(np.searchsorted(times, t)) for t in np.arange(times[0], times[-1], 1.0 / arguments.rate)]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, i in enumerate(chosen):
            cv2.imwrite(str(folder / f"{number:04d}.png"), np.hstack([path_panel(steps, i, scenario, side) for side in (True, False)]))
        palette = f"split[a][b];[a]palettegen=max_colors={arguments.colours}[p];[b][p]paletteuse=dither=none:diff_mode=rectangle"
        run("ffmpeg", "-y", "-framerate", arguments.rate, "-i", folder / "%04d.png", "-vf", palette, "-loop", 0, arguments.output)
    print(f"{arguments.output}: {len(chosen)} images, {arguments.output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
