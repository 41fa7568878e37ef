#!/usr/bin/env python3
"""Arbitrary messages on all inputs at once, beside or instead of the true ones, judged by the oracles."""
import sys
import time
import unittest

import fault_paths  # noqa: F401
import rospy
import rostest
from fault_notes import note
from geometry_msgs.msg import TransformStamped, TwistStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_msgs.msg import Bool
from window_ingress.msg import ReferenceImage, WindowDetection, WindowPose

import chain
import monitor as monitors
import oracles
import support
from homography_pose_test import detection

try:
    from hypothesis import HealthCheck, given, settings, strategies
    import arbitrary
except ImportError:  # Debian and Ubuntu: python3-hypothesis
    given = None

EXAMPLES, SECONDS_AN_EXAMPLE = 60, 0.15
NOW = rospy.Time(1)


def inputs():
    """topic -> a valid message"""
    transforms = support.transforms_type()
    return {"image_raw": support.Camera(chain.window_image())(NOW), "camera_info": support.camera_info(NOW), "imu": support.imu(NOW), "odom": support.odometry(NOW),
            "window": detection(NOW), "window_pose": support.no_window(NOW), "engaged": Bool(True), "reference": ReferenceImage(),
            "ingress_navigator/cmd_vel": TwistStamped(), "/tf": transforms([transform()])}


def transform():
    message = TransformStamped(child_frame_id="camera_optical_frame")
    message.header.frame_id = "base_link"
    message.transform.rotation.w = 1.0
    return message


KINDS = {"image_raw": Image, "camera_info": CameraInfo, "imu": Imu, "odom": Odometry, "window": WindowDetection, "window_pose": WindowPose,
         "engaged": Bool, "reference": ReferenceImage, "ingress_navigator/cmd_vel": TwistStamped}


@unittest.skipUnless(given, "python3-hypothesis is not installed")
class HostileTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.monitor = monitors.Monitor(topics={"steered": "/ingress_navigator/cmd_vel"})
        cls.monitor.limits.frame_ms = 5000.0
        cls.chain = chain.Chain()
        cls.sound = inputs()
        kinds = {**KINDS, "/tf": support.transforms_type()}
        cls.publishers = {topic: rospy.Publisher(topic, kind, queue_size=20) for topic, kind in kinds.items()}
        cls.sent = 0

    def judge(self, begin):
        """Other publishers control the guard and claim to be the autopilot: O9 and O4 are not judged here."""
        found = [v for v in self.monitor.violations(begin) if v.oracle in ("O1", "O2", "O3", "O7")]
        self.assertEqual(found, [])

    def throw(self, messages):
        begin = time.monotonic()
        for i, (topic, message) in enumerate(messages):
            if hasattr(message, "header") and i % 2:
                message.header.stamp = rospy.Time.now()  # otherwise the stamps alone would make nodes refuse nearly all
            self.publishers[topic].publish(message)
            type(self).sent += 1
        support.wait_for(lambda: time.monotonic() > begin + SECONDS_AN_EXAMPLE, "the nodes to have heard it")
        self.judge(begin)
        self.monitor.forget_before(begin)

    def test_1_anything_beside_the_true_messages(self):
        self.chain.fly(self.monitor)
        began = time.monotonic()
        memory = {p.node: p.megabytes for p in self.monitor.part(began - 2.0).processes}
        any_message = strategies.sampled_from(sorted(self.sound)).flatmap(
            lambda topic: strategies.tuples(strategies.just(topic), arbitrary.like(self.sound[topic])))

        @settings(max_examples=EXAMPLES, deadline=None, database=None, derandomize=True, suppress_health_check=list(HealthCheck))
        @given(strategies.lists(any_message, min_size=5, max_size=25))
        def attack(messages):
            self.throw(messages)
        attack()
        last = support.wait_for(lambda: self.monitor.part(time.monotonic() - 3.0).processes, "a look at the processes")
        grown = {p.node: p.megabytes - memory.get(p.node, p.megabytes) for p in last}
        self.assertLess(max(grown.values()), 60.0, grown)
        type(self).grown = max(grown.values())

    def test_2_afterwards_all_is_as_before(self):
        self.chain.call("abort")
        type(self).mounting = support.publish_mounting()  # tf2 keeps a wrong static frame until it is published again
        begin = time.monotonic()
        self.chain.fly(self.monitor)
        self.judge(begin)
        note("M80", f"{self.sent} arbitrary messages on {len(self.publishers)} topics: no process lost, all outputs finite and within "
                    f"limits, {self.grown:.0f} MB; on its way again after {time.monotonic() - begin:.1f} s")

    def test_3_a_second_source_of_setpoints_is_bound_by_the_limits(self):
        self.chain.fly(self.monitor)
        begin = time.monotonic()

        def rush(_):
            message = TwistStamped()
            message.header.stamp, message.header.frame_id = rospy.Time.now(), "odom"
            message.twist.linear.x = 30.0
            return message

        def passed_on():
            return [s for s in self.monitor.part(begin).setpoints if s.source == "/setpoint_guard"]
        other = support.Stream("ingress_navigator/cmd_vel", TwistStamped, rush, 60.0)
        try:
            self.assertEqual(self.monitor.names(begin, "setpoint_guard: cmd_vel_in", "in"), [])
            support.wait_for(lambda: len(passed_on()) >= 10, "setpoints of the guard")
        finally:
            other.stop()
        fastest = max(oracles.norm(s.velocity) for s in passed_on())
        self.assertLessEqual(fastest, self.monitor.limits.guard_speed_mps)
        self.judge(begin)


if __name__ == "__main__":
    rospy.init_node("hostile_test")
    rostest.rosrun("window_ingress", "hostile_test", HostileTest, sys.argv)
