#!/usr/bin/env python3
"""The world renders and judges an externally simulated vehicle at the pose that vehicle_odom reports."""
import itertools
import math
import sys
import random
import threading
import time
import unittest

import numpy
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import Image
from window_ingress.msg import FlightVerdict

import support

RATE_HZ = 50.0
SPEED_MPS = 1.0
WINDOW_X_M, CENTRE_Z_M, STOP_X_M = 5.0, 1.5, 6.8   # of config/scenarios/external.yaml
CAMERA_AHEAD_M, CAMERA_UP_M = 0.10, 0.02
OFFSET_Y_M = 0.07
NEWEST_S = 0.03 + 1.0 / 30.0 + 0.005   # latency, period and step of the camera: the age of the newest image at most
PATIENCE_S = 0.5   # waiting for a world that renders nothing: a reset forgets images
TOPIC = "/mavros/local_position/odom"


def pose_at(t):
    """Flies straight through the window, a little left of its centre, then stands."""
    x = min(STOP_X_M, SPEED_MPS * t)
    return x, OFFSET_Y_M, CENTRE_Z_M


def odometry_at(began, count):
    """Odometry of the other simulator at its step number `count`."""
    message = Odometry(child_frame_id="base_link")
    message.header.stamp = began + rospy.Duration(count / RATE_HZ)
    message.header.frame_id = "map"
    p = message.pose.pose.position
    p.x, p.y, p.z = pose_at(count / RATE_HZ)
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = SPEED_MPS if p.x < STOP_X_M else 0.0
    return message


def with_poor_twist(message, _):
    """Like the twist of a real estimator: with a constant bias in the body frame, and noise."""
    linear = message.twist.twist.linear
    linear.x += 0.2 + random.gauss(0.0, 0.05)
    linear.y += 0.15 + random.gauss(0.0, 0.05)


def with_late_samples(message, count):
    """Every tenth sample is stamped 55 ms early, before the two preceding it, every 40th 150 ms ahead."""
    if count > 10 and count % 10 == 0:
        message.header.stamp += rospy.Duration(0.15) if count % 40 == 0 else rospy.Duration(-0.055)


def after_a_long_beginning(message, count):
    """Six seconds pass while the world builds its house, which it does at the first sample."""
    if count > 0:
        message.header.stamp += rospy.Duration(6.0)


class Flight:
    """Another simulator with its own time. It is not faster than the world, which may be slow here."""

    _next_s = 1000.0   # flights follow each other
    _publisher = None

    def __init__(self, distort=lambda message, count: None):
        self.began = rospy.Time.from_sec(Flight._next_s)
        Flight._next_s += 100.0
        self._distort = distort
        Flight._publisher = Flight._publisher or rospy.Publisher(TOPIC, Odometry, queue_size=20)
        self._truths = support.Listener("ground_truth/window_in_camera", PoseStamped)  # one with each image
        self._seen = self.began
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self):
        support.wait_for(lambda: Flight._publisher.get_num_connections() > 0, "a world that listens")
        for count in itertools.count():
            if self._over.wait(0.25 / RATE_HZ):
                return
            message = odometry_at(self.began, count)
            self._distort(message, count)
            Flight._publisher.publish(message)
            end = time.monotonic() + PATIENCE_S
            while count > 10 and message.header.stamp - self._truth() > rospy.Duration(0.1) and time.monotonic() < end:
                self._over.wait(0.001)

    def _truth(self):
        stamps = [m.header.stamp for m in self._truths.since(time.monotonic() - 5.0)]
        self._seen = max([self._seen, *stamps])
        return self._seen

    def stop(self):
        self._over.set()
        self._thread.join()
        self._truths.stop()


class ExternalVehicleTest(unittest.TestCase):
    def test_1_without_vehicle_odom_it_is_said_so(self):
        support.Diagnostics().wait("world: vehicle_odom", "no vehicle_odom on", "0 publishers")

    def test_2_the_flight_through_the_window_is_seen_and_passed(self):
        images = support.Listener("/camera/image_raw", Image)
        in_camera = support.Listener("ground_truth/window_in_camera", PoseStamped)
        verdicts = support.Listener("referee", FlightVerdict)
        flight = Flight()
        try:
            verdict = verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING, "a verdict", 60.0)
        finally:
            flight.stop()
        self.assertEqual(verdict.outcome_name, "PASSED", verdict.reason)
        self.assertAlmostEqual(verdict.offset_y, OFFSET_Y_M, delta=1e-3)
        truths = {t.header.stamp: t.pose.position for t in in_camera.since(0.0)}
        judged = [i for i in images.since(0.0) if i.header.stamp in truths]
        self.assertGreater(len(judged), 100)
        self.assertGreaterEqual(len(judged), len(images.since(0.0)) - 1, "truth stands beside each image")
        for image in judged:
            x = pose_at((image.header.stamp - flight.began).to_sec())[0]
            where = truths[image.header.stamp]
            self.assertAlmostEqual(where.z, WINDOW_X_M - x - CAMERA_AHEAD_M, delta=0.01)
            self.assertAlmostEqual(where.x, OFFSET_Y_M, delta=1e-6)
            self.assertAlmostEqual(where.y, CAMERA_UP_M, delta=1e-6)
        self.assert_opening_is_where_the_truth_says(judged, truths)

    def assert_opening_is_where_the_truth_says(self, images, truths):
        """The orange frame left of the opening: compares its columns in the image with its projection."""
        focal = 320.0 / math.tan(0.6)
        checked = 0
        for image in images[::10]:
            where = truths[image.header.stamp]
            if not 2.0 < where.z < 4.5:
                continue
            pixels = numpy.frombuffer(image.data, numpy.uint8).reshape(image.height, image.width, 3).astype(int)
            row = pixels[int(round(239.5 + focal * where.y / where.z))]
            orange = numpy.flatnonzero((row[:, 2] > 120) & (row[:, 2] > 2 * row[:, 1]) & (row[:, 1] > row[:, 0]))
            left = orange[orange < 319.5 + focal * where.x / where.z]
            border = 319.5 + focal * (where.x - 0.6) / where.z
            self.assertAlmostEqual(left.max() + 0.5, border, delta=3.0)
            checked += 1
        self.assertGreater(checked, 4)

    def judged(self, distort):
        """The verdict on this flight, its time since the start [s], and the messages meanwhile."""
        verdicts, log = support.Listener("referee", FlightVerdict), support.Listener("/rosout", Log)
        begin = time.monotonic()
        flight = Flight(distort)
        try:
            verdict = verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING and v.header.stamp >= flight.began, "a verdict", 60.0)
        finally:
            flight.stop()
        return verdict, (verdict.header.stamp - flight.began).to_sec(), [m.msg for m in log.since(begin)]

    def test_3_it_stands_where_its_places_stand_whatever_its_twist_says(self):
        verdict, after_s, _ = self.judged(with_poor_twist)
        self.assertEqual(verdict.outcome_name, "PASSED", verdict.reason)
        self.assertLess(after_s, STOP_X_M / SPEED_MPS + 2.5)
        self.assertAlmostEqual(verdict.max_speed, SPEED_MPS, delta=0.05)

    def test_3_late_samples_are_left_out_and_the_flight_goes_on(self):
        verdict, _, said = self.judged(with_late_samples)
        self.assertEqual(verdict.outcome_name, "PASSED", verdict.reason)
        anew = [text for text in said if "the world restarts" in text]
        self.assertEqual(len(anew), 1, anew)  # only this flight, which begins 100 s after the one before
        self.assertTrue(any("late samples are left out" in text for text in said), said)

    def test_3_building_the_house_takes_none_of_the_flights_time(self):
        verdict, _, said = self.judged(after_a_long_beginning)
        self.assertEqual(verdict.outcome_name, "PASSED", verdict.reason)
        anew = [text for text in said if "the world restarts" in text]
        self.assertEqual(len(anew), 1, anew)

    def test_3_a_reset_begins_another_flight_without_a_leap_of_time(self):
        verdicts, log = support.Listener("referee", FlightVerdict), support.Listener("/rosout", Log)
        flight = Flight()
        verdicts.wait(lambda v: v.header.stamp >= flight.began + rospy.Duration(2.0), "two seconds of flight", 60.0)
        begin = time.monotonic()
        self.assertTrue(support.call("/world/reset").success)
        try:
            later = verdicts.wait(lambda v: v.header.stamp > flight.began + rospy.Duration(3.0), "the flight after the reset", 60.0)
        finally:
            flight.stop()
        self.assertEqual(later.header.stamp.secs // 100, flight.began.secs // 100, "time is still the vehicle's")
        self.assertEqual([m.msg for m in log.since(begin) if "stamps jumped" in m.msg], [])

    def test_3_of_images_that_fall_due_at_once_only_the_newest_are_drawn(self):
        images = support.Listener("/camera/image_raw", Image)
        flight = Flight()
        images.wait(lambda i: i.header.stamp > flight.began + rospy.Duration(1.0), "a second of flight")
        flight.stop()
        begin, leap = time.monotonic(), int(4.0 * RATE_HZ)
        last = odometry_at(flight.began, leap)
        Flight._publisher.publish(last)
        images.wait(lambda i: last.header.stamp - i.header.stamp < rospy.Duration(NEWEST_S), "the newest image", begin=begin)
        support.wait_for(lambda: time.monotonic() - begin > 1.0, "a second for others")
        of_the_gap = [i for i in images.since(begin) if i.header.stamp > flight.began + rospy.Duration(1.6)]
        self.assertEqual(len(of_the_gap), 2)

    def test_4_when_it_falls_silent_images_stop_and_it_is_said(self):
        flight = Flight()
        images = support.Listener("/camera/image_raw", Image)
        images.wait(what="an image")
        flight.stop()
        support.Diagnostics().wait("world: vehicle_odom", "no more vehicle_odom")
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() - begin > 0.5, "half a second")
        self.assertEqual(len(images.since(begin)), 0)

    def test_5_what_is_no_pose_is_refused_by_name(self):
        def bend(message):
            message.pose.pose.orientation.w = 2.0

        def spoil(message):
            message.pose.pose.position.x = math.nan

        def rename(message):
            message.header.frame_id = "odom"

        diagnostics = support.Diagnostics()
        images = support.Listener("/camera/image_raw", Image)
        for distort, word in ((bend, "quaternion"), (spoil, "finite"), (rename, "'odom'")):
            count = itertools.count()

            def make(_):
                message = odometry_at(rospy.Time(9000), next(count))
                distort(message)
                return message
            stream = support.Stream(TOPIC, Odometry, make, RATE_HZ)
            diagnostics.wait("world: vehicle_odom", "refused", word)
            stream.stop()
        self.assertEqual([i.header.stamp for i in images.since(0.0) if i.header.stamp > rospy.Time(8999)], [])


if __name__ == "__main__":
    rospy.init_node("external_vehicle_test")
    rostest.rosrun("window_ingress", "external_vehicle_test", ExternalVehicleTest, sys.argv)
