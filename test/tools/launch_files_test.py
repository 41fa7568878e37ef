"""Launch files load, and their remaps lead setpoints from the navigator through the guard to the autopilot, never past the guard."""
import json
import pathlib
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import cv2
import numpy
import pytest
import rosgraph.names
import roslaunch.config
import roslaunch.xmlloader

from repository import ROOT, call, run

LAUNCH_FILES = sorted((ROOT / "launch").glob("*.launch"))
NEEDED = {"replay": ["bag:=/tmp/none.bag"], "record": ["name:=/tmp/none"], "mavros": ["modes:=[OFFBOARD]"]}  # arguments without a default
VEHICLE = ROOT / "test/ros/vehicle.yaml"
SIZE = ["window_size:=1.2,1.0", f"config:={VEHICLE}"]
GIVEN = {**NEEDED, "px4": SIZE, "ardupilot": SIZE, "mavros": [*NEEDED["mavros"], *SIZE]}  # without these nothing is flown
CHAIN = {"window_detector", "homography_pose", "ingress_navigator", "setpoint_guard"}


def dump(name, *arguments):
    """What a launch file starts: {"nodes": {name: {"type": "pkg/type", "remaps": {from: to}, ..}}, "params": {name: value}}."""
    named = {text.split(":=")[0] for text in arguments}
    given = [text for text in GIVEN.get(name, []) if text.split(":=")[0] not in named]
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader(resolve_anon=False).load(str(ROOT / f"launch/{name}.launch"), config, argv=[*given, *arguments], verbose=False)
    assert config.config_errors == []
    nodes = {}
    for node in config.nodes:
        own = {source: rosgraph.names.resolve_name(target, "/") for source, target in node.remap_args}
        nodes[rosgraph.names.ns_join(node.namespace, node.name)] = {
            "type": f"{node.package}/{node.type}", "remaps": own, "args": node.args, "required": node.required, "respawn": node.respawn,
            "prefix": node.launch_prefix}
    return {"nodes": nodes, "params": {name: param.value for name, param in config.params.items()}}


def photograph(file):
    """A frame on a wall. \return the file's name"""
    image = numpy.full((240, 320, 3), 190, numpy.uint8)
    cv2.rectangle(image, (50, 40), (270, 200), (20, 95, 225), -1)
    cv2.rectangle(image, (60, 50), (260, 190), (60, 50, 45), -1)
    cv2.imwrite(str(file), image)
    return str(file)


def remaps(launch, node):
    return launch["nodes"][f"/{node}"]["remaps"]


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
    assert nodes["/setpoint_guard"]["respawn"]


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


@pytest.mark.parametrize("name", ["ingress", "px4", "replay"])
@pytest.mark.parametrize("argument, said", [
    ("reference:=/nowhere/window.jpg", "reference/picture: /nowhere/window.jpg: no such file"),
    ("reference:=window.jpg", "reference:=window.jpg: give its whole path, as /"),
    ("reference:=~/window.jpg", f"give its whole path, as {pathlib.Path.home()}/window.jpg"),
    ("reference_corners:=1,2,3", "reference_corners: '1,2,3' is not 8 numbers"),
    ("reference_corners:=1,2,3,2,3,4,1,4", "reference corners without their image: give reference:= as well"),
    ("window_size:=1.2", "window_size: '1.2' is not 2 numbers"), ("window_size:=0,1", "window_size 0,1: opening_width_m = 0 is not within"),
    ("config:=/nowhere/drone.yaml", "/nowhere/drone.yaml")])
def test_an_argument_that_cannot_be_ends_the_launch_before_anything_starts(name, argument, said):
    done = run("roslaunch", "--nodes", ROOT / f"launch/{name}.launch", *NEEDED.get(name, []), argument)
    assert done.returncode == 1 and said in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["px4", "ardupilot", "mavros"])
def test_a_drone_does_not_fly_by_a_size_that_nobody_said(name):
    done = run("roslaunch", "--nodes", ROOT / f"launch/{name}.launch", *NEEDED.get(name, []))
    assert done.returncode == 1 and "the opening's size is missing: measure it and give window_size:=W,H" in done.stderr, done.stderr


def test_what_flies_without_saying_sizes_is_told_by_which_it_flies(tmp_path):
    """ingress.launch is also for other autopilots and for simulators. The package's own launch files state their sizes."""
    said = run("roslaunch", "--nodes", ROOT / "launch/ingress.launch").stderr
    for warning in ("the opening's size is missing: ", "assuming 1.2 x 1 m", "the vehicle's size is missing: ", "no reference image"):
        assert warning in said, said
    for quiet in (["ingress", "fly:=false"], ["sim"], ["rehearse"], ["replay", *NEEDED["replay"]], ["replay", *NEEDED["replay"], "navigator:=true"]):
        done = run("roslaunch", "--nodes", ROOT / f"launch/{quiet[0]}.launch", *quiet[1:])
        assert done.returncode == 0 and "warning" not in done.stderr, done.stderr


def test_a_simulated_flight_says_where_the_file_has_other_sizes_than_the_world(tmp_path):
    config = tmp_path / "drone.yaml"
    config.write_text("homography_pose: {pose: {opening_width_m: 1.3, opening_height_m: 1.0}}\n")
    done = run("roslaunch", "--nodes", ROOT / "launch/sim.launch", f"config:={config}")
    assert done.returncode == 0 and "the file says an opening of 1.3 x 1 m, the world has 1.2 x 1 m: the navigator uses the file's sizes" in done.stderr
    config.write_text("homography_pose: {pose: {opening_width_m: 1.2, opening_height_m: 1.0}}\n")
    assert "the world has" not in run("roslaunch", "--nodes", ROOT / "launch/sim.launch", f"config:={config}").stderr


def test_the_simulated_world_is_flown_by_the_sizes_of_its_scenario_unless_the_users_file_gives_others(tmp_path):
    def sizes(*arguments):
        params = dump("sim", f"scenario:={ROOT}/config/scenarios/tight.yaml", *arguments)["params"]
        return [params[f"/{key}"] for key in ("homography_pose/pose/opening_width_m", "homography_pose/pose/opening_height_m",
                                              "vehicle/half_length_m", "vehicle/half_width_m", "vehicle/half_height_m")]

    assert sizes() == [0.64, 0.45, 0.2, 0.2, 0.07]
    config = tmp_path / "drone.yaml"
    config.write_text("vehicle: {half_width_m: 0.22}\nhomography_pose: {pose: {opening_width_m: 0.7}}\n")
    assert sizes(f"config:={config}") == [0.7, 0.45, 0.2, 0.22, 0.07]


def test_what_is_missing_of_a_size_is_named(tmp_path):
    config = tmp_path / "drone.yaml"
    config.write_text("vehicle: {half_length_m: 0.3, half_width_m: 0.3}\nhomography_pose: {pose: {opening_width_m: 1.3}}\n")
    said = run("roslaunch", "--nodes", ROOT / "launch/ingress.launch", f"config:={config}").stderr
    assert "vehicle/half_height_m is missing: assuming 0.6 x 0.6 x 0.24 m" in said
    assert "homography_pose/pose/opening_height_m is missing: measure it" in said and "size is missing" not in said


@pytest.mark.parametrize("text, is_said", [
    ("{}", False), ("vehicle: {half_width_m: 0.3}", False), ("homography_pose: {pose: {opening_width_m: 1.3}}", False),
    ("homography_pose: {odom_wait_sec: 0.1}", False), ("homography_pose: {pose: {scale_sigma: 0.0}}", False),
    ("homography_pose: {pose: {opening_width_m: 1.3, opening_height_m: 1.1}}", True),
    ("homography_pose: {pose: {scale_sigma: 0.5, aspect_sigma: 0.3}}", True)])
def test_the_size_is_said_by_the_file_or_by_the_argument(tmp_path, text, is_said):
    config = tmp_path / "drone.yaml"
    config.write_text(text)
    done = run("check_overlay", config, "--needs-window-size", "true")
    assert done.returncode == (0 if is_said else 2) and (" is missing: measure it and give window_size" in done.stderr) != is_said, done.stderr
    for arguments in (("--needs-window-size", "true", "--window-size", "1.3,1.1"), ("--needs-window-size", "false")):
        assert run("check_overlay", config, *arguments).returncode == 0
    assert ("(assumed: " in run("check_overlay", config).stderr) != is_said
    assert "(assumed: " not in run("check_overlay", config, "--window-size", "1.3,1.1").stderr


@pytest.mark.parametrize("vehicle", [{}, {"half_width_m": 0.3, "half_height_m": 0.1}])
def test_a_drone_does_not_fly_by_the_size_of_somebody_elses_vehicle(tmp_path, vehicle):
    (tmp_path / "drone.yaml").write_text(json.dumps({"vehicle": vehicle}))
    launch = (ROOT / "launch/px4.launch", "window_size:=1.2,1.0", f"config:={tmp_path}/drone.yaml")
    done = run("roslaunch", "--nodes", *launch)
    width = 2 * vehicle.get("half_width_m", 0.25)
    assert done.returncode == 0 and f" is missing: assuming 0.5 x {width:g} x " in done.stderr
    done = run("roslaunch", "--nodes", *launch, "fly:=false")
    assert done.returncode == 0 and "warning: no reference image" in done.stderr


def test_what_a_launch_file_would_refuse_is_refused_by_hand_too(tmp_path):
    config, said = tmp_path / "drone.yaml", "homography_pose: {pose: {opening_width_m: 1.3, opening_height_m: 1.1}}\n"
    for text, why in (("vehicle: {half_width_m: 0.7}", "does not fit through the opening, 1.3 x 1.1 m"),
                      ("vehicle: {half_width_m: 0.62}", "with 0.05 m on each side (vehicle/margin_m)"),
                      ("ingress_navigator: {navigator: {limits: {min_height_m: 12}}}", "min_height_m must be below limits/max_height_m"),
                      ("window_detector: {reference: {picture: /nowhere.png}}", f"{config}: window_detector/reference/picture"),
                      ("window_pose: {rate_hz: 3}", "window_pose: unknown key; there is vehicle, window_detector, ")):
        config.write_text(said + text)
        done = run("check_overlay", config)
        assert done.returncode == 2 and not done.stdout and why in done.stderr, done.stderr


@pytest.mark.parametrize("pose, said", [("[0.1,0,0.02,0,15,0]", "not degrees"), ("[0.1,0]", "is not 6 numbers"),
                                        ("0.1,0.5,0.02,0,0,0", "lies outside of the vehicle"), ("0.1,0,0.02,0,2,0", "does not look forward")])
def test_a_mounting_that_cannot_be_ends_the_launch_before_anything_starts(pose, said):
    done = run("roslaunch", "--nodes", ROOT / "launch/px4.launch", *SIZE, f"camera_pose:={pose}")
    assert done.returncode == 1 and "camera_pose" in done.stderr and said in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["px4", "rehearse"])
def test_a_mounting_is_given_with_or_without_brackets(name):
    for pose in ("[0.1,0,0.02,0,0.1,0]", "0.1,0,0.02,0,0.1,0"):
        assert dump(name, f"camera_pose:={pose}")["params"]["/camera_mounting/pose"] == [0.1, 0, 0.02, 0, 0.1, 0]


def refusal(*launch):
    """The refusal that roslaunch prints before it starts anything."""
    done = run("roslaunch", "--nodes", *launch)
    assert done.returncode == 1 and not done.stdout, done.stdout
    return done.stderr


@pytest.mark.parametrize("file", LAUNCH_FILES, ids=lambda file: file.stem)
def test_an_argument_that_the_launch_file_does_not_have_ends_the_launch(file):
    assert f"{file.name} has no argument 'sede'" in refusal(file, *GIVEN.get(file.stem, []), "sede:=3")


@pytest.mark.parametrize("file", [("window_ingress", "px4.launch"), (ROOT / "launch/px4.launch",)], ids=["package", "path"])
def test_the_argument_that_was_meant_is_named(file):
    for wrong, said in (("cammera_pose:=[0,0,0,0,0,0]", "'cammera_pose'; did you mean 'camera_pose'?"),
                        ("refrence:=/w.png", "'refrence'; did you mean 'reference'?")):
        assert f"px4.launch has no argument {said}" in refusal(*file, *SIZE, wrong)
    said = refusal(*file, *SIZE, "glass:=excluded")
    assert "'glass'; roslaunch --ros-args window_ingress px4.launch lists them\ncheck_overlay: nothing is started." in said
    assert "cannot override arg 'modes'" in refusal(*file, *SIZE, "modes:=[GUIDED]")
    done = run("roslaunch", "--nodes", *file, *SIZE, "image_transport:=compressed")  # of mavros.launch, by pass_all_args
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("name, argument, said", [
    ("sim", "glass:=exluded", "give one of as_set, excluded, possible"), ("sim", "unverified_opening:=alow", "give one of as_set, allow, ask, deny"),
    ("sim", "auto_start:=yes", "give one of true, false"), ("sim", "real_time_factor:=fast", "give a number"),
    ("sim", "scenario:=gusty.yaml", "give its whole path, as /"), ("record", "images:=jpeg", "give one of raw, compressed, none"),
    ("record", "compression:=zip", "give one of none, lz4, bz2"), ("record", "name:=garden", "give its whole path, as /"),
    ("mavros", "modes:=OFFBORD", "give one of [OFFBOARD], [GUIDED]"), ("external", "start_at:=here", "give one of vehicle, scenario"),
    ("replay", "bag:=flight.bag", "give its whole path, as /"), ("replay", "rate:=half", "give a number"),
    ("replay", "stay:=ture", "give one of true, false"), ("px4", "fly:=flase", "give one of true, false"),
    ("rehearse", "camera:=flase", "give one of true, false"), ("view", "software:=1", "give one of true, false")])
def test_a_value_that_cannot_be_ends_the_launch_with_those_that_can(name, argument, said):
    given = [text for text in GIVEN.get(name, []) if text.split(":=")[0] != argument.split(":=")[0]]
    assert f"{name}.launch: {argument}: {said}" in refusal(ROOT / f"launch/{name}.launch", *given, argument)


@pytest.mark.parametrize("name, arguments", [("ingress", []), ("px4", SIZE), ("sim", [])])
def test_a_vehicle_that_does_not_fit_through_the_opening_ends_the_launch(tmp_path, name, arguments):
    config = tmp_path / "drone.yaml"
    config.write_text("vehicle: {half_length_m: 0.25, half_width_m: 0.7, half_height_m: 0.12}\n")
    launch = (ROOT / f"launch/{name}.launch", *arguments, f"config:={config}")
    assert "the vehicle, 1.4 x " in refusal(*launch)
    if name != "sim":
        assert run("roslaunch", "--nodes", *launch, "fly:=false").returncode == 0
    config.write_text((VEHICLE.read_text() if name == "px4" else "") +
                      "homography_pose: {pose: {opening_width_m: 0.55, opening_height_m: 0.4}}\n")
    launch = (ROOT / f"launch/{name}.launch", f"config:={config}")
    if name == "sim":  # its vehicle is smaller than the package's
        assert run("roslaunch", "--nodes", *launch).returncode == 0
    else:
        assert "does not fit through the opening, 0.55 x 0.4 m, with 0.05 m on each side" in refusal(*launch)
    config.write_text("vehicle: {half_length_m: 0.25, half_width_m: 0.7, half_height_m: 0.12}\n"
                      "homography_pose: {pose: {scale_sigma: 0.5}}\n")  # measured in flight
    assert run("roslaunch", "--nodes", *launch).returncode == 0


def test_a_file_beside_the_user_is_found_and_one_that_is_not_there_is_named_whole(tmp_path):
    (tmp_path / "drone.yaml").write_text("vehicle: {half_width_m: 0.3}\n")
    for name, code in (("drone.yaml", 0), ("dron.yaml", 1)):
        done = run("roslaunch", "--nodes", ROOT / "launch/ingress.launch", f"config:={name}", cwd=tmp_path)
        assert done.returncode == code, done.stderr
    assert f"config {tmp_path}/dron.yaml: no such file" in done.stderr


def test_each_launch_file_takes_its_arguments():
    for name in (file.stem for file in LAUNCH_FILES):
        given = {text.split(":=")[0]: text for text in GIVEN.get(name, [])}
        for arg in ElementTree.parse(ROOT / f"launch/{name}.launch").getroot().findall("arg"):
            if arg.get("default") is not None and "$(" not in arg.get("default"):
                given.setdefault(arg.get("name"), f"{arg.get('name')}:={arg.get('default')}")
        done = run("roslaunch", "--nodes", ROOT / f"launch/{name}.launch", *given.values())
        assert done.returncode == 0, done.stderr


def test_all_that_is_wrong_is_said_at_once(tmp_path):
    config = tmp_path / "drone.yaml"
    config.write_text("vehicle:\n  half_widht_m: 0.3\n  half_height_m: -1\nhomography_pose: {gravity_source: mag}\n")
    said = refusal(ROOT / "launch/px4.launch", f"config:={config}", "refrence:=none", "fly:=maybe", "camera_pose:=[1,2]")
    for fault in (f"{config}:2: vehicle/half_widht_m: unknown key; did you mean 'half_width_m'?",
                  f"{config}:3: vehicle/half_height_m = -1 is not within", f"{config}:4: homography_pose/gravity_source = mag is not one of",
                  "px4.launch has no argument 'refrence'", "px4.launch: fly:=maybe: give one of true, false",
                  "camera_pose: '1,2' is not 6 numbers"):
        assert f"check_overlay: {fault}" in said
    config.write_text("vehicle: {half_width_m: 0.7}\ningress_navigator: {navigator: {limits: {acceleration_mps2: 0.5}}}\n")
    said = refusal(ROOT / "launch/ingress.launch", f"config:={config}", "reference:=none.png", "window_size:=1")
    for fault in ("reference:=none.png: give its whole path", "window_size: '1' is not 2 numbers",
                  "must not be below vehicle/braking_mps2", "does not fit through the opening"):
        assert fault in said
    assert said.count("give its whole path") == 1, said


def test_images_by_a_transport_that_is_not_there_end_the_launch(tmp_path):
    launch = ROOT / "launch/px4.launch"
    said = refusal(launch, *SIZE, "image_transport:=compresed")
    assert "image_transport is 'compresed', available are: compressed, raw" in said and "ros-noetic-compresed-image-transport" in said
    config = tmp_path / "drone.yaml"
    config.write_text(f"{VEHICLE.read_text()}window_detector: {{image_transport: theorra}}\n")
    assert "image_transport is 'theorra', available are" in refusal(launch, SIZE[0], f"config:={config}")
    assert run("roslaunch", "--nodes", launch, *SIZE, "image_transport:=compressed").returncode == 0


@pytest.mark.parametrize("name, key, argument, standard", [
    ("px4", "vehicle: {odom_frame: there}", "odom_frame", "map"), ("sim", "vehicle: {odom_frame: there}", "odom_frame", "odom"),
    ("replay", "window_detector: {image_transport: raw}", "image_transport", "compressed")])
def test_what_others_go_by_too_is_not_said_differently_by_the_file(tmp_path, name, key, argument, standard):
    config = tmp_path / "drone.yaml"
    config.write_text(key)
    wanted = key.rpartition(" ")[2].strip("}")
    said = refusal(ROOT / f"launch/{name}.launch", *NEEDED.get(name, []), f"config:={config}")
    assert f"/{argument} is '{wanted}', but the launch argument {argument} is '{standard}': give {argument}:={wanted}, or remove it" in said
    config.write_text(key.replace(wanted, standard))
    assert dump(name, *(["window_size:=1.2,1.0"] if name == "px4" else []), f"config:={config}")


@pytest.mark.skipif(run("rospack", "find", "usb_cam").returncode == 0, reason="usb_cam is here")
@pytest.mark.parametrize("name", ["usb_cam", "rehearse"])
def test_a_driver_that_is_not_installed_ends_the_launch_before_anything_starts(name):
    done = run("roslaunch", "window_ingress", f"{name}.launch", *(["rviz:=false"] if name == "rehearse" else []))
    assert done.returncode == 1 and "started with pid" not in done.stdout
    assert "check_overlay: the package usb_cam is not installed: apt install ros-noetic-usb-cam" in done.stderr


@pytest.mark.parametrize("words", ["sim.launch rviz:=true", "view.launch"])
def test_rviz_without_a_display_ends_the_launch_before_anything_starts(words):
    done = run("env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", "roslaunch", "window_ingress", *words.split())
    assert done.returncode == 1 and "started with pid" not in done.stdout
    assert "check_overlay: rviz has no display: " in done.stderr, done.stderr


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


@pytest.mark.parametrize("name, argument", [("sim", "record"), ("external", "verdict_file"), ("demo", "bag"), ("record", "name")])
def test_a_folder_to_write_into_that_is_not_there_is_named_before_anything_starts(tmp_path, name, argument):
    done = run("roslaunch", "window_ingress", f"{name}.launch", f"{argument}:={tmp_path}/none/flight")
    assert done.returncode == 1 and "started with pid" not in done.stdout
    assert f"{name}.launch: {argument}:={tmp_path}/none/flight: no such folder: mkdir -p {tmp_path}/none" in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["sim", "demo", "external", "board", "check_frames"])
def test_a_scenario_that_cannot_be_ends_the_launch_before_anything_starts(tmp_path, name):
    scenario = tmp_path / "scenario.yaml"
    scenario.write_text("start:\n  distanse_m: 4\n  distance_m: 99\n")
    said = refusal(ROOT / f"launch/{name}.launch", f"scenario:={scenario}")
    assert f"{scenario}:2: start/distanse_m: unknown key" in said and f"{scenario}:3: start/distance_m = 99 is not within" in said


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


def test_contradictions_are_said(tmp_path):
    config = tmp_path / "drone.yaml"
    config.write_text("homography_pose: {pose: {opening_width_m: 1.6, opening_height_m: 1.4}}\n"
                      "ingress_navigator: {navigator: {limits: {speed_mps: 0.6}}}\nsetpoint_guard: {max_speed_mps: 0.5}\n")
    done = run("check_overlay", config, "--window-size", "1.2,1.4")
    assert done.returncode == 0
    assert f"window_size 1.2,1.4 overrides {config}, which says 1.6,1.4" in done.stderr
    assert "max_speed_mps 0.5 is not above ingress_navigator/navigator/limits/speed_mps 0.6" in done.stderr
    config.write_text("homography_pose: {pose: {opening_width_m: 1.6, opening_height_m: 1.4}}\n")
    said = run("check_overlay", config, "--window-size", "1.6,1.4").stderr
    assert said.count("warning: ") == 1 and "the vehicle's size is missing: assuming " in said
    config.write_text(config.read_text() + "vehicle: {half_length_m: 0.2, half_width_m: 0.2, half_height_m: 0.1}\n")
    assert run("check_overlay", config, "--window-size", "1.6,1.4").stderr == (
        "check_overlay: a vehicle of 0.4 x 0.4 x 0.2 m (length, width, height) through 1.6 x 1.4 m: 0.60 m free on each side, 0.60 m above and below\n")


@pytest.mark.parametrize("side, other", [("width", "height"), ("height", "width")])
def test_a_side_of_the_opening_that_is_not_said_is_named(tmp_path, side, other):
    (tmp_path / "drone.yaml").write_text(f"homography_pose: {{pose: {{opening_{side}_m: 1.3}}}}")
    done = run("check_overlay", tmp_path / "drone.yaml")
    assert done.returncode == 0 and f"homography_pose/pose/opening_{other}_m is missing, assuming 1" in done.stderr, done.stderr


@pytest.mark.parametrize("size, is_said", [("1.4,2.0", True), ("2.0,0.8", True), ("2.0,1.4", False), ("1.8,1.4", False)])
def test_a_size_that_is_not_that_of_the_reference_image_is_said(tmp_path, size, is_said):
    arguments = "--reference", photograph(tmp_path / "window.png"), "--reference-corners", "60,50,260,50,260,190,60,190"
    done = run("check_overlay", "--window-size", size, *arguments)
    assert done.returncode == 0
    assert ("but 1.43 times in the reference image: measure both sides" in done.stderr) == is_said
    assert done.stderr.count("warning: ") == 1 + is_said and "the vehicle's size is missing" in done.stderr


def test_a_reference_that_is_not_there_is_one_line(tmp_path):
    done = run("check_overlay", "--reference", tmp_path / "none.png")
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "no such file" in done.stderr


def test_what_is_started_again_does_not_end_the_launch():
    assert not any(node["required"] for node in dump("ingress", "fly:=false", "respawn:=true")["nodes"].values())


def test_what_is_empty_is_as_good_as_not_given():
    names = "reference", "window_size", "config", "defaults", "launch_prefix"
    assert dump("ingress", *(f"{name}:=" for name in names)) == dump("ingress")


@pytest.mark.parametrize("name", ["ingress", "px4", "sim", "replay"])
@pytest.mark.parametrize("text, meant", [
    ("navigator: {vehicle: {half_width_m: 0.45}}", "did you mean 'ingress_navigator: {navigator: ..}'?"),
    ("ingres_navigator: {rate_hz: 40}", "did you mean 'ingress_navigator'?"),
    ("ingress_navigator: {navigator: {vehicle: {half_width_m: 0.45}}}", "it is now 'vehicle: {..}'")])
def test_a_file_with_keys_that_nobody_reads_ends_the_launch_before_anything_starts(tmp_path, name, text, meant):
    config = tmp_path / "drone.yaml"
    config.write_text(text)
    done = run("roslaunch", "--nodes", ROOT / f"launch/{name}.launch", *NEEDED.get(name, []), f"config:={config}")
    assert done.returncode == 1
    assert f"{config}:1: {text.split(':')[0]}" in done.stderr and meant in done.stderr, done.stderr


@pytest.mark.parametrize("name", ["ingress", "replay", "ardupilot"])
def test_what_is_given_as_an_argument_counts_more_than_the_file(tmp_path, name):
    config, in_file, given = tmp_path / "window.yaml", photograph(tmp_path / "file.png"), photograph(tmp_path / "given.png")
    config.write_text(f"{VEHICLE.read_text()}homography_pose: {{pose: {{opening_width_m: 2.0, opening_height_m: 1.9}}}}\n"
                      f"window_detector: {{reference: {{picture: {in_file}, corners: [60, 50, 260, 50, 260, 190, 60, 190]}}}}\n")
    size, reference = "/homography_pose/pose/opening_{}_m", "/window_detector/reference/{}"
    params = dump(name, f"config:={config}", "window_size:=none")["params"]
    assert (params[size.format("width")], params[size.format("height")]) == (2.0, 1.9)
    assert params[reference.format("picture")] == in_file
    params = dump(name, f"config:={config}", "window_size:=1.3,1.1", f"reference:={given}")["params"]
    assert (params[size.format("width")], params[size.format("height")]) == (1.3, 1.1)
    assert (params[reference.format("picture")], params[reference.format("corners")]) == (given, [])


def test_in_simulation_too_the_file_counts_more_than_the_defaults_and_the_argument_more_than_the_file(tmp_path):
    config, glass = tmp_path / "asking.yaml", "/ingress_navigator/navigator/commit/glass"
    config.write_text("ingress_navigator: {navigator: {commit: {glass: possible}}}\n")
    assert dump("sim")["params"][glass] == "excluded"
    assert dump("sim", f"config:={config}")["params"][glass] == "possible"
    assert dump("sim", f"config:={config}", "glass:=excluded")["params"][glass] == "excluded"


@pytest.mark.parametrize("name, half_width, braking, response", [
    ("ingress", 0.25, 1.2, 0.3), ("px4", 0.25, 1.2, 0.3), ("ardupilot", 0.25, 0.9, 0.45), ("sim", 0.2, 1.2, 0.3)])
def test_the_vehicle_is_said_once_for_all_nodes(tmp_path, name, half_width, braking, response):
    params = dump(name)["params"]
    assert [key for key in params if "half_width_m" in key or "vehicle_width_m" in key] == ["/vehicle/half_width_m"]
    said = [params[f"/vehicle/{key}"] for key in ("half_width_m", "braking_mps2", "response_sec")]
    assert said == [half_width, braking, response]
    config = tmp_path / "drone.yaml"
    config.write_text("vehicle: {half_length_m: 0.3, half_width_m: 0.45, half_height_m: 0.1}\n")
    params = dump(name, f"config:={config}")["params"]
    assert params["/vehicle/half_width_m"] == 0.45 and params["/vehicle/braking_mps2"] == braking


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


@pytest.mark.parametrize("name", ["ingress", "replay", "px4", "ardupilot"])
def test_size_and_corners_are_given_as_to_the_tools(name, tmp_path):
    image = tmp_path / "window.png"
    cv2.imwrite(str(image), cv2.rectangle(numpy.full((120, 160, 3), 190, numpy.uint8), (40, 30), (120, 90), (20, 95, 225), 6))
    size, corners = "/homography_pose/pose/opening_{}_m", "/window_detector/reference/corners"
    params = dump(name)["params"]
    assert (params[size.format("width")], params[size.format("height")], params[corners]) == (1.2, 1.0, [])
    for brackets in ("{}", "[{}]"):
        params = dump(name, "window_size:=" + brackets.format("1.3,1.1"), f"reference:={image}",
                      "reference_corners:=" + brackets.format("40.5, 30,120,30,120,90,40,90"))["params"]
        assert (params[size.format("width")], params[size.format("height")]) == (1.3, 1.1)
        assert params[corners] == [40.5, 30, 120, 30, 120, 90, 40, 90]


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
