#!/usr/bin/env python3
"""Runs detect_images on annotated photographs and prints tables: first without a reference, then with the reference of
each scene that has one, on that scene and on every image without a target.

Rules and the halves `tune` and `report` are as in evaluate_detections.py. With a reference every detection that is not on
an annotated quadrilateral is false.

The folder of --photos holds images/ and these tables:
  meta.csv         file, scene, tier (a group's name; `neg`: no target), exhaustive (`yes`: every window is annotated)
  annotations.csv  file, label, x1, y1, ..., x4, y4: a row a window's inner border, clockwise from the top left [px]
  refs.csv         may be missing: scene, taken_from_file, ref_with_margin (png: the target and a quarter of it all round)
"""
import os
import pathlib
import struct
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import evaluate_candidates  # noqa: E402
import evaluate_detections as rules  # noqa: E402
from ingress_tools import package_paths  # noqa: E402
from ingress_tools.command_line import Parser  # noqa: E402

MARGIN = 0.25  # of the `ref_with_margin` images, at each side [width or height of the target]
REFERENCES = "scene", "taken_from_file", "ref_with_margin"  # columns of refs.csv
CELL, COLUMNS = (280, 210), 8  # of the sheet of wrong images [px]
DEFAULT_TOOL = package_paths.program("detect_images") or "detect_images"


def png_size(path):
    with open(path, "rb") as file:
        return struct.unpack(">II", file.read(24)[16:])


def corners_in_reference(path):
    """The target's corners in an image that shows it in the middle, with a margin."""
    sides = []
    for size in png_size(path):
        inner = size / (1.0 + 2.0 * MARGIN)
        sides.append((0.5 * (size - inner) - 0.5, 0.5 * (size + inner) - 0.5))
    (left, right), (top, bottom) = sides
    return ",".join(f"{value:.2f}" for value in (left, top, right, top, right, bottom, left, bottom))


class Photographs:
    def __init__(self, options):
        self.options = options
        self.folder = options.photos
        self.meta = {row["file"]: row for row in rules.rows_of(self.folder / "meta.csv", rules.META)}
        self.annotations = rules.rows_of(self.folder / "annotations.csv", rules.ANNOTATIONS)
        self.references = rules.rows_of(self.folder / "refs.csv", REFERENCES) if (self.folder / "refs.csv").exists() else []
        self.candidates = []  # (title, records) of each run, with --candidates

    def run(self, name, files, leave_out=(), reference=None):
        """Records of these files, as `evaluate_detections.evaluate` makes them."""
        half = self.options.half
        files = [f for f in files if half in ("all", rules.half_of(self.meta[f]["scene"], f))]
        table = self.options.output / f"{name}.csv"
        command = [self.options.tool, "--output", table, *self.options.tool_arguments]
        if self.options.params:
            command += ["--params", self.options.params]
        if reference:
            command += ["--reference", reference, "--reference-corners", corners_in_reference(reference)]
        if self.options.overlay:
            command += ["--overlay", self.options.output / name]
        if self.options.candidates:
            command += ["--candidates", self.options.output / f"{name}_candidates.csv"]
        subprocess.run([*map(str, command), *(str(self.folder / "images" / file) for file in files)], check=True)
        if self.options.candidates:
            every = rules.rows_of(self.options.output / f"{name}_candidates.csv")
            self.candidates.append((name, evaluate_candidates.evaluate(every, self.annotations, self.meta, set(leave_out),
                                                                       self.options.iou)))
        return rules.evaluate(rules.rows_of(table), self.annotations, self.meta, set(leave_out), self.options.iou)

    def without_reference(self):
        return self.run("without_reference", sorted(self.meta))

    def with_reference(self, row):
        files = sorted(f for f, info in self.meta.items() if info["scene"] == row["scene"] or info["tier"] == "neg")
        return self.run(row["scene"], files, [row["taken_from_file"]], self.folder / row["ref_with_margin"])


def precision(records):
    """(rate, count) over detections in images whose every target is annotated."""
    detected = rules.exhaustive_detections(records)
    return rules.rate(r["hit"] for r in detected), len(detected)


def alarms(records):
    return f"{sum(r['detected'] for r in records)} of {len(records)}"


def milliseconds(records):
    times = sorted(r["ms"] for r in records)
    return f"{times[len(times) // 2]:.2f}" if times else ""


def print_without_reference(records, per_scene):
    print("| tier | scenes | recall, scenes averaged | recall over images | precision where exhaustive | median ms |")
    print("|---|---|---|---|---|---|")
    targets = [r for r in records if r["target"]]
    for tier in sorted({r["tier"] for r in targets}):
        some = [r for r in targets if r["tier"] == tier]
        exact, count = precision(some)
        print(f"| {tier} | {len({r['scene'] for r in some})} | {rules.percent(rules.macro(some, lambda r: r['hit']))} "
              f"| {sum(r['hit'] for r in some)} of {len(some)} | {rules.percent(exact)}{f' of {count}' if count else ''} "
              f"| {milliseconds(some)} |")
    exact, count = precision(records)
    print(f"\nAll tiers where exhaustive: {f'precision {rules.percent(exact)} of {count}' if count else 'no'} detections.")
    for name, hard in (("without a target", False), ("with other rectangles", True)):
        some = [r for r in records if not r["target"] and r["hard"] == hard]
        print(f"Images {name}: {f'false alarms on {alarms(some)}' if some else 'none'}.")
    if per_scene:
        print("\n| scene | tier | found |\n|---|---|---|")
        for tier, scene in sorted({(r["tier"], r["scene"]) for r in targets}):
            some = [r for r in targets if r["scene"] == scene]
            print(f"| {scene} | {tier} | {sum(r['hit'] for r in some)} of {len(some)} |")


def print_with_reference(runs):
    print("| reference of | recall | precision | false alarms on all negatives | of those, with other rectangles |")
    print("|---|---|---|---|---|")
    for scene, records in runs:
        own = [r for r in records if r["target"]]
        negatives = [r for r in records if not r["target"]]
        detected = [r for r in own if r["detected"]]
        print(f"| {scene} | {rules.percent(rules.rate(r['hit'] for r in own))} of {len(own)} "
              f"| {rules.percent(rules.rate(r['hit'] for r in detected))} of {len(detected)} | {alarms(negatives)} "
              f"({rules.percent(rules.rate(r['detected'] for r in negatives))}) | {alarms([r for r in negatives if r['hard']])} |")


def sheet(photographs, records, path):
    """Draws every wrong image: annotated quadrilaterals in white, the detection in red."""
    import cv2  # needed here only
    import numpy

    annotated, cells = rules.targets_of(photographs.annotations), []
    for r in rules.wrong(records):
        image = cv2.imread(str(photographs.folder / "images" / r["file"]), cv2.IMREAD_COLOR)
        scale = min(CELL[0] / image.shape[1], CELL[1] / image.shape[0])
        small = cv2.resize(image, None, fx=scale, fy=scale,
                           interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        for quad, colour in [(q, (255, 255, 255)) for q in annotated[r["file"]]] + [(r["found"], (0, 0, 255))]:
            if quad:
                points = numpy.array([[(x + 0.5) * scale - 0.5, (y + 0.5) * scale - 0.5] for x, y in quad])
                cv2.polylines(small, [numpy.round(points * 16).astype(numpy.int32)], True, colour, 1, cv2.LINE_AA, 4)
        cell = numpy.zeros((CELL[1] + 16, CELL[0], 3), numpy.uint8)
        cell[16:16 + small.shape[0], :small.shape[1]] = small
        said = f"{r['iou']:.2f}" if r["detected"] else r["reason"]
        cv2.putText(cell, f"{r['file'][-26:-4]} {said}", (2, 12), cv2.FONT_HERSHEY_SIMPLEX, 0.38, (255, 255, 255))
        cells.append(cell)
    while len(cells) % COLUMNS:
        cells.append(numpy.zeros_like(cells[0]))
    if cells:
        rows = [numpy.hstack(cells[i:i + COLUMNS]) for i in range(0, len(cells), COLUMNS)]
        cv2.imwrite(str(path), numpy.vstack(rows))


def parse():
    parser = Parser(__doc__)
    parser.add_argument("--photos", required=True, type=pathlib.Path, help="folder, see above")
    parser.add_argument("--output", required=True, type=pathlib.Path, help="folder for the csv files")
    parser.add_argument("--tool", default=DEFAULT_TOOL, help="the program detect_images")
    parser.add_argument("--params", help="yaml file laid over the defaults, as config:= of launch files")
    parser.add_argument("--half", choices=("all", "tune", "report"), default="all", help="only images of this half")
    parser.add_argument("--iou", type=float, default=rules.SAME_IOU)
    parser.add_argument("--per-scene", action="store_true")
    parser.add_argument("--misses", action="store_true", help="list the targets that were missed and the false detections")
    parser.add_argument("--sheets", action="store_true", help="draw those images: OUTPUT/*_wrong.png")
    parser.add_argument("--candidates", action="store_true", help="recall among all candidates, and why the right one lost")
    parser.add_argument("--overlay", action="store_true", help="also draw what happened to each candidate")
    parser.add_argument("tool_arguments", nargs="*", help="after --: further options of detect_images")
    return parser.parse_args()


def main():
    options = parse()
    options.output.mkdir(parents=True, exist_ok=True)
    try:
        photographs = Photographs(options)
        plain = photographs.without_reference()
        runs = [(row["scene"], photographs.with_reference(row)) for row in photographs.references]
    except OSError as error:
        print(f"evaluate_photos: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except subprocess.CalledProcessError as error:
        print(f"evaluate_photos: {os.path.basename(error.cmd[0])} failed", file=sys.stderr)
        return 1
    print(f"## Without a reference, images: {options.half}\n")
    print_without_reference(plain, options.per_scene)
    print("\n## With a reference\n")
    print_with_reference(runs)
    if options.candidates:
        print(f"\n## Candidates\n\n{evaluate_candidates.HEADER}")
        for title, records in photographs.candidates:
            evaluate_candidates.print_table(records, title, options.per_scene)
    for title, records in [("without_reference", plain), *runs]:
        if options.misses:
            print(f"\n## Not found, or found wrongly: {title}\n")
            rules.print_misses(records)
        if options.sheets:
            sheet(photographs, records, options.output / f"{title}_wrong.png")
    return 0


if __name__ == "__main__":
    sys.exit(main())
