#!/usr/bin/env python3
"""Recall and precision of a csv of detect_images against annotated quadrilaterals.

An image counts as found if its detection overlaps any annotated quadrilateral by IoU >= 0.7. Rates are averaged over
scenes, not over images. Precision counts detections on images whose every target is annotated; detections on images
without a target are false alarms. Labels that start with pose_only_, or end in _small, are no targets.

A hash of scene and file name splits the images into two halves: tune on the half `tune`, measure what you report on the
half `report`. Names that differ only in their last digit (neighbours in a video) are in the same half.
"""
import collections
import hashlib
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from ingress_tools.command_line import Parser, fail, rows_of  # noqa: E402

SAME_IOU = 0.7  # from this overlap on the right window was found
ANNOTATIONS = "file", "label", *(f"{axis}{i}" for i in range(1, 5) for axis in "xy")  # columns of these tables
META = "file", "scene", "tier", "exhaustive"


def cross(o, a, b):
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def area(polygon):
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(polygon, polygon[1:] + polygon[:1]))


def clockwise(polygon):
    return polygon if area(polygon) >= 0 else polygon[::-1]


def intersection_area(p, q):
    """Area shared by two convex polygons: p clipped by each side of q."""
    clipper = clockwise(q)
    for a, b in zip(clipper, clipper[1:] + clipper[:1]):
        kept = []
        for s, e in zip(p, p[1:] + p[:1]):
            ds, de = cross(a, b, s), cross(a, b, e)
            if ds >= 0:
                kept.append(s)
            if (ds < 0) != (de < 0):
                t = ds / (ds - de)
                kept.append((s[0] + t * (e[0] - s[0]), s[1] + t * (e[1] - s[1])))
        p = kept
        if not p:
            return 0.0
    return abs(area(p))


def iou(p, q):
    shared = intersection_area(p, q)
    united = abs(area(p)) + abs(area(q)) - shared
    return shared / united if united > 0 else 0.0


def corners(row):
    if not all(row[f"x{i}"] for i in range(1, 5)):
        return None
    return [(float(row[f"x{i}"]), float(row[f"y{i}"])) for i in range(1, 5)]


def read_judged(tool, table, options):
    """(rows of the table, annotations, {file: its row in the list of images}); exits if one cannot be read."""
    try:
        rows, annotations, meta = rows_of(table), rows_of(options.annotations, ANNOTATIONS), rows_of(options.meta, META)
    except OSError as error:
        fail(2, f"{tool}: {error.filename}: {error.strerror}")
    return rows, annotations, {row["file"]: row for row in meta}


def is_target(row):
    """False for annotations with another purpose."""
    return not row["label"].startswith("pose_only_") and not row["label"].endswith("_small")


def targets_of(annotations):
    """{file: quadrilaterals of its targets}"""
    quads = collections.defaultdict(list)
    for row in annotations:
        if row["x1"] and is_target(row):
            quads[row["file"]].append(corners(row))
    return quads


def half_of(scene, name):
    """"tune" or "report"."""
    stem = os.path.splitext(os.path.basename(name))[0]
    key = scene + "/" + re.sub(r"[0-9]$", "", stem)
    return ("tune", "report")[hashlib.md5(key.encode()).digest()[0] & 1]


def only(records, half):
    return [r for r in records if half == "all" or half_of(r["scene"], r["file"]) == half]


def evaluate(detections, annotations, meta, leave_out, min_iou):
    """One record per image: scene, tier, whether it holds a target, detected, overlap with the best target."""
    quads = targets_of(annotations)
    hard = {row["file"] for row in annotations if row["label"] == "negative_hard"}
    records = []
    for row in detections:
        name = os.path.basename(row["file"])
        if name not in meta or name in leave_out:
            continue
        info, found = meta[name], corners(row) if row["detected"] == "1" else None
        best = max((iou(found, q) for q in quads[name]), default=0.0) if found else 0.0
        if not quads[name] and info["tier"] != "neg":
            continue
        records.append({"file": name, "scene": info["scene"], "tier": info["tier"], "hard": name in hard,
                        "target": bool(quads[name]), "exhaustive": info["exhaustive"] == "yes",
                        "detected": found is not None, "iou": best, "hit": best >= min_iou, "found": found,
                        "score": float(row["score"] or 0), "reason": row["reject_reason"], "ms": float(row["milliseconds"] or 0)})
    return records


def percent(value):
    return "" if value != value else f"{100.0 * value:.1f} %"


def rate(hits):
    hits = list(hits)
    return sum(hits) / len(hits) if hits else float("nan")


def macro(records, key):
    scenes = collections.defaultdict(list)
    for r in records:
        scenes[r["scene"]].append(key(r))
    return rate(rate(v) for v in scenes.values())


def exhaustive_detections(records):
    """Detections on images whose every target is annotated."""
    return [r for r in records if r["detected"] and r["target"] and r["exhaustive"]]


def report(records, title, per_scene):
    print(f"== {title}: {len(records)} images")
    targets = [r for r in records if r["target"]]
    for tier in sorted({r["tier"] for r in targets}):
        some = [r for r in targets if r["tier"] == tier]
        print(f"tier {tier}: recall {macro(some, lambda r: r['hit']):6.1%} over {len({r['scene'] for r in some})} scenes"
              f" ({rate(r['hit'] for r in some):.1%} of {len(some)} images), detected {rate(r['detected'] for r in some):.1%}")
    if per_scene:
        for scene in sorted({r["scene"] for r in targets}):
            some = [r for r in targets if r["scene"] == scene]
            print(f"  {scene:62s} {sum(r['hit'] for r in some):3d} of {len(some):3d}")
    for name, some in (("negatives", [r for r in records if not r["target"] and not r["hard"]]),
                       ("hard negatives (for use with a reference)",
                        [r for r in records if not r["target"] and r["hard"]])):
        if some:
            print(f"{name}: false alarms on {sum(r['detected'] for r in some)} of {len(some)} images")
    detected = exhaustive_detections(records)
    if detected:
        print(f"exhaustively annotated: precision {rate(r['hit'] for r in detected):.1%} of {len(detected)} detections")
    if records:
        times = sorted(r["ms"] for r in records)
        print(f"time: median {times[len(times) // 2]:.2f} ms, largest {times[-1]:.2f} ms")


def wrong(records):
    """Missed targets and false detections."""
    return [r for r in records if not r["hit"] and (r["target"] or r["detected"])]


def print_misses(records):
    for r in wrong(records):
        said = f"iou {r['iou']:.2f} score {r['score']:.2f}" if r["detected"] else r["reason"]
        print(f"{r['tier']:3s} {r['scene'][:44]:44s} {r['file']:46s} {said}")


def parser_for(description, table, text):
    """Options of the tools that compare a csv with annotations."""
    parser = Parser(description)
    parser.add_argument(table, help=text)
    parser.add_argument("--annotations", required=True)
    parser.add_argument("--meta", required=True)
    parser.add_argument("--leave-out", action="append", default=[], metavar="FILE", help="image that the reference was cut from")
    parser.add_argument("--iou", type=float, default=SAME_IOU)
    parser.add_argument("--half", choices=("all", "tune", "report"), default="all", help="only images of this half")
    parser.add_argument("--per-scene", action="store_true")
    return parser


def main():
    parser = parser_for(__doc__, "detections", "csv of detect_images")
    parser.add_argument("--misses", action="store_true", help="list the images whose target was not found")
    options = parser.parse_args()
    detections, annotations, meta = read_judged("evaluate_detections", options.detections, options)
    records = evaluate(detections, annotations, meta, set(options.leave_out), options.iou)
    if not records:
        fail(1, f"evaluate_detections: {options.detections}: no image of {options.meta} in it")
    records = only(records, options.half)
    report(records, options.half, options.per_scene)
    if options.misses:
        print_misses(records)


if __name__ == "__main__":
    main()
