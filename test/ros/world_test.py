#!/usr/bin/env python3
"""The simulated vehicle moves along the axes of the setpoint's frame, and a reset puts it back."""
import math
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_srvs.srv import Trigger

import support

FAR_ENOUGH_M = 0.5
SPEED_MPS = 0.5


def heading(odometry):
    q = odometry.pose.pose.orientation
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


def position(odometry):
    p = odometry.pose.pose.position
    return p.x, p.y, p.z


class WorldTest(unittest.TestCase):
    def setUp(self):
        self.truth = support.Listener("ground_truth/odom", Odometry)
        self.assertTrue(self.reset().success)
        self.begin = self.truth.wait(what="the truth after the reset")

    def tearDown(self):
        self.truth.stop()

    @staticmethod
    def reset():
        rospy.wait_for_service("world/reset", support.DEADLINE_S)
        return rospy.ServiceProxy("world/reset", Trigger)()

    def moved(self, truth):
        return [now - then for now, then in zip(position(truth), position(self.begin))]

    def fly(self, frame_id, x=0.0, y=0.0, z=0.0):
        """Distance moved in odom [m], once it is far enough."""
        def command(stamp):
            message = TwistStamped()
            message.header.stamp = stamp
            message.header.frame_id = frame_id
            linear = message.twist.linear
            linear.x, linear.y, linear.z = x, y, z
            return message
        stream = support.Stream("cmd_vel", TwistStamped, command)
        try:
            return self.moved(self.truth.wait(lambda t: math.dist(self.moved(t), (0, 0, 0)) > FAR_ENOUGH_M, "motion"))
        finally:
            stream.stop()

    def assert_went(self, moved, x, y, z):
        for got, wanted in zip(moved, (x, y, z)):
            self.assertAlmostEqual(got / FAR_ENOUGH_M, wanted, delta=0.35)

    def test_setpoint_in_odom(self):
        self.assert_went(self.fly("odom", y=SPEED_MPS), 0, 1, 0)

    def test_setpoint_in_base_link_goes_along_the_heading(self):
        psi = heading(self.begin)
        self.assert_went(self.fly("base_link", x=SPEED_MPS), math.cos(psi), math.sin(psi), 0)

    def test_left_of_base_link_is_left(self):
        psi = heading(self.begin)
        self.assert_went(self.fly("base_link", y=SPEED_MPS), -math.sin(psi), math.cos(psi), 0)

    def test_up_is_up(self):
        self.assert_went(self.fly("odom", z=SPEED_MPS), 0, 0, 1)

    def test_setpoint_of_another_frame_is_refused_by_name(self):
        def command(stamp):
            message = TwistStamped()
            message.header.stamp = stamp
            message.header.frame_id = "map"
            message.twist.linear.x = SPEED_MPS
            return message
        stream = support.Stream("cmd_vel", TwistStamped, command)
        support.Diagnostics().wait("world: cmd_vel", "'map'")
        stream.stop()
        self.assertLess(math.dist(self.moved(self.truth.wait(what="the truth")), (0, 0, 0)), FAR_ENOUGH_M)

    def test_reset_puts_it_back_and_time_goes_on(self):
        clock = support.Listener("/clock", Clock)
        before = clock.wait(what="the clock").clock
        self.fly("odom", z=SPEED_MPS)
        self.assertTrue(self.reset().success)
        again = self.truth.wait(what="the truth", begin=time.monotonic() + 0.2)
        self.assertLess(math.dist(self.moved(again), (0, 0, 0)), FAR_ENOUGH_M / 2)
        self.assertGreater(clock.wait(what="the clock").clock, before)
        clock.stop()

    def test_everything_is_published_in_its_frame(self):
        for topic, kind, frame_id in (("image_raw", Image, "camera_optical_frame"),
                                      ("camera_info", CameraInfo, "camera_optical_frame"),
                                      ("odom", Odometry, "odom"), ("imu", Imu, "base_link"),
                                      ("ground_truth/window", PoseStamped, "odom"),
                                      ("ground_truth/window_in_camera", PoseStamped, "camera_optical_frame")):
            listener = support.Listener(topic, kind)
            self.assertEqual(listener.wait(what=topic).header.frame_id, frame_id, topic)
            listener.stop()


if __name__ == "__main__":
    rospy.init_node("world_test")
    rostest.rosrun("window_ingress", "world_test", WorldTest, sys.argv)
