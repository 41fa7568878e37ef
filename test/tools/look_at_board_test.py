"""look_at_board.py: the whole board is in every image, and the views differ enough for a calibrator."""
import numpy
import pytest

from ingress_tools.transforms import matrix_of
from repository import load

pytest.importorskip("rospy")
look_at_board = load("nodes/look_at_board.py")

FOCAL, CENTRE = 467.74, (319.5, 239.5)  # of the default camera, 640 x 480
VIEWS = look_at_board.FAR + look_at_board.TILTED + look_at_board.NEAR
CORNERS = [(5.0, 0.1 * (3.5 - column), 1.5 + 0.1 * (2.5 - row)) for row in range(6) for column in range(8)]


def seen(view):
    """Pixels of the inner corners. The camera is at the vehicle's centre: x forward, y left, z up."""
    place, angles = look_at_board.pose(*view)
    forward, left, up = matrix_of(look_at_board.quaternion(*angles)).T @ (numpy.array(CORNERS) - place).T
    assert (forward > 0.3).all()
    return numpy.stack([CENTRE[0] - FOCAL * left / forward, CENTRE[1] - FOCAL * up / forward])


@pytest.mark.parametrize("view", VIEWS)
def test_the_whole_board_is_in_the_image(view):
    u, v = seen(view)
    assert 0 <= u.min() and u.max() < 640 and 0 <= v.min() and v.max() < 480


def test_near_and_far_and_in_all_parts_of_the_image():
    pixels = numpy.array([seen(view) for view in VIEWS])
    widths = numpy.ptp(pixels[:, 0], axis=1)
    assert widths.max() > 2.5 * widths.min()
    assert pixels[:, 0].min() < 60 and pixels[:, 0].max() > 580 and pixels[:, 1].min() < 60 and pixels[:, 1].max() > 420


def test_halfway_between_two_views_is_neither():
    a, b = look_at_board.FAR[0], look_at_board.FAR[1]
    assert look_at_board.between(a, b, 0.0) == pytest.approx(a) and look_at_board.between(a, b, 1.0) == pytest.approx(b)
    assert look_at_board.between(a, b, 0.5) == pytest.approx([0.5 * (x + y) for x, y in zip(a, b)])
