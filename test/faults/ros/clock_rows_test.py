#!/usr/bin/env python3
"""Simulated time that is missing, stands still, or jumps, while the vehicle is on its way; the monitor judges."""
import sys
import time
import unittest

import fault_paths  # noqa: F401
import rospy
import rostest
from fault_notes import note
from frozen_clock_test import SimulatedClock
from window_ingress.msg import WindowDetection, WindowPose

import chain
import monitor as monitors
import oracles
import support

WATCH_S = 1.0


class ClockRowsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.monitor = monitors.Monitor(topics={"steered": "/ingress_navigator/cmd_vel"})
        cls.began = time.monotonic()

    def tearDown(self):
        self.assertEqual(self.monitor.violations(self.began), [])

    def watch(self, seconds):
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() > begin + seconds, "the time of the measurement")

    def test_1_M42_without_a_clock_nothing_moves_and_it_is_said(self):
        begin = time.monotonic()
        self.watch(2.0)
        said = [s for s in self.monitor.part(self.began).said if s.name == "ingress_navigator: clock" and "nothing has come on /clock" in s.text]
        self.assertTrue(said, "the cause")
        reply = chain.Chain.call("start")
        self.assertFalse(reply.success)
        self.assertIn("/clock", reply.message)
        setpoints = self.monitor.part(begin).setpoints
        self.assertTrue(all(oracles.is_still(s) for s in setpoints))
        rate = len([s for s in setpoints if s.source == "/setpoint_guard"]) / (time.monotonic() - begin)
        self.assertGreater(rate, 20.0)
        note("M42", f"'{reply.message}'; zeros at {rate:.0f} Hz")

    def test_2_M41_a_clock_that_freezes(self):
        type(self).clock = SimulatedClock(1000.0)
        type(self).chain = chain.Chain()
        self.chain.fly(self.monitor)
        begin = time.monotonic()
        self.clock.running = False
        self.assertEqual(self.monitor.stops(begin, WATCH_S), [])
        for node in monitors.NODES:
            self.assertEqual(self.monitor.names(begin, f"{node}: clock", "/clock stands still"), [])
        part = self.monitor.part(begin)
        rate = len([s for s in part.setpoints if s.source == "/setpoint_guard"]) / (time.monotonic() - begin)
        self.assertGreater(rate, 20.0)
        stopped = oracles.stop_time(part, begin, time.monotonic()) or 0.0
        self.clock.running = True
        self.chain.fly(self.monitor)  # O3: the velocity grows from zero
        note("M41", f"stands after {stopped:.2f} s, zeros at {rate:.0f} Hz, each node says that /clock stands still")

    def test_3_M44_a_clock_that_leaps_ahead(self):
        self.chain.fly(self.monitor)
        begin = time.monotonic()
        camera = self.chain.streams["image_raw"]
        camera.pause()  # otherwise the first image of the new time may precede the navigator's check
        self.clock.leap(950.0)
        self.watch(0.5)
        camera.resume()
        self.assertIn("HOLD", [s.name for s in self.monitor.part(begin).states], "all that it knows is old")
        self.chain.fly(self.monitor)
        states = [s.name for s in self.monitor.part(begin).states]
        note("M44", f"{' '.join(dict.fromkeys(states))}; on its way again after {time.monotonic() - begin:.1f} s")

    def test_4_M43_a_clock_that_jumps_back(self):
        self.chain.fly(self.monitor)
        windows, poses = support.Listener("window", WindowDetection), support.Listener("window_pose", WindowPose)
        self.monitor.clock_restarts()
        begin = time.monotonic()
        self.clock.leap(-51.0)
        after = rospy.Time.from_sec(self.clock.now + 0.5)
        support.wait_for(lambda: [s for s in self.monitor.states_since(begin) if s.name == "ABORTED"], "ABORTED")
        windows.wait(lambda w: w.detected and w.header.stamp < after, "a window in the new time", 3.0, begin=begin)
        poses.wait(lambda p: p.filtered.valid, "a pose in the new time", 3.0, begin=begin + 0.5)
        took = time.monotonic() - begin
        self.watch(1.0)
        moving = [s for s in self.monitor.part(begin + 0.3).setpoints if not oracles.is_still(s)]
        self.assertEqual(moving, [], "no motion without ~start")
        self.chain.fly(self.monitor)
        note("M43", f"mission aborted, window and pose in the new time after {took:.1f} s, on its way again after ~start")


if __name__ == "__main__":
    rospy.init_node("clock_rows_test")
    rostest.rosrun("window_ingress", "clock_rows_test", ClockRowsTest, sys.argv)
