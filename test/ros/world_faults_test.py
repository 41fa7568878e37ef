#!/usr/bin/env python3
"""Faults and calibration by service: the world sends what was asked for, and publishes the faults."""
import math
import os
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, Imu
from sensor_msgs.srv import SetCameraInfo
from std_srvs.srv import Trigger
from window_ingress.msg import FlightVerdict, IngressState
from window_ingress.srv import Inject

import support

SHORT_S, LONG_S = 1.0, 600.0


class WorldFaultsTest(unittest.TestCase):
    def setUp(self):
        rospy.wait_for_service("world/inject", support.DEADLINE_S)
        self.service = rospy.ServiceProxy("world/inject", Inject)
        self.reset = rospy.ServiceProxy("world/reset", Trigger)
        self.assertTrue(self.reset().success)
        self.listeners = []

    def tearDown(self):
        self.reset()
        for listener in self.listeners:
            listener.stop()

    def listen(self, topic, kind):
        listener = support.Listener(topic, kind)
        self.listeners.append(listener)
        listener.wait(what=topic)
        return listener

    def inject(self, unit, kind, duration=LONG_S):
        reply = self.service(unit, kind, duration)
        self.assertTrue(reply.success, reply.message)
        return time.monotonic()

    def test_what_is_off_is_silent_and_comes_again_at_its_time(self):
        odometry, imu = self.listen("odom", Odometry), self.listen("imu", Imu)
        self.inject("odom", "off", SHORT_S)
        said = odometry.since(0.0)[-1].header.stamp
        again = support.wait_for(lambda: [m for m in odometry.since(0.0) if m.header.stamp > said + rospy.Duration(0.5)],
                                 "odometry again")[0]
        self.assertAlmostEqual((again.header.stamp - said).to_sec(), SHORT_S, delta=0.2)
        stamps = [m.header.stamp for m in imu.since(0.0)]
        self.assertGreater(sum(said < s < again.header.stamp for s in stamps), 80, "the imu went on")

    def test_what_a_vehicle_claims_of_an_earlier_flight_is_no_verdict_on_the_next(self):
        verdicts = self.listen("referee", FlightVerdict)
        vehicle = support.Stream("state", IngressState, lambda stamp: IngressState(state=IngressState.PASSED))
        self.listeners.append(vehicle)
        self.assertTrue(self.reset().success)
        begin = time.monotonic()
        support.wait_for(lambda: len(verdicts.since(begin)) >= 3, "verdicts")
        self.assertEqual({v.outcome_name for v in verdicts.since(begin)}, {"RUNNING"})
        vehicle.make = lambda stamp: IngressState(state=IngressState.SEARCH)
        begin = time.monotonic()
        support.wait_for(lambda: len(verdicts.since(begin)) >= 2, "verdicts on a vehicle that searches")
        vehicle.make = lambda stamp: IngressState(state=IngressState.PASSED)
        verdicts.wait(lambda v: v.outcome_name == "FALSE_INGRESS", "what is claimed in this flight is judged")

    def test_garbage_and_wrong(self):
        odometry, imu, info = self.listen("odom", Odometry), self.listen("imu", Imu), self.listen("camera_info", CameraInfo)
        focal, x = info.wait().K[0], odometry.wait().pose.pose.position.x
        begin = self.inject("imu", "garbage")
        self.inject("camera_info", "wrong")
        self.inject("odom", "wrong")
        imu.wait(lambda m: math.isnan(m.orientation.w), "an imu that is not finite", begin=begin)
        info.wait(lambda m: abs(m.K[0] / focal - 1.3) < 1e-9 and abs(m.P[5] / focal - 1.3) < 1e-9, "another calibration")
        odometry.wait(lambda m: abs(m.pose.pose.position.x - x - 4.0) < 0.5, "a jump of four metres")
        self.assertTrue(self.reset().success)
        begin = time.monotonic() + 0.2
        self.assertFalse(math.isnan(imu.wait(begin=begin).orientation.w), "a reset ends all faults")
        self.assertEqual(info.wait(begin=begin).K[0], focal)

    def test_image_transform_and_clock_stand_still(self):
        images, clock, transforms = self.listen("image_raw", Image), self.listen("/clock", Clock), self.listen("/tf", rospy.AnyMsg)
        self.inject("image", "stuck")
        self.inject("tf", "off")
        begin = self.inject("clock", "stuck") + 0.3
        support.wait_for(lambda: len(images.since(begin)) > 5 and len(clock.since(begin)) > 20, "images and times")
        self.assertEqual(len({m.data for m in images.since(begin)}), 1)
        self.assertGreater(len({m.header.stamp for m in images.since(begin)}), 5)
        self.assertEqual(len({m.clock for m in clock.since(begin)}), 1)
        self.assertEqual(len(transforms.since(begin)), 0)

    def test_a_clock_jumps_back_and_forth(self):
        clock = self.listen("/clock", Clock)
        before = clock.wait().clock
        self.inject("clock", "wrong", SHORT_S)
        clock.wait(lambda m: m.clock < before - rospy.Duration(4.0), "a clock that is behind")
        clock.wait(lambda m: m.clock > before, "a clock that is right again")

    def test_what_makes_no_sense_is_refused_by_name(self):
        for unit, kind, duration, word in (("clock", "garbage", 1.0, "clock garbage"), ("lidar", "off", 1.0, "unit"),
                                           ("odom", "sad", 1.0, "kind"), ("odom", "off", -1.0, "duration_sec"),
                                           ("odom", "off", math.nan, "duration_sec")):
            reply = self.service(unit, kind, duration)
            self.assertFalse(reply.success)
            self.assertIn(word, reply.message)

    def test_truth_stands_beside_each_image(self):
        truths, images = self.listen("ground_truth/window_in_camera", PoseStamped), self.listen("image_raw", Image)
        begin = time.monotonic()
        support.wait_for(lambda: len(images.since(begin)) > 10, "images")
        stamps = {m.header.stamp for m in truths.since(0.0)}
        judged = images.since(begin)[:-1]
        self.assertEqual([m.header.stamp for m in judged if m.header.stamp not in stamps], [])

    def test_a_calibration_can_be_set_and_is_stored(self):
        info = self.listen("camera_info", CameraInfo)
        calibration = info.wait()
        true_focal = calibration.K[0]
        set_camera_info = rospy.ServiceProxy("set_camera_info", SetCameraInfo)
        for focal in (412.5, true_focal):
            calibration.K = [focal if k == calibration.K[0] else k for k in calibration.K]
            reply = set_camera_info(calibration)
            self.assertTrue(reply.success, reply.status_message)
            info.wait(lambda m: abs(m.K[0] - focal) < 1e-6, "the new calibration")
        home = os.environ.get("ROS_HOME", os.path.expanduser("~/.ros"))
        with open(os.path.join(home, "camera_info", "world.yaml")) as file:
            self.assertIn("camera_matrix", file.read())


if __name__ == "__main__":
    rospy.init_node("world_faults_test")
    rostest.rosrun("window_ingress", "world_faults_test", WorldFaultsTest, sys.argv)
