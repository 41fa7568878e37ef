#!/usr/bin/env python3
"""Plays a video file as camera images, with the calibration of the camera that took it. Node of rehearse.launch.

Starts ~wait seconds after the first subscriber. Publishes the images at the file's rate, with the current time as stamp. Ends after
the last image, with ~stay when the launch ends. Exit code: 0 played, 2 video or calibration cannot be used.
"""
import os
import sys

import cv2
import rospy
import yaml
from sensor_msgs.msg import CameraInfo, Image

USUAL_HZ = 30.0  # for a file without a rate
USUAL_CALIBRATION = "~/.ros/camera_info/camera.yaml"
MATRICES = {"K": "camera_matrix", "D": "distortion_coefficients", "R": "rectification_matrix", "P": "projection_matrix"}


class Unusable(Exception):
    """What is wrong with a file, and what to do."""


def calibration(file):
    """camera_info from the calibrator's file."""
    file = os.path.expanduser(file.replace("file://", "", 1))
    if not os.path.isabs(file):
        raise Unusable(f"calibration {file}: give its whole path, as file:///home/me/camera.yaml")
    if not os.path.isfile(file):
        raise Unusable(f"calibration {file}: no such file; calibrate the camera that took the video (doc/window.md), or give calibration:=")
    try:
        with open(file, encoding="utf-8") as stream:
            read = yaml.safe_load(stream)
        return CameraInfo(width=read["image_width"], height=read["image_height"], distortion_model=read["distortion_model"],
                          **{name: read[key]["data"] for name, key in MATRICES.items()})
    except (OSError, UnicodeDecodeError, yaml.YAMLError, KeyError, TypeError) as error:
        raise Unusable(f"calibration {file}: not as a calibrator writes it: {error}") from error


def opened(file, info):
    if not os.path.isfile(file):
        raise Unusable(f"video {file}: no such file")
    video = cv2.VideoCapture(file)
    size = tuple(int(video.get(key)) for key in (cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT))
    if not video.isOpened() or 0 in size:
        raise Unusable(f"video {file}: cannot be read as a video; give mp4 or avi")
    if size != (info.width, info.height):
        raise Unusable(f"video {file}: its images have {size[0]} x {size[1]} pixels, those of the calibration {info.width} x {info.height}")
    return video


def message_of(image, header):
    return Image(header=header, height=image.shape[0], width=image.shape[1], step=3 * image.shape[1], encoding="bgr8", data=image.tobytes())


def play(video, info, frame):
    images = rospy.Publisher("/camera/image_raw", Image, queue_size=2)
    infos = rospy.Publisher("/camera/camera_info", CameraInfo, queue_size=2)
    while images.get_num_connections() == 0:
        rospy.sleep(0.1)
    rospy.sleep(rospy.get_param("~wait", 0.0))
    info.header.frame_id = frame
    rate = rospy.Rate(video.get(cv2.CAP_PROP_FPS) or USUAL_HZ)
    there, image = video.read()
    while there and not rospy.is_shutdown():
        info.header.stamp = rospy.Time.now()
        infos.publish(info)
        images.publish(message_of(image, info.header))
        there, image = video.read()
        rate.sleep()
    if rospy.get_param("~stay", False):
        rospy.loginfo("the video is over; close rviz, or press Ctrl-C, to end the launch")
        sys.stdout.flush()  # rospy does not, and this process goes on
        rospy.spin()
    else:
        rospy.loginfo("the video is over, so the launch ends: roslaunch's red lines are no error")


def main():
    rospy.init_node("play_video")
    try:
        info = calibration(rospy.get_param("~calibration", USUAL_CALIBRATION))
        play(opened(rospy.get_param("~video"), info), info, rospy.get_param("~frame", "camera_optical_frame"))
    except Unusable as error:
        rospy.logfatal("%s", error)
        return 2
    except rospy.ROSInterruptException:
        pass
    return 0


if __name__ == "__main__":
    sys.exit(main())
