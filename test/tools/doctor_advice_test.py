"""What doctor advises, on made-up findings; how it fares on live systems: test/ros/doctor*.test."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess
import types

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RAW, COMPRESSED = "sensor_msgs/Image", "sensor_msgs/CompressedImage"


@pytest.fixture(name="doctor", scope="module")
def fixture_doctor():
    loader = importlib.machinery.SourceFileLoader("doctor", str(ROOT / "scripts/doctor"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("doctor", loader))
    loader.exec_module(module)
    return module


def seen(doctor, topics=(), said=()):
    """A system with topics {name: type} of one camera, and what nodes said {status: level}."""
    system = object.__new__(doctor.System)
    topics = dict(topics)
    system.graph = types.SimpleNamespace(publishers={topic: ["/camera"] for topic in topics},
                                         topics_of_type=lambda kind: sorted(t for t, k in topics.items() if k == kind))
    system.said = {name: types.SimpleNamespace(level=level, message="") for name, level in dict(said).items()}
    return system


@pytest.mark.parametrize("wanted, kind, there, arguments", [
    ("/eye/image_raw", RAW, {"/camera/image_raw": RAW}, " image:=/camera/image_raw"),
    ("/eye/image_raw", RAW, {"/camera/image_raw/compressed": COMPRESSED}, " image_transport:=compressed image:=/camera/image_raw"),
    ("/eye/image_raw/compressed", COMPRESSED, {"/camera/image_raw/compressed": COMPRESSED},
     " image_transport:=compressed image:=/camera/image_raw"),
    ("/camera/image_raw/compressed", COMPRESSED, {"/camera/image_raw": RAW}, " image:=/camera/image_raw"),
    ("/odom", "nav_msgs/Odometry", {"/mavros/local_position/odom": "nav_msgs/Odometry"}, " odom:=/mavros/local_position/odom")])
def test_another_topic_is_given_as_launch_files_want_it(doctor, wanted, kind, there, arguments):
    assert doctor.suggest(seen(doctor, there), wanted, kind) == doctor.LAUNCH + arguments


def test_without_another_topic_the_argument_is_named(doctor):
    assert doctor.suggest(seen(doctor), "/imu", "sensor_msgs/Imu") == "start what publishes /imu, or give imu:=ITS_TOPIC"


@pytest.mark.parametrize("mounting, window, known", [(0, 0, True), (2, 0, False), (0, 2, False), (None, None, False)])
def test_a_transform_that_the_pose_node_has_is_not_missed(doctor, mounting, window, known):
    levels = {"/homography_pose: camera mounting": mounting, "/homography_pose: window": window}
    assert seen(doctor, said={name: level for name, level in levels.items() if level is not None}).knows_mounting() == known


def test_each_remedy_is_reached(doctor):
    for number, (words, mend) in enumerate(doctor.REMEDIES):
        assert doctor.remedy(f"so {words} it is") == mend, number


@pytest.mark.parametrize("simulated, clocks, heard, said", [
    (True, ["/world"], 3, "OK     time is that of /clock, from /world"),
    (True, ["/world"], 0, "ERROR  use_sim_time is set, but nothing comes on /clock from /world"),
    (True, [], 0, "ERROR  use_sim_time is set, but nobody publishes /clock"),
    (False, ["/world"], 0, "OK     time is that of this computer"),
    (False, ["/world"], 3, "WARN   time is that of this computer; use_sim_time is not set, nobody heeds /clock from /world"),
    (False, [], 0, "OK     time is that of this computer")])
def test_time_is_that_of_a_clock_which_runs_and_is_heeded(doctor, monkeypatch, capsys, simulated, clocks, heard, said):
    monkeypatch.setattr(doctor.rospy, "get_param", lambda name, default: simulated if name == "/use_sim_time" else default)
    system = object.__new__(doctor.System)
    system.graph = types.SimpleNamespace(publishers={"/clock": clocks} if clocks else {})
    system.clock = types.SimpleNamespace(times=[0.0] * heard)
    doctor.check_clock(system, doctor.Report())
    assert capsys.readouterr().out.startswith(said)


@pytest.mark.parametrize("words", [["--seconds", "abc"], ["--seconds", "-1"], ["--seconds", "nan"], ["--nope"]])
def test_wrong_usage(words):
    done = subprocess.run([str(ROOT / "scripts/run"), "doctor", *words], capture_output=True, text=True, timeout=60, check=False,
                          env={**os.environ, "ROS_MASTER_URI": "http://localhost:1"})
    assert done.returncode == 2 and "Traceback" not in done.stderr and words[0] in done.stderr, done.stderr
