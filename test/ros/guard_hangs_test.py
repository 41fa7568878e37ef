#!/usr/bin/env python3
"""The guard hangs in fast flight towards the wall; the autopilot would fly on for 3.2 s. The navigator stops the vehicle and waits."""
import os
import signal
import sys
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from window_ingress.msg import FlightVerdict, IngressState

import support

READY_WITHIN_S = 120.0  # wall time; on a slow machine the simulated clock waits
FLIGHT_WITHIN_S = 120.0
HANG_AT_M = 3.0         # from the window's plane
FAST_MPS = 0.7
STANDS_MPS = 0.1
NAVIGATOR, GUARD = "/ingress_navigator", "/setpoint_guard"


def speed(velocity):
    return (velocity.x ** 2 + velocity.y ** 2 + velocity.z ** 2) ** 0.5


def source(message):
    return message._connection_header["callerid"]


class GuardHangsTest(unittest.TestCase):
    def test_the_navigator_brakes_past_it_and_goes_on_when_it_is_back(self):
        setpoints = support.Listener("/cmd_vel", TwistStamped)
        states = support.Listener("/state", IngressState)
        truth = support.Listener("/ground_truth/odom", Odometry)
        verdicts = support.Listener("/referee", FlightVerdict)
        support.start_mission(READY_WITHIN_S)
        states.wait(lambda s: s.target_valid and s.distance < HANG_AT_M and speed(s.velocity) > FAST_MPS,
                    "full speed towards the window", FLIGHT_WITHIN_S)
        self.assertEqual({source(s) for s in setpoints.since(0.0)}, {GUARD}, "the autopilot hears the guard alone")
        guard = support.pid_of(GUARD)
        os.kill(guard, signal.SIGSTOP)
        try:
            states.wait(lambda s: s.state_name == "HOLD" and "guard" in s.reason, "HOLD without the guard", FLIGHT_WITHIN_S)
            truth.wait(lambda t: speed(t.twist.twist.linear) < STANDS_MPS, "a vehicle at rest", FLIGHT_WITHIN_S)
            support.Diagnostics().wait("ingress_navigator: passed_on", "nothing on /setpoint_guard/passed_on")
            self.assertEqual(states.since(0.0)[-1].state_name, "HOLD")
            past = [s for s in setpoints.since(0.0) if source(s) == NAVIGATOR]
            self.assertGreater(len(past), 10)
            self.assertEqual({speed(s.twist.linear) + abs(s.twist.angular.z) for s in past}, {0.0})
            self.assertEqual(verdicts.since(0.0)[-1].outcome_name, "RUNNING", "neither through nor into anything")
        finally:
            os.kill(guard, signal.SIGCONT)
        verdict = verdicts.wait(lambda v: v.outcome_name != "RUNNING", "the end of the mission", FLIGHT_WITHIN_S)
        self.assertEqual(verdict.outcome_name, "PASSED", verdict.reason)
        self.assertEqual(source(setpoints.since(0.0)[-1]), GUARD)


if __name__ == "__main__":
    rospy.init_node("guard_hangs_test")
    rostest.rosrun("window_ingress", "guard_hangs_test", GuardHangsTest, sys.argv)
