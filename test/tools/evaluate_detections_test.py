"""Results of the scripts for detections of known quality."""
import csv
import math
import sys

import cv2
import numpy
import pytest

import evaluate_candidates as candidates
import evaluate_detections as rules
import evaluate_photos as photos
import evaluate_sequence as sequence
from repository import ROOT, call

SQUARE = [(10.0, 10.0), (50.0, 10.0), (50.0, 50.0), (10.0, 50.0)]
META = {name: {"file": name, "scene": scene, "tier": tier, "exhaustive": exhaustive}
        for name, scene, tier, exhaustive in [("a1.jpg", "many", "A", "yes"), ("a2.jpg", "many", "A", "yes"),
                                              ("a3.jpg", "many", "A", "no"), ("b1.jpg", "one", "A", "no"),
                                              ("n1.jpg", "none", "neg", ""), ("n2.jpg", "none", "neg", "")]}


def row(name, quad=None, **more):
    corners = {f"{axis}{i + 1}": str(quad[i][k]) if quad else "" for i in range(4) for k, axis in enumerate("xy")}
    return {"file": name, "detected": "1" if quad else "0", "score": "", "milliseconds": "2", "reject_reason": "score",
            "label": "window", **corners, **more}


def shifted(quad, by):
    return [(x + by, y) for x, y in quad]


@pytest.fixture
def records():
    annotations = [row(name, SQUARE) for name in ("a1.jpg", "a2.jpg", "a3.jpg", "b1.jpg")]
    annotations.append(row("n2.jpg", label="negative_hard"))
    detections = [row("x/a1.jpg", SQUARE), row("x/a2.jpg", shifted(SQUARE, 30.0)), row("x/a3.jpg", None),
                  row("x/b1.jpg", shifted(SQUARE, 2.0)), row("x/n1.jpg", SQUARE), row("x/n2.jpg", None)]
    return rules.evaluate(detections, annotations, META, set(), 0.7)


def test_overlap_of_squares():
    assert rules.iou(SQUARE, SQUARE) == pytest.approx(1.0)
    assert rules.iou(SQUARE, shifted(SQUARE, 20.0)) == pytest.approx(1.0 / 3.0)
    assert rules.iou(SQUARE, shifted(SQUARE, 40.0)) == pytest.approx(0.0)
    assert rules.iou(SQUARE, SQUARE[::-1]) == pytest.approx(1.0)


def test_recall_is_averaged_over_scenes(records):
    targets = [r for r in records if r["target"]]
    assert rules.rate(r["hit"] for r in targets) == pytest.approx(2 / 4)
    assert rules.macro(targets, lambda r: r["hit"]) == pytest.approx((1 / 3 + 1.0) / 2)


def candidate(name, quad, proposed, reason, score="0"):
    return {**row(name, quad), "proposed": proposed, "reason": reason, "score": score}


def test_the_right_candidate_is_looked_for_where_the_search_put_it():
    annotations = [row(name, SQUARE) for name in ("a1.jpg", "a2.jpg", "b1.jpg")]
    annotations.append(row("a3.jpg", SQUARE, label="window_small"))
    table = [candidate("x/a1.jpg", shifted(SQUARE, 30.0), "1", "outscored"), candidate("x/a1.jpg", SQUARE, "2", "none"),
             candidate("x/a2.jpg", SQUARE, "12", "duplicate", "0.9"), candidate("x/a2.jpg", SQUARE, "", "score", "0.3"),
             candidate("x/a3.jpg", SQUARE, "1", "none"), candidate("x/b1.jpg", shifted(SQUARE, 30.0), "1", "none")]
    found = candidates.evaluate(table, annotations, META, set(), 0.7)
    assert [(r["file"], r["place"], r["fate"]) for r in found] == [("a1.jpg", 2, "chosen"), ("a2.jpg", 12, "score"),
                                                                  ("b1.jpg", None, "unseen")]
    assert candidates.among(found, 1) == pytest.approx(0.0)
    assert candidates.among(found, 10) == pytest.approx((1 / 2 + 0) / 2)
    assert candidates.among(found, 50) == pytest.approx((1 + 0) / 2)


def test_precision_counts_only_what_is_annotated_exhaustively(records):
    assert photos.precision(records) == (pytest.approx(0.5), 2)
    negatives = [r for r in records if not r["target"]]
    assert photos.alarms(negatives) == "1 of 2"
    assert [r["hard"] for r in negatives] == [False, True]


def test_rate_of_nothing_is_no_number():
    assert math.isnan(rules.rate([]))
    assert rules.percent(rules.rate([])) == ""


def test_halves_are_fixed_and_keep_neighbours_of_a_video_together():
    names = [f"video_{i:05d}.jpg" for i in range(400)]
    halves = [rules.half_of("hall", name) for name in names]
    assert halves == [rules.half_of("hall", name) for name in names]
    assert all(len(set(halves[i:i + 10])) == 1 for i in range(0, 400, 10))
    assert 0.3 < halves.count("tune") / 400 < 0.7


def test_every_record_is_in_one_half(records):
    assert len(rules.only(records, "tune")) + len(rules.only(records, "report")) == len(records)
    assert rules.only(records, "all") == records


def test_corners_in_a_reference_with_margin(tmp_path):
    cv2.imwrite(str(tmp_path / "r.png"), numpy.zeros((120, 150, 3), numpy.uint8))
    values = [float(v) for v in photos.corners_in_reference(tmp_path / "r.png").split(",")]
    assert values == pytest.approx([24.5, 19.5, 124.5, 19.5, 124.5, 99.5, 24.5, 99.5])


def test_sequence_corners_in_any_cyclic_order():
    turned = SQUARE[2:] + SQUARE[:2]
    assert sequence.corner_errors(turned, SQUARE) == [0.0] * 4
    assert sequence.corner_errors(shifted(turned, 1.5), SQUARE) == pytest.approx([1.5] * 4)


def test_sequence_counts_missing_partial_and_wrong_as_lost():
    partial = row("f", SQUARE)
    partial["x3"] = partial["y3"] = ""
    found = [row("f", SQUARE, target_id="1"), row("f", None), partial, row("f", shifted(SQUARE, 30.0))]
    frames = sequence.score(found, [row("f", SQUARE)] * 4)
    assert [tracked for tracked, _, _ in frames] == [True, False, False, False]
    assert frames[0][1] == [0.0] * 4


def draw_window(shift):
    image = numpy.full((240, 320, 3), 200, numpy.uint8)
    cv2.rectangle(image, (80 + shift, 60), (220 + shift, 170), (20, 95, 225), -1)
    cv2.rectangle(image, (95 + shift, 75), (205 + shift, 155), (40, 40, 40), -1)
    image = cv2.GaussianBlur(image, (0, 0), 0.6)  # no camera gives steps without any blur
    return image, [(94.5 + shift, 74.5), (205.5 + shift, 74.5), (205.5 + shift, 155.5), (94.5 + shift, 155.5)]


def test_a_window_that_moves_is_followed(tmp_path):
    with open(tmp_path / "gt.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, ["file"] + [f"{axis}{i}" for i in range(1, 5) for axis in "xy"])
        writer.writeheader()
        for i in range(6):
            image, quad = draw_window(2 * i)
            cv2.imwrite(str(tmp_path / f"{i}.png"), image)
            corners = {f"{axis}{k + 1}": quad[k][j] for k in range(4) for j, axis in enumerate("xy")}
            writer.writerow({"file": f"{i}.png", **corners})
    tool = next(path for path in (ROOT / "build/ros/devel/lib/window_ingress/detect_images",
                                  ROOT / "build/core/detect_images") if path.exists())
    done = call(sys.executable, ROOT / "tools/evaluate_sequence.py", tmp_path, "--output", tmp_path / "out", "--tool", tool)
    assert done.returncode == 0, done.stderr
    assert "6 frames, tracked in 6, lost in 0" in done.stdout
    assert "target numbers: 1\n" in done.stdout


def test_a_table_that_lacks_columns_is_refused_by_name(tmp_path):
    (tmp_path / "meta.csv").write_text("file,scene\na.jpg,garden\n")
    (tmp_path / "annotations.csv").write_text("file,label\n")
    done = call("/usr/bin/python3", ROOT / "tools/evaluate_photos.py", "--photos", tmp_path, "--output", tmp_path / "out")
    assert done.returncode == 2 and done.stderr == f"{tmp_path}/meta.csv: has no column tier, exhaustive\n", done.stderr
