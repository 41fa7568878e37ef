"""Odometry of a hand-carried camera, from the poses of a window, which stands still. Without ROS."""
import numpy

from .transforms import matrix_of

HEIGHT_M = 1.5              # initial height in odom
TURN_TIME_S = 0.4           # averaging time of the rotation, which is least certain from one image
PLACE_TIME_S = 0.1          # averaging time of the window's position relative to the body
VELOCITY_TIME_S = 0.25
LONGEST_GUESS_S = 0.15      # without an image the motion is extrapolated for this many seconds
FORGOTTEN_AFTER_S = 1.0
MOST_MPS = 3.0              # no hand carries a camera faster: more means that another window was detected
MOST_EVIDENCE, ENOUGH_EVIDENCE = 2.0, 10.0  # [nats] most from one image; sum that selects the mirrored solution
# Axes of the camera (x right, y down, z ahead) in those of the body (x ahead, y left, z up).
R_BODY_CAMERA = numpy.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def nearest_rotation(matrix):
    u, _, v = numpy.linalg.svd(matrix)
    return u @ numpy.diag([1.0, 1.0, numpy.linalg.det(u @ v)]) @ v


def angle_between(a, b):
    return numpy.arccos(numpy.clip((numpy.trace(a.T @ b) - 1.0) / 2.0, -1.0, 1.0))


class HandOdometry:
    """Puts the window upright into odom when it is first seen; from then on computes the camera's pose from it."""

    def __init__(self):
        self.place, self.velocity = numpy.array([0.0, 0.0, HEIGHT_M]), numpy.zeros(3)
        self.rotation = numpy.eye(3)  # of the body in odom
        self._window = None           # its rotation and place in odom
        self._turn = self._sight = None  # the window's rotation and place in body axes, averaged
        self._seen_s = None
        self._doubt = 0.0  # evidence for the mirrored one [nats]

    def see(self, stamp_s, candidates, evidence=0.0):
        """candidates: [(rotation, place)] of the window in the camera, the likelier first. evidence: by how many nats."""
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
        """Whether the followed solution has been the less likely one over enough images."""
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
        """Moves with this velocity while the window is out of sight."""
        self.velocity = numpy.asarray(velocity, float)
        self.place = self.place + dt_s * self.velocity

    def at(self, now_s):
        """(place, velocity, rotation of the body) in odom, the velocity in odom axes."""
        guessed_s = now_s - self._seen_s if self.is_seen(now_s) else 0.0
        return self.place + guessed_s * self.velocity, self.velocity, self.rotation
