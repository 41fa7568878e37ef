"""Odometry of a camera carried in front of a window: it moves like the camera, and stands when it sees nothing."""
import numpy
import pytest

from ingress_tools.hand_odometry import HEIGHT_M, R_BODY_CAMERA, HandOdometry
from ingress_tools.transforms import matrix_of, quaternion_of

RATE_HZ = 30.0


def turn(yaw, pitch=0.0, roll=0.0):
    def about(axis, angle):
        half = angle / 2
        return matrix_of([*(numpy.sin(half) * numpy.eye(3)[axis]), numpy.cos(half)])
    return about(2, yaw) @ about(1, pitch) @ about(0, roll)


def seen(place, rotation, window=(3.0, 0.0, 0.0)):
    """The window (its axes are the room's) in the camera of a body at this place and attitude."""
    return R_BODY_CAMERA.T @ rotation.T, R_BODY_CAMERA.T @ rotation.T @ (numpy.array(window) - place)


def carried(hand, places, rotations, noise=0.0):
    random = numpy.random.default_rng(1)
    for i, (place, rotation) in enumerate(zip(places, rotations)):
        shaken = rotation @ turn(*(noise * random.normal(size=3)))
        hand.see(i / RATE_HZ, [seen(numpy.asarray(place), shaken)])
    return (len(places) - 1) / RATE_HZ


def test_walks_towards_the_window_at_the_speed_that_it_is_carried():
    hand = HandOdometry()
    end_s = carried(hand, [(0.4 * i / RATE_HZ, 0.0, 0.0) for i in range(90)], [numpy.eye(3)] * 90)
    place, velocity, rotation = hand.at(end_s)
    assert place == pytest.approx([1.18, 0.0, HEIGHT_M], abs=0.05)
    assert velocity == pytest.approx([0.4, 0.0, 0.0], abs=0.02)
    assert rotation == pytest.approx(numpy.eye(3), abs=1e-6)


def test_sees_how_it_is_turned_and_that_it_goes_sideways():
    hand = HandOdometry()
    attitude = turn(0.3, 0.1, -0.05)
    end_s = carried(hand, [(0.0, 0.2 * i / RATE_HZ, 0.0) for i in range(60)], [attitude] * 60)
    _, velocity, rotation = hand.at(end_s)
    level = turn(0.3).T @ rotation @ turn(0.3)  # odom begins with the nose ahead
    assert numpy.linalg.norm(velocity) == pytest.approx(0.2, abs=0.02)
    assert numpy.arcsin(-rotation[2, 0]) == pytest.approx(0.1, abs=0.02) and abs(level[1, 0]) < 0.05


def test_noise_of_the_turn_does_not_become_a_dance():
    hand = HandOdometry()
    end_s = carried(hand, [(0.0, 0.0, 0.0)] * 120, [numpy.eye(3)] * 120, noise=0.01)
    place, velocity, _ = hand.at(end_s)
    assert place == pytest.approx([0.0, 0.0, HEIGHT_M], abs=0.08) and numpy.linalg.norm(velocity) < 0.15


def test_a_window_elsewhere_is_no_hand_that_flies():
    hand = HandOdometry()
    end_s = carried(hand, [(0.0, 2.0 * (i >= 30), 0.0) for i in range(36)], [numpy.eye(3)] * 36)
    assert numpy.linalg.norm(hand.at(end_s)[1]) <= 3.0


def test_of_two_that_explain_the_image_it_stays_with_the_one_that_it_had():
    hand = HandOdometry()
    for i in range(30):
        true, mirrored = seen(numpy.zeros(3), turn(0.15)), seen(numpy.zeros(3), turn(-0.15))
        hand.see(i / RATE_HZ, [true, mirrored] if i % 2 == 0 else [mirrored, true])
    place, velocity, _ = hand.at(29 / RATE_HZ)
    assert place == pytest.approx([0.0, 0.0, HEIGHT_M], abs=0.01) and numpy.linalg.norm(velocity) < 0.01


def test_a_mirrored_beginning_is_mended_by_the_evidence_of_many_images():
    hand, place = HandOdometry(), numpy.array([0.0, 0.3, 0.0])
    true, mirrored = seen(place, numpy.eye(3)), seen(numpy.array([0.0, -0.3, 0.0]), turn(0.2))
    hand.see(0.0, [mirrored, true], 0.1)
    for i in range(1, 40):
        hand.see(i / RATE_HZ, [true, mirrored], 0.5)
    hand.see(40 / RATE_HZ, [mirrored, true], 5.0)  # one image is not enough
    _, velocity, rotation = hand.at(40 / RATE_HZ)
    assert numpy.linalg.norm(velocity) < 0.01
    before = hand.at(40 / RATE_HZ)[0]
    for i in range(41, 71):
        hand.see(i / RATE_HZ, [seen(place + [0.3 * (i - 40) / RATE_HZ, 0.0, 0.0], numpy.eye(3)), mirrored], 0.5)
    moved = rotation.T @ (hand.at(70 / RATE_HZ)[0] - before)
    assert moved == pytest.approx([0.3, 0.0, 0.0], abs=0.04)  # straight ahead, as it was carried


def test_stands_when_the_window_is_out_of_sight_or_follows_when_told_to():
    hand = HandOdometry()
    end_s = carried(hand, [(0.4 * i / RATE_HZ, 0.0, 0.0) for i in range(60)], [numpy.eye(3)] * 60)
    assert hand.is_seen(end_s + 0.1) and not hand.is_seen(end_s + 0.5)
    hand.carry(numpy.zeros(3), 0.02)
    place, velocity, _ = hand.at(end_s + 0.5)
    assert numpy.linalg.norm(velocity) == 0.0
    hand.carry([0.5, 0.0, 0.0], 0.02)
    moved, velocity, _ = hand.at(end_s + 0.5)
    assert moved == pytest.approx(place + [0.01, 0.0, 0.0]) and velocity == pytest.approx([0.5, 0.0, 0.0])


def test_rotations_become_quaternions_and_back():
    for angles in ((0.3, 0.1, -0.2), (3.0, 0.0, 0.0), (0.0, 0.0, numpy.pi)):
        assert matrix_of(quaternion_of(turn(*angles))) == pytest.approx(turn(*angles), abs=1e-9)
