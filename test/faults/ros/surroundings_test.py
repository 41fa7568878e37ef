#!/usr/bin/env python3
"""The environment of the nodes: parameters, disk, nodelet manager, master, bag files."""
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import fault_paths
import rospy
import rostest
from fault_notes import note
from geometry_msgs.msg import TwistStamped
from roslib.packages import find_node

import support

NAN = float("nan")
FLIPS = 4  # bags with corrupted bytes


def program(name):
    return find_node("window_ingress", name)[0]


def run(command, **environment):
    return subprocess.run(command, capture_output=True, text=True, timeout=60, env={**os.environ, **environment}, check=False)


class SurroundingsTest(unittest.TestCase):
    def refused(self, node, name, value):
        rospy.set_param(f"/{node}/{name}", value)
        try:
            done = run([program(node)])
        finally:
            rospy.delete_param(f"/{node}/{name}")
        self.assertEqual(done.returncode, 2, f"{name} = {value}: {done.stderr}")
        self.assertIn(f"/{node}/{name}", done.stderr)
        return done.stderr.strip().splitlines()[-1]

    def test_M82_numbers_and_truths_of_another_type(self):
        said = [self.refused("setpoint_guard", "late_sec", "0.5"), self.refused("setpoint_guard", "lockstep", 1),
                self.refused("ingress_navigator", "navigator/search/turns", 2.5), self.refused("homography_pose", "window_frame", 7)]
        note("M82", f"each refused, e.g. '{said[0]}'")

    def test_M83_numbers_that_are_none_and_names_that_are_wrong(self):
        for value in (NAN, float("inf"), -float("inf"), 1e300):
            self.refused("ingress_navigator", "navigator/limits/speed_mps", value)
            self.refused("ingress_navigator", "navigator/search/turns", value)
        said = self.refused("window_detector", "detector/min_scroe", 0.5)
        note("M83", f"nan, inf, 1e300 for numbers and for whole numbers; '{said}'")

    def test_M84_even_and_odd_sizes_by_yaml(self):
        self.refused("window_detector", "detector/min_score", NAN)
        self.refused("window_detector", "detector/preprocess/blur_px", -1.0)

    def test_M85_a_transport_that_is_not_there(self):
        rospy.set_param("/window_detector/image_transport", "h265_of_tomorrow")
        done = run([program("window_detector")])
        rospy.delete_param("/window_detector/image_transport")
        self.assertEqual(done.returncode, 2)
        self.assertIn("available are: compressed", done.stderr)
        note("M85", done.stderr.strip().splitlines()[-1])

    def test_M88_no_place_to_write_to(self):
        """Home and logs lie below a file, so that they cannot be created; standard output is full."""
        rospy.set_param("/guard_without_disk/frame", "odom")
        with open("/dev/full", "w", encoding="utf-8") as full:
            process = subprocess.Popen([program("setpoint_guard"), "__name:=guard_without_disk"], stdout=full, stderr=subprocess.PIPE,
                                       env={**os.environ, "ROS_HOME": "/dev/null/ros", "ROS_LOG_DIR": "/dev/null/log", "HOME": "/dev/null"})
        output = support.Listener("cmd_vel", TwistStamped)
        try:
            output.wait(what="the stream")
            begin = time.monotonic()
            support.wait_for(lambda: len(output.since(begin)) > 40, "the stream goes on", 3.0)
            self.assertIsNone(process.poll())
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate(timeout=10)
            output.stop()
        self.assertEqual(process.returncode, 0)
        note("M88", "streams without home, logs and standard output, ends with 0")

    def test_M94_nodelets_that_cannot_start_leave_their_manager(self):
        manager = subprocess.Popen(["rosrun", "nodelet", "nodelet", "manager", "__name:=nodelets"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.PIPE, start_new_session=True)
        try:
            rospy.wait_for_service("/nodelets/load_nodelet", 20.0)
            rospy.set_param("/bad/detector", {"min_score": "high"})
            self.load("bad")  # remains, without a node, until it is unloaded
            self.assertIsNone(manager.poll(), "the manager lives")
        finally:
            os.killpg(manager.pid, signal.SIGTERM)
            manager.wait(20)
        note("M94", "onInit that throws: said as FATAL, the manager lives; nodelets.test takes one out and puts it in again")

    @staticmethod
    def load(name):
        return run(["timeout", "8", "rosrun", "nodelet", "nodelet", "load", "window_ingress/WindowDetectorNodelet", "nodelets", f"__name:={name}"])

    def test_M90_the_master_dies_and_comes_back(self):
        done = run([sys.executable, str(fault_paths.HERE / "master_dies.py")])
        self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
        note("M90", done.stdout.strip().splitlines()[-1])

    def test_zM87_last_bags_that_are_none_or_damaged(self):
        with tempfile.TemporaryDirectory() as folder:
            good = os.path.join(folder, "good.bag")
            subprocess.run([sys.executable, str(fault_paths.HERE.parents[1] / "ros" / "write_camera_bag.py"), good, "seconds=0.4"], check=True)
            data = pathlib.Path(good).read_bytes()
            codes = {what: self.replay(folder, what, content) for what, content in
                     (("missing", None), ("empty", b""), ("garbage", os.urandom(5000)), ("cut in its header", data[:100]),
                      ("cut in its middle", data[:len(data) // 2]))}
            generator = random.Random(1)
            flipped = []
            for _ in range(FLIPS):
                damaged = bytearray(data)
                for _ in range(20):
                    damaged[generator.randrange(100, len(damaged))] ^= 1 << generator.randrange(8)
                flipped.append(self.replay(folder, "flipped", bytes(damaged)))
        self.assertEqual({codes[what] for what in ("missing", "empty", "garbage", "cut in its header")}, {2}, codes)
        note("M87", f"{codes}; {FLIPS} with 20 flipped bits each: {sorted(flipped)}")

    def replay(self, folder, what, content):
        bag = os.path.join(folder, "bad.bag")
        if content is None:
            bag = os.path.join(folder, "not_there.bag")
        else:
            pathlib.Path(bag).write_bytes(content)
        done = run([program("replay_bag"), "--bag", bag, "--output", os.path.join(folder, "out")])
        self.assertIn(done.returncode, (0, 1, 2), f"{what}: {done.stderr[-500:]}")
        if done.returncode:
            self.assertTrue(done.stderr.strip(), f"{what}: no word of why")
        return done.returncode


if __name__ == "__main__":
    rospy.init_node("surroundings_test")
    rostest.rosrun("window_ingress", "surroundings_test", SurroundingsTest, sys.argv)
