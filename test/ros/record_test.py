#!/usr/bin/env python3
"""record.launch beside a flight: replay_bag and plot_flight can use the bag."""
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import rosbag
import roslib.packages
import rospy
import rostest
from window_ingress.msg import FlightVerdict

import support

READY_WITHIN_S, FLIGHT_WITHIN_S = 120.0, 200.0
NEEDED = ("/camera/image_raw/compressed", "/camera/camera_info", "/odom", "/imu", "/tf", "/tf_static", "/window", "/window_pose",
          "/state", "/cmd_vel", "/ingress_navigator/cmd_vel", "/diagnostics", "/ground_truth/odom", "/ground_truth/window")


def tool(name, *arguments):
    """Does not use rosrun, which asks interactively if a build folder lies within the package."""
    program = roslib.packages.find_node("window_ingress", name)[0]
    return subprocess.run([program, *arguments], capture_output=True, text=True, check=False)


class RecordTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        recorder = subprocess.Popen(["roslaunch", "window_ingress", "record.launch", f"name:={cls.folder}/flight"])
        support.wait_for(lambda: glob.glob(cls.folder + "/*.bag.active"), "a bag", READY_WITHIN_S)
        verdicts = support.Listener("referee", FlightVerdict)
        support.start_mission(READY_WITHIN_S)
        cls.verdict = verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING, "a verdict", FLIGHT_WITHIN_S)
        recorder.send_signal(signal.SIGINT)
        recorder.wait(60)
        cls.bags = sorted(glob.glob(cls.folder + "/flight*.bag"))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_1_one_closed_bag_with_what_is_needed_and_no_more(self):
        self.assertEqual(len(self.bags), 1, os.listdir(self.folder))
        with rosbag.Bag(self.bags[0]) as bag:
            topics = bag.get_type_and_topic_info().topics
            seconds = bag.get_end_time() - bag.get_start_time()
            images = topics[NEEDED[0]].message_count
        self.assertEqual([topic for topic in NEEDED if topic not in topics], [])
        self.assertFalse({"/camera/image_raw", "/clock", "/debug_image", "/markers"} & set(topics))
        size_mb = os.path.getsize(self.bags[0]) / 1e6
        print(f"recorded {size_mb:.1f} MB in {seconds:.1f} s: {60 * size_mb / seconds:.0f} MB a minute, {images} images", flush=True)
        self.assertLess(60 * size_mb / seconds, 200.0, "MB a minute")

    def test_2_replay_bag_finds_the_window_in_it(self):
        out = self.folder + "/replay"
        done = tool("replay_bag", "--bag", self.bags[0], "--output", out, "--window-size", "1.2,1.0")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out + "/replay.json", encoding="utf-8") as file:
            counts = json.load(file)["counts"]
        self.assertGreater(counts["images"], 50)
        self.assertEqual((counts["without_calibration"], counts["jumps_back_in_time"]), (0, 0))
        self.assertLess(counts["without_odometry"], 5)
        with open(out + "/frames.csv", encoding="utf-8") as file:
            found = [line.split(",")[1] == "1" for line in file][1:]
        self.assertGreater(sum(found), 30)
        self.assertTrue(os.path.isfile(out + "/report.html"))

    def test_3_plot_flight_draws_it(self):
        done = tool("plot_flight", self.bags[0], "--output", self.folder + "/flight.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"referee: {self.verdict.outcome_name}", done.stdout)
        self.assertGreater(os.path.getsize(self.folder + "/flight.png"), 20000)


if __name__ == "__main__":
    rospy.init_node("record_test")
    rostest.rosrun("window_ingress", "record_test", RecordTest, sys.argv)
