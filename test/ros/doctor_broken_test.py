#!/usr/bin/env python3
"""doctor on nodes with wrong inputs: a topic of another type, an invalid camera frame, no subscriber to the setpoints,
no reference image."""
import sys
import unittest

import rosgraph
import rospy
import rostest
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, CompressedImage, Imu
from std_msgs.msg import String

import support
from doctor_test import doctor


def looking_left():
    """Mounted with the axes of a body instead of an optical frame, and turned to the left."""
    message = support.mounting()
    rotation = message.transform.rotation
    rotation.x = rotation.y = 0.0
    rotation.z = rotation.w = 0.5 ** 0.5
    return message


class DoctorBrokenTest(unittest.TestCase):
    def test_each_fault_is_a_line_with_what_mends_it(self):
        kind = support.transforms_type()
        frames = rospy.Publisher("/tf_static", kind, queue_size=1, latch=True)
        frames.publish(kind([looking_left()]))
        streams = [support.Stream(topic, type_, make, rate) for topic, type_, make, rate in (
            ("/camera/image_raw", CompressedImage, lambda stamp: CompressedImage(), 10.0),
            ("/camera/camera_info", CameraInfo, support.camera_info, 10.0),
            ("/odom", Odometry, support.odometry, 50.0), ("/imu", Imu, support.imu, 50.0))]
        expected = ("/camera/image_raw: is a sensor_msgs/CompressedImage, window_detector reads sensor_msgs/Image",
                    "tf: camera_optical_frame does not look forward: its z axis is (+0.00, +0.00, +1.00) in base_link",
                    "/cmd_vel: nobody takes setpoints", "cmd_vel:=ITS_TOPIC", "the pilot's switch does not end a mission",
                    "window_detector: no reference image", "mend: ingress reference IMAGE")
        for _ in range(4):  # nodes discover each other one by one
            code, said = doctor()
            if all(words in said for words in expected):
                break
        for stream in streams:
            stream.stop()
        self.assertEqual(code, 1, said)
        for words in expected:
            self.assertIn(words, said)
        self.assertNotIn("image:=/debug_image", said)  # the detector's own

    def test_types_that_nobody_expects(self):
        """Bytes that are no camera_info, and words instead of numbers, give findings, not a crash."""
        support.Stream._publishers.pop("/camera/camera_info").unregister()
        stream = support.Stream("/camera/camera_info", String, lambda stamp: String("hello"), 20.0)
        wide = "/homography_pose/pose/opening_width_m"
        before = rospy.get_param(wide)
        rospy.set_param(wide, "wide")
        expected = "/camera/camera_info: is a std_msgs/String, ", "homography_pose: pose/opening_width_m is 'wide', not a number"
        for _ in range(4):
            code, said = doctor()
            if all(words in said for words in expected):
                break
        stream.stop()
        rospy.set_param(wide, before)
        self.assertEqual(code, 1, said)
        self.assertNotIn("Traceback", said)
        for words in expected:
            self.assertIn(words, said)
        readers = dict(rosgraph.Master("/test").getSystemState()[1])["/tf"]
        self.assertFalse([node for node in readers if node.startswith("/doctor_") and "test" not in node], "does not stay registered")


if __name__ == "__main__":
    rospy.init_node("doctor_broken_test")
    rostest.rosrun("window_ingress", "doctor_broken_test", DoctorBrokenTest, sys.argv)
