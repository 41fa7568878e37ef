"""A rehearsal from a video file: its window starts a mission, and a file that cannot be played is reported."""
import os
import signal
import socket
import subprocess
import sys
import time

import cv2
import numpy
import pytest

from repository import ROOT

pytest.importorskip("rospy")
sys.path.insert(0, str(ROOT / "test/ros"))
from rehearse_test import PX_PER_M, wall  # noqa: E402

WIDTH, HEIGHT, FOCAL = 640, 480, 467.74
CALIBRATION = f"""image_width: {WIDTH}
image_height: {HEIGHT}
camera_name: camera
camera_matrix: {{rows: 3, cols: 3, data: [{FOCAL}, 0, 319.5, 0, {FOCAL}, 239.5, 0, 0, 1]}}
distortion_model: plumb_bob
distortion_coefficients: {{rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}}
rectification_matrix: {{rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}}
projection_matrix: {{rows: 3, cols: 4, data: [{FOCAL}, 0, 319.5, 0, 0, {FOCAL}, 239.5, 0, 0, 0, 1, 0]}}
"""


@pytest.fixture(name="folder", scope="module")
def fixture_folder(tmp_path_factory):
    """A folder with eight seconds of a camera carried towards the printed window, and its calibration."""
    folder = tmp_path_factory.mktemp("video")
    (folder / "camera.yaml").write_text(CALIBRATION)
    video = cv2.VideoWriter(str(folder / "hand.avi"), cv2.VideoWriter_fourcc(*"MJPG"), 20.0, (WIDTH, HEIGHT))
    height, width = wall().shape[:2]
    metres = numpy.array([[1 / PX_PER_M, 0, -width / 2 / PX_PER_M], [0, 1 / PX_PER_M, -height / 2 / PX_PER_M], [0, 0, 1]])
    camera = numpy.array([[FOCAL, 0, 319.5], [0, FOCAL, 239.5], [0, 0, 1]])
    for distance in numpy.linspace(2.2, 1.6, 160):
        seen_from = numpy.array([[1, 0, 0.2], [0, 1, 0], [0, 0, distance]])
        video.write(cv2.warpPerspective(wall(), camera @ seen_from @ metres, (WIDTH, HEIGHT), borderValue=(185, 185, 185)))
    video.release()
    (folder / "text.avi").write_text("no video")
    (folder / "small.yaml").write_text(CALIBRATION.replace(f"image_width: {WIDTH}", "image_width: 320"))
    (folder / "list.yaml").write_text("[1, 2]")
    return folder


def rehearse(folder, *arguments, seconds=60):
    """Returns all output of roslaunch until it ends, and its exit code."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost", "ROS_HOME": str(folder)}
    command = [ROOT / "scripts/run", "roslaunch", "-p", str(port), "window_ingress", "rehearse.launch", "rviz:=false", *arguments]
    launched = subprocess.Popen(command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    try:
        return launched.communicate(timeout=seconds)[0], launched.returncode
    finally:
        if launched.poll() is None:
            launched.send_signal(signal.SIGINT)
            launched.communicate(timeout=30)


def test_a_mission_begins_by_what_the_video_shows_and_all_ends_with_it(folder):
    begin = time.monotonic()
    said, _ = rehearse(folder, f"video:={folder}/hand.avi", f"calibration:=file://{folder}/camera.yaml")
    assert "ALIGN: " in said and " m/s " in said and "the video is over" in said, said
    assert time.monotonic() - begin > 8.0


def test_with_rviz_the_launch_stays_when_the_video_is_over(folder):
    with pytest.raises(subprocess.TimeoutExpired) as stayed:
        rehearse(folder, f"video:={folder}/hand.avi", f"calibration:=file://{folder}/camera.yaml", "stay:=true", seconds=35)
    assert b"the video is over; close rviz" in stayed.value.output


@pytest.mark.parametrize("video, calibration, words", [
    ("none.avi", "camera.yaml", "rehearse.launch: video:={}/none.avi: no such file"), ("text.avi", "camera.yaml", "{}/text.avi: cannot be read as a video"),
    ("hand.avi", "none.yaml", "calibration {}/none.yaml: no such file; calibrate the camera"), ("hand.avi", "list.yaml", "{}/list.yaml: not as a calibrator writes it"),
    ("hand.avi", "small.yaml", "{}/hand.avi: its images have 640 x 480 pixels, those of the calibration 320 x 480")])
def test_what_cannot_be_played_is_said(folder, video, calibration, words):
    said, _ = rehearse(folder, f"video:={folder}/{video}", f"calibration:={folder}/{calibration}")
    assert words.format(folder) in said and "Traceback" not in said, said
