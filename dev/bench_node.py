#!/usr/bin/env python3
"""Shows images to a detector node and watches its memory. Started by dev/bench_node."""
import json
import os
import subprocess
import sys
import threading
import time
from urllib.parse import urlparse

import cv2
import rospy
import yaml
from sensor_msgs.msg import CameraInfo, Image
from window_ingress.msg import WindowDetection

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
RUN = os.path.join(ROOT, "scripts", "run")
SEQUENCE = "plaster"
STEADY = 300  # images before the first figure, while connections and buffers settle
MOST_MB, MOST_GROWTH_MB = 150.0, 2.0
DEADLINE_S = 30.0


def resident_mb(pid):
    with open(f"/proc/{pid}/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE") / 1e6


def wait_for(condition, what):
    end = time.monotonic() + DEADLINE_S
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"bench_node: no {what} within {DEADLINE_S:.0f} s")
        time.sleep(0.02)


def master_answers():
    try:
        rospy.get_master().getPid()
        return True
    except OSError:
        return False


def image_message(pixels):
    message = Image(height=pixels.shape[0], width=pixels.shape[1], encoding="bgr8", step=3 * pixels.shape[1])
    message.header.frame_id = "camera_optical_frame"
    message.data = pixels.tobytes()
    return message


def camera_message(camera):
    message = CameraInfo(width=camera["width"], height=camera["height"], distortion_model="plumb_bob",
                         D=camera["distortion"])
    message.header.frame_id = "camera_optical_frame"
    fx, fy, cx, cy = (camera[key] for key in ("fx", "fy", "cx", "cy"))
    message.K = [fx, 0, cx, 0, fy, cy, 0, 0, 1]
    message.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    message.P = [fx, 0, cx, 0, 0, fy, cy, 0, 0, 0, 1, 0]
    return message


def read_sequence(folder):
    with open(os.path.join(folder, "frames.json")) as file:
        return next(entry for entry in json.load(file) if entry["name"] == SEQUENCE)


def set_parameters(folder):
    with open(os.path.join(ROOT, "config", "detector.yaml")) as file:
        rospy.set_param("/window_detector", yaml.safe_load(file))
    reference = read_sequence(folder)["reference"]
    rospy.set_param("/window_detector/reference/picture", os.path.join(os.path.abspath(folder), reference["picture"]))
    rospy.set_param("/window_detector/reference/corners", reference["corners"])


class Showing:
    """Publishes images one by one, each after the answer to the previous one."""

    def __init__(self, folder):
        entry = read_sequence(folder)
        forth = [image_message(cv2.imread(os.path.join(folder, name))) for name in entry["images"]]
        self._images = forth + forth[-2:0:-1]
        self._camera = camera_message(entry["camera"])
        self._publisher = rospy.Publisher("image_raw", Image, queue_size=1)
        self._cameras = rospy.Publisher("camera_info", CameraInfo, queue_size=1)
        self._answered = threading.Event()
        self._last = None
        self.found = 0
        rospy.Subscriber("window", WindowDetection, self._receive, queue_size=1)

    def connected(self):
        return self._publisher.get_num_connections() > 0 and self._cameras.get_num_connections() > 0

    def _receive(self, message):
        if message.header.stamp == self._last:
            self.found += message.detected
            self._answered.set()

    def show(self, index):
        image = self._images[index % len(self._images)]
        self._last = image.header.stamp = self._camera.header.stamp = rospy.Time.now()
        self._answered.clear()
        self._cameras.publish(self._camera)
        self._publisher.publish(image)
        self._answered.wait(1.0)


def watch(folder, images, node):
    rospy.init_node("bench", anonymous=True, disable_signals=True)
    showing = Showing(folder)
    wait_for(showing.connected, "subscription of the node")
    figures = {}
    for index in range(images):
        if index in (STEADY, images // 10):
            figures[index] = resident_mb(node.pid)
        showing.show(index)
    if node.poll() is not None:
        sys.exit(f"bench_node: the node ended with {node.returncode}")
    first = figures.get(STEADY, figures[images // 10])
    return {"pictures": images, "found": showing.found / images, "start_mb": first,
            "tenth_mb": figures[images // 10], "end_mb": resident_mb(node.pid)}


def main():
    folder, images = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 108000
    started = []

    def start(*command):
        started.append(subprocess.Popen([RUN, *command], stdout=subprocess.DEVNULL))
        return started[-1]

    try:
        start("roscore", "-p", str(urlparse(os.environ["ROS_MASTER_URI"]).port))
        wait_for(master_answers, "master")
        set_parameters(folder)
        result = watch(folder, images, start("window_detector"))
    finally:
        for process in reversed(started):
            process.terminate()
            process.wait()
    print(json.dumps(result))
    growth = result["end_mb"] - result["tenth_mb"]
    sys.exit(0 if result["end_mb"] <= MOST_MB and growth <= MOST_GROWTH_MB and result["found"] > 0.9 else 1)


if __name__ == "__main__":
    main()
