#!/usr/bin/env python3
"""World, detector, pose node, navigator and guard as processes: started by service, judged PASSED by the referee.

How far off the centre it may cross is bounded in closed_loop_flight_test.cpp."""
import sys
import unittest

import rospy
import rostest
from window_ingress.msg import FlightVerdict, IngressState

import support

READY_WITHIN_S = 120.0   # wall time; on a slow machine the simulated clock waits
FLIGHT_WITHIN_S = 400.0


class FlightTest(unittest.TestCase):
    def test_flight_passes(self):
        verdicts = support.Listener("referee", FlightVerdict)
        states = support.Listener("state", IngressState)
        support.start_mission(READY_WITHIN_S)
        verdict = verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING, "a verdict", FLIGHT_WITHIN_S)
        visited = [state.state_name for state in states.since(0.0)]
        self.assertEqual(verdict.outcome_name, "PASSED", f"{verdict.reason}; {visited[-1]}: {states.since(0.0)[-1].reason}")
        self.assertGreater(verdict.min_clearance, 0.0)
        states.wait(lambda s: s.state_name == "PASSED", "the navigator agrees", begin=0.0)


if __name__ == "__main__":
    rospy.init_node("flight_test")
    rostest.rosrun("window_ingress", "flight_test", FlightTest, sys.argv)
