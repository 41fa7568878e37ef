#!/usr/bin/env python3
"""Image in, corners out: with and without calibration, and with anything else on the topic."""
import os
import sys
import time
import unittest

import numpy
import rospy
import rostest
import yaml
from dynamic_reconfigure.client import Client
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_srvs.srv import Trigger
from window_ingress.msg import WindowDetection

import support

CAPTURE_STEM = "/tmp/window_detector_test_reference"  # as in window_detector.test


class WindowDetectorTest(unittest.TestCase):
    def setUp(self):
        self.windows = support.Listener("window", WindowDetection)
        self.streams = []

    def tearDown(self):
        for stream in self.streams:
            stream.stop()
        self.windows.stop()

    def stream(self, make, topic="image_raw", kind=Image, rate_hz=15.0):
        self.streams.append(support.Stream(topic, kind, make, rate_hz))
        return self.streams[-1]

    def test_corners_come_without_calibration(self):
        pixels = support.window_image()
        self.stream(lambda stamp: support.image_message(pixels, stamp))
        window = self.windows.wait(lambda w: w.detected, "a window without camera_info")
        for corner, wanted in zip(window.corners, support.CORNERS):
            self.assertAlmostEqual(corner.x, wanted[0], delta=1.5)
            self.assertAlmostEqual(corner.y, wanted[1], delta=1.5)
        self.assertEqual(window.header.frame_id, "camera_optical_frame")
        self.assertEqual((window.image_width, window.image_height), (support.WIDTH, support.HEIGHT))
        self.assertEqual((window.reject, window.reason), (WindowDetection.OK, ""))
        support.Diagnostics().wait("window_detector: camera_info", "no camera_info on /camera_info (0 publishers)")

    def test_the_attitude_of_the_exposure_comes_from_imu_and_mounting(self):
        pixels = support.window_image()
        diagnostics = support.Diagnostics()
        self.stream(lambda stamp: support.image_message(pixels, stamp - rospy.Duration(0.03)))
        self.stream(support.camera_info, "camera_info", CameraInfo)
        self.windows.wait(lambda w: w.detected, "a window without attitude")
        diagnostics.wait("window_detector: attitude", "image alone", "nothing on /imu")
        imu = self.stream(support.imu, "imu", Imu, 100.0)
        diagnostics.wait("window_detector: attitude", "image alone", "not in tf")
        mounting = support.publish_mounting()
        diagnostics.wait("window_detector: attitude", "known at the last image")
        self.windows.wait(lambda w: w.detected, "a window with attitude")

        def elsewhere(stamp):
            message = support.imu(stamp)
            message.header.frame_id = "imu_link"
            return message
        imu.make = elsewhere
        diagnostics.wait("window_detector: attitude", "image alone", "'imu_link', expected 'base_link'")
        self.windows.wait(lambda w: w.detected, "a window all the same")
        mounting.unregister()

    def test_stamp_is_that_of_the_image(self):
        pixels = support.window_image()
        sent = []
        self.stream(lambda stamp: sent.append(stamp) or support.image_message(pixels, stamp))
        self.stream(support.camera_info, "camera_info", CameraInfo)
        window = self.windows.wait(lambda w: w.detected, "a window")
        self.assertIn(window.header.stamp, sent)

    def test_no_window_is_news_with_a_reason(self):
        wall = numpy.full((support.HEIGHT, support.WIDTH, 3), 190, numpy.uint8)
        self.stream(lambda stamp: support.image_message(wall, stamp))
        window = self.windows.wait(lambda w: not w.detected, "a message without window")
        self.assertNotEqual(window.reason, "")
        self.assertNotEqual(window.reject, WindowDetection.OK)
        self.assertEqual([corner.x for corner in window.corners], [0.0] * 4)

    def test_bad_images_are_refused_by_name_and_good_ones_go_on(self):
        pixels = support.window_image()

        def overflow(stamp):  # height * step wraps in 32 bits
            message = support.image_message(pixels, stamp)
            message.encoding, message.width, message.height, message.step = "mono8", 65536, 65537, 65536
            message.data = bytes(65536)
            return message
        bad = self.stream(overflow)
        support.Diagnostics().wait("window_detector: image", "refused", "max_pixels")
        bad.make = lambda stamp: support.image_message(pixels, stamp)
        self.windows.wait(lambda w: w.detected, "a window after bad images")

    def test_stamps_of_zero_and_far_future_are_refused(self):
        pixels = support.window_image()
        diagnostics = support.Diagnostics()
        stream = self.stream(lambda stamp: support.image_message(pixels, rospy.Time()))
        diagnostics.wait("window_detector: image", "header.stamp is zero")
        stream.make = lambda stamp: support.image_message(pixels, rospy.Time(4294967295, 0))
        diagnostics.wait("window_detector: image", "ahead of the clock")
        stream.make = lambda stamp: support.image_message(pixels, stamp)
        self.windows.wait(lambda w: w.detected, "a window after bad stamps")

    def test_debug_image_comes_while_somebody_looks(self):
        pixels = support.window_image()
        self.stream(lambda stamp: support.image_message(pixels, stamp))
        debug = support.Listener("debug_image", Image)
        image = debug.wait(what="a debug image")
        debug.stop()
        self.assertEqual((image.width, image.height, image.encoding), (support.WIDTH, support.HEIGHT, "bgr8"))

    def test_reference_is_captured_from_the_window_in_view(self):
        rospy.wait_for_service("window_detector/capture_reference", support.DEADLINE_S)
        capture = rospy.ServiceProxy("window_detector/capture_reference", Trigger)
        wall = numpy.full((support.HEIGHT, support.WIDTH, 3), 190, numpy.uint8)
        stream = self.stream(lambda stamp: support.image_message(wall, stamp))
        self.windows.wait(lambda w: not w.detected, "a message without window")
        refused = capture()
        self.assertFalse(refused.success)
        self.assertIn("no window in the last image", refused.message)
        pixels = support.window_image()
        stream.make = lambda stamp: support.image_message(pixels, stamp)
        self.windows.wait(lambda w: w.detected, "a window")
        answers = []

        def is_taken():
            answers.append(capture())
            return answers[-1].success
        support.wait_for(is_taken, "the reference captured")
        stem = os.path.splitext(answers[-1].message.rpartition("; written to ")[2])[0]
        self.addCleanup(lambda: [os.remove(stem + end) for end in (".png", ".yaml", "_understood.png")])
        self.assertTrue(stem.startswith(CAPTURE_STEM))
        window = self.windows.wait(lambda w: w.detected and w.appearance.compared, "a window compared with the reference")
        self.assertLess(window.appearance.bhattacharyya, 0.2)
        support.Diagnostics().wait("window_detector: reference", "live image", "distance")
        with open(stem + ".yaml") as file:
            kept = yaml.safe_load(file)["window_detector"]["reference"]
        self.assertEqual(kept["picture"], stem + ".png")
        self.assertGreater(os.path.getsize(stem + ".png"), 1000)
        self.assertGreater(os.path.getsize(stem + "_understood.png"), 1000)
        for (x, y), wanted in zip(zip(kept["corners"][::2], kept["corners"][1::2]), support.CORNERS):
            self.assertAlmostEqual(x, wanted[0], delta=1.5)
            self.assertAlmostEqual(y, wanted[1], delta=1.5)

    def test_tuning_is_taken_or_refused_aloud_and_reaches_the_detector(self):
        client = Client("window_detector/tuning", timeout=support.DEADLINE_S)
        before = client.get_configuration(timeout=support.DEADLINE_S)
        pixels = support.window_image()
        self.stream(lambda stamp: support.image_message(pixels, stamp))
        self.windows.wait(lambda w: w.detected, "a window")
        console, begin = support.Listener("/rosout", Log), time.monotonic()

        def refused_aloud():  # a new subscriber may miss a line
            after = client.update_configuration({"min_score": 7.0, "min_correlation": 1.0})
            self.assertEqual([after[name] for name in ("min_score", "min_correlation")], [before[name] for name in ("min_score", "min_correlation")])
            return any("change refused, old values kept" in m.msg and "min_score = 7 is not within" in m.msg for m in console.since(begin))
        support.wait_for(refused_aloud, "the refusal")
        console.stop()
        self.assertEqual(client.update_configuration(
            {"min_score": 1.0, "min_score_reference": 1.0, "min_correlation": 1.0})["min_score"], 1.0)
        begin = time.monotonic()
        self.windows.wait(lambda w: not w.detected, "a window that is no longer good enough", begin=begin)
        self.assertEqual(client.update_configuration(
            {name: before[name] for name in ("min_score", "min_score_reference", "min_correlation")})["min_score"],
            before["min_score"])
        self.windows.wait(lambda w: w.detected, "a window again")


if __name__ == "__main__":
    rospy.init_node("window_detector_test")
    rostest.rosrun("window_ingress", "window_detector_test", WindowDetectorTest, sys.argv)
