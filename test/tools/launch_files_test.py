"""Launch files load, and their remaps lead setpoints from the navigator through the guard to the autopilot, never past the guard."""
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest

from launch_support import CHAIN, GIVEN, LAUNCH_FILES, NEEDED, VEHICLE, dump, remaps
from repository import ROOT, call, run


@pytest.mark.parametrize("file", LAUNCH_FILES, ids=lambda file: file.stem)
def test_each_is_xml_and_loads(file):
    root = ElementTree.parse(file).getroot()
    assert root.tag == "launch"
    required = [arg.get("name") for arg in root.findall("arg") if arg.get("default") is None and arg.get("value") is None]
    assert sorted(required) == sorted(text.split(":=")[0] for text in NEEDED.get(file.stem, []))
    for option in ("--nodes", "--files"):
        done = run("roslaunch", option, file, *GIVEN.get(file.stem, []))
        assert done.returncode == 0 and done.stdout.strip(), done.stderr
    assert dump(file.stem)["nodes"]


@pytest.mark.parametrize("name", ["ingress", "sim", "demo", "mavros", "px4", "ardupilot"])
def test_setpoints_go_from_the_navigator_over_the_guard_to_the_autopilot(name):
    launch = dump(name)
    assert CHAIN <= {node[1:] for node in launch["nodes"]}
    autopilot = "/mavros/setpoint_velocity/cmd_vel" if name in ("mavros", "px4", "ardupilot") else "/cmd_vel"
    between = remaps(launch, "ingress_navigator")["cmd_vel"]
    assert between not in (autopilot, "/cmd_vel")
    heard = remaps(launch, "ingress_navigator")["passed_on"]
    assert remaps(launch, "setpoint_guard") == {"cmd_vel_in": between, "cmd_vel": autopilot, "passed_on": heard}
    past = {(node, name) for node, what in launch["nodes"].items() for name, to in what["remaps"].items() if to == autopilot}
    assert past == {("/setpoint_guard", "cmd_vel"), ("/ingress_navigator", "brake")}


@pytest.mark.parametrize("name", ["ingress", "sim", "demo", "px4", "ardupilot"])
def test_in_flight_no_node_takes_the_guard_with_it(name):
    nodes = dump(name, *(["camera_pose:=[0,0,0,0,0,0]"] if name in GIVEN else []))["nodes"]
    assert not [node for node, what in nodes.items() if what["required"] and node not in ("/world", "/start_mission")]
    assert nodes["/setpoint_guard"]["respawn"] and nodes.get("/camera_mounting", {"respawn": True})["respawn"]


@pytest.mark.parametrize("name, arguments", [("replay", ["rviz:=true"]), ("replay", []), ("rehearse", []), ("px4", ["fly:=false"])])
def test_where_nothing_flies_a_node_that_ends_ends_the_launch(name, arguments):
    nodes = dump(name, *arguments)["nodes"]
    goes_on = {"/play"}  # to look at the end of a bag
    assert len(nodes) >= 2 and not [node for node, what in nodes.items() if what["respawn"] or not what["required"] and node not in goes_on]


@pytest.mark.parametrize("name, mode", [("px4", "OFFBOARD"), ("ardupilot", "GUIDED")])
def test_autopilots_are_wired_by_standard_topics_and_map_frame(name, mode):
    launch = dump(name)
    for node in ("homography_pose", "ingress_navigator"):
        assert remaps(launch, node)["odom"] == "/mavros/local_position/odom"
    assert remaps(launch, "homography_pose")["imu"] == "/mavros/imu/data"
    params = launch["params"]
    assert {params[f"/{key}"] for key in ("vehicle/odom_frame", "setpoint_guard/frame")} == {"map"}
    assert params["/ingress_navigator/engagement/required"] is True
    assert params["/engaged_from_mavros/modes"] == [mode]
    relay = remaps(launch, "engaged_from_mavros")
    assert relay == {"autopilot_state": "/mavros/state", "engaged": remaps(launch, "ingress_navigator")["engaged"],
                     "companion_status": "/mavros/companion_process/status"}
    assert not any("mavros" in node["type"].split("/")[0] for node in launch["nodes"].values())


def test_another_namespace_of_mavros_moves_everything():
    launch = dump("px4", "mavros:=/uav1/mavros")
    topics = {topic for node in launch["nodes"].values() for topic in node["remaps"].values()}
    assert "/uav1/mavros/setpoint_velocity/cmd_vel" in topics
    assert not any(topic.startswith("/mavros") for topic in topics)


def test_the_users_file_lies_over_the_frames_and_without_flying_nothing_commands(tmp_path):
    config = tmp_path / "drone.yaml"
    config.write_text(f"{VEHICLE.read_text()}setpoint_guard: {{stop_streaming_after_sec: 3.0, frame: local}}\n")
    params = dump("ardupilot", f"config:={config}")["params"]
    assert params["/setpoint_guard/frame"] == "local" and params["/setpoint_guard/stop_streaming_after_sec"] == 3.0
    assert {node for node in dump("px4", "fly:=false")["nodes"]} == {"/window_detector", "/homography_pose"}


@pytest.mark.parametrize("file", LAUNCH_FILES, ids=lambda file: file.stem)
def test_only_what_has_no_default_is_listed_as_required(file):
    done = run("roslaunch", "--ros-args", file)
    assert done.returncode == 0, done.stderr
    assert "undocumented" not in done.stdout, done.stdout
    listed = done.stdout.partition("Required Arguments:")[2].partition("Optional Arguments:")[0]
    assert sorted(line.split(":")[0].strip() for line in listed.splitlines() if line.strip()) == sorted(
        text.split(":=")[0] for text in NEEDED.get(file.stem, []))


@pytest.mark.parametrize("name", ["px4", "rehearse"])
def test_a_mounting_is_given_with_or_without_brackets(name):
    for pose in ("[0.1,0,0.02,0,0.1,0]", "0.1,0,0.02,0,0.1,0"):
        assert dump(name, f"camera_pose:={pose}")["params"]["/camera_mounting/pose"] == [0.1, 0, 0.02, 0, 0.1, 0]


def test_each_launch_file_takes_its_arguments():
    for name in (file.stem for file in LAUNCH_FILES):
        given = {text.split(":=")[0]: text for text in GIVEN.get(name, [])}
        for arg in ElementTree.parse(ROOT / f"launch/{name}.launch").getroot().findall("arg"):
            if arg.get("default") is not None and "$(" not in arg.get("default"):
                given.setdefault(arg.get("name"), f"{arg.get('name')}:={arg.get('default')}")
        done = run("roslaunch", "--nodes", ROOT / f"launch/{name}.launch", *given.values())
        assert done.returncode == 0, done.stderr


def test_the_demo_says_why_it_did_not_fly():
    nowhere = call(ROOT / "scripts/demo", "--scenario", "/nowhere.yaml")
    assert nowhere.returncode == 2 and "/nowhere.yaml" in nowhere.stderr and "building" not in nowhere.stdout
    mistyped = call(ROOT / "scripts/demo", "--sead", "3")
    assert mistyped.returncode == 2 and "unknown option '--sead'" in mistyped.stderr


def test_the_demo_says_how_far_the_build_is_while_it_builds(tmp_path):
    scripts = tmp_path / "scripts"
    scripts.mkdir()
    for name in ("demo", "env.sh"):
        shutil.copy(ROOT / "scripts" / name, scripts)
    build = f"echo '[ 12%] one'; for i in {{1..100}}; do [ ! -e {tmp_path}/seen ] || break; sleep 0.1; done; touch {tmp_path}/ended; exit 1"
    for name, text in (("setup", ""), ("build", build)):
        (scripts / name).write_text(f"#!/bin/bash\n{text}\n")
        (scripts / name).chmod(0o755)
    with subprocess.Popen([scripts / "demo"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as demo:
        assert "building" in demo.stdout.readline() and demo.stdout.readline() == "demo: 10 % built\n"
        assert not (tmp_path / "ended").exists(), "not before the build ended"
        (tmp_path / "seen").touch()
    assert demo.returncode == 1


def test_the_demo_keeps_its_last_flight_if_the_scenario_is_wrong(tmp_path):
    (tmp_path / "scripts").mkdir()
    (tmp_path / "out/demo").mkdir(parents=True)
    kept = tmp_path / "out/demo/flight.bag"
    kept.write_text("")
    for name in ("demo", "env.sh"):
        shutil.copy(ROOT / "scripts" / name, tmp_path / "scripts")
    for name, text in (("setup", ""), ("build", ""), ("run", f"exec {ROOT}/scripts/run \"$@\"")):
        (tmp_path / "scripts" / name).write_text(f"#!/bin/bash\n{text}\n")
        (tmp_path / "scripts" / name).chmod(0o755)
    (tmp_path / "mine.yaml").write_text("window: {sil_m: 1}\n")
    done = call(tmp_path / "scripts/demo", "--scenario", tmp_path / "mine.yaml")
    assert done.returncode == 2 and "mine.yaml:1: window/sil_m: unknown key" in done.stderr and kept.exists(), done.stderr


def test_what_is_started_again_does_not_end_the_launch():
    assert not any(node["required"] for node in dump("ingress", "fly:=false", "respawn:=true")["nodes"].values())


def test_what_is_empty_is_as_good_as_not_given():
    names = "reference", "window_size", "config", "defaults", "launch_prefix"
    assert dump("ingress", *(f"{name}:=" for name in names)) == dump("ingress")


def test_the_camera_is_mounted_where_it_is_said_to_be():
    for name in ("px4", "sim"):
        assert "/camera_mounting" not in dump(name)["nodes"]
    assert dump("ingress", "camera_pose:=[0.1,0,0,0,0,0]")["params"]["/camera_mounting/pose"] == [0.1, 0, 0, 0, 0, 0]
    launch = dump("px4", "camera_pose:=[0.1, 0, 0.02, 0, 0.3, 0]", "image:=/eye/image_raw")
    nodes = launch["nodes"]
    assert launch["params"]["/camera_mounting/pose"] == [0.1, 0, 0.02, 0, 0.3, 0] and "/camera_mounting" in nodes
    assert nodes["/window_detector"]["remaps"]["image_raw"] == "/eye/image_raw"


def test_the_usb_camera_publishes_what_the_detector_takes():
    camera, chain = dump("usb_cam"), dump("ingress")
    own = camera["nodes"]["/usb_cam"]["remaps"]
    for topic in ("image_raw", "camera_info"):
        assert own[f"~{topic}"] == remaps(chain, "window_detector")[topic]
    assert camera["params"]["/usb_cam/camera_frame_id"] == "camera_optical_frame"


def test_a_rehearsal_commands_nobody_and_stands_in_for_what_a_webcam_lacks():
    launch = dump("rehearse")
    nodes, params = launch["nodes"], launch["params"]
    assert CHAIN | {"usb_cam", "camera_mounting", "rehearsal", "rviz"} == {node[1:] for node in nodes}
    sent = {to for node in nodes.values() for name, to in node["remaps"].items() if name in ("cmd_vel", "brake")}
    assert sent == {"/rehearsal/cmd_vel", "/ingress_navigator/cmd_vel"}
    assert remaps(launch, "ingress_navigator")["odom"] == remaps(launch, "rehearsal")["odom"] == "/rehearsal/odom"
    assert params["/rehearsal/odometry"] is True and params["/camera_mounting/pose"] == [0] * 6
    assert params["/homography_pose/pose/opening_width_m"] == 0.6
    with_odometry = dump("rehearse", "odom:=/t265/odom", "camera:=false", "rviz:=false", "window_size:=0.8,0.7")
    assert remaps(with_odometry, "ingress_navigator")["odom"] == "/t265/odom" and with_odometry["params"]["/rehearsal/odometry"] is False
    assert not {"/usb_cam", "/rviz"} & set(with_odometry["nodes"])
    assert with_odometry["params"]["/homography_pose/pose/opening_width_m"] == 0.8
    by_video = dump("rehearse", "video:=/tmp/hand.mp4", "camera_frame:=eye")
    assert "/play_video" in by_video["nodes"] and "/usb_cam" not in by_video["nodes"]
    assert by_video["params"]["/play_video/video"] == "/tmp/hand.mp4" and by_video["params"]["/play_video/frame"] == "eye"


def test_a_debugger_goes_before_the_nodes_but_not_before_the_guard():
    prefixes = {name: node["prefix"] for name, node in dump("ingress", "launch_prefix:=gdb -ex run --args")["nodes"].items()}
    assert prefixes.pop("/setpoint_guard") is None
    assert set(prefixes.values()) == {"gdb -ex run --args"}
