#!/usr/bin/env python3
"""Shows where annotated quadrilaterals get lost. Reads a csv of `detect_images --candidates`, and prints recall among the
first 1, 10, 50 and all candidates of the search, and why the right one was not chosen.

A candidate is right if it overlaps an annotated quadrilateral by IoU >= 0.7. An image counts once, whichever of its
quadrilaterals was found. Rates are averaged over scenes, as in evaluate_detections.py. Labels that end in _small are
ignored.
"""
import collections
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
import evaluate_detections as rules  # noqa: E402
from ingress_tools.command_line import fail  # noqa: E402

FIRST = (1, 10, 50)


def is_proposed(candidate):
    return candidate["proposed"] != ""


def fate(right):
    """What stopped the candidate on the target that came furthest; `unseen` if there is none."""
    if not right:
        return "unseen"
    furthest = max(right, key=lambda c: (c["reason"] == "none", c["reason"] != "duplicate", float(c["score"]), is_proposed(c)))
    return "chosen" if furthest["reason"] == "none" else furthest["reason"]


def evaluate(candidates, annotations, meta, leave_out, min_iou):
    """One record per image with a target."""
    quads, of_image = rules.targets_of(annotations), collections.defaultdict(list)
    for row in candidates:
        of_image[os.path.basename(row["file"])].append(row)
    records = []
    for name in sorted(of_image):
        if name not in meta or name in leave_out or not quads[name]:
            continue
        right, seen = [], set()
        for candidate in of_image[name]:
            quad = rules.corners(candidate)
            on = [i for i, target in enumerate(quads[name]) if rules.iou(quad, target) >= min_iou]
            if on:
                right.append(candidate)
                seen.update(on)
        places = [int(c["proposed"]) for c in right if is_proposed(c)]
        records.append({"file": name, "scene": meta[name]["scene"], "tier": meta[name]["tier"], "fate": fate(right),
                        "place": min(places, default=None), "any": bool(right), "chosen": fate(right) == "chosen",
                        "targets": len(quads[name]), "seen": len(seen)})
    return records


def among(records, first):
    return rules.macro(records, lambda r: r["place"] is not None and r["place"] <= first)


HEADER = ("| images | number | chosen | among first " + " | ".join(map(str, FIRST)) + " | proposed | seen at all | of all annotated | lost to |\n"
          "|" + "---|" * (len(FIRST) + 7))


def table_row(title, records):
    lost = collections.Counter(r["fate"] for r in records if not r["chosen"])
    said = ", ".join(f"{reason} {count}" for reason, count in lost.most_common())
    every = rules.rate([1] * sum(r["seen"] for r in records) + [0] * sum(r["targets"] - r["seen"] for r in records))
    cells = [rules.macro(records, lambda r: r["chosen"]), *(among(records, first) for first in FIRST), among(records, 10**9),
             rules.macro(records, lambda r: r["any"]), every]
    return f"| {title} | {len(records)} | " + " | ".join(map(rules.percent, cells)) + f" | {said} |"


def print_table(records, title="", per_scene=False):
    if title == "":
        print(HEADER)
    for tier in sorted({r["tier"] for r in records}):
        some = [r for r in records if r["tier"] == tier]
        print(table_row(f"{title or 'tier'} {tier}", some))
        for scene in sorted({r["scene"] for r in some}) if per_scene else []:
            print(table_row(scene, [r for r in some if r["scene"] == scene]))


def main():
    options = rules.parser_for(__doc__, "candidates", "csv of detect_images --candidates").parse_args()
    candidates, annotations, meta = rules.read_judged("evaluate_candidates", options.candidates, options)
    records = rules.only(evaluate(candidates, annotations, meta, set(options.leave_out), options.iou), options.half)
    if not records:
        fail(1, f"evaluate_candidates: {options.candidates}: no image of {options.meta} with a target in it")
    print_table(records, per_scene=options.per_scene)


if __name__ == "__main__":
    main()
