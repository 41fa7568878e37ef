#!/usr/bin/env python3
"""Nodes that must not start say why in one line and exit with 2. Nodes that are stopped leave zero and exit with 0."""
import signal
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from roslib.packages import find_node

import support

NODES = ("window_detector", "homography_pose", "ingress_navigator", "setpoint_guard", "world")
EXIT_WITHIN_S = 2.0
LAUNCH_ENDS_WITHIN_S = 30.0


def launch(node):
    program = find_node("window_ingress", node)[0]
    return subprocess.Popen([program], stderr=subprocess.PIPE, text=True)


class RefusedStartTest(unittest.TestCase):
    def errors_of(self, node, name, value):
        """The error text of a node that exits with 2."""
        rospy.set_param(name, value)
        try:
            process = launch(node)
            _, errors = process.communicate(timeout=support.DEADLINE_S)
        finally:
            rospy.delete_param(name)
        self.assertEqual(process.returncode, 2, errors)
        return errors

    def assert_refused(self, node, name, value, *words):
        errors = self.errors_of(node, f"/{node}/{name}", value)
        lines = [line for line in errors.splitlines() if line.strip()]
        self.assertEqual(len(lines), 1, errors)
        for word in ("[FATAL]", f"{node}: ", f"/{node}/{name}", *words):
            self.assertIn(word, lines[0])

    def test_unknown_names_are_refused_by_every_node(self):
        for node in NODES:
            self.assert_refused(node, "thershold", 1.0, "unknown parameter")

    def test_wrong_types_are_refused(self):
        self.assert_refused("setpoint_guard", "late_sec", "0.2", "must be a number, not a text")
        self.assert_refused("homography_pose", "publish_tf", 1, "must be true or false")
        self.assert_refused("window_detector", "detector/min_score", "high", "must be a number")

    def test_numbers_out_of_range_are_refused(self):
        for value in (float("nan"), float("inf"), -1.0, 1e300):
            self.assert_refused("ingress_navigator", "navigator/limits/speed_mps", value, "is not within")

    def test_what_is_wrong_with_vehicle_and_node_is_told_at_once(self):
        rospy.set_param("/vehicle/half_width_m", -1.0)
        try:
            for node in ("window_detector", "homography_pose", "ingress_navigator"):
                self.assert_refused(node, "thershold", 1.0, "unknown parameter", "/vehicle/half_width_m = -1 is not within")
        finally:
            rospy.delete_param("/vehicle/half_width_m")

    def test_a_word_that_is_none_of_those_there_are_is_refused(self):
        self.assert_refused("homography_pose", "gravity_source", "mag", "is not one of imu, odom, tf")
        self.assert_refused("ingress_navigator", "setpoint_frame", "map", "is not one of odom, base_link")

    def test_lockstep_is_refused_without_simulated_time(self):
        for node in ("window_detector", "homography_pose", "ingress_navigator", "setpoint_guard"):
            self.assertIn("use_sim_time", self.errors_of(node, f"/{node}/lockstep", True))

    def test_start_at_once_is_refused_outside_lockstep(self):
        self.assertIn("start_at_once", self.errors_of("ingress_navigator", "/ingress_navigator/start_at_once", True))

    def test_a_house_in_front_of_a_vehicle_that_the_world_simulates_itself_is_refused(self):
        self.assertIn("'vehicle: external'", self.errors_of("world", "/world/start_at", "vehicle"))

    def test_unknown_transport_lists_the_known_ones(self):
        errors = self.errors_of("window_detector", "/window_detector/image_transport", "theora_or_so")
        self.assertIn("raw", errors)
        self.assertIn("compressed", errors)

    def test_missing_reference_image_is_named(self):
        self.assertIn("/nowhere/window.jpg", self.errors_of("window_detector", "/window_detector/reference/picture", "/nowhere/window.jpg"))

    def test_a_mounting_that_has_not_six_numbers_is_refused(self):
        for pose in ([], [0.1, 0.0, 0.02], [float("nan")] * 6, [0.1, 0.0, 0.0, 15.0, 0.0, 0.0], [100.0, 0.0, 0.0, 0.0, 0.0, 0.0]):
            self.assertIn("pose", self.errors_of("camera_mounting", "/camera_mounting/pose", pose))

    def test_a_number_where_the_parameters_stand_is_refused(self):
        for name, node in (("window_detector", "window_detector"), ("ingress_navigator", "ingress_navigator"), ("setpoint_guard", "setpoint_guard"),
                           ("vehicle", "homography_pose"), ("vehicle", "ingress_navigator")):
            self.assertIn(f"{node}: /{name} is a whole number, must be a mapping", self.errors_of(node, f"/{name}", 5))

    def test_what_has_moved_is_named_with_its_new_place(self):
        self.assert_refused("ingress_navigator", "navigator/vehicle", {"half_width_m": 0.45}, "it is now 'vehicle: {..}'")
        self.assert_refused("homography_pose", "tracker/fit", {"vehicle_width_m": 0.9}, "half_width_m")
        self.assert_refused("homography_pose", "filter/gate_squares", 30.0, "it is now 'nis_gate'")
        self.assert_refused("setpoint_guard", "max_sped_mps", 0.9, "did you mean 'max_speed_mps'?")

    def assert_stops(self, node, number, frame="odom"):
        setpoints = support.Listener("cmd_vel", TwistStamped)
        process = launch(node)
        support.wait_for(lambda: setpoints._subscriber.get_num_connections() > 0, f"{node} publishes cmd_vel")
        sent = time.monotonic()
        process.send_signal(number)
        process.wait(timeout=support.DEADLINE_S)
        self.assertLess(time.monotonic() - sent, EXIT_WITHIN_S)
        self.assertEqual(process.returncode, 0)
        last = setpoints.since(sent)[-1]
        self.assertEqual(last.header.frame_id, frame)
        self.assertTrue(support.is_zero(last), last)
        setpoints.stop()

    def test_mavros_frame_names_are_accepted_and_said_in_the_setpoints(self):
        rospy.set_param("/vehicle/odom_frame", "map")
        try:
            self.assert_stops("ingress_navigator", signal.SIGINT, frame="map")
        finally:
            rospy.delete_param("/vehicle/odom_frame")

    def test_a_launch_that_flies_nothing_ends_with_the_node_that_is_refused(self):
        """Refused by a parameter that is in no file, so that no check before the start finds it."""
        for node in ("window_detector", "ingress_navigator", "setpoint_guard"):
            rospy.set_param(f"/{node}/thershold", 1.0)
            done = subprocess.run(["roslaunch", "window_ingress", "rehearse.launch", "camera:=false", "rviz:=false"], capture_output=True,
                                  text=True, timeout=LAUNCH_ENDS_WITHIN_S, check=False)
            rospy.delete_param(f"/{node}/thershold")
            self.assertRegex(done.stdout + done.stderr, f"unknown parameter.*/{node}/thershold")
            self.assertIn(f"REQUIRED process [{node}-", done.stdout + done.stderr)

    def test_signals_leave_zero_velocity_behind(self):
        for node in ("ingress_navigator", "setpoint_guard"):
            for number in (signal.SIGINT, signal.SIGTERM):
                self.assert_stops(node, number)


if __name__ == "__main__":
    rospy.init_node("refused_start_test")
    rostest.rosrun("window_ingress", "refused_start_test", RefusedStartTest, sys.argv)
