#!/usr/bin/env python3
"""Tracks the target through an annotated video and prints for how long and how exactly.

FOLDER/gt.csv has one row per frame: file and the target's corners x1, y1, ... x4, y4. The first frame with its corners
is the reference. A frame is lost if nothing is detected in it, or if the detection overlaps the target by less than an
intersection over union of 0.7. Corners are compared in the cyclic order that fits best.
"""
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import evaluate_detections as rules  # noqa: E402
from ingress_tools import package_paths  # noqa: E402
from ingress_tools.command_line import Parser  # noqa: E402

DEFAULT_TOOL = package_paths.program("detect_images") or "detect_images"


def distance(p, q):
    return ((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2) ** 0.5


def corner_errors(found, truth):
    """Distances of the four corners, in the cyclic order with the smallest sum."""
    turned = [found[k:] + found[:k] for k in range(4)]
    return min(([distance(p, q) for p, q in zip(quad, truth)] for quad in turned), key=sum)


def quantile(values, fraction):
    values = sorted(values)
    return values[min(len(values) - 1, int(fraction * len(values)))] if values else float("nan")


def score(detections, truth):
    """Per frame: (tracked, corner errors or None, target number)."""
    frames = []
    for found, true in zip(detections, truth):
        quad, known = (rules.corners(found) if found["detected"] == "1" else None), rules.corners(true)
        tracked = quad is not None and rules.iou(quad, known) >= rules.SAME_IOU
        frames.append((tracked, corner_errors(quad, known) if tracked else None, found.get("target_id", "")))
    return frames


def run(options, truth):
    reference = truth[0]
    corners = ",".join(reference[f"{axis}{i}"] for i in range(1, 5) for axis in "xy")
    table = options.output / "sequence.csv"
    command = [options.tool, "--output", table, "--reference", options.folder / reference["file"],
               "--reference-corners", corners, "--rate", options.rate]
    if not options.single:
        command.append("--track")
    for name in ("params", "camera"):
        if getattr(options, name):
            command += [f"--{name}", getattr(options, name)]
    if options.overlay:
        command += ["--overlay", options.output / "overlay"]
    subprocess.run([*map(str, command), *(str(options.folder / row["file"]) for row in truth)], check=True)
    return rules.rows_of(table)


def report(frames, detections):
    lost = [i for i, (tracked, _, _) in enumerate(frames) if not tracked]
    print(f"{len(frames)} frames, tracked in {len(frames) - len(lost)}, lost in {len(lost)}"
          + (f", first in frame {lost[0]}" if lost else ""))
    numbers = sorted({number for tracked, _, number in frames if tracked and number})
    if numbers:
        print(f"target numbers: {', '.join(numbers)}")
    errors = [e for _, each, _ in frames if each for e in each]
    print(f"corner error: median {quantile(errors, 0.5):.3f} px, 95 % {quantile(errors, 0.95):.3f} px, "
          f"worst {max(errors, default=float('nan')):.3f} px")
    times = [float(row["milliseconds"]) for row in detections]
    print(f"time: median {quantile(times, 0.5):.2f} ms, largest {max(times):.2f} ms")


def main():
    parser = Parser(__doc__)
    parser.add_argument("folder", type=pathlib.Path, help="folder with gt.csv")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for sequence.csv")
    parser.add_argument("--tool", default=DEFAULT_TOOL, help="the program detect_images")
    parser.add_argument("--rate", default="15", help="images per second")
    parser.add_argument("--single", action="store_true", help="search each image alone, for comparison")
    parser.add_argument("--params", help="yaml file laid over the defaults, as config:= of launch files")
    parser.add_argument("--camera", help="calibration file")
    parser.add_argument("--overlay", action="store_true", help="also draw what happened to each candidate")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        truth = rules.rows_of(options.folder / "gt.csv")
        detections = run(options, truth)
    except OSError as error:
        print(f"evaluate_sequence: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as error:
        print(f"evaluate_sequence: {options.tool} ended with {error.returncode}", file=sys.stderr)
        return 1
    report(score(detections, truth), detections)
    return 0


if __name__ == "__main__":
    sys.exit(main())
