#!/usr/bin/env python3
"""Services always answer, the stream never stops while enabled, and setpoints are zero when the data stops."""
import os
import signal
import sys
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from window_ingress.msg import IngressState, WindowPose

import support

STREAM_HZ, STREAM_FOR_S = 20.0, 2.0
SLEEPS_S = 4.0
STALE_WITHIN_S = 0.6  # limit of the age, plus margin for a loaded machine


def speed(message):
    linear, angular = message.twist.linear, message.twist.angular
    return max(abs(v) for v in (linear.x, linear.y, linear.z, angular.x, angular.y, angular.z))


class IngressNavigatorTest(unittest.TestCase):
    def setUp(self):
        self.states = support.Listener("state", IngressState)
        self.setpoints = support.Listener("cmd_vel", TwistStamped)
        self.streams = {}
        self.call("abort")
        support.wait_for(lambda: self.call("reset").success, "a navigator that can be reset")
        self.wait_for_state("IDLE")

    def tearDown(self):
        for stream in self.streams.values():
            stream.stop()
        self.states.stop()
        self.setpoints.stop()

    @staticmethod
    def call(service):
        return support.call(f"ingress_navigator/{service}")

    def wait_for_state(self, *names):
        begin = time.monotonic() - 0.5
        return self.states.wait(lambda s: s.state_name in names, f"state {names}", begin=begin)

    def feed(self, pose=support.no_window):
        self.streams["odom"] = support.Stream("odom", Odometry, support.odometry, 50.0)
        self.streams["window_pose"] = support.Stream("window_pose", WindowPose, pose, 30.0)

    def start(self):
        def started():
            reply = self.call("start")
            return reply if reply.success else None
        self.feed()
        reply = support.wait_for(started, "a mission that starts")
        self.wait_for_state("SEARCH")
        return reply

    def refused(self):
        """The answer, or None: the previous test's messages may still be fresh."""
        reply = self.call("start")
        if not reply.success:
            return reply.message
        self.call("abort")
        self.call("reset")
        return None

    def test_start_without_data_lists_what_is_missing(self):
        self.assertIn("odom", support.wait_for(self.refused, "a start without data that is refused"))

    def test_start_names_the_nodes_before_it_that_do_not_run(self):
        silent = "window_detector says nothing on /diagnostics: does it run?"
        support.wait_for(lambda: silent in (self.refused() or ""), "an answer that names the detector")
        status = DiagnosticStatus(DiagnosticStatus.OK, "window_detector: image", "", "", [])
        self.streams["diagnostics"] = support.Stream("/diagnostics", DiagnosticArray, lambda _: DiagnosticArray(status=[status]), 10.0)
        support.wait_for(lambda: silent not in (self.refused() or silent), "an answer that does not")
        self.assertIn("homography_pose says nothing", self.refused())

    def test_start_names_what_the_nodes_before_it_lack(self):
        lacks = {"window_detector: image": "no image on /image_raw", "window_detector: camera_info": "no camera_info on /camera_info",
                 "homography_pose: imu": "no imu on /imu"}

        def say(level, prefix=""):
            names = [prefix + name for name in lacks]
            return lambda _: DiagnosticArray(status=[DiagnosticStatus(level, name, text, "", []) for name, text in zip(names, lacks.values())])

        self.streams["diagnostics"] = support.Stream("/diagnostics", DiagnosticArray, say(DiagnosticStatus.ERROR), 10.0)
        support.wait_for(lambda: all(text in (self.refused() or "") for text in lacks.values()), "an answer that names all three")
        for say_now in (say(DiagnosticStatus.OK), say(DiagnosticStatus.ERROR, "other_drone/")):
            self.streams["diagnostics"].make = say_now
            support.wait_for(lambda: "no imu" not in (self.refused() or "no imu"), "an answer that names none of them")

    def test_start_says_what_will_be_asked(self):
        self.assertIn("will ask for ~confirm_opening at the line: glass is not excluded", self.start().message)

    def test_start_without_a_calibration_says_so(self):
        missing = "no calibration: no camera_info on /camera/camera_info so far"
        self.feed(support.changed(support.no_window, camera__fault=missing))
        support.wait_for(lambda: self.refused() == f"not started: {missing}", "a start that names the calibration alone")
        support.Diagnostics().wait("ingress_navigator: camera", missing)
        self.streams["window_pose"].make = support.changed(support.no_window, camera__known=True, camera__forward=0.3, camera__horizontal_fov=1.1,
                                                           camera__vertical_fov=0.9, camera__pixel_angle=0.002)
        support.Diagnostics().wait("ingress_navigator: camera", "0.30 m ahead, field of view 1.10 x 0.90 rad", "from camera_info and tf")
        support.wait_for(lambda: self.call("start").success, "a start with a calibration")

    def test_start_twice_is_answered_twice(self):
        self.start()
        again = self.call("start")
        self.assertNotEqual(again.message, "")
        self.assertEqual(self.states.wait(what="a state").state_name, "SEARCH")

    def test_abort_is_idempotent_and_stops_at_once(self):
        self.start()
        self.setpoints.wait(lambda s: speed(s) > 0.0, "motion")
        for _ in range(2):
            self.assertTrue(self.call("abort").success)
        begin = time.monotonic() + 0.1
        self.wait_for_state("ABORTED")
        self.setpoints.wait(lambda s: speed(s) == 0.0, "zero after the abort")
        self.assertTrue(all(speed(s) == 0.0 for s in self.setpoints.since(begin)))

    def test_reset_is_refused_in_flight_with_a_reason(self):
        self.start()
        reply = self.call("reset")
        self.assertFalse(reply.success)
        self.assertNotEqual(reply.message, "")

    def test_a_confirmation_without_a_window_is_refused_with_a_reason(self):
        reply = self.call("confirm_opening")
        self.assertFalse(reply.success)
        self.assertIn("no window is being approached", reply.message)

    def test_stream_is_fast_and_truthful_about_its_frame(self):
        self.start()
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() - begin > STREAM_FOR_S, "the time of the measurement")
        setpoints = self.setpoints.since(begin)
        self.assertGreater(len(setpoints) / STREAM_FOR_S, STREAM_HZ)
        self.assertEqual({s.header.frame_id for s in setpoints}, {"odom"})

    def test_the_state_is_latched_and_setpoints_never_are(self):
        self.assertTrue(support.is_latched(self.states.wait(what="a state", begin=0.0)))
        self.assertFalse(support.is_latched(self.setpoints.wait(what="a setpoint")))

    def test_lost_odometry_means_zero_and_the_stream_goes_on(self):
        self.start()
        self.setpoints.wait(lambda s: speed(s) > 0.0, "motion")
        self.streams.pop("odom").stop()
        begin = time.monotonic() + STALE_WITHIN_S
        self.wait_for_state("HOLD", "ABORTED")
        support.wait_for(lambda: len(self.setpoints.since(begin)) > 20, "the stream after the loss")
        self.assertTrue(all(speed(s) == 0.0 for s in self.setpoints.since(begin)))

    def test_a_navigator_that_stood_still_does_not_fly_on(self):
        self.start()
        navigator = support.pid_of("/ingress_navigator")
        os.kill(navigator, signal.SIGSTOP)
        time.sleep(SLEEPS_S)
        os.kill(navigator, signal.SIGCONT)
        said = self.wait_for_state("ABORTED")
        self.assertIn("the navigator itself stood still for", said.reason)
        self.assertEqual({speed(s) for s in self.setpoints.since(time.monotonic() - SLEEPS_S + 0.2)}, {0.0})

    def test_odometry_that_is_not_finite_is_no_odometry(self):
        self.start()
        self.setpoints.wait(lambda s: speed(s) > 0.0, "motion")

        self.streams["odom"].make = support.changed(support.odometry, twist__twist__linear__y=float("nan"))
        self.wait_for_state("HOLD", "ABORTED")
        support.Diagnostics().wait("ingress_navigator: odom", "not finite")

    def test_odometry_of_another_frame_is_refused_by_name(self):
        self.feed()

        self.streams["odom"].make = support.changed(support.odometry, header__frame_id="map")
        support.Diagnostics().wait("ingress_navigator: odom", "'map'", "'odom'")
        self.assertFalse(self.call("start").success)


if __name__ == "__main__":
    rospy.init_node("ingress_navigator_test")
    rostest.rosrun("window_ingress", "ingress_navigator_test", IngressNavigatorTest, sys.argv)
