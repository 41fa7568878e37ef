#!/usr/bin/env python3
"""In lockstep a flight through the real nodes repeats exactly, on any machine load."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from window_ingress.msg import WindowPose

import support

FLIGHT_WITHIN_S = 400.0
FREE_AGAIN_WITHIN_S = 60.0
TOPICS = {"ground_truth/odom": Odometry, "ground_truth/window_in_camera": PoseStamped,
          "window_pose": WindowPose, "cmd_vel": TwistStamped}
BUSY = "while True: pass"


def numbers(message):
    """All members of a message except its sequence number, as text: equal only if equal to the last bit."""
    message.header.seq = 0
    return repr(message)


def by_stamp(messages):
    """stamp -> first message with this stamp. A node that shuts down may publish once more with its last stamp."""
    recording = {}
    for message in messages:
        recording.setdefault(message.header.stamp, numbers(message))
    return recording


def latest_first(recordings):
    """Time from which all recordings have data: on a busy machine a subscriber may be late. The verdict covers the whole flight."""
    return max(min(recording) for recording in recordings)


class LockstepTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def fly(self, seed, *arguments):
        """One flight: topic -> stamp -> message, and the verdict as it was written."""
        verdict_file = os.path.join(self.folder.name, f"verdict_{time.monotonic()}.json")
        listeners = {topic: support.Listener(topic, kind) for topic, kind in TOPICS.items()}
        launch = subprocess.Popen(["roslaunch", "window_ingress", "sim.launch", "lockstep:=true", "auto_start:=true",
                                   f"seed:={seed}", f"verdict_file:={verdict_file}", *arguments],
                                  start_new_session=True)
        try:
            launch.wait(FLIGHT_WITHIN_S)
        finally:
            if launch.poll() is None:
                launch.send_signal(signal.SIGINT)
                launch.wait(FREE_AGAIN_WITHIN_S)
            for listener in listeners.values():
                listener.stop()
        recording = {topic: by_stamp(listener.since(0.0)) for topic, listener in listeners.items()}
        with open(verdict_file) as file:
            return recording, file.read()

    def assert_same(self, one, other, end):
        """Compares up to the referee's verdict. Then the launch ends, and nodes send zeros while they stop at different times."""
        for topic in TOPICS:
            begin = latest_first([one[topic], other[topic]])
            a = {t: m for t, m in one[topic].items() if begin <= t < end}
            b = {t: m for t, m in other[topic].items() if begin <= t < end}
            print(f"{topic}: {len(a)} messages compared of {len(one[topic])} and {len(other[topic])}", file=sys.stderr)
            self.assertGreater(len(a), 100, topic)
            self.assertGreater(len(a), 0.5 * max(len(one[topic]), len(other[topic])), f"{topic}: too few in common")
            self.assertEqual(sorted(a), sorted(b), topic)
            differing = sorted(t for t in a if a[t] != b[t])
            self.assertEqual(len(differing), 0, differing and
                             f"{topic} differs first at {differing[0]}:\n{a[differing[0]]}\n{b[differing[0]]}")

    def test_two_flights_are_the_same_to_the_bit_with_the_machine_busy_or_not(self):
        calm, calm_verdict = self.fly(1)
        busy_loops = [subprocess.Popen([sys.executable, "-c", BUSY]) for _ in range(os.cpu_count())]
        try:
            busy, busy_verdict = self.fly(1)
        finally:
            for loop in busy_loops:
                loop.kill()
        print(calm_verdict, file=sys.stderr)
        verdict = json.loads(calm_verdict)
        self.assertEqual(verdict["outcome"], "PASSED", calm_verdict)
        self.assertEqual(calm_verdict, busy_verdict)
        self.assert_same(calm, busy, rospy.Time.from_sec(verdict["stamp"]))


if __name__ == "__main__":
    rospy.init_node("lockstep_test")
    rostest.rosrun("window_ingress", "lockstep_test", LockstepTest, sys.argv)
