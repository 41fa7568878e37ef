#!/usr/bin/env python3
"""Rows of faults in the inputs of the nodes, one after another, while the vehicle is on its way towards the window.

Each row: the vehicle is on its way - the fault begins - a status names its cause, and the vehicle stops if the row says so - the
fault ends - the status is OK and the vehicle is on its way again. The monitor judges all the time.
"""
import collections
import itertools
import struct
import sys
import time
import unittest

import cv2
import numpy
import rospy
import rostest
from dynamic_reconfigure.client import Client
from sensor_msgs.msg import CameraInfo, CompressedImage, Image
from std_msgs.msg import Bool
from std_srvs.srv import Trigger, TriggerResponse
from window_ingress.msg import ImagePose, ReferenceImage, WindowCorner, WindowDetection, WindowPose

import fault_paths  # noqa: F401
import chain
import homography_pose_test
import monitor as monitors
import oracles
import support
from chain import later
from support import changed
from fault_notes import note
from homography_pose_test import detection

NAN, INF = float("nan"), float("inf")
STOPS, FLIES_ON, GOES_ON = "stops", "flies on", "goes on as soon as it has looked"
WATCH_S = 0.5        # time for which setpoints are watched after the limit of O4
LASTS_S = 1.0        # duration of a fault that must not stop the vehicle

# row, description, topic, change of its messages, (status, words...) that name the cause, reaction of the vehicle
Row = collections.namedtuple("Row", "row what topic change says does counts")
Row.__new__.__defaults__ = (None,)  # counts: words that the images' status contains nevertheless


def sized(width, height, encoding="bgr8"):
    """Other images of this size, of the same scene."""
    pixels = cv2.resize(chain.window_image(), (width, height))
    if encoding == "mono8":
        pixels = cv2.cvtColor(pixels, cv2.COLOR_BGR2GRAY)

    def make(stamp):
        pixels.flat[0] = (int(pixels.flat[0]) + 1) % 256
        message = Image(height=height, width=width, encoding=encoding, step=width * (1 if encoding == "mono8" else 3))
        message.header.stamp, message.header.frame_id = stamp, "camera_optical_frame"
        message.data = pixels.tobytes()
        return message
    return make


class Repeating:
    """Sends every stamp twice."""

    def __init__(self, make):
        self._make, self._count, self._stamp = make, 0, None

    def __call__(self, stamp):
        self._count += 1
        self._stamp = stamp if self._count % 2 or self._stamp is None else self._stamp
        return self._make(self._stamp)


class Shuffled:
    """Every second message is older than the one before it."""

    def __init__(self, make, seconds):
        self._make, self._seconds, self._count = make, seconds, 0

    def __call__(self, stamp):
        self._count += 1
        return self._make(stamp - rospy.Duration(self._seconds * (self._count % 2)))


IMAGE, ODOM, INFO, MOUNTING = ("window_detector: image", "ingress_navigator: odom", "window_detector: calibration",
                               "homography_pose: camera mounting")


def rows():
    image, odom = support.Camera(chain.window_image()), support.odometry
    far, past = rospy.Time(4294967295, 0), rospy.Time(1, 0)
    return [
        Row("M15", "another size", "image_raw", sized(320, 240), [(INFO, "sizes differ", "320x240")], STOPS),
        Row("M15", "another encoding", "image_raw", sized(640, 480, "mono8"), [], GOES_ON),
        Row("M19", "each stamp twice", "image_raw", Repeating(image), [], FLIES_ON, "is not after the previous one"),
        Row("M19", "every other frame from before", "image_raw", Shuffled(image, 0.2), [], FLIES_ON, "is not after the previous one"),
        Row("M22", "no frame_id in images", "image_raw", changed(image, header__frame_id=""),
            [(MOUNTING, "base_link <- ''")], STOPS),
        Row("M22", "frame_id of another camera", "image_raw", changed(image, header__frame_id="rear"),
            [(INFO, "'rear'", "'camera_optical_frame'")], STOPS),
        Row("M24", "info never of the same stamp", "camera_info", changed(support.camera_info, header__stamp=later(-3.0)),
            [(INFO, "stamps of image and camera_info", "apart")], FLIES_ON),
        Row("M31", "info of another size", "camera_info", changed(support.camera_info, width=320, height=240),
            [(INFO, "sizes differ"), ("homography_pose: calibration", "sizes differ", "320x240")], STOPS),
        Row("M38", "images stamped 4294967295", "image_raw", changed(image, header__stamp=far), [(IMAGE, "ahead of the clock")], STOPS),
        Row("M38", "odometry stamped 4294967295", "odom", changed(odom, header__stamp=far), [(ODOM, "ahead of the clock")], STOPS),
        Row("M38", "odometry stamped 1", "odom", changed(odom, header__stamp=past), [(ODOM, "days old")], STOPS),
        Row("M40", "images 5 s ahead", "image_raw", changed(image, header__stamp=later(5.0)), [(IMAGE, "ahead of the clock")], STOPS),
        Row("M40", "odometry 5 s old", "odom", changed(odom, header__stamp=later(-5.0)), [(ODOM, "s old, limit")], STOPS),
        Row("M58", "imu without attitude", "imu", changed(support.imu, orientation_covariance=[-1.0] + 8 * [0.0]),
            [("homography_pose: imu", "refused")], None),
        Row("M62", "velocity NaN", "odom", changed(odom, twist__twist__linear__y=NAN), [(ODOM, "not finite")], STOPS),
        Row("M62", "velocity infinite", "odom", changed(odom, twist__twist__linear__x=INF), [(ODOM, "not finite")], STOPS),
        Row("M62", "a million metres away", "odom", changed(odom, pose__pose__position__x=1e6), [(ODOM, "beyond 100 km")], STOPS),
        Row("M65", "no frame_id", "odom", changed(odom, header__frame_id=""), [(ODOM, "''", "'odom'")], STOPS),
        Row("M65", "no child_frame_id", "odom", changed(odom, child_frame_id=""), [(ODOM, "''", "'base_link'")], STOPS),
        Row("M65", "another child_frame_id", "odom", changed(odom, child_frame_id="gimbal"), [(ODOM, "'gimbal'", "'base_link'")], STOPS),
        Row("M68", "not engaged", "engaged", lambda _: Bool(False), [], STOPS),
    ]


class ChainTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.monitor = monitors.Monitor((*monitors.NODES, "compressed_detector", "pose_of_corners"), {"steered": "/ingress_navigator/cmd_vel"})
        cls.chain = chain.Chain()
        cls.infos = support.Stream("corners_info", CameraInfo, support.camera_info, 15.0)

    def setUp(self):
        self.began = time.monotonic()

    def tearDown(self):
        self.chain.restore()
        self.assertEqual(self.monitor.violations(self.began), [])
        self.monitor.forget_before(time.monotonic() - 2.0)

    def assert_none(self, violations, what):
        self.assertEqual(violations, [], what)

    def put_to_the_test(self, row):
        self.chain.fly(self.monitor)
        stream = self.chain.streams[row.topic]
        begin = time.monotonic()
        stream.make = row.change
        seen = self.bear(row, begin)
        self.chain.restore()
        ended = time.monotonic()
        for name, *_ in row.says:
            self.assert_none(self.monitor.recovers(ended, name), row.what)
        self.chain.fly(self.monitor)
        note(row.row, f"{row.what}: {seen}, on its way again after {time.monotonic() - ended:.1f} s")

    def bear(self, row, begin):
        if row.does == STOPS:
            self.assert_none(self.monitor.stops(begin, WATCH_S), row.what)
        for name, *words in row.says:
            self.assert_none(self.monitor.names(begin, name, *words), row.what)
        if row.counts:
            support.wait_for(lambda: time.monotonic() > begin + LASTS_S + 0.3, "the fault to be counted")
            counted = [s.text for s in self.monitor.part(begin).said if s.name == IMAGE and row.counts in s.text]
            self.assertTrue(counted, f"{row.what} is not counted")
        if row.does == GOES_ON:
            support.wait_for(lambda: time.monotonic() > begin + LASTS_S, "the fault to last")
            self.chain.fly(self.monitor)
            return f"on its way by that after {time.monotonic() - begin:.1f} s"
        if row.does == FLIES_ON:
            support.wait_for(lambda: time.monotonic() > begin + LASTS_S, "the fault to last")
            part = self.monitor.part(begin)
            self.assertTrue(all(s.name == "APPROACH" for s in part.states if s.at >= begin), f"{row.what}: {[s.name for s in part.states]}")
            return "flies on"
        stopped = oracles.stop_time(self.monitor.part(begin), begin, begin + self.monitor.limits.stop_within_s + WATCH_S)
        return "named" if stopped is None else f"stands after {stopped:.2f} s"


    # --- rows that change more than one stream

    def test_M21_jpeg_that_is_cut_off_or_damaged(self):
        said, windows = "compressed_detector: image", support.Listener("seen_in_jpeg", WindowDetection)
        goods = itertools.cycle([bytes(cv2.imencode(".jpg", chain.window_image() + numpy.uint8(i))[1]) for i in range(4)])
        good = next(goods)

        def sound(stamp):
            return compressed(next(goods), stamp)
        jpeg = support.Stream("jpeg/compressed", CompressedImage, sound, 10.0)
        try:
            for what, data in (("truncated", good[:len(good) // 20]), ("damaged", good[:2] + bytes(len(good) - 2)), ("empty", b""),
                               ("no image", b"not an image at all"), ("png header alone", PNG_OF_4E9_PIXELS)):
                windows.wait(lambda w: w.detected, f"a window before {what}", begin=time.monotonic())
                begin = time.monotonic()
                jpeg.make = lambda stamp, data=data: compressed(data, stamp)
                self.assert_none(self.monitor.names(begin, said, "refused"), what)
                jpeg.make = sound
                self.assert_none(self.monitor.recovers(time.monotonic(), said), what)
        finally:
            jpeg.stop()
            windows.stop()
        note("M21", "truncated, damaged, empty, foreign and oversized: each refused by name, the next good image seen")

    def test_M34_rectified_images_whose_distortion_would_be_undone_again(self):
        images = support.Stream("image_rect", Image, support.Camera(chain.window_image()), 10.0)
        infos = support.Stream("rect_info", CameraInfo, changed(support.camera_info, D=[-0.2, 0.05, 0.0, 0.0, 0.0]), 10.0)
        begin = time.monotonic()
        try:
            self.assert_none(self.monitor.names(begin + 0.3, "rect_detector: calibration", "/image_rect", "image_is_rectified"), "the hint")
            infos.make = support.camera_info
            self.assert_none(self.monitor.recovers(time.monotonic(), "rect_detector: calibration"), "no lens, no hint")
        finally:
            images.stop()
            infos.stop()
        note("M34", "image_is_rectified is honoured; a topic named rect with a distortion is said")

    def test_M35_calibration_changes_in_flight(self):
        poses = support.Listener("window_pose", WindowPose)
        far = poses.wait(lambda p: p.image.reject == ImagePose.OK, "a pose").image.pose.pose.position.z
        self.chain.streams["camera_info"].make = lambda stamp: support.camera_info(stamp, focal=0.8 * support.FOCAL)
        begin = time.monotonic()
        pose = poses.wait(lambda p: p.image.reject == ImagePose.OK and abs(p.image.pose.pose.position.z - 0.8 * far) < 0.05, "the new distance")
        took = time.monotonic() - begin
        poses.stop()
        self.assertLess(took, 0.5)
        note("M35", f"{far:.2f} m became {pose.image.pose.pose.position.z:.2f} m after {took:.2f} s")

    def corners(self, make):
        return support.Stream("corners", WindowDetection, make, 15.0), support.Listener("pose_of_corners", WindowPose)

    def test_M57_a_jump_of_one_frame_is_no_news_and_one_that_lasts_is(self):
        shift = {"px": 0.0}

        def make(stamp):
            message = corners_at(stamp)
            for corner in message.corners:
                corner.x += shift["px"]
            return message
        stream, poses = self.corners(make)
        try:
            before = poses.wait(lambda p: p.filtered.valid and p.filtered.updates > 10, "a settled pose").filtered.pose.pose.position.y
            begin = time.monotonic()
            shift["px"] = -support.FOCAL / corners_distance()  # one metre to the left
            poses.wait(lambda p: p.image.reject == ImagePose.OK and p.image.pose.pose.position.x < -0.8, "the frame that jumps", begin=begin)
            shift["px"] = 0.0
            jumped = [p.filtered.pose.pose.position.y for p in poses.since(begin) if p.filtered.valid]
            self.assertLess(max(abs(y - before) for y in jumped), 0.2, "not believed at once")
            begin = time.monotonic()
            poses.wait(lambda p: p.filtered.valid and abs(p.filtered.pose.pose.position.y - before) < 0.05, "the old place", begin=begin)
            begin = time.monotonic()
            shift["px"] = -support.FOCAL / corners_distance()
            poses.wait(lambda p: p.filtered.valid and abs(p.filtered.pose.pose.position.y - before - 1.0) < 0.1, "the new place", begin=begin)
            note("M57", f"one frame: moved {max(abs(y - before) for y in jumped):.3f} m; lasting: believed after {time.monotonic() - begin:.1f} s")
        finally:
            stream.stop()
            poses.stop()

    def test_M58_covariances_that_say_nothing_are_no_certainty(self):
        stream, poses = self.corners(corners_at)
        try:
            usual = poses.wait(lambda p: p.image.reject == ImagePose.OK, "a pose").image.pose.covariance
            for what, number in (("zero", 0.0), ("NaN", NAN), ("negative", -1.0), ("infinite", INF)):
                begin = time.monotonic() + 0.2
                stream.make = changed(corners_at, corners=lambda m, c=number: [WindowCorner(True, p.x, p.y, [c, 0.0, 0.0, c]) for p in m.corners])
                pose = poses.wait(what="a verdict", begin=begin)
                sure = pose.image.reject == ImagePose.OK and pose.image.pose.covariance[14] < 0.5 * usual[14]
                self.assertFalse(sure, f"{what}: {pose.image.pose.covariance[14]} m2, usually {usual[14]}")
            note("M58", "zero, NaN, negative, infinite: refused, or no surer than without")
        finally:
            stream.stop()
            poses.stop()

    def test_M60_transforms_that_tf2_accepts(self):
        kind = support.transforms_type()
        publisher = rospy.Publisher("/tf_static", kind, queue_size=5, latch=True)
        infinite, bent, slashed = mounted("camera_infinite"), mounted("camera_bent"), mounted("/camera_slashed")
        infinite.transform.translation.x = INF
        for part in "xyzw":
            setattr(bent.transform.rotation, part, 1.0005 * getattr(bent.transform.rotation, part))
        loop = [mounted("loop_a", "loop_b"), mounted("loop_b", "loop_a")]
        stream, poses = self.corners(corners_at)
        self.infos.pause()
        infos = support.Stream("corners_info", CameraInfo, support.camera_info, 15.0)
        seen = []
        try:
            for frame, right in (("camera_infinite", False), ("camera_bent", True), ("/camera_slashed", False), ("loop_a", False),
                                 ("camera_unknown", False)):
                publisher.publish(kind([infinite, bent, slashed, *loop, support.mounting()]))
                begin = time.monotonic() + 0.3
                stream.make = changed(corners_at, header__frame_id=frame)
                infos.make = lambda stamp, frame=frame: support.camera_info(stamp, frame)
                pose = poses.wait(lambda p: p.header.frame_id == frame and p.image.reject == ImagePose.OK and
                                  (not right or p.filtered.reason == ""), f"a pose in {frame}", begin=begin)
                seen.append(f"{frame}: {'used' if pose.filtered.reason == '' else pose.filtered.reason[:60]}")
                if not right:
                    self.assertIn(frame.lstrip("/"), pose.filtered.reason)
        finally:
            stream.stop()
            poses.stop()
            publisher.unregister()
            infos.stop()
            self.infos.resume()
        note("M60", "; ".join(seen))

    def test_M70_disarmed_and_armed_again_waits_for_a_start(self):
        self.chain.fly(self.monitor)
        begin = time.monotonic()
        self.chain.engaged = False
        self.assert_none(self.monitor.stops(begin, WATCH_S), "disarmed")
        self.chain.engaged = True
        again = time.monotonic()
        support.wait_for(lambda: time.monotonic() > again + 2.0, "two seconds, armed again")
        self.assertEqual(self.monitor.states_since(again)[-1].name, "IDLE")
        self.assertTrue(all(oracles.is_still(s) for s in self.monitor.part(again).setpoints))
        self.chain.fly(self.monitor)
        note("M70", "IDLE, zeros for two seconds after it was armed again, on its way after ~start")

    def test_M72_abort_in_each_state_is_answered_at_once_and_zero_follows(self):
        slowest, zero = 0.0, 0.0
        for state in ("SEARCH", "ALIGN", "APPROACH", "HOLD"):
            self.lead_into(state)
            begin = time.monotonic()
            for _ in range(2):
                asked = time.monotonic()
                self.assertTrue(self.chain.call("abort").success)
                slowest = max(slowest, time.monotonic() - asked)
            self.assert_none(self.monitor.stops(begin, 0.3), state)
            zero = max(zero, oracles.stop_time(self.monitor.part(begin), begin, time.monotonic()) or 0.0)
            self.chain.restore()
        self.assertLess(slowest, 0.1 + self.monitor.limits.machine_s)
        note("M72", f"answered within {1e3 * slowest:.0f} ms, last motion {1e3 * zero:.0f} ms after")

    def lead_into(self, state):
        """Leads an idle navigator into the state. SEARCH and ALIGN last while nothing is seen, or have only begun."""
        self.chain.call("abort")
        support.wait_for(lambda: self.chain.call("reset").success, "a reset")
        if state == "SEARCH":
            self.chain.streams["image_raw"].make = Wall()
        support.wait_for(lambda: self.chain.call("start").success, "a start")
        if state == "HOLD":
            self.chain.fly(self.monitor)
            self.chain.streams["image_raw"].make = Wall()
        support.wait_for(lambda: [s for s in self.monitor.states_since(time.monotonic() - 0.3) if s.name == state], state)

    def test_M73_services_of_an_autopilot_that_hang_are_nobodys_business(self):
        calls = []

        def hang(_):
            calls.append(time.monotonic())
            time.sleep(30.0)
            return TriggerResponse()
        services = [rospy.Service(name, Trigger, hang) for name in ("mavros/set_mode", "mavros/cmd/arming")]
        begin = time.monotonic()
        self.chain.fly(self.monitor)
        support.wait_for(lambda: time.monotonic() - begin > 1.5, "a while in flight")
        for service in services:
            service.shutdown()
        self.assertEqual(calls, [])
        note("M73", "no node has any service client: 0 calls, the stream went on")

    def test_M84_tuning_that_is_not_finite_is_rejected(self):
        client = Client("window_detector/tuning", timeout=support.DEADLINE_S)
        before = client.get_configuration(timeout=support.DEADLINE_S)
        numbers = [name for name, value in before.items() if isinstance(value, float) and name != "groups"]
        for number in (NAN, INF, -INF):
            client.update_configuration({name: number for name in numbers[:8]})
            after = client.get_configuration(timeout=support.DEADLINE_S)
            self.assertTrue(all(abs(after[name]) < 1e6 for name in numbers), [n for n in numbers if not abs(after[n]) < 1e6])
            client.update_configuration({name: before[name] for name in numbers})
        windows = support.Listener("window", WindowDetection)
        windows.wait(lambda w: w.detected, "windows as before")
        windows.stop()
        note("M84", f"NaN and infinity in {len(numbers[:8])} values: none was taken")

    def test_M89_a_callback_that_throws_each_time_is_caught_counted_and_reported(self):
        self.chain.fly(self.monitor)
        begin = time.monotonic()
        bad = support.Stream("reference", ReferenceImage, lambda _: ReferenceImage(), 20.0)
        try:
            self.assert_none(self.monitor.names(begin, "window_detector: callbacks", "callbacks failed", "reference image"), "counted")
            support.wait_for(lambda: [s for s in self.monitor.part(begin).said if s.name == "window_detector: callbacks" and s.level == 2],
                             "an ERROR after many in a row")
        finally:
            bad.stop()
        self.assertTrue(all(s.name == "APPROACH" for s in self.monitor.part(begin).states if s.at >= begin))
        note("M89", "caught, counted, ERROR after five in a row; the flight went on")


def compressed(data, stamp):
    message = CompressedImage(format="jpeg", data=data)
    message.header.stamp, message.header.frame_id = stamp, "camera_optical_frame"
    return message


PNG_OF_4E9_PIXELS = b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR" + struct.pack(">II", 65000, 65000) + b"\x08\x02\x00\x00\x00" + bytes(64)


class Wall(support.Camera):
    """A wall without a window, different in each image."""

    def __init__(self):
        super().__init__(numpy.full((support.HEIGHT, support.WIDTH, 3), 190, numpy.uint8))


def corners_at(stamp):
    return detection(stamp)


def corners_distance():
    return homography_pose_test.DISTANCE


def mounted(child, parent="base_link"):
    message = support.mounting()
    message.child_frame_id, message.header.frame_id = child, parent
    return message


def add_rows():
    for i, row in enumerate(rows()):
        name = f"test_{row.row}_{i:02d}_" + "".join(c if c.isalnum() else "_" for c in row.what)
        setattr(ChainTest, name, lambda self, row=row: self.put_to_the_test(row))


add_rows()

if __name__ == "__main__":
    rospy.init_node("chain_test")
    rostest.rosrun("window_ingress", "chain_test", ChainTest, sys.argv)
