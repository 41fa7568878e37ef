#!/usr/bin/env python3
"""The last gate: valid input passes, everything else becomes zero, and the guard falls silent only long after its input."""
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped

import support

LATE_S = 0.2
MARGIN_S = 0.2  # a loaded machine


def command(stamp, x=0.5, yaw_rate=0.1, frame_id="odom"):
    message = TwistStamped()
    message.header.stamp = stamp
    message.header.frame_id = frame_id
    message.twist.linear.x = x
    message.twist.angular.z = yaw_rate
    return message


class SetpointGuardTest(unittest.TestCase):
    def setUp(self):
        self.output = support.Listener("cmd_vel", TwistStamped)
        self.input = None

    def tearDown(self):
        if self.input:
            self.input.stop()
        self.output.stop()

    def send(self, make):
        self.input = support.Stream("cmd_vel_in", TwistStamped, make, 30.0)
        return self.input

    def expect_zeros_from(self, begin, count=20):
        support.wait_for(lambda: len(self.output.since(begin)) >= count, "the stream goes on")
        self.assertTrue(all(support.is_zero(m) for m in self.output.since(begin)))

    def test_zeros_without_input_at_20_hz_and_more(self):
        begin = time.monotonic() + LATE_S + MARGIN_S  # input of the previous test must be late
        self.expect_zeros_from(begin, 60)
        self.assertLess(time.monotonic() - begin, 60 / 20.0)

    def test_an_output_that_nobody_takes_is_said(self):
        self.output.stop()
        support.Diagnostics().wait("setpoint_guard: cmd_vel", "nobody subscribes to /cmd_vel")

    def test_a_second_source_is_said(self):
        self.send(command)
        other = subprocess.Popen(["rostopic", "pub", "-r", "10", "cmd_vel_in", "geometry_msgs/TwistStamped", "{}"],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            support.Diagnostics().wait("setpoint_guard: cmd_vel_in", "several (2 publishers)", "only one may steer")
        finally:
            other.terminate()
            other.wait(timeout=support.DEADLINE_S)

    def test_sane_input_passes_with_its_frame(self):
        self.send(lambda stamp: command(stamp, frame_id="base_link"))
        message = self.output.wait(lambda m: not support.is_zero(m), "the input at the output")
        self.assertEqual((message.twist.linear.x, message.twist.angular.z), (0.5, 0.1))
        self.assertEqual(message.header.frame_id, "base_link")
        self.assertGreater(message.header.stamp.to_sec(), 0.0)

    def test_late_input_is_zero(self):
        self.send(command)
        self.output.wait(lambda m: not support.is_zero(m), "the input at the output")
        self.input.stop()
        self.input = None
        self.expect_zeros_from(time.monotonic() + LATE_S + MARGIN_S)
        support.Diagnostics().wait("setpoint_guard: cmd_vel_in", "silent")

    def test_input_that_is_not_finite_or_too_fast_is_zero(self):
        stream = self.send(command)
        for x, yaw_rate in ((float("nan"), 0.0), (0.0, float("inf")), (50.0, 0.0), (0.0, -20.0)):
            stream.make = command
            self.output.wait(lambda m: not support.is_zero(m), "sane input passes again")
            stream.make = lambda stamp, x=x, yaw_rate=yaw_rate: command(stamp, x, yaw_rate)
            self.expect_zeros_from(time.monotonic() + MARGIN_S)
        support.Diagnostics().wait("setpoint_guard: cmd_vel_in", "sending zero")


if __name__ == "__main__":
    rospy.init_node("setpoint_guard_test")
    rostest.rosrun("window_ingress", "setpoint_guard_test", SetpointGuardTest, sys.argv)
