#!/usr/bin/env python3
"""If a scenario asks for a chosen target, start_mission.py chooses it before the start, and the vehicle flies through it."""
import sys
import unittest

import rospy
import rostest
from window_ingress.msg import Facade, FlightVerdict, IngressState

import support

FLIGHT_WITHIN_S = 400.0  # wall time; on a slow machine the simulated clock waits


class ChosenTargetTest(unittest.TestCase):
    def test_the_window_pointed_at_is_the_one_flown_through(self):
        verdicts, states = support.Listener("referee", FlightVerdict), support.Listener("state", IngressState)
        facades = support.Listener("facade", Facade)
        verdict = verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING, "a verdict", FLIGHT_WITHIN_S, begin=0.0)
        self.assertEqual(verdict.outcome_name, "PASSED", f"{verdict.reason}; {states.since(0.0)[-1].reason}")
        begun = next(s.header.stamp for s in states.since(0.0) if s.state != IngressState.IDLE)
        chosen = next(f.header.stamp for f in facades.since(0.0) if f.target_chosen)
        self.assertLessEqual(chosen, begun)


if __name__ == "__main__":
    rospy.init_node("chosen_target_test")
    rostest.rosrun("window_ingress", "chosen_target_test", ChosenTargetTest, sys.argv)
