#!/usr/bin/env python3
"""rehearse.launch with a recorded webcam: the navigator commands, odometry follows the hand, and nothing reaches an autopilot."""
import sys
import time
import unittest

import cv2
import numpy
import rosgraph
import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image
from window_ingress.msg import IngressState

import support

UP_WITHIN_S = 60.0
RATE_HZ = 20.0
PX_PER_M = 400.0
OPENING_M, FRAME_M = (0.6, 0.45), 0.05


def wall():
    """A plaster wall of 4 x 3 m with the printed window in its centre."""
    size = (3.0, 4.0)
    random = numpy.random.default_rng(3)
    image = cv2.resize(random.normal(185.0, 6.0, (300, 400)).astype(numpy.float32), None, fx=4, fy=4)
    image = numpy.repeat(image[:, :, None], 3, axis=2)
    middle = [round(side / 2 * PX_PER_M) for side in size]
    for half, colour in ((FRAME_M, (20, 95, 225)), (0.0, (60, 52, 48))):
        rows, columns = (round((side / 2 + half) * PX_PER_M) for side in reversed(OPENING_M))
        image[middle[0] - rows:middle[0] + rows, middle[1] - columns:middle[1] + columns] = colour
    return numpy.clip(image, 0, 255).astype(numpy.uint8)


class Hand:
    """Carries the camera: level, looking ahead, at `distance` from the wall and `left` of the window's axis."""

    def __init__(self):
        self.distance, self.left = 2.2, 0.2
        self._wall = wall()
        self._bare = numpy.full_like(support.window_image(), 185)
        self._random = numpy.random.default_rng(5)
        self.covers_the_lens = False
        self._streams = [support.Stream("/camera/image_raw", Image, self._image, RATE_HZ),
                         support.Stream("/camera/camera_info", CameraInfo, lambda _: self._info, RATE_HZ)]

    _info = support.camera_info(rospy.Time(1))

    def _image(self, stamp):
        self._info.header.stamp = stamp
        camera = numpy.array(self._info.K).reshape(3, 3)
        height, width = self._wall.shape[:2]
        metres = numpy.array([[1 / PX_PER_M, 0, -width / 2 / PX_PER_M], [0, 1 / PX_PER_M, -height / 2 / PX_PER_M], [0, 0, 1]])
        seen_from = numpy.array([[1, 0, self.left], [0, 1, 0], [0, 0, self.distance]])
        image = cv2.warpPerspective(self._wall, camera @ seen_from @ metres, (support.WIDTH, support.HEIGHT), borderValue=(185, 185, 185))
        image = self._bare if self.covers_the_lens else image
        noisy = numpy.clip(image + self._random.normal(0.0, 1.5, image.shape), 0, 255).astype(numpy.uint8)
        return support.image_message(noisy, stamp)

    def carry(self, distance, speed):
        """Moves the camera there at this speed."""
        begin, start = time.monotonic(), self.distance
        sign = 1.0 if distance > start else -1.0

        def arrived():
            gone = min(abs(distance - start), speed * (time.monotonic() - begin))
            self.distance = start + sign * gone
            return gone >= abs(distance - start)
        support.wait_for(arrived, "the end of the way", UP_WITHIN_S)


class RehearseTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.hand = Hand()
        cls.states = support.Listener("/state", IngressState)
        cls.setpoints = support.Listener("/rehearsal/cmd_vel", TwistStamped)
        cls.odometry = support.Listener("/rehearsal/odom", Odometry)

    def place(self):
        return self.odometry.wait(what="odometry").pose.pose.position

    def test_1_a_mission_begins_by_itself_and_wishes_to_move(self):
        self.states.wait(lambda s: s.state_name == "ALIGN", "ALIGN", UP_WITHIN_S, begin=0.0)
        state = self.states.wait(lambda s: s.target_valid, "the window's place", UP_WITHIN_S)
        self.assertAlmostEqual(state.distance, self.hand.distance, delta=0.25)
        self.setpoints.wait(lambda s: not support.is_zero(s), "a wish to move", UP_WITHIN_S)

    def test_2_odometry_and_distance_follow_the_hand(self):
        before = self.place()
        self.hand.carry(1.4, 0.3)
        support.wait_for(lambda: abs(self.place().x - before.x - 0.8) < 0.2, "odometry that has come with the hand")
        self.states.wait(lambda s: s.target_valid and abs(s.distance - 1.4) < 0.2, "the distance of the hand", UP_WITHIN_S)

    def test_3_nothing_reaches_an_autopilot(self):
        publishers, subscribers, _ = rosgraph.Master("/test").getSystemState()
        commands = [topic for topic, _ in publishers if "cmd_vel" in topic or "mavros" in topic or "setpoint" in topic]
        self.assertEqual(sorted(commands), ["/ingress_navigator/cmd_vel", "/rehearsal/cmd_vel", "/setpoint_guard/passed_on"])
        heard = dict(subscribers)["/rehearsal/cmd_vel"]
        self.assertEqual(set(heard) - {rospy.get_name()}, {"/rehearsal"})

    def test_4_without_the_window_the_vehicle_stands(self):
        self.hand.covers_the_lens = True
        begin = time.monotonic() + 0.5

        def stands(message):
            linear = message.twist.twist.linear
            return (linear.x, linear.y, linear.z) == (0.0, 0.0, 0.0)
        self.odometry.wait(stands, "odometry that stands", begin=begin)
        self.hand.covers_the_lens = False
        self.states.wait(lambda s: s.target_valid, "the window seen again", UP_WITHIN_S)

    def test_5_at_the_line_it_commits_and_goes_through_as_the_setpoint_says(self):
        self.hand.left = 0.0
        self.states.wait(lambda s: s.state_name == "APPROACH" and abs(s.lateral) < 0.1, "APPROACH", UP_WITHIN_S)
        begin = time.monotonic()
        self.hand.carry(0.7, 0.15)
        self.states.wait(lambda s: s.state_name == "COMMIT", "COMMIT", UP_WITHIN_S, begin=begin)
        self.hand.covers_the_lens = True
        before = self.place().x
        self.states.wait(lambda s: s.state_name == "PASSED", "the way through the opening, unseen", UP_WITHIN_S, begin=begin)
        self.assertGreater(self.place().x, before + 1.0)

    def test_6_after_its_end_the_next_mission_begins(self):
        self.hand.covers_the_lens = False
        self.hand.distance = 2.0
        begin = time.monotonic()
        self.states.wait(lambda s: s.state_name == "SEARCH", "the next mission", UP_WITHIN_S, begin=begin)


if __name__ == "__main__":
    rospy.init_node("rehearse_test")
    rostest.rosrun("window_ingress", "rehearse_test", RehearseTest, sys.argv)
