#!/usr/bin/env python3
"""Simulated time that is missing, stands still, or jumps back: zeros continue, and the cause is reported."""
import sys
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock, Log
from std_srvs.srv import Trigger
from window_ingress.msg import IngressState, WindowPose

import support
from ingress_navigator_test import speed


TICK_S = 0.01


class SimulatedClock:
    """/clock at 100 Hz, from `start`, until it is frozen."""

    def __init__(self, start):
        self._publisher = rospy.Publisher("/clock", Clock, queue_size=1)
        self.now = start
        self.running = True
        self._moving = threading.Lock()
        self._over = threading.Event()
        threading.Thread(target=self._run, daemon=True).start()

    def leap(self, seconds):
        with self._moving:
            self.now += seconds

    def _run(self):
        while not self._over.wait(TICK_S):
            if self.running:
                self.leap(TICK_S)
                self._publisher.publish(Clock(rospy.Time.from_sec(self.now)))

    def stop(self):
        self._over.set()


class FrozenClockTest(unittest.TestCase):
    def expect_zeros_of_the_guard(self, guarded, begin):
        """Two seconds of wall time, at 20 Hz or more, whatever /clock does."""
        support.wait_for(lambda: len(guarded.since(begin)) >= 40, "the guard's stream goes on", 2.0 + time.monotonic() - begin)
        self.assertTrue(all(speed(s) == 0.0 for s in guarded.since(begin)))

    def test_absent_then_frozen_then_jumping_back(self):
        setpoints = support.Listener("cmd_vel", TwistStamped)
        guarded = support.Listener("guarded", TwistStamped)
        states, log = support.Listener("state", IngressState), support.Listener("/rosout", Log)
        diagnostics = support.Diagnostics()
        rospy.wait_for_service("ingress_navigator/start")
        start = rospy.ServiceProxy("ingress_navigator/start", Trigger)

        reply = start()
        self.assertFalse(reply.success)
        self.assertIn("/clock", reply.message)
        diagnostics.wait("ingress_navigator: clock", "nothing has come on /clock")

        guarded.wait(what="the guard's stream without a clock")
        self.expect_zeros_of_the_guard(guarded, time.monotonic())

        early = support.Stream("odom", Odometry, lambda stamp: support.odometry(rospy.Time(1000)), 50.0)
        diagnostics.wait("ingress_navigator: odom", "refused", "the clock has not begun")
        early.stop()
        self.assertEqual([m.msg for m in log.since(0.0) if "odom refused" in m.msg], [], "counted, but no complaint of its own")

        clock = SimulatedClock(1000.0)
        support.Stream("odom", Odometry, support.odometry, 50.0)
        support.Stream("window_pose", WindowPose, support.no_window, 30.0)
        support.wait_for(lambda: start().success, "a mission that starts")
        setpoints.wait(lambda s: speed(s) > 0.0, "motion")
        guarded.wait(lambda s: speed(s) > 0.0, "motion behind the guard")

        clock.running = False
        frozen = time.monotonic() + 0.6
        diagnostics.wait("ingress_navigator: clock", "stands still")
        support.wait_for(lambda: len(setpoints.since(frozen)) > 40, "the stream goes on")
        self.assertTrue(all(speed(s) == 0.0 for s in setpoints.since(frozen)))
        self.expect_zeros_of_the_guard(guarded, frozen)

        clock.leap(-51.0)
        clock.running = True
        states.wait(lambda s: s.state_name == "ABORTED", "the mission aborted when the clock jumped back")
        clock.stop()


if __name__ == "__main__":
    rospy.init_node("frozen_clock_test")
    rostest.rosrun("window_ingress", "frozen_clock_test", FrozenClockTest, sys.argv)
