#!/usr/bin/env python3
"""Corners in, pose out. Missing inputs are reported by name, and no pose is invented."""
import math
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PolygonStamped, PoseWithCovarianceStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Imu
from visualization_msgs.msg import Marker, MarkerArray
from window_ingress.msg import (DetectedWindow, Facade, FilteredPose, ImagePose, WindowCorner, WindowDetection, WindowEdge,
                                WindowPose)

import support

DISTANCE = 4.0
WINDOW_W, WINDOW_H = 1.2, 1.0  # defaults of config/pose.yaml
VEHICLE_X, CAMERA_X = 0.0, support.CAMERA_X


def detection(stamp, frame_id="camera_optical_frame"):
    """A window that faces the camera at `DISTANCE`."""
    message = WindowDetection(image_width=support.WIDTH, image_height=support.HEIGHT, detected=True, score=0.9)
    message.header.stamp = stamp
    message.header.frame_id = frame_id
    cx, cy = (support.WIDTH - 1) / 2, (support.HEIGHT - 1) / 2
    half_w, half_h = support.FOCAL * WINDOW_W / 2 / DISTANCE, support.FOCAL * WINDOW_H / 2 / DISTANCE
    xs, ys = [cx - half_w, cx + half_w, cx + half_w, cx - half_w], [cy - half_h, cy - half_h, cy + half_h, cy + half_h]
    message.corners = [WindowCorner(visible=True, x=x, y=y, covariance=[0.04, 0.0, 0.0, 0.04]) for x, y in zip(xs, ys)]
    message.edges = [WindowEdge(visible=True, sigma_px=0.1, sigma_rad=0.001) for _ in range(4)]
    message.target_id = 1
    message.windows = [DetectedWindow(corner_x=xs, corner_y=ys, score=0.9, is_target=True, may_be_target=True)]
    return message


def partial(stamp):
    """The same window with only its left and right border; their ends are outside the image."""
    message = detection(stamp)
    for i in (WindowDetection.RIGHT, WindowDetection.LEFT):
        edge, begin, end = message.edges[i], message.corners[i], message.corners[(i + 1) % 4]
        edge.a_x, edge.a_y, edge.b_x, edge.b_y = begin.x, 24.0 + 0.9 * begin.y, end.x, 24.0 + 0.9 * end.y
    message.edges[WindowDetection.TOP] = message.edges[WindowDetection.BOTTOM] = WindowEdge()
    message.corners = [WindowCorner()] * 4
    return message


class HomographyPoseTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mounting = support.publish_mounting()

    def setUp(self):
        self.poses = support.Listener("window_pose", WindowPose)
        self.streams = []

    def tearDown(self):
        for stream in self.streams:
            stream.stop()
        self.poses.stop()

    def stream(self, topic, kind, make, rate_hz=30.0):
        self.streams.append(support.Stream(topic, kind, make, rate_hz))
        return self.streams[-1]

    def start_vehicle(self):
        self.stream("odom", Odometry, support.odometry, 50.0)
        self.stream("imu", Imu, support.imu, 50.0)

    def test_pose_in_camera_and_in_odom(self):
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.camera_info)
        self.stream("window", WindowDetection, detection)
        pose = self.poses.wait(lambda p: p.image.reject == ImagePose.OK and p.filtered.valid, "a pose, filtered")
        self.assertAlmostEqual(pose.image.pose.pose.position.x, 0.0, delta=0.02)
        self.assertAlmostEqual(pose.image.pose.pose.position.y, 0.0, delta=0.02)
        self.assertAlmostEqual(pose.image.pose.pose.position.z, DISTANCE, delta=0.05)
        self.assertEqual(pose.filtered.header.frame_id, "odom")
        self.assertAlmostEqual(pose.filtered.pose.pose.position.x, VEHICLE_X + CAMERA_X + DISTANCE, delta=0.05)
        self.assertAlmostEqual(pose.filtered.pose.pose.position.y, 0.0, delta=0.05)
        self.assertAlmostEqual(pose.filtered.pose.pose.position.z, 1.5, delta=0.05)
        self.assertGreater(pose.filtered.pose.covariance[0], 0.0)
        self.assertEqual((pose.size.width, pose.size.height), (WINDOW_W, WINDOW_H))

    def test_a_transform_is_published_where_asked_for_only_and_no_pose_is_latched(self):
        transforms = support.Listener("/tf", support.transforms_type())
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.camera_info)
        self.stream("window", WindowDetection, detection)
        message = transforms.wait(what="a transform")
        self.assertEqual((message.transforms[0].header.frame_id, message.transforms[0].child_frame_id), ("odom", "window"))
        self.assertAlmostEqual(message.transforms[0].transform.translation.x, VEHICLE_X + CAMERA_X + DISTANCE, delta=0.1)
        self.assertFalse(support.is_latched(self.poses.wait(lambda p: p.filtered.valid, "a filtered pose")))
        self.assertEqual({m._connection_header["callerid"] for m in transforms.since(0.0)}, {"/second/homography_pose"})
        transforms.stop()

    def test_a_reset_forgets_the_track_and_all_windows(self):
        markers, facades = support.Listener("markers", MarkerArray), support.Listener("facade", Facade)
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.camera_info)
        windows = self.stream("window", WindowDetection, detection)
        before = self.poses.wait(lambda p: p.filtered.updates > 20, "a window that is followed")
        facades.wait(lambda f: len(f.windows) == 1, "a window that is known")
        self.assertTrue(before.filtered.valid)
        windows.make = support.changed(detection, detected=False, reason="gone")
        self.poses.wait(lambda p: "gone" in p.image.reason, "the view without it")
        begin = time.monotonic()
        reply = support.call("homography_pose/reset")
        self.assertTrue(reply.success)
        self.assertIn("forgotten", reply.message)
        gone = markers.wait(lambda m: any(marker.action == Marker.DELETEALL for marker in m.markers), "markers taken away", begin=begin)
        self.assertEqual(gone.markers[0].header.frame_id, "odom")
        self.assertEqual(len(facades.wait(what="the windows known now", begin=begin).windows), 0)
        after = self.poses.wait(lambda p: p.header.stamp > before.header.stamp + rospy.Duration(0.5), "a pose after the reset", begin=begin)
        self.assertFalse(after.filtered.valid)
        self.assertEqual((after.target.window_id, after.filtered.updates), (0, 0))
        windows.make = detection
        again = self.poses.wait(lambda p: p.filtered.valid, "a window found anew")
        self.assertLess(again.filtered.updates, before.filtered.updates)
        for listener in (markers, facades):
            listener.stop()

    def test_two_sides_near_the_window_update_the_filter(self):
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.camera_info)
        windows = self.stream("window", WindowDetection, detection)
        whole = self.poses.wait(lambda p: p.filtered.valid, "a filtered pose")
        windows.make = partial
        pose = self.poses.wait(lambda p: p.image.reject != ImagePose.OK and p.filtered.updates > whole.filtered.updates
                               and p.filtered.age < 0.01, "an update by two sides")
        self.assertIn("2 of 4 sides in view", pose.image.reason)
        self.assertEqual((pose.filtered.reject, pose.filtered.reason), (FilteredPose.OK, ""))
        self.assertAlmostEqual(pose.filtered.pose.pose.position.x, VEHICLE_X + CAMERA_X + DISTANCE, delta=0.05)

    def test_polygon_and_covariance_stand_in_the_camera_frame(self):
        polygons = support.Listener("window_polygon", PolygonStamped)
        poses = support.Listener("window_pose_cov", PoseWithCovarianceStamped)
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.camera_info)
        self.stream("window", WindowDetection, detection)
        polygon = polygons.wait(what="a polygon")
        self.assertEqual(polygon.header.frame_id, "camera_optical_frame")
        self.assertAlmostEqual(polygon.polygon.points[0].x, -WINDOW_W / 2, delta=0.05)  # top left, x right, y down
        self.assertAlmostEqual(polygon.polygon.points[0].y, -WINDOW_H / 2, delta=0.05)
        self.assertAlmostEqual(polygon.polygon.points[0].z, DISTANCE, delta=0.1)
        self.assertAlmostEqual(poses.wait(what="a pose").pose.pose.position.z, DISTANCE, delta=0.05)

    def test_uncalibrated_camera_is_named(self):
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, lambda stamp: support.camera_info(stamp, focal=0.0))
        self.stream("window", WindowDetection, detection)
        self.poses.wait(lambda p: p.image.reject == ImagePose.NO_CALIBRATION and "uncalibrated" in p.image.reason,
                        "a refusal that names the calibration")
        support.Diagnostics().wait("homography_pose: camera_info", "uncalibrated")

    def test_the_camera_is_told_beside_every_pose_and_what_is_missing_of_it_with_no_window_either(self):
        def nothing(stamp):
            return detection(stamp, "camera_that_nobody_mounted") if self.unmounted else \
                support.changed(detection, detected=False, reason="nothing with four sides")(stamp)
        self.unmounted = False
        self.start_vehicle()
        calibration = self.stream("camera_info", CameraInfo, lambda stamp: support.camera_info(stamp, focal=0.0))
        self.stream("window", WindowDetection, nothing)
        self.poses.wait(lambda p: p.camera.fault.startswith("no calibration: ") and "uncalibrated" in p.camera.fault and not p.camera.known,
                        "the missing calibration")
        calibration.make = support.camera_info
        camera = self.poses.wait(lambda p: p.camera.known, "the camera").camera
        self.assertEqual(camera.fault, "")
        self.assertAlmostEqual(camera.forward, CAMERA_X)
        self.assertAlmostEqual(camera.horizontal_fov, 2.0 * math.atan(support.WIDTH / 2 / support.FOCAL))
        self.assertAlmostEqual(camera.vertical_fov, 2.0 * math.atan(support.HEIGHT / 2 / support.FOCAL))
        self.assertAlmostEqual(camera.pixel_angle, 1.0 / support.FOCAL)
        calibration.make = lambda stamp: support.camera_info(stamp, "camera_that_nobody_mounted")
        self.unmounted = True
        self.poses.wait(lambda p: "camera mounting base_link <- 'camera_that_nobody_mounted'" in p.camera.fault and not p.camera.known,
                        "the missing mounting")

    def test_calibration_of_another_size_is_named(self):
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, support.changed(support.camera_info, width=320, height=240))
        self.stream("window", WindowDetection, detection)
        self.poses.wait(lambda p: "sizes differ" in p.image.reason, "a refusal that names both sizes")

    def test_unknown_mounting_withholds_the_filtered_pose_only(self):
        frame = "camera_that_nobody_mounted"
        self.start_vehicle()
        self.stream("camera_info", CameraInfo, lambda stamp: support.camera_info(stamp, frame))
        self.stream("window", WindowDetection, lambda stamp: detection(stamp, frame))
        pose = self.poses.wait(lambda p: p.header.frame_id == frame and p.image.reject == ImagePose.OK, "a pose in the camera")
        self.assertIn(frame, pose.filtered.reason)
        self.assertEqual(pose.filtered.reject, FilteredPose.NO_MOUNTING)
        self.assertAlmostEqual(pose.image.pose.pose.position.z, DISTANCE, delta=0.05)

    def test_missing_odometry_is_named(self):
        self.stream("camera_info", CameraInfo, support.camera_info)
        self.stream("window", WindowDetection, detection)
        pose = self.poses.wait(lambda p: p.image.reject == ImagePose.OK and "odom" in p.filtered.reason, "a pose without odometry")
        self.assertAlmostEqual(pose.image.pose.pose.position.z, DISTANCE, delta=0.05)
        support.Diagnostics().wait("homography_pose: odom", " odom on /odom (")
        self.stream("odom", Odometry, support.changed(support.odometry, header__frame_id="map"), 50.0)
        self.poses.wait(lambda p: "the pose node has no odometry: " in p.camera.fault and "'map', expected 'odom'" in p.camera.fault,
                        "what keeps a mission from starting")

    def test_no_window_passes_its_reason_on(self):
        def nothing(stamp):
            message = WindowDetection(reason="nothing with four sides")
            message.header.stamp = stamp
            return message
        self.stream("window", WindowDetection, nothing)
        pose = self.poses.wait(lambda p: p.image.reject == ImagePose.NO_WINDOW, "a message without pose")
        self.assertIn("four sides", pose.image.reason)


if __name__ == "__main__":
    rospy.init_node("homography_pose_test")
    rostest.rosrun("window_ingress", "homography_pose_test", HomographyPoseTest, sys.argv)
