#!/usr/bin/env python3
"""The nodelets work like the nodes, in one process. One can be unloaded and loaded again without harm to the others."""
import os
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from roslib.packages import find_node
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_srvs.srv import Trigger
from window_ingress.msg import IngressState, WindowDetection, WindowPose

import support

start = rospy.ServiceProxy("/ingress_navigator/start", Trigger)
NODELET = ("rosrun", "nodelet", "nodelet")  # its services have no Python types on Debian


class NodeletsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pixels = support.window_image()
        cls.mounting = support.publish_mounting()
        cls.streams = [support.Stream(topic, kind, make, rate) for topic, kind, make, rate in (
            ("image_raw", Image, lambda stamp: support.image_message(pixels, stamp), 10.0),
            ("camera_info", CameraInfo, support.camera_info, 10.0),
            ("imu", Imu, support.imu, 50.0), ("odom", Odometry, support.odometry, 50.0))]
        cls.windows = support.Listener("window", WindowDetection)
        cls.poses = support.Listener("window_pose", WindowPose)
        cls.states = support.Listener("state", IngressState)

    def test_1_from_image_to_pose_in_one_process(self):
        self.windows.wait(lambda w: w.detected, "a window", begin=0.0)
        self.poses.wait(lambda p: p.image.reject == p.image.OK, "a pose", begin=0.0)
        self.states.wait(lambda s: s.state_name == "IDLE", "the navigator's state", begin=0.0)

    def test_2_doctor_looks_at_the_inputs_of_nodelets_too(self):
        said = subprocess.run([find_node("window_ingress", "doctor")[0], "--seconds", "2.5"], capture_output=True, text=True, timeout=60, check=False,
                              env={**os.environ, "WINDOW_INGRESS_RUN": ""}).stdout
        for words in ("/image_raw: ", "should be 15 Hz or more", "/odom: ", "/camera_info: calibrated", "tf: "):
            self.assertIn(words, said)

    def test_3_one_of_them_is_taken_out_and_put_in_again(self):
        subprocess.run([*NODELET, "unload", "/window_detector", "/manager"], check=True, timeout=support.DEADLINE_S)
        support.wait_for(lambda: "window_detector says nothing" in start().message, "the navigator's word for it")
        self.assertNotIn("homography_pose says nothing", start().message)
        begin = time.monotonic()
        loader = subprocess.Popen([*NODELET, "load", "window_ingress/WindowDetectorNodelet", "/manager",
                                   "__name:=window_detector_again"])
        try:
            self.windows.wait(lambda w: w.detected, "a window after it", begin=begin)
            self.poses.wait(lambda p: p.image.reject == p.image.OK, "a pose after it", begin=begin)
        finally:
            loader.terminate()
            loader.wait()

    def test_4_a_manager_whose_namespace_its_topics_would_take_is_refused(self):
        log = support.Listener("/rosout", Log)
        loader = subprocess.Popen([*NODELET, "load", "window_ingress/HomographyPoseNodelet", "/camera/manager", "__name:=pose_elsewhere"])
        try:
            said = log.wait(lambda line: line.level == Log.FATAL, "the refusal").msg
            self.assertIn("/pose_elsewhere: not started: its topics would be in /camera", said)
        finally:
            loader.terminate()
            loader.wait()


if __name__ == "__main__":
    rospy.init_node("nodelets_test")
    rostest.rosrun("window_ingress", "nodelets_test", NodeletsTest, sys.argv)
