#!/usr/bin/env python3
"""px4.launch with a simulated MAVROS: stand-by, engagement, a pilot who takes over, and a navigator killed in flight."""
import os
import signal
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from mavros_msgs.msg import CompanionProcessStatus  # of stand_ins
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu
from window_ingress.msg import IngressState, WindowPose

import support

LATE_S, STOP_S = 0.2, 2.0  # of the guard; the second is set in autopilot.test
MARGIN_S = 0.3             # a loaded machine


class AutopilotTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.setpoints = support.Listener("/mavros/setpoint_velocity/cmd_vel", TwistStamped)
        cls.states = support.Listener("/state", IngressState)
        cls.companion = support.Listener("/mavros/companion_process/status", CompanionProcessStatus)
        cls.armed, cls.mode, cls.system_status = False, "POSCTL", 4
        cls.streams = [support.Stream("/mavros/local_position/odom", Odometry, support.changed(support.odometry, header__frame_id="map"), 50.0),
                       support.Stream("/mavros/imu/data", Imu, support.imu, 50.0),
                       support.Stream("/window_pose", WindowPose, support.no_window, 30.0)]
        cls.states_of_autopilot = support.Stream("/mavros/state", support.AutopilotState, cls.state, 5.0)

    @classmethod
    def tearDownClass(cls):
        for stream in (*cls.streams, cls.states_of_autopilot):
            stream.stop()

    @classmethod
    def state(cls, stamp):
        message = support.AutopilotState(connected=True, armed=cls.armed, mode=cls.mode, system_status=cls.system_status)
        message.header.stamp = stamp
        return message

    @staticmethod
    def call(service):
        return support.call(f"/ingress_navigator/{service}")

    def fly(self):
        type(self).armed, type(self).mode = True, "OFFBOARD"
        support.wait_for(lambda: self.call("start").success, "a mission that starts")
        return self.setpoints.wait(lambda s: not support.is_zero(s), "motion")

    def companion_is(self, state):
        self.companion.wait(lambda s: s.state == state and s.component == CompanionProcessStatus.MAV_COMP_ID_USER1, f"companion status {state}")

    def zeros_from(self, begin, seconds):
        support.wait_for(lambda: time.monotonic() > begin + seconds, "the time of the measurement")
        setpoints = self.setpoints.since(begin)
        self.assertTrue(setpoints and all(support.is_zero(s) for s in setpoints))
        self.assertGreater(len(setpoints) / (time.monotonic() - begin), 20.0)
        self.assertEqual({s.header.frame_id for s in setpoints}, {"map"})

    def test_1_stands_by_with_zeros_and_starts_only_when_engaged(self):
        self.call("reset")
        self.setpoints.wait(what="a stream before the start")
        self.zeros_from(time.monotonic(), LATE_S + STOP_S + 1.0)  # longer than the guard waits before it stops streaming
        support.Diagnostics().wait("ingress_navigator: engaged", "not armed, not in a mode")
        self.companion_is(CompanionProcessStatus.MAV_STATE_STANDBY)
        for type(self).armed, type(self).mode in ((True, "POSCTL"), (False, "OFFBOARD")):
            begin = time.monotonic() + 1.0  # five messages of the autopilot
            support.wait_for(lambda: time.monotonic() > begin, "the autopilot's state to be heard")
            reply = self.call("start")
            self.assertFalse(reply.success)
            self.assertIn("not armed, not in a mode", reply.message)
        support.wait_for(lambda: "disarmed, mode OFFBOARD" in self.call("start").message, "a start that names the autopilot's mode")
        type(self).armed, type(self).mode = True, "GUIDED"
        support.Diagnostics().wait("engaged_from_mavros: autopilot", "mode GUIDED (it follows in OFFBOARD)")
        self.assertEqual(self.fly().header.frame_id, "map")
        self.companion_is(CompanionProcessStatus.MAV_STATE_ACTIVE)

    def test_1_strangers_beside_the_autopilot_are_named(self):
        said = support.Diagnostics()
        for topic, name, words in (("/engaged", "ingress_navigator: engaged", "more than one source on /engaged"),
                                   ("/mavros/state", "engaged_from_mavros: autopilot", "is std_msgs/Bool, without connected")):
            stranger = subprocess.Popen(["rostopic", "pub", "-r", "5", topic, "std_msgs/Bool", "data: false"], stdout=subprocess.DEVNULL)
            try:
                said.wait(name, words)
            finally:
                stranger.terminate()
                stranger.wait(10)
        self.fly()

    def test_2_a_pilot_who_takes_over_has_it_until_the_next_start(self):
        type(self).mode = "POSCTL"
        self.states.wait(lambda s: s.state_name == "IDLE", "IDLE after the take-over")
        self.zeros_from(time.monotonic() + MARGIN_S, 1.0)
        begin = time.monotonic() + MARGIN_S
        type(self).mode = "OFFBOARD"
        self.zeros_from(begin, 1.5)  # the mode alone starts nothing
        self.fly()

    def test_2_an_autopilot_in_a_failsafe_is_not_flown(self):
        type(self).system_status = 5  # critical, for example because of its battery
        self.states.wait(lambda s: s.state_name == "IDLE", "IDLE in the failsafe")
        self.zeros_from(time.monotonic() + MARGIN_S, 0.5)
        in_failsafe = "the autopilot does not follow setpoints: armed, mode OFFBOARD, in a failsafe"
        support.Diagnostics().wait("engaged_from_mavros: autopilot", in_failsafe)
        support.wait_for(lambda: in_failsafe in self.call("start").message, "a start that names the failsafe")
        type(self).system_status = 4
        self.fly()

    def test_3_an_autopilot_that_falls_silent_is_out_of_control(self):
        self.states_of_autopilot.stop()
        self.states.wait(lambda s: s.state_name == "IDLE", "IDLE without the autopilot's state")
        self.zeros_from(time.monotonic() + MARGIN_S, 0.5)
        reply = self.call("start")
        self.assertFalse(reply.success)
        self.assertIn("/engaged has fallen silent", reply.message)
        support.wait_for(lambda: "/mavros/state has fallen silent" in self.call("start").message, "a start that names MAVROS's state")
        type(self).states_of_autopilot = support.Stream("/mavros/state", support.AutopilotState, self.state, 5.0)
        self.fly()

    def test_4_the_guard_brakes_for_a_navigator_killed_in_flight_and_then_gives_way(self):
        guard = support.pid_of("/setpoint_guard")
        os.kill(support.pid_of("/ingress_navigator"), signal.SIGKILL)
        killed = time.monotonic()
        self.zeros_from(killed + LATE_S + MARGIN_S, STOP_S - 2 * MARGIN_S)
        quiet = killed + LATE_S + STOP_S + MARGIN_S
        support.wait_for(lambda: time.monotonic() > quiet + 1.5, "the silence of the guard")
        self.assertEqual(self.setpoints.since(quiet), [])
        self.assertEqual(support.pid_of("/setpoint_guard"), guard)
        self.companion_is(CompanionProcessStatus.MAV_STATE_CRITICAL)
        support.Diagnostics().wait("setpoint_guard: cmd_vel_in", "failsafe has to act")


if __name__ == "__main__":
    rospy.init_node("autopilot_test")
    rostest.rosrun("window_ingress", "autopilot_test", AutopilotTest, sys.argv)
