#!/usr/bin/env python3
"""Draws a flight as a short animation: what the camera sees from the places of the flight, with what the detector makes of it,
beside the path from above.

    scripts/run fly --scenario config/scenarios/nominal.yaml --seeds 20 --output out/fly --log out/log
    scripts/draw_flight_gif.py --log out/log/flight_20.csv --scenario config/scenarios/nominal.yaml --seed 20 --output doc/flight.gif

The images are rendered anew, level and with the window in the middle. Needs ffmpeg.
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
import package_paths  # noqa: E402
from flight_data import STATE_COLOURS  # noqa: E402

WIDTH, HEIGHT = 240, 180  # of each half [px]
LABEL = 26  # above an image of draw_scenarios [px]
SIDE = 2    # beside it
NEAREST_M, IN_VIEW_RAD = 1.05, 0.35
METRE_PX, PLANE = 30.0, (176, 96)  # of the path: scale, and where the opening's centre is
REFERENCE_M, MARGIN = 3.0, 0.35
FONT = cv2.FONT_HERSHEY_SIMPLEX


def run(*command):
    subprocess.run([str(part) for part in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def photograph(scenario, seed, place, folder):
    """What the camera sees from that place (distance [m], bearing [rad], height [m]) when it looks at the window."""
    distance, bearing, height = place
    start = {"distance_m": distance, "off_axis_rad": bearing, "height_offset_m": height}
    (folder / "there.yaml").write_text(yaml.safe_dump(dict(scenario, start=start)))
    width = scenario["camera"]["width_px"]
    run(*package_paths.command("draw_scenarios"), "--output", folder / "there.png", "--width", width, "--seed", seed, folder / "there.yaml")
    sheet = cv2.imread(str(folder / "there.png"))
    return sheet[LABEL:LABEL + scenario["camera"]["height_px"], SIDE:SIDE + width]


def reference_of(scenario, seed, folder):
    """The operator's image, taken square in front, and the opening's corners in it."""
    image = photograph(scenario, seed, (REFERENCE_M, 0.0, 0.0), folder)
    cv2.imwrite(str(folder / "reference.png"), image)
    focal = 0.5 * image.shape[1] / math.tan(0.5 * scenario["camera"]["horizontal_fov_rad"])
    forward = scenario["camera"].get("forward_m", 0.1)
    half = [0.5 * focal * scenario["window"][side] / (REFERENCE_M - forward) for side in ("width_m", "height_m")]
    x, y = 0.5 * (image.shape[1] - 1), 0.5 * (image.shape[0] - 1)
    corners = [(x + sx * half[0], y + sy * half[1]) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    return ",".join(f"{value:.1f}" for corner in corners for value in corner)


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


def blank(text):
    panel = np.full((HEIGHT, WIDTH, 3), 60, np.uint8)
    cv2.putText(panel, text, (12, 94), FONT, 0.42, (230, 230, 230), 1, cv2.LINE_AA)
    return panel


def camera_panels(steps, chosen, scenario, seed, folder):
    """A panel for each chosen step: the detector's overlay, or why there is no image."""
    panels, files = {}, {}
    corners = reference_of(scenario, seed, folder)
    (folder / "frames").mkdir()
    for i in chosen:
        x, y, z = (float(steps[i][name]) for name in ("x_m", "y_m", "z_m"))
        if x > -NEAREST_M:
            panels[i] = blank("behind the window" if x > 0 else "too near to see it whole")
        elif abs(float(steps[i]["heading_rad"]) - math.atan2(-y, -x)) > IN_VIEW_RAD:
            panels[i] = blank("looking for the window")
        else:
            files[i] = folder / "frames" / f"{i:05d}.png"
            cv2.imwrite(str(files[i]), photograph(scenario, seed, (math.hypot(x, y), math.atan2(y, -x), z), folder))
    run(*package_paths.command("detect_images"), "--output", folder / "found.csv", "--reference", folder / "reference.png",
        "--reference-corners", corners, "--overlay", folder / "overlay", folder / "frames")
    for i, file in files.items():
        overlay = next((folder / "overlay").glob(f"{file.stem}*"))
        panels[i] = cv2.resize(cv2.imread(str(overlay)), (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)
    return panels


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--log", required=True, type=pathlib.Path, help="flight_N.csv of fly --log")
    parser.add_argument("--scenario", required=True, type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--path-only", action="store_true", help="the path from the side in place of the camera's images")
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
        if arguments.path_only:
            panels = {i: path_panel(steps, i, scenario, True) for i in chosen}
        else:
            panels = camera_panels(steps, chosen, scenario, arguments.seed, folder)
        for number, i in enumerate(chosen):
            cv2.imwrite(str(folder / f"{number:04d}.png"), np.hstack([panels[i], path_panel(steps, i, scenario, False)]))
        palette = f"split[a][b];[a]palettegen=max_colors={arguments.colours}[p];[b][p]paletteuse=dither=none:diff_mode=rectangle"
        run("ffmpeg", "-y", "-framerate", arguments.rate, "-i", folder / "%04d.png", "-vf", palette, "-loop", 0, arguments.output)
    print(f"{arguments.output}: {len(chosen)} images, {arguments.output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
