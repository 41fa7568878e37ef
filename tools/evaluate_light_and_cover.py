#!/usr/bin/env python3
"""Measures the detector on views that are lit differently from the reference image, or partly covered.

Draws over views saved by `survey_detector --save`, and runs `survey_detector --load` on the result. The reference image
is unchanged. The same views give the same images.

shadow    one or two hard cast shadows across the window, 35 to 60 % darker, with another white balance
overcast  less light, a colder white balance, flatter contrasts
dusk      an eighth to a third of the light, cold, with noise
wet       parts of the wall with a ragged edge are 25 to 45 % darker
exposure  0.5 to 1.7 times the exposure, with clipping and another tone curve
person, plants, rope, leaf
          an object in front of the window hides 10 to 33 % of the ring around the opening (leaf: an open shutter)
"""
import os
import pathlib
import shutil
import subprocess
import sys
import zlib

import cv2
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from ingress_tools import package_paths  # noqa: E402
from ingress_tools.command_line import Parser, rows_of  # noqa: E402

RING = 0.22  # width of the ring around the opening [sides of the opening]
LEAST_HIDDEN, MOST_HIDDEN = 0.10, 0.33
DEFAULT_TOOL = package_paths.program("survey_detector") or "survey_detector"
CORNERS = [f"inner_{axis}{i}" for i in range(1, 5) for axis in "xy"]


def pixels(image):
    return np.stack(np.meshgrid(np.arange(image.shape[1]), np.arange(image.shape[0])), 2).astype(np.float64)


def blotches(shape, size, rng):
    """Smooth noise of mean 0 and standard deviation 1."""
    small = rng.standard_normal((max(2, int(shape[0] / size)) + 2, max(2, int(shape[1] / size)) + 2))
    large = cv2.resize(small, (shape[1], shape[0]), interpolation=cv2.INTER_CUBIC)
    return (large - large.mean()) / large.std()


def lit(image, gains, gamma=1.0):
    return 255.0 * np.clip(image * gains / 255.0, 0.0, 1.0) ** gamma


def side_of(quad):
    return float(np.sqrt(cv2.contourArea(quad.astype(np.float32))))


def shadow(image, quad, rng):
    """Half planes or bars whose edge crosses the window."""
    covered = np.zeros(image.shape[:2])
    for _ in range(rng.integers(1, 3)):
        angle = rng.uniform(0, 2 * np.pi)
        normal = np.array([np.cos(angle), np.sin(angle)])
        through = quad.mean(0) + rng.uniform(-0.6, 0.6, 2) * side_of(quad)
        distance = (pixels(image) - through) @ normal
        width = rng.choice([1e4, rng.uniform(0.15, 0.8) * side_of(quad)])
        covered = np.maximum(covered, ((distance > 0) & (distance < width)).astype(float))
    covered = cv2.GaussianBlur(covered, (0, 0), 0.6)[:, :, None]
    balance = np.array([rng.uniform(1.0, 1.15), 1.0, rng.uniform(0.88, 1.0)])
    return lit(image, 1.0 - covered * (1.0 - rng.uniform(0.40, 0.65) * balance))


def overcast(image, quad, rng):
    cold = np.array([rng.uniform(1.02, 1.12), 1.0, rng.uniform(0.85, 0.97)])
    return lit(image, rng.uniform(0.55, 0.9) * cold, rng.uniform(0.85, 1.0))


def dusk(image, quad, rng):
    cold = np.array([rng.uniform(1.1, 1.4), 1.0, rng.uniform(0.7, 0.95)])
    return lit(image, rng.uniform(0.125, 0.33) * cold) + rng.normal(0.0, 2.0, image.shape)


def wet(image, quad, rng):
    size = side_of(quad)
    ragged = blotches(image.shape[:2], 0.35 * size, rng) + 0.4 * blotches(image.shape[:2], 0.06 * size, rng)
    depth = np.clip(0.5 + (ragged - rng.uniform(-0.5, 0.5)) / 0.15, 0.0, 1.0)[:, :, None]
    return lit(image, 1.0 - depth * rng.uniform(0.25, 0.45) * np.array([0.9, 1.0, 1.05]))


def exposure(image, quad, rng):
    return lit(image, np.exp(rng.uniform(np.log(0.5), np.log(1.7))), rng.uniform(0.75, 1.3))


def painted(mask, image, quad, rng, hue=None):
    """Paints the mask in one colour, with folds and blotches."""
    colour = rng.uniform(25, 225, 3) if hue is None else np.array(hue) * rng.uniform(0.6, 1.3)
    texture = 1.0 + 0.18 * blotches(image.shape[:2], 0.1 * side_of(quad), rng)
    soft = cv2.GaussianBlur(mask.astype(np.float64), (0, 0), 0.6)[:, :, None]
    return image * (1.0 - soft) + soft * np.clip(colour * texture[:, :, None], 0, 255)


def in_plane(quad, points):
    unit = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    map_to_image = cv2.getPerspectiveTransform(unit, quad.astype(np.float32))
    return cv2.perspectiveTransform(np.array([points], np.float32), map_to_image)[0]


def filled(image, polygon):
    mask = np.zeros(image.shape[:2], np.uint8)
    cv2.fillPoly(mask, [np.round(16 * polygon).astype(np.int32)], 1, cv2.LINE_8, 4)
    return mask


def ring_of(image, quad):
    outer = in_plane(quad, [(-RING, -RING), (1 + RING, -RING), (1 + RING, 1 + RING), (-RING, 1 + RING)])
    return filled(image, outer) & ~filled(image, quad) & 1


def person_mask(image, quad, rng):
    size, mask = side_of(quad), np.zeros(image.shape[:2], np.uint8)
    x, top = quad.mean(0) + (rng.uniform(-0.75, 0.75) * size, rng.uniform(-0.7, 0.4) * size)
    width = rng.uniform(0.14, 0.24) * size
    cv2.ellipse(mask, (round(x), round(top)), (round(0.45 * width), round(0.6 * width)), 0, 0, 360, 1, -1)
    cv2.ellipse(mask, (round(x), round(top + 3.3 * width)), (round(width), round(2.8 * width)), 0, 0, 360, 1, -1)
    hips, feet = (round(x - 0.6 * width), round(top + 3.3 * width)), (round(x + 0.6 * width), image.shape[0])
    cv2.rectangle(mask, hips, feet, 1, -1)
    return mask


def plants_mask(image, quad, rng):
    size, mask = side_of(quad), np.zeros(image.shape[:2], np.uint8)
    centre = quad[rng.choice([2, 3])] + rng.uniform(-0.25, 0.25, 2) * size
    for _ in range(rng.integers(60, 200)):
        x, y = centre + rng.standard_normal(2) * size * np.array([0.28, 0.22])
        axes = (max(1, round(rng.uniform(0.02, 0.06) * size)), max(1, round(rng.uniform(0.01, 0.03) * size)))
        cv2.ellipse(mask, (round(x), round(y)), axes, rng.uniform(0, 180), 0, 360, 1, -1)
    return mask


def rope_mask(image, quad, rng):
    size, mask = side_of(quad), np.zeros(image.shape[:2], np.uint8)
    for _ in range(rng.integers(2, 6)):
        ends = quad.mean(0) + rng.uniform(-0.7, 0.7, (2, 2)) * size
        way = 3.0 * (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0]) * size
        a, b = ends[0] - way, ends[0] + way
        cv2.line(mask, tuple(map(round, a)), tuple(map(round, b)), 1, max(1, round(rng.uniform(0.02, 0.07) * size)))
    return mask


def leaf_mask(image, quad, rng):
    """A shutter leaf on the wall, with its edge near the left or right border."""
    edge, top, bottom = rng.uniform(-0.05, 0.04), rng.uniform(-0.06, 0.02), rng.uniform(0.98, 1.06)
    polygon = [(-0.55, top), (edge, top), (edge, bottom), (-0.55, bottom)]
    return filled(image, in_plane(quad, polygon if rng.random() < 0.5 else [(1.0 - x, y) for x, y in polygon]))


def covered(make_mask, hue=None):
    def draw(image, quad, rng):
        ring = ring_of(image, quad)
        for _ in range(1000):
            mask = make_mask(image, quad, rng)
            if LEAST_HIDDEN <= (mask & ring).sum() / max(1, ring.sum()) <= MOST_HIDDEN:
                break
        return painted(mask, image, quad, rng, hue)
    return draw


KINDS = {"shadow": shadow, "overcast": overcast, "dusk": dusk, "wet": wet, "exposure": exposure,
         "person": covered(person_mask), "plants": covered(plants_mask, (50, 110, 70)), "rope": covered(rope_mask),
         "leaf": covered(leaf_mask)}


def redraw(views, folder, kind):
    folder.mkdir(parents=True, exist_ok=True)
    for row in rows_of(views / "truth.csv"):
        name = f"{row['scenario']}_{row['seed']}"
        for ending in (".reference.png", ".camera.yaml"):
            if (views / (name + ending)).exists():
                shutil.copy(views / (name + ending), folder)
        image = cv2.imread(str(views / f"{name}.png")).astype(np.float64)
        quad = np.array([float(row[c]) for c in CORNERS]).reshape(4, 2)
        if row["present"] != "1":  # no target: anywhere in the image
            quad = np.array([[0.3, 0.3], [0.7, 0.3], [0.7, 0.7], [0.3, 0.7]]) * image.shape[1::-1]
        drawn = KINDS[kind](image, quad, np.random.default_rng(zlib.crc32(f"{kind} {name}".encode())))
        cv2.imwrite(str(folder / f"{name}.png"), np.clip(np.round(drawn), 0, 255).astype(np.uint8))
    shutil.copy(views / "truth.csv", folder)  # last: its presence says that all are drawn


def counts(file):
    """(frames, count of each verdict, worst corners of the hits) of one frames.csv."""
    rows = rows_of(file)
    verdicts = [row["verdict"] for row in rows]
    corners = sorted(float(row["worst_corner_px"]) for row in rows if row["verdict"] == "hit")
    return len(rows), {v: verdicts.count(v) for v in set(verdicts)}, corners


def row_of(kind, file):
    frames, verdicts, corners = counts(file)
    number = {verdict: verdicts.get(verdict, 0) for verdict in ("hit", "inexact", "missed", "nothing")}
    wrong = frames - sum(number.values())
    quantiles = [f"{corners[int(part * len(corners))]:.3f}" if corners else "" for part in (0.5, 0.9)]
    return f"| {kind} | {frames} | {number['hit']} | {number['inexact']} | {number['missed'] + number['nothing']} " \
           f"| {wrong} | {quantiles[0]} | {quantiles[1]} |"


def parse():
    parser = Parser(__doc__)
    parser.add_argument("--views", required=True, type=pathlib.Path, help="folder written by survey_detector --save")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the images drawn and the tables")
    parser.add_argument("--kinds", nargs="+", choices=KINDS, default=list(KINDS), help="default: all")
    parser.add_argument("--tool", default=DEFAULT_TOOL, help="the program survey_detector")
    parser.add_argument("tool_arguments", nargs="*", help="after --: further options of survey_detector")
    return parser.parse_args()


def main():
    options = parse()
    print("| kind | frames | hit | inexact | nothing found | something else | worst corner of hits, median, px | 90 % |\n"
          "|---|---|---|---|---|---|---|---|")
    for kind in options.kinds:
        views, results = options.output / kind / "views", options.output / kind
        try:
            drawn, asked = views / "truth.csv", options.views / "truth.csv"
            if not drawn.exists() or drawn.read_bytes() != asked.read_bytes():
                redraw(options.views, views, kind)
        except OSError as error:
            print(f"evaluate_light_and_cover: {error.filename}: {error.strerror}", file=sys.stderr)
            return 2
        command = [options.tool, "--load", views, "--output", results, *options.tool_arguments]
        if subprocess.run(list(map(str, command)), stdout=subprocess.DEVNULL, check=False).returncode != 0:
            return 1
        print(row_of(kind, results / "frames.csv"), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
