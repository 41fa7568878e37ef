"""view.launch in rviz itself, without a screen: it loads the whole configuration and subscribes to the right topics. Needs rviz
and Xvfb (package xvfb); skipped if they are not installed."""
import os
import shutil
import signal
import socket
import subprocess
import time
import xmlrpc.client

import pytest

from repository import ROOT

UP_WITHIN_S = 90.0
COMPLAINTS = ("failed to load", "could not be loaded", "does not exist", "unable to open", "error when loading", "exception",
              "segmentation")
NOISE = ("media_export", "librospack")  # rviz looks for packages with media exports; there are none

pytestmark = pytest.mark.skipif(not shutil.which("rviz"), reason="rviz is not installed")


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


def asked_by_rviz(port):
    """Topics that rviz subscribes to, as the master reports."""
    try:
        _, _, (_, subscribed, _) = xmlrpc.client.ServerProxy(f"http://localhost:{port}").getSystemState("/test")
    except OSError:
        return set()
    return {topic for topic, nodes in subscribed if "/rviz" in nodes}


def view(screen, folder, *arguments, awaits=("/markers",)):
    """Opens view.launch until it has subscribed to `awaits`. Returns all its topics and its output."""
    port = free_port()
    environment = dict(os.environ, DISPLAY=screen, ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost",
                       ROS_HOME=str(folder), ROS_LOG_DIR=str(folder / "log"), XDG_RUNTIME_DIR=str(folder))
    command = [str(ROOT / "scripts/run"), "roslaunch", "-p", str(port), str(ROOT / "launch/view.launch"), "software:=true",
               "required:=true", *arguments]
    with open(folder / "said.txt", "w", encoding="utf-8") as said:
        process = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT, env=environment)
        topics, end = set(), time.monotonic() + UP_WITHIN_S
        while not set(awaits) <= topics and process.poll() is None and time.monotonic() < end:
            time.sleep(0.2)
            topics = asked_by_rviz(port)
        process.send_signal(signal.SIGINT)
        process.wait(30)
    return topics, (folder / "said.txt").read_text(encoding="utf-8")


def complaints(said):
    lines = [line for line in said.splitlines() if not any(noise in line for noise in NOISE)]
    return [line for line in lines if any(word in line.lower() for word in COMPLAINTS)]


def test_the_configuration_loads_whole_and_asks_for_what_the_nodes_publish(screen, tmp_path):
    topics, said = view(screen, tmp_path, awaits=("/markers", "/debug_image", "/window_polygon", "/tf"))
    assert {"/markers", "/debug_image", "/window_polygon", "/tf", "/tf_static"} <= topics, said
    assert complaints(said) == []


def test_topics_and_frame_are_arguments(screen, tmp_path):
    topics, said = view(screen, tmp_path, "markers:=/uav1/markers", "debug_image:=/uav1/camera/image_raw", "frame:=map",
                        awaits=("/uav1/markers", "/uav1/camera/image_raw"))
    assert {"/uav1/markers", "/uav1/camera/image_raw"} <= topics, said
    assert not {"/markers", "/debug_image"} & topics
    assert complaints(said) == []


def test_a_configuration_that_rviz_does_not_understand_is_seen_as_one(screen, tmp_path):
    broken = tmp_path / "broken.rviz"
    broken.write_text((ROOT / "config/view.rviz").read_text(encoding="utf-8").replace("rviz/TF", "rviz/NoSuchDisplay"),
                      encoding="utf-8")
    _, said = view(screen, tmp_path, f"config:={broken}")
    assert any("NoSuchDisplay" in line for line in complaints(said)), said
