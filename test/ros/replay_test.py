#!/usr/bin/env python3
"""replay.launch, looped: detections and poses appear, no other recorded topic does, and each loop starts anew and says so."""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from rosgraph_msgs.msg import Log
from window_ingress.msg import IngressState, WindowDetection, WindowPose

import support
import write_camera_bag

WRITER = pathlib.Path(__file__).resolve().parent / "write_camera_bag.py"
UP_WITHIN_S = 60.0
SECONDS = 3
LONG_S = 6  # before the bag begins: longer than nodes wait for each other


class ReplayTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        bag = os.path.join(cls.folder, "flight.bag")
        subprocess.run([sys.executable, str(WRITER), bag, "compressed", "outputs", f"seconds={SECONDS}"], check=True)
        cls.windows, cls.poses = support.Listener("window", WindowDetection), support.Listener("window_pose", WindowPose)
        cls.commands = [support.Listener(topic, TwistStamped) for topic in write_camera_bag.COMMANDS if "navigator" not in topic]
        cls.own_commands = [support.Listener(topic, TwistStamped) for topic in ("replay/cmd_vel", "ingress_navigator/cmd_vel")]
        cls.states, cls.log = support.Listener("state", IngressState), support.Listener("/rosout", Log)
        config = os.path.join(cls.folder, "window.yaml")
        with open(config, "w", encoding="utf-8") as file:
            file.write("homography_pose: {pose: {opening_width_m: 1.25, opening_height_m: 1.0}}\n")  # as support.window_image() shows it
        cls.play = subprocess.Popen(["roslaunch", "window_ingress", "replay.launch", f"bag:={bag}", f"config:={config}", "loop:=true",
                                     "navigator:=true", f"wait:={LONG_S}"])

    @classmethod
    def tearDownClass(cls):
        cls.play.send_signal(signal.SIGINT)
        cls.play.wait(30)
        shutil.rmtree(cls.folder)

    def said(self, node, words):
        return self.log.wait(lambda m: m.name == node and words in m.msg, f"{node} says '{words}'", UP_WITHIN_S, begin=0.0)

    def test_0_nodes_wait_for_the_bag_without_a_complaint(self):
        self.windows.wait(what="the first image", deadline_s=UP_WITHIN_S, begin=0.0)
        # On a busy machine the player's clock is late at times, and the nodes say so. This is no complaint about waiting.
        said = [(m.name, m.msg) for m in self.log.since(0.0) if m.level >= Log.WARN and "its player is too slow" not in m.msg]
        self.assertEqual(said, [])
        self.assertIn("/window_detector", {m.name for m in self.log.since(0.0) if "waiting for" in m.msg})

    def test_1_the_recording_is_seen_and_located(self):
        self.windows.wait(lambda m: m.detected, "a window", UP_WITHIN_S, begin=0.0)
        self.poses.wait(lambda m: m.filtered.valid and m.filtered.updates > 5, "a filtered pose", UP_WITHIN_S, begin=0.0)

    def test_2_only_what_is_needed_is_played(self):
        self.poses.wait(what="a pose", deadline_s=UP_WITHIN_S, begin=0.0)
        self.assertEqual([m for m in self.poses.since(0.0) if m.filtered.reason == "from the recording"], [])
        topics = {topic for topic, nodes in rosgraph.Master("/test").getSystemState()[0] if "/play" in nodes}
        self.assertEqual(topics, {"/camera/image_raw/compressed", "/camera/camera_info", "/odom", "/imu", "/tf_static", "/replay/clock", "/rosout"})

    def test_3_nothing_commands_and_the_navigator_stays_idle(self):
        self.states.wait(what="a state", deadline_s=UP_WITHIN_S, begin=0.0)
        self.assertEqual({m.state_name for m in self.states.since(0.0)}, {"IDLE"})
        self.assertEqual([m for topic in self.commands for m in topic.since(0.0)], [], "no recorded setpoint")
        self.own_commands[0].wait(what="the guard's zeros", deadline_s=UP_WITHIN_S, begin=0.0)
        self.assertEqual([m for topic in self.own_commands for m in topic.since(0.0) if m.twist.linear.x != 0.0], [])

    def test_5_the_clock_of_others_is_left_alone(self):
        self.assertFalse(rospy.has_param("/use_sim_time"))

    def test_4_a_loop_forgets_everything_and_says_so(self):
        for node, words in (("/window_detector", "the clock jumped back: the track is forgotten"),
                            ("/homography_pose", "the clock jumped back: odometry, transforms and filter forgotten"),
                            ("/ingress_navigator", "the clock jumped back: inputs forgotten")):
            self.said(node, words)
        poses = support.wait_for(self.poses_of_two_loops, "poses after the loop", UP_WITHIN_S)
        before, after = poses
        self.assertGreater(before[-1].filtered.updates, 10)
        self.assertLess(after[0].filtered.updates, 10, "the filter has begun anew")
        self.windows.wait(lambda m: m.detected, "a window in a later loop", UP_WITHIN_S)

    def poses_of_two_loops(self):
        """Filtered poses of two successive loops, once both have some."""
        loops, last_sec = [[]], 0.0
        for pose in self.poses.since(0.0):
            stamp_sec = pose.header.stamp.to_sec()
            if stamp_sec < last_sec - 0.5 * SECONDS:
                loops.append([])
            last_sec = stamp_sec
            if pose.filtered.valid:
                loops[-1].append(pose)
        return next(((before, after) for before, after in zip(loops, loops[1:]) if before and after), None)


if __name__ == "__main__":
    rospy.init_node("replay_test")
    rostest.rosrun("window_ingress", "replay_test", ReplayTest, sys.argv)
