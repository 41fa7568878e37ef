#!/usr/bin/env python3
"""The simulated camera can be calibrated like a real one: the calibrator's service sets and saves the calibration for the next start."""
import os
import subprocess
import sys
import unittest

import rospy
import rostest
import yaml
from roslib.packages import find_node
from sensor_msgs.msg import CameraInfo, Image
from sensor_msgs.srv import SetCameraInfo

import support

FILE = "/tmp/world_calibration_test.yaml"  # as in world_calibration.test
FOCAL = 432.125


class WorldCalibrationTest(unittest.TestCase):
    def test_set_saved_and_read_again(self):
        self.addCleanup(lambda: os.path.exists(FILE) and os.remove(FILE))
        infos = support.Listener("camera_info", CameraInfo)
        images = support.Listener("image_raw", Image)
        true = infos.wait(what="the true calibration, as the file is not there yet")
        self.assertNotAlmostEqual(true.K[0], FOCAL)
        self.assertEqual(images.wait(what="an image").width, true.width)
        rospy.wait_for_service("set_camera_info", support.DEADLINE_S)
        wanted = CameraInfo(width=true.width, height=true.height, distortion_model="plumb_bob", D=[0.1, -0.05, 0.0, 0.0, 0.0],
                            K=[FOCAL, 0, 319.5, 0, FOCAL, 239.5, 0, 0, 1], R=[1, 0, 0, 0, 1, 0, 0, 0, 1],
                            P=[FOCAL, 0, 319.5, 0, 0, FOCAL, 239.5, 0, 0, 0, 1, 0])
        answer = rospy.ServiceProxy("set_camera_info", SetCameraInfo)(wanted)
        self.assertTrue(answer.success, answer.status_message)
        told = infos.wait(lambda info: info.K[0] == FOCAL, "the new calibration")
        self.assertEqual(list(told.D), list(wanted.D))
        with open(FILE) as file:
            self.assertEqual(yaml.safe_load(file)["camera_matrix"]["data"][0], FOCAL)

        rospy.set_param("/again/world/camera_info_url", f"file://{FILE}")
        again = support.Listener("/again/camera_info", CameraInfo)
        process = subprocess.Popen([find_node("window_ingress", "world")[0]], env={**os.environ, "ROS_NAMESPACE": "again"},
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            self.assertEqual(again.wait(what="camera_info of a new world").K[0], FOCAL)
        finally:
            process.terminate()
            process.wait(timeout=support.DEADLINE_S)

    def test_an_address_that_is_none_is_refused(self):
        rospy.set_param("/world_with_a_path/camera_info_url", "/tmp/camera.yaml")
        process = subprocess.run([find_node("window_ingress", "world")[0], "__name:=world_with_a_path"], capture_output=True,
                                 text=True, timeout=support.DEADLINE_S, check=False)
        self.assertEqual(process.returncode, 2)
        self.assertIn("camera_info_url is '/tmp/camera.yaml', must begin with file:///", process.stderr)


if __name__ == "__main__":
    rospy.init_node("world_calibration_test")
    rostest.rosrun("window_ingress", "world_calibration_test", WorldCalibrationTest, sys.argv)
