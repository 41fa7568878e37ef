#!/usr/bin/env python3
"""/diagnostics reports every fault of an input or an output within two seconds, in one line that names the topic, until the
fault ends."""
import os
import re
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from roslib.packages import find_node
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import CameraInfo, Image, Imu
from window_ingress.msg import WindowDetection, WindowPose

import support
from homography_pose_test import detection

WITHIN_S = 2.0
DAY_S = 86400
OK = 0


class Journal:
    """Every status of every node, with its wall time of arrival."""

    def __init__(self):
        self._lock = threading.Lock()
        self._entries = []
        self._subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self._receive, queue_size=100)

    def _receive(self, message):
        with self._lock:
            self._entries += [(time.monotonic(), status) for status in message.status]

    def since(self, begin, name):
        with self._lock:
            return [(at, status) for at, status in self._entries if at >= begin and status.name == name]

    def last(self, name):
        entries = self.since(0.0, name)
        return entries[-1][1] if entries else None

    def first(self, begin, name, accept):
        """Time of the first status that `accept`s; otherwise fails with the statuses received."""
        try:
            found = support.wait_for(lambda: [at for at, s in self.since(begin, name) if accept(s)], name, 2.0 * WITHIN_S)
        except AssertionError:
            status = self.last(name)
            raise AssertionError(f"{name} says: {status.message if status else 'nothing'}") from None
        return found[0]


def ago(seconds):
    return lambda message: message.header.stamp - rospy.Duration(seconds)


def setpoint(stamp):
    message = TwistStamped()
    message.header.stamp = stamp
    message.header.frame_id = "odom"
    return message


def corners(stamp):
    """Corners of an image with a long processing time: odometry and tf of its exposure have arrived."""
    return detection(stamp - rospy.Duration(0.1))


def vehicle_in_odom(stamp):
    message = support.mounting()
    message.header.stamp = stamp
    message.header.frame_id, message.child_frame_id = "odom", "base_link"
    rotation = message.transform.rotation
    rotation.x = rotation.y = rotation.z = 0.0
    rotation.w = 1.0
    return support.transforms_type()([message])


class SpokenCausesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.journal = Journal()
        cls.mounting = support.publish_mounting()
        cls.camera = support.Camera()
        cls.streams = {topic: support.Stream(topic, kind, make, rate) for topic, kind, make, rate in (
            ("image_raw", Image, cls.camera, 12.0), ("camera_info", CameraInfo, support.camera_info, 12.0),
            ("imu", Imu, support.imu, 50.0), ("odom", Odometry, support.odometry, 50.0),
            ("window", WindowDetection, corners, 15.0), ("window_pose", WindowPose, support.no_window, 15.0),
            ("cmd_vel_in", TwistStamped, setpoint, 30.0), ("/tf", support.transforms_type(), vehicle_in_odom, 50.0))}
        cls.listeners = {topic: support.Listener(topic, kind) for topic, kind in (
            ("seen", WindowDetection), ("estimated", WindowPose), ("steered", TwistStamped), ("cmd_vel", TwistStamped))}

    def expect_healthy(self, name):
        support.wait_for(lambda: self.journal.last(name) and self.journal.last(name).level == OK,
                         f"{name} at ease before the test; it says {self.journal.last(name) and self.journal.last(name).message}")

    def assert_said(self, begin, name, *words):
        at = self.journal.first(begin, name, lambda s: s.level != OK and all(word in s.message for word in words))
        self.assertLess(at - begin, WITHIN_S, f"{name}: {words}")

    def assert_over(self, begin, name):
        at = self.journal.first(begin, name, lambda s: s.level == OK)
        self.assertLess(at - begin, WITHIN_S, f"{name} is not at ease again")

    def provoke(self, cause, mend, *lines):
        """Parameter `lines`: (status, words...). Each status is OK before and afterwards, and contains the words in between."""
        for name, *_ in lines:
            self.expect_healthy(name)
        begin = time.monotonic()
        cause()
        try:
            for name, *words in lines:
                self.assert_said(begin, name, *words)
        finally:
            mended = time.monotonic()
            mend()
        for name, *_ in lines:
            self.assert_over(mended, name)

    def while_sent(self, topic, make, *lines):
        """While messages of another kind are sent."""
        stream = self.streams[topic]
        before = stream.make

        def use(maker):
            stream.make = maker
        self.provoke(lambda: use(make), lambda: use(before), *lines)

    def while_silent(self, topic, *lines):
        stream = self.streams[topic]
        self.provoke(stream.pause, stream.resume, *lines)

    def while_unheard(self, topic, name):
        kind = self.listeners[topic].kind

        def again():
            self.listeners[topic] = support.Listener(topic, kind)
        self.provoke(self.listeners[topic].stop, again, (name, f"nobody subscribes to /{topic}"))

    # --- calibration

    def test_camera_info_that_stops(self):
        self.while_silent("camera_info", ("window_detector: camera_info", "no more camera_info on /camera_info", "nothing is sent"),
                          ("homography_pose: camera_info", "no more camera_info on /camera_info"))

    def test_sizes_that_differ(self):
        self.while_sent("camera_info", support.changed(support.camera_info, width=320, height=240),
                        *((f"{node}: calibration", "sizes differ", "640x480", "camera_info on /camera_info is for 320x240")
                          for node in ("window_detector", "homography_pose")))

    def test_a_camera_that_is_not_calibrated(self):
        self.while_sent("camera_info", lambda stamp: support.camera_info(stamp, focal=0.0),
                        ("homography_pose: camera_info", "/camera_info", "uncalibrated"),
                        ("window_detector: camera_info", "/camera_info", "uncalibrated"))

    def test_stamps_that_are_apart(self):
        self.while_sent("camera_info", support.changed(support.camera_info, header__stamp=ago(3.0)),
                        *((f"{node}: calibration", "stamps of image and camera_info on /camera_info are ", " s apart")
                          for node in ("window_detector", "homography_pose")))

    def test_calibration_of_another_camera(self):
        self.while_sent("camera_info", support.changed(support.camera_info, header__frame_id="rear"),
                        ("homography_pose: calibration", "frames differ", "'camera_optical_frame'", "'rear'"))

    # --- images

    def test_images_that_stop(self):
        self.while_silent("image_raw", ("window_detector: image", "no more image on /image_raw"),
                          ("window_detector: detection", "no image for"))

    def test_images_of_days_ago(self):
        self.while_sent("image_raw", support.changed(self.camera, header__stamp=ago(50 * DAY_S)),
                        ("window_detector: image", "/image_raw", "stamp is 50 days old", "use_sim_time", "--clock"))

    def test_images_of_an_unknown_encoding(self):
        self.while_sent("image_raw", support.changed(self.camera, encoding="florp"),
                        ("window_detector: image", "/image_raw", "refused", "florp"))

    def test_a_camera_that_is_stuck(self):
        def stick(value):
            self.camera.stuck = value
        self.provoke(lambda: stick(True), lambda: stick(False), ("window_detector: image", "/image_raw", "does not change"))

    def test_time_of_an_image_beside_its_budget(self):
        status = support.wait_for(lambda: next((s for _, s in self.journal.since(0.0, "hurried_detector: time") if s.level), None),
                                  "a budget that is exceeded")
        self.assertIn("the budget is 0.0 ms: images are dropped; most goes into", status.message)
        values = {pair.key: float(pair.value) for pair in status.values}
        stages = ("track", "preprocess", "edges", "lines", "outlines", "candidates", "reference", "borders")
        self.assertGreater(sum(values[f"{stage}_ms"] for stage in stages), 0.0)
        self.assertLessEqual(sum(values[f"{stage}_ms"] for stage in stages), 1.05 * values["whole_ms"] + 0.1)
        self.expect_healthy("window_detector: time")
        usual = {pair.key: float(pair.value) for pair in self.journal.last("window_detector: time").values}
        self.assertAlmostEqual(usual["budget_ms"], 1e3 / 12.0, delta=15.0)

    # --- attitude, odometry, frames

    def test_attitude_that_stops(self):
        self.while_silent("imu", ("homography_pose: imu", "no more imu on /imu"))

    def test_an_imu_without_attitude(self):
        self.while_sent("imu", support.changed(support.imu, orientation_covariance=[-1.0] + 8 * [0.0]),
                        ("homography_pose: imu", "/imu", "refused"))

    def test_attitude_missing_in_tf(self):
        self.while_silent("/tf", ("pose_by_tf: attitude", "no attitude: odom <- base_link is not in tf"))

    def test_odometry_that_stops(self):
        self.while_silent("odom", *((f"{node}: odom", "no more odom on /odom") for node in ("homography_pose", "ingress_navigator")))

    def test_odometry_of_another_frame(self):
        self.while_sent("odom", support.changed(support.odometry, header__frame_id="map"),
                        *((f"{node}: odom", "/odom", "refused", "'map'", "'odom'") for node in ("homography_pose", "ingress_navigator")))

    def test_a_camera_that_nobody_mounted(self):
        self.while_sent("window", support.changed(corners, header__frame_id="nobody_mounted_this"),
                        ("homography_pose: camera mounting", "base_link <- 'nobody_mounted_this'", "not in tf"))

    # --- between the nodes

    def test_corners_that_stop(self):
        self.while_silent("window", ("homography_pose: window", "no more window on /window"))

    def test_poses_that_stop(self):
        self.while_silent("window_pose", ("ingress_navigator: window_pose", "no more window_pose on /window_pose"))

    def test_setpoints_that_stop(self):
        self.while_silent("cmd_vel_in", ("setpoint_guard: cmd_vel_in", "/cmd_vel_in is silent", "sending zero"))

    def test_setpoints_that_are_too_fast(self):
        self.while_sent("cmd_vel_in", support.changed(setpoint, twist__linear__x=9.0),
                        ("setpoint_guard: cmd_vel_in", "/cmd_vel_in", "speed of 9.00 m/s is above the limit, max_speed_mps: 1.2"))

    def test_outputs_that_nobody_hears(self):
        self.while_unheard("seen", "window_detector: window")
        self.while_unheard("estimated", "homography_pose: window_pose")
        self.while_unheard("steered", "ingress_navigator: cmd_vel")
        self.while_unheard("cmd_vel", "setpoint_guard: cmd_vel")

    # --- from the start

    def launch(self, node, name, *arguments):
        """A node without neighbours, in a namespace of its name. Returns the time of its first status."""
        process = subprocess.Popen([find_node("window_ingress", node)[0], "__name:=node", *arguments],
                                   env={**os.environ, "ROS_NAMESPACE": name}, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)

        def end():
            process.terminate()
            process.wait(timeout=support.DEADLINE_S)
        self.addCleanup(end)
        return support.wait_for(lambda: [at for at, status in self.journal.since(0.0, f"{name}/node: clock")
                                         if status.message != "Node starting up"], f"{name} is there")[0]

    def test_inputs_that_nobody_publishes(self):
        for node, inputs in (("window_detector", ("image", "camera_info")),
                             ("homography_pose", ("window", "odom", "imu", "camera_info")),
                             ("ingress_navigator", ("odom", "window_pose"))):
            begin = self.launch(node, f"lonely_{node}")
            for name in inputs:
                topic = f"/lonely_{node}/{'image_raw' if name == 'image' else name}"
                self.assert_said(begin, f"lonely_{node}/node: {name}", f"no {name} on {topic} (0 publishers); check the remapping")

    def test_a_node_that_has_just_started_waits_before_it_complains(self):
        with tempfile.NamedTemporaryFile("r") as console:
            with open(console.name, "w", encoding="utf-8") as sink:
                process = subprocess.Popen([find_node("window_ingress", "ingress_navigator")[0], "__name:=node"], stderr=sink, stdout=sink,
                                           env={**os.environ, "ROS_NAMESPACE": "early"})

            def said(*words):
                console.seek(0)
                return [line for line in console if all(word in line for word in words)]

            def stamp(line):
                return float(re.search(r"\] \[(\d+\.\d+)\]", line).group(1))
            try:
                first = support.wait_for(lambda: said("[ INFO]", "waiting for odom: no odom on /early/odom (0 publishers)"), "what is waited for")[0]
                later = support.wait_for(lambda: said("[ERROR]", "no odom on /early/odom (0 publishers)"), "the complaint")[0]
                self.assertEqual(said("[ERROR]")[0].count("waiting"), 0)
                self.assertGreater(stamp(later) - stamp(first), 1.0)
                self.assertEqual(len(said("no odom on")), 2)
            finally:
                process.terminate()
                process.wait(timeout=support.DEADLINE_S)

    def test_simulated_time_without_a_clock_and_with_the_wrong_one(self):
        rospy.set_param("/use_sim_time", True)
        self.addCleanup(rospy.delete_param, "/use_sim_time")
        begin = self.launch("window_detector", "timeless", "image_raw:=/image_raw")
        self.assert_said(begin, "timeless/node: clock", "use_sim_time is set but nothing has come on /clock")
        clock = support.Stream("/clock", Clock, lambda stamp: Clock(stamp - rospy.Duration(400 * DAY_S)), 50.0)
        begin = time.monotonic()
        self.assert_over(begin, "timeless/node: clock")
        self.assert_said(begin, "timeless/node: image", "/image_raw", "400 days ahead of the clock", "is use_sim_time set")
        clock.pause()
        self.assert_said(time.monotonic(), "timeless/node: clock", "/clock stands still")
        clock.stop()


if __name__ == "__main__":
    rospy.init_node("spoken_causes_test")
    rostest.rosrun("window_ingress", "spoken_causes_test", SpokenCausesTest, sys.argv)
