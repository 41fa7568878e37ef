"""Odometry of a camera that is carried by hand before a window: from the window itself, which stands still. Without ROS."""
import numpy

from .transforms import matrix_of

HEIGHT_M = 1.5              # where it begins, above the ground of its frame
TURN_TIME_S = 0.4           # over which the turn against the window is averaged: from one image it is the least certain
PLACE_TIME_S = 0.1          # likewise the window's place in the image and its distance
VELOCITY_TIME_S = 0.25
LONGEST_GUESS_S = 0.15      # without an image the movement is taken to go on for so long
FORGOTTEN_AFTER_S = 1.0
MOST_MPS = 3.0              # no hand carries a camera faster: another window is taken for the one before
MOST_EVIDENCE, ENOUGH_EVIDENCE = 2.0, 10.0  # [nats] of one image; to take the mirrored solution in place of the one followed
# Axes of the camera (x right, y down, z ahead) in those of the body (x ahead, y left, z up).
R_BODY_CAMERA = numpy.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def nearest_rotation(matrix):
    u, _, v = numpy.linalg.svd(matrix)
    return u @ numpy.diag([1.0, 1.0, numpy.linalg.det(u @ v)]) @ v


def angle_between(a, b):
    return numpy.arccos(numpy.clip((numpy.trace(a.T @ b) - 1.0) / 2.0, -1.0, 1.0))


class HandOdometry:
    """The window is set up in odom, upright, when it is first seen; from then on it says where the camera is."""

    def __init__(self):
        self.place, self.velocity = numpy.array([0.0, 0.0, HEIGHT_M]), numpy.zeros(3)
        self.rotation = numpy.eye(3)  # of the body in odom
        self._window = None           # its rotation and place in odom
        self._turn = self._sight = None  # the window's rotation and place in body axes, averaged
        self._seen_s = None
        self._doubt = 0.0  # evidence for the mirrored one [nats]

    def see(self, stamp_s, candidates, evidence=0.0):
        """An image: what explains it, [(rotation, place)] of the window in the camera, the likelier first, by so many nats."""
        candidates = [(R_BODY_CAMERA @ rotation, R_BODY_CAMERA @ place) for rotation, place in candidates]
        dt = None if self._seen_s is None else stamp_s - self._seen_s
        if dt is None or not 0.0 < dt < FORGOTTEN_AFTER_S:
            self._turn, self._sight = candidates[0]
            self._doubt = 0.0
        elif self._is_mirrored(candidates, evidence):
            self._turn, self._sight = candidates[0]
            dt = None
        else:
            turn, sight = min(candidates, key=lambda candidate: angle_between(candidate[0], self._turn))
            self._turn = nearest_rotation(self._turn + min(1.0, dt / TURN_TIME_S) * (turn - self._turn))
            self._sight = self._sight + min(1.0, dt / PLACE_TIME_S) * (sight - self._sight)
        self._seen_s = stamp_s
        if self._window is None:
            self._set_up()
        rotation = self._window[0] @ self._turn.T
        place = self._window[1] - rotation @ self._sight
        moved = dt is not None and 0.0 < dt < FORGOTTEN_AFTER_S
        wish = (place - self.place) / dt if moved else numpy.zeros(3)
        wish = wish * MOST_MPS / max(numpy.linalg.norm(wish), MOST_MPS)
        self.velocity = self.velocity + min(1.0, dt / VELOCITY_TIME_S) * (wish - self.velocity) if moved else wish
        self.place, self.rotation = place, rotation

    def _is_mirrored(self, candidates, evidence):
        """That the solution followed is not the likelier one, image after image."""
        follows_likelier = angle_between(candidates[0][0], self._turn) <= angle_between(candidates[-1][0], self._turn)
        step = min(evidence, MOST_EVIDENCE)
        self._doubt = max(0.0, self._doubt - step) if follows_likelier else self._doubt + step
        if self._doubt < ENOUGH_EVIDENCE:
            return False
        self._doubt = 0.0
        return True

    def _set_up(self):
        heading = numpy.arctan2(self._turn[1, 0], self._turn[0, 0])
        upright = matrix_of([0.0, 0.0, numpy.sin(heading / 2), numpy.cos(heading / 2)])
        self._window = upright, self.place + upright @ self._turn.T @ self._sight

    def is_seen(self, now_s):
        return self._seen_s is not None and now_s - self._seen_s <= LONGEST_GUESS_S

    def carry(self, velocity, dt_s):
        """Out of sight of the window, as if the setpoint were followed."""
        self.velocity = numpy.asarray(velocity, float)
        self.place = self.place + dt_s * self.velocity

    def at(self, now_s):
        """(place, velocity, rotation of the body) in odom, the velocity in odom axes."""
        if not self.is_seen(now_s):
            return self.place, numpy.zeros(3), self.rotation
        return self.place + (now_s - self._seen_s) * self.velocity, self.velocity, self.rotation
