"""Launch files that record, replay or show a flight command nobody and name what cannot be played."""
import re

import pytest

from launch_support import dump, refusal, remaps
from repository import ROOT, run


@pytest.mark.parametrize("name, argument", [("replay", "bag:={0}/there.bag {0}/none.bag"), ("rehearse", "video:={0}/none.bag"), ("view", "bag:={0}/none.bag")])
def test_a_recording_that_is_not_there_is_named_before_anything_starts(tmp_path, name, argument):
    (tmp_path / "there.bag").write_text("#ROSBAG V2.0\n")
    done = run("roslaunch", "window_ingress", f"{name}.launch", argument.format(tmp_path))
    assert done.returncode == 1 and "started with pid" not in done.stdout
    assert f"{name}.launch: {argument.split(':=')[0]}:={tmp_path}/none.bag: no such file\n" in done.stderr, done.stderr
    assert "there.bag" not in done.stderr


def test_topics_that_a_bag_has_under_other_names_are_named_before_anything_starts(tmp_path):
    written = run("python3", ROOT / "test/ros/write_camera_bag.py", tmp_path / "flight.bag", "seconds=0.2", "image=/eye/image_raw")
    assert written.returncode == 0, written.stderr
    words = "roslaunch", "window_ingress", "replay.launch", f"bag:={tmp_path}/flight.bag"
    done = run(*words, "imu:=/mavros/imu/data")
    assert done.returncode == 1 and "started with pid" not in done.stdout
    for said in ("/camera/image_raw/compressed", ": give image:=/eye/image_raw"), ("/camera/camera_info", ": give camera_info:=/eye/camera_info"), (
            "/mavros/imu/data", ": give imu:=/imu"):
        assert f"check_overlay: replay.launch: no {said[0]} in {tmp_path}/flight.bag{said[1]}\n" in done.stderr, done.stderr
    assert "no /odom" not in done.stderr
    content = (tmp_path / "flight.bag").read_bytes()
    (tmp_path / "flight.bag").write_bytes(content[:len(content) // 2])
    damaged = run("check_overlay", "--bag", tmp_path / "flight.bag", "--plays", "imu=/imu")
    assert damaged.returncode == 2 and f"check_overlay: {tmp_path}/flight.bag: damaged: " in damaged.stderr, damaged.stderr
    (tmp_path / "flight.bag").write_bytes(content)
    assert run("python3", ROOT / "test/ros/write_camera_bag.py", tmp_path / "early.bag", "seconds=0.2", "no_clock").returncode == 0
    early = run("roslaunch", "--nodes", ROOT / "launch/replay.launch", f"bag:={tmp_path}/early.bag")
    assert f"{tmp_path}/early.bag: recorded 20000 days after the stamps of its images. Start record.launch after sim.launch" in early.stderr, early.stderr
    right = f"image:=/eye/image_raw camera_info:=/eye/camera_info bag:={tmp_path}/flight.bag"
    assert run("roslaunch", "--nodes", ROOT / "launch/replay.launch", *right.split()).returncode == 0


@pytest.mark.parametrize("words, said", [
    ("replay.launch bag:={0}/text", "replay.launch: bag:={0}/text: is no bag file"),
    ("replay.launch bag:={0}/text rate:=0", "replay.launch: rate:=0: give a number above 0"),
    ("rehearse.launch calibration:=file://{0}/none.yaml", "rehearse.launch: calibration:={0}/none.yaml: no such file")])
def test_what_cannot_be_played_is_named_before_anything_starts(tmp_path, words, said):
    (tmp_path / "text").write_text("no bag\n")
    done = run("roslaunch", "window_ingress", *words.format(tmp_path).split())
    assert done.returncode == 1 and "started with pid" not in done.stdout
    assert f"check_overlay: {said.format(tmp_path)}\n" in done.stderr, done.stderr


def played(*arguments):
    """Topics that rosbag play plays."""
    args = dump("replay", *arguments)["nodes"]["/play"]["args"]
    return args.split("--topics ")[1].split(" --bags")[0].split()


def test_a_replay_plays_what_is_taken_and_commands_nobody():
    own = ["/camera/camera_info", "/odom", "/imu", "/tf", "/tf_static", "/reference"]
    assert played() == ["/camera/image_raw/compressed", *own]
    assert played("image_transport:=raw") == ["/camera/image_raw", *own]
    assert played("odom:=/uav1/mavros/local_position/odom")[2] == "/uav1/mavros/local_position/odom"
    launch = dump("replay", "rviz:=true", "loop:=true", "rate:=0.5", "start:=3", "odom_frame:=map")
    assert remaps(launch, "setpoint_guard")["cmd_vel"] == "/replay/cmd_vel" and launch["params"]["/vehicle/odom_frame"] == "map"
    assert {"/rviz", "/ingress_navigator"} <= set(launch["nodes"])
    assert "/ingress_navigator" not in dump("replay")["nodes"]


def test_a_recorded_flight_is_looked_at_without_commanding_anybody():
    assert set(dump("view")["nodes"]) == {"/rviz"} and set(dump("view")["params"]) == {"/checked"}
    launch = dump("view", "bag:=/tmp/flight.bag")
    args = launch["nodes"]["/play"]["args"]
    assert args.endswith("--bags /tmp/flight.bag")
    assert set(args.split("--topics ")[1].split(" --bags")[0].split()) == {"/demo/detection", "/markers", "/window_polygon", "/odom", "/tf", "/tf_static"}
    assert remaps(launch, "rviz")["/debug_image"] == "/demo/detection"
    for node in launch["nodes"].values():
        assert (node["remaps"]["/clock"], node["remaps"]["/use_sim_time"]) == ("/replay/clock", "/replay/use_sim_time")


def test_a_replay_leaves_the_clock_of_others_alone():
    launch = dump("replay", "rviz:=true")
    assert "/use_sim_time" not in launch["params"] and launch["params"]["/replay/use_sim_time"] is True
    for node in launch["nodes"].values():
        assert (node["remaps"]["/clock"], node["remaps"]["/use_sim_time"]) == ("/replay/clock", "/replay/use_sim_time")


def test_a_replay_in_rviz_waits_for_it_and_stays_until_it_is_closed():
    alone, seen = dump("replay")["nodes"], dump("replay", "rviz:=true")["nodes"]
    assert alone["/play"]["required"] and not seen["/play"]["required"] and seen["/rviz"]["required"]
    assert "--delay 2.0" in alone["/play"]["args"] and "--delay 8.0" in seen["/play"]["args"]
    assert dump("replay", "rviz:=true", "stay:=false")["nodes"]["/play"]["required"]


def test_a_simulated_flight_in_rviz_waits_for_it_and_stays_until_it_is_closed():
    alone, seen = dump("sim", "auto_start:=true"), dump("sim", "auto_start:=true", "rviz:=true", "software:=true")
    assert alone["nodes"]["/start_mission"]["required"] and not seen["nodes"]["/start_mission"]["required"]
    assert seen["nodes"]["/rviz"]["required"]
    assert (alone["params"]["/start_mission/wait_sec"], seen["params"]["/start_mission/wait_sec"]) == (0.0, 8.0)
    assert dump("sim", "auto_start:=true", "rviz:=true", "stay:=false")["nodes"]["/start_mission"]["required"]


@pytest.mark.parametrize("name, argument", [("sim", "record"), ("demo", "bag")])
def test_a_recording_that_is_there_is_replaced_only_where_that_is_asked_for(tmp_path, name, argument):
    bag = tmp_path / "flight.bag"
    launch = ROOT / f"launch/{name}.launch", f"{argument}:={bag}"
    assert run("roslaunch", "--nodes", *launch).returncode == 0
    bag.write_text("of another flight")
    assert f"record:={bag} is there already: overwrite:=true replaces it" in refusal(*launch)
    assert run("roslaunch", "--nodes", *launch, "overwrite:=true").returncode == 0


def recorded(*arguments):
    """Arguments of rosbag record."""
    return dump("record", *arguments)["nodes"]["/recorder"]["args"].split()


def test_a_recording_holds_what_replay_and_plots_need():
    topics = recorded()
    assert {"/camera/image_raw/compressed", "/camera/camera_info", "/odom", "/imu", "/tf", "/tf_static", "/window", "/window_pose",
            "/state", "/cmd_vel", "/ingress_navigator/cmd_vel", "/diagnostics"} <= set(topics)
    assert "/clock" not in topics and "/debug_image" not in topics and "-a" not in topics
    assert "--split" in topics and "--size=1024" in topics and "--lz4" in topics


def test_a_recorded_simulated_flight_can_be_replayed():
    nodes = dump("demo", "bag:=/tmp/flight.bag")["nodes"]
    left_out = nodes["/record"]["args"].split("-x '")[1].split("'")[0]
    assert not re.fullmatch(left_out, nodes["/image_compressor"]["remaps"]["compressed"]) and re.fullmatch(left_out, "/camera/image_raw")
    assert "/image_compressor" not in dump("sim")["nodes"]


def test_images_of_a_recording_are_by_choice():
    assert "/camera/image_raw" in recorded("images:=raw") and "/camera/image_raw/compressed" not in recorded("images:=raw")
    assert not any("image_raw" in word for word in recorded("images:=none"))
    assert "/eye/image_raw/compressed" in recorded("image:=/eye/image_raw")
    launch = dump("record", "image:=/eye/image_raw")
    assert remaps(launch, "image_compressor") == {"image_raw": "/eye/image_raw", "compressed": "/eye/image_raw/compressed"}
    for argument in ("compress:=false", "images:=raw", "images:=none"):
        assert "/image_compressor" not in dump("record", argument)["nodes"]


def test_a_recording_is_bounded_as_asked():
    assert {"--split", "--size=100", "--max-splits=5"} <= set(recorded("split_mb:=100", "files:=5"))
    timed = recorded("seconds:=30", "compression:=none")
    assert "--duration=30" in timed and "--split" not in timed and "--lz4" not in timed
    assert {"/more", "/topics"} <= set(recorded("more:=/more /topics"))
