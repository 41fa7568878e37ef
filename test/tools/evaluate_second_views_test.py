"""Rendered second views: reproducible, with the windows at the places in the table, and an honest verdict."""
import csv
import sys

import cv2
import numpy as np
import pytest

import evaluate_second_views as views
from ingress_tools import package_paths
from repository import call

WINDOWS = np.array([[[200, 200], [360, 205], [358, 330], [202, 326]], [[600, 210], [760, 210], [760, 330], [600, 330]]], float)


@pytest.fixture
def photos(tmp_path):
    """Two photographs of walls of coloured stones, with two windows each."""
    (tmp_path / "images").mkdir()
    with open(tmp_path / "annotations.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["file", *(f"{axis}{i}" for i in range(1, 5) for axis in "xy"), "label"])
        for seed, name in enumerate(("a.png", "b.png")):
            rng = np.random.default_rng(seed)
            stones = rng.integers(110, 200, (24, 32, 3)).astype(np.uint8)
            image = cv2.resize(stones, (1024, 768), interpolation=cv2.INTER_NEAREST)
            for quad in WINDOWS:
                cv2.fillPoly(image, [np.round(quad).astype(np.int32)], (40, 40, 45))
                table.writerow([name, *quad.ravel(), "window"])
            cv2.imwrite(str(tmp_path / "images" / name), image)
    return tmp_path


def test_one_seed_draws_the_same_and_the_corners_lie_on_the_windows(photos, tmp_path):
    folders = [tmp_path / name for name in ("one", "two")]
    for folder in folders:
        folder.mkdir()
    drawn, again = (views.draw_all(photos, folder, 5) for folder in folders)
    assert drawn and list(drawn) == list(again)
    for name, (at, target, others) in drawn.items():
        view = cv2.imread(str(folders[0] / f"{name}.png"))
        assert np.array_equal(view, cv2.imread(str(folders[1] / f"{name}.png")))
        inside = np.zeros(view.shape[:2], np.uint8)
        cv2.fillPoly(inside, [np.round(target).astype(np.int32)], 1)
        inside = cv2.erode(inside, np.ones((7, 7), np.uint8)).astype(bool)
        assert view[inside].mean() < 0.6 * np.median(view), "a window is dark, the wall is not"
        reference = cv2.imread(str(folders[0] / f"{name}.reference.png"))
        assert (at.min() > 0) and (at.max(0) < reference.shape[1::-1]).all()
        assert len(others) == 1


def test_a_verdict_tells_the_target_from_its_twin():
    target, twin = WINDOWS.tolist()
    assert views.verdict(target, target, [twin]) == "right"
    assert views.verdict(twin, target, [twin]) == "twin"
    assert views.verdict([[0, 0], [9, 0], [9, 9], [0, 9]], target, [twin]) == "elsewhere"
    assert views.verdict(None, target, [twin]) == "nothing"


def test_windows_among_stones_are_found_and_no_other(photos, tmp_path):
    tool = package_paths.program("detect_images")
    if not tool:
        pytest.skip("detect_images is not built")
    run = call(sys.executable, views.__file__, "--photos", photos, "--output", tmp_path / "out", "--tool", tool, "--seed", "5")
    count = [cell.strip() for cell in run.stdout.splitlines()[-1].split("|")[1:-1]]
    assert int(count[0]) >= 3 and count[1] == count[0], run.stdout
    assert count[-1].startswith("0 of "), run.stdout


def test_a_folder_without_annotations_is_refused(tmp_path):
    run = call(sys.executable, views.__file__, "--photos", tmp_path, "--output", tmp_path / "out")
    assert run.returncode != 0 and "annotations.csv" in run.stderr
