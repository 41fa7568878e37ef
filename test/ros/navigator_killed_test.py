#!/usr/bin/env python3
"""The navigator is killed in fast flight towards the wall; the autopilot would fly on for 3.2 s. The guard stops the vehicle."""
import os
import signal
import sys
import unittest

import numpy
import rospy
import rostest
from nav_msgs.msg import Odometry
from window_ingress.msg import FlightVerdict, IngressState

import support

READY_WITHIN_S = 120.0  # wall time; on a slow machine the simulated clock waits
FLIGHT_WITHIN_S = 120.0
KILL_AT_M = 3.0         # from the window's plane
FAST_MPS = 0.7
TRAVEL_M = 1.5          # 1.04 m or less on an idle machine (doc/autopilots.md); 4 m without the guard
STANDS_MPS = 0.1


def place(odometry):
    point = odometry.pose.pose.position
    return numpy.array([point.x, point.y, point.z])


def speed(odometry):
    linear = odometry.twist.twist.linear
    return numpy.linalg.norm([linear.x, linear.y, linear.z])


class NavigatorKilledTest(unittest.TestCase):
    def test_the_vehicle_stops_short_of_the_wall(self):
        truth = support.Listener("/ground_truth/odom", Odometry)
        states = support.Listener("/state", IngressState)
        verdicts = support.Listener("/referee", FlightVerdict)
        support.start_mission(READY_WITHIN_S)
        states.wait(lambda s: s.target_valid and s.distance < KILL_AT_M and s.velocity.x ** 2 + s.velocity.y ** 2 > FAST_MPS ** 2,
                    "full speed towards the window", FLIGHT_WITHIN_S)
        os.kill(support.pid_of("/ingress_navigator"), signal.SIGKILL)
        killed = truth.since(0.0)[-1]
        self.assertGreater(speed(killed), FAST_MPS)

        rest = truth.wait(lambda t: speed(t) < STANDS_MPS, "a vehicle at rest", FLIGHT_WITHIN_S)
        after = rospy.Duration(3.0) + rest.header.stamp
        end = truth.wait(lambda t: t.header.stamp > after, "three seconds more", FLIGHT_WITHIN_S)
        way = [place(t) for t in truth.since(0.0) if killed.header.stamp <= t.header.stamp <= end.header.stamp]
        furthest = max(numpy.linalg.norm(point - way[0]) for point in way)
        print(f"killed at {speed(killed):.2f} m/s: {furthest:.2f} m to the furthest point")
        self.assertLess(furthest, TRAVEL_M)
        self.assertEqual(verdicts.since(0.0)[-1].outcome_name, "RUNNING", "neither through nor into anything")


if __name__ == "__main__":
    rospy.init_node("navigator_killed_test")
    rostest.rosrun("window_ingress", "navigator_killed_test", NavigatorKilledTest, sys.argv)
