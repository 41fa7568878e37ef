#!/usr/bin/env python3
"""Measures how often the detector finds a photographed window in a drawn second view: turned, smaller, in another light.

For façades with one photograph only. The reference is the window with a margin of a quarter of its size, cut from the
photograph. The view is the whole photograph, turned by up to 29 degrees, with noise and JPEG. Objects in front of the
wall are drawn flat with it. Each reference is also tried on views of four other façades, where every detection is false.
One seed gives the same images. Columns of the table: right (IoU 0.7); its twin (another annotated window); elsewhere.
"""
import collections
import os
import pathlib
import subprocess
import sys

import cv2
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import evaluate_detections as rules  # noqa: E402
from ingress_tools import package_paths  # noqa: E402
from ingress_tools.command_line import Parser  # noqa: E402

MARGIN, LEAST_SIDE = 0.25, 50  # of a reference: margin [sides of the window], least side of the window [px]
WINDOWS = 2  # of one photograph, the first that are annotated
VIEW, FOCAL = (640, 480), 600.0
OTHERS = (37, 71, 101, 13)  # steps to the views of other façades
DEFAULT_TOOL = package_paths.program("detect_images") or "detect_images"


def sides(quad):
    lengths = np.linalg.norm(np.roll(quad, -1, 0) - quad, axis=1)
    return 0.5 * (lengths[0] + lengths[2]), 0.5 * (lengths[1] + lengths[3])


def cut_out(image, quad):
    """(window with its surroundings, its corners there)"""
    low = np.maximum(quad.min(0) - MARGIN * np.array(sides(quad)), 0).round().astype(int)
    high = np.minimum(quad.max(0) + MARGIN * np.array(sides(quad)), np.array(image.shape[1::-1]) - 1).round().astype(int)
    return image[low[1]:high[1] + 1, low[0]:high[0] + 1], quad - low


def turned(quad, rng):
    """(homography to a view in which the window's side has 60 to 200 pixels, how much it shrinks)"""
    angles = rng.uniform([-0.2, -0.5, -0.08], [0.2, 0.5, 0.08])
    rotation = np.eye(3)
    for axis in (1, 0, 2):
        rotation = rotation @ cv2.Rodrigues(angles[axis] * np.eye(3)[axis])[0]
    size, side, centre = rng.uniform(60, 200), max(sides(quad)), quad.mean(0)
    to_plane = np.array([[1 / side, 0, -centre[0] / side], [0, 1 / side, -centre[1] / side], [0, 0, 1]])
    camera = np.array([[FOCAL, 0, rng.uniform(200, 440)], [0, FOCAL, rng.uniform(150, 330)], [0, 0, 1]])
    return camera @ np.column_stack([rotation[:, 0], rotation[:, 1], [0, 0, FOCAL / size]]) @ to_plane, side / size


def relit(image, rng):
    light = (image / 255.0) ** 2.2 * rng.uniform(0.5, 1.3) * rng.uniform(0.85, 1.18, 3)
    view = np.clip(light, 0, 1) ** (rng.uniform(0.85, 1.2) / 2.2)
    view = cv2.GaussianBlur(view, (0, 0), rng.uniform(0.4, 1.0)) + rng.normal(0, rng.uniform(0.004, 0.015), view.shape)
    packed = cv2.imencode(".jpg", np.clip(255 * view, 0, 255).astype(np.uint8), [1, int(rng.integers(75, 95))])[1]
    return cv2.imdecode(packed, cv2.IMREAD_COLOR)


def drawn_view(image, quad, rng):
    """(view, homography to it); None if it cuts the window off."""
    homography, shrunk = turned(quad, rng)
    seen = cv2.perspectiveTransform(quad[None], homography)[0]
    if seen.min() < 4 or (seen.max(0) > np.array(VIEW) - 5).any():
        return None
    smooth = cv2.GaussianBlur(image, (0, 0), 0.45 * shrunk) if shrunk > 1 else image
    return relit(cv2.warpPerspective(smooth, homography, VIEW, borderMode=cv2.BORDER_REFLECT), rng), homography


def draw_all(photos, folder, seed):
    """{view: (corners in its reference, corners in the view, corners of the other windows there)}"""
    rng, drawn = np.random.default_rng(seed), {}
    annotated = collections.defaultdict(list)
    for row in rules.rows_of(photos / "annotations.csv"):
        if rules.corners(row):
            annotated[row["file"]].append((row["label"], np.array(rules.corners(row))))
    for file, windows in sorted(annotated.items()):
        image = cv2.imread(str(photos / "images" / file))
        size = np.array(image.shape[1::-1])
        for k, quad in enumerate([q for label, q in windows if not label.endswith("_small")][:WINDOWS]):
            is_whole = min(sides(quad)) >= LEAST_SIDE and quad.min() >= 2 and (quad.max(0) <= size - 3).all()
            made = drawn_view(image, quad, rng) if is_whole else None
            if made is None:
                continue
            name = f"{pathlib.Path(file).stem}_{k}"
            reference, at = cut_out(image, quad)
            cv2.imwrite(str(folder / f"{name}.reference.png"), reference)
            cv2.imwrite(str(folder / f"{name}.png"), made[0])
            others = [cv2.perspectiveTransform(q[None], made[1])[0].tolist() for _, q in windows if q is not quad]
            drawn[name] = (at, cv2.perspectiveTransform(quad[None], made[1])[0].tolist(), others)
    return drawn


def found_by(tool, folder, name, at, views, arguments):
    """For each view the detected quadrilateral, or None."""
    table = folder / f"{name}.csv"
    command = [tool, "--output", table, "--reference", folder / f"{name}.reference.png", "--reference-corners",
               ",".join(f"{v:.2f}" for v in at.ravel()), *arguments, *(folder / f"{view}.png" for view in views)]
    subprocess.run(list(map(str, command)), check=True, stdout=subprocess.DEVNULL)
    return [rules.corners(row) if row["detected"] == "1" else None for row in rules.rows_of(table)]


def verdict(quad, target, others):
    if quad is None:
        return "nothing"
    if rules.iou(quad, target) >= rules.SAME_IOU:
        return "right"
    return "twin" if any(rules.iou(quad, other) >= rules.SAME_IOU for other in others) else "elsewhere"


def facade_of(name):
    return name.rsplit("_", 1)[0].split("_scaled")[0]


def main():
    parser = Parser(__doc__)
    parser.add_argument("--photos", required=True, type=pathlib.Path, help="folder with images/ and annotations.csv")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the views and what is found")
    parser.add_argument("--seed", type=int, default=20261127)
    parser.add_argument("--tool", default=DEFAULT_TOOL, help="the program detect_images")
    options, arguments = parser.parse_known_args()
    if not (options.photos / "annotations.csv").exists():
        sys.exit(f"evaluate_second_views: {options.photos} has no annotations.csv")
    options.output.mkdir(parents=True, exist_ok=True)
    drawn = draw_all(options.photos, options.output, options.seed)
    names, verdicts, false, negatives = list(drawn), collections.Counter(), 0, 0
    for i, (name, (at, target, others)) in enumerate(drawn.items()):
        strangers = [names[(i + k) % len(names)] for k in OTHERS]
        strangers = [other for other in strangers if facade_of(other) != facade_of(name)]
        quads = found_by(options.tool, options.output, name, at, [name, *strangers], arguments)
        verdicts[verdict(quads[0], target, others)] += 1
        false += sum(quad is not None for quad in quads[1:])
        negatives += len(strangers)
        if sys.stderr.isatty():
            print(f"\r{i + 1} of {len(names)} windows", end="", file=sys.stderr)
    print("| views | right | its twin | elsewhere | nothing | false on other façades |\n|---|---|---|---|---|---|")
    print(f"| {len(names)} | {verdicts['right']} | {verdicts['twin']} | {verdicts['elsewhere']} | {verdicts['nothing']} "
          f"| {false} of {negatives} |")


if __name__ == "__main__":
    main()
