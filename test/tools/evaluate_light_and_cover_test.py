"""Light and covers drawn over views: reproducible, of the stated strength, and only where they belong."""
import csv

import cv2
import numpy as np
import pytest

import evaluate_light_and_cover as drawing

QUAD = np.array([[120, 80], [210, 85], [208, 165], [118, 160]], float)
COVERS = ("person", "plants", "rope", "leaf")


def wall():
    image = np.full((240, 320, 3), (150, 160, 170), np.uint8)
    cv2.fillPoly(image, [np.round(QUAD).astype(np.int32)], (40, 40, 40))
    return image.astype(np.float64)


def drawn(kind, seed=1):
    return drawing.KINDS[kind](wall(), QUAD, np.random.default_rng(seed))


@pytest.mark.parametrize("kind", drawing.KINDS)
def test_one_seed_gives_the_same_image(kind):
    assert np.array_equal(drawn(kind), drawn(kind))
    assert drawn(kind).shape == wall().shape


@pytest.mark.parametrize("kind", COVERS)
def test_covers_hide_a_tenth_to_a_third_of_the_ring(kind):
    ring = drawing.ring_of(wall(), QUAD).astype(bool)
    for seed in range(5):
        hidden = (np.abs(drawn(kind, seed) - wall()).max(2) > 1.0)[ring].mean()
        assert drawing.LEAST_HIDDEN - 0.02 < hidden < drawing.MOST_HIDDEN + 0.12, "edges are smooth"


@pytest.mark.parametrize("kind", ["shadow", "overcast", "dusk", "wet"])
def test_less_light_makes_nothing_brighter(kind):
    assert (drawn(kind) <= 1.15 * wall() + 10.0).all()
    assert drawn(kind).mean() < wall().mean()


def test_a_folder_of_views_is_redrawn_with_its_truth(tmp_path):
    views, folder = tmp_path / "views", tmp_path / "dusk"
    views.mkdir()
    row = {"scenario": "wall", "seed": "7", "present": "1", **dict(zip(drawing.CORNERS, QUAD.ravel()))}
    with open(views / "truth.csv", "w", newline="") as file:
        table = csv.DictWriter(file, row)
        table.writeheader()
        table.writerow(row)
    cv2.imwrite(str(views / "wall_7.png"), wall())
    cv2.imwrite(str(views / "wall_7.reference.png"), wall())
    drawing.redraw(views, folder, "dusk")
    assert (folder / "truth.csv").read_bytes() == (views / "truth.csv").read_bytes()
    assert (folder / "wall_7.reference.png").read_bytes() == (views / "wall_7.reference.png").read_bytes()
    assert cv2.imread(str(folder / "wall_7.png")).mean() < 0.5 * wall().mean()
