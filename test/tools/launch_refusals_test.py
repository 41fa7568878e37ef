"""Launch files refuse wrong arguments and files by name before anything starts."""
import pathlib

import pytest

from launch_support import GIVEN, LAUNCH_FILES, NEEDED, SIZE, VEHICLE, dump, refusal
from repository import ROOT, run


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


@pytest.mark.parametrize("text", ["", "windows: {}\nstart: {distance_m: 3}\nwind: {}\n", "vehicle: {mass_kg: 1.0}\n"])
def test_a_scenario_in_place_of_a_parameter_file_is_one_line(tmp_path, text):
    scenario = tmp_path / "mine.yaml"
    scenario.write_text(text or (ROOT / "config/scenarios/brick.yaml").read_text())
    done = run("check_overlay", scenario)
    assert done.returncode == 2 and done.stderr == (f"check_overlay: {scenario}: is a scenario, no parameter file: launch files take it as "
                                                    "scenario:=, tools, check-config too, as --scenario\n")
    assert run("check_overlay", "--scenario", scenario).returncode == (2 if "windows" in text else 0)


@pytest.mark.parametrize("pose, said", [("[0.1,0,0.02,0,15,0]", "not degrees"), ("[0.1,0]", "is not 6 numbers"),
                                        ("0.1,0.5,0.02,0,0,0", "lies outside of the vehicle"), ("0.1,0,0.02,0,2,0", "does not look forward")])
def test_a_mounting_that_cannot_be_ends_the_launch_before_anything_starts(pose, said):
    done = run("roslaunch", "--nodes", ROOT / "launch/px4.launch", *SIZE, f"camera_pose:={pose}")
    assert done.returncode == 1 and "camera_pose" in done.stderr and said in done.stderr, done.stderr


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
    ("sim", "scenario:=my.yaml", "give its whole path, as /"), ("sim", "scenario:=gusty", f"give its whole path, as {ROOT}/config/scenarios/gusty.yaml"),
    ("record", "images:=jpeg", "give one of raw, compressed, none"),
    ("record", "compression:=zip", "give one of none, lz4, bz2"), ("record", "name:=garden", "give its whole path, as /"),
    ("mavros", "modes:=OFFBORD", "give one of [OFFBOARD], [GUIDED]"), ("external", "start_at:=here", "give one of vehicle, scenario"),
    ("replay", "bag:=flight.bag", "give its whole path, as /"), ("replay", "rate:=half", "give a number"),
    ("replay", "stay:=ture", "give one of true, false"), ("px4", "fly:=flase", "give one of true, false"),
    ("rehearse", "camera:=flase", "give one of true, false"), ("rehearse", "video:=README.md", "give its whole path, as /"),
    ("view", "software:=1", "give one of true, false")])
def test_a_value_that_cannot_be_ends_the_launch_with_those_that_can(name, argument, said):
    given = [text for text in GIVEN.get(name, []) if text.split(":=")[0] != argument.split(":=")[0]]
    assert f"{name}.launch: {argument}: {said}" in refusal(ROOT / f"launch/{name}.launch", *given, argument)


def test_a_file_beside_the_user_is_found_and_one_that_is_not_there_is_named_whole(tmp_path):
    (tmp_path / "drone.yaml").write_text("vehicle: {half_width_m: 0.3}\n")
    for name, code in (("drone.yaml", 0), ("dron.yaml", 1)):
        done = run("roslaunch", "--nodes", ROOT / "launch/ingress.launch", f"config:={name}", cwd=tmp_path)
        assert done.returncode == code, done.stderr
    assert f"config {tmp_path}/dron.yaml: no such file" in done.stderr


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
                  "braking_mps2 must not exceed limits/acceleration_mps2", "does not fit through the opening"):
        assert fault in said
    assert said.count("give its whole path") == 1, said


def test_images_by_a_transport_that_is_not_there_end_the_launch(tmp_path):
    launch = ROOT / "launch/px4.launch"
    said = refusal(launch, *SIZE, "image_transport:=compresed")
    assert "image_transport is 'compresed', available are: compressed, " in said and ", raw" in said and said.count(" compressed,") == 1
    assert "ros-noetic-compresed-image-transport" in said
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


def test_a_vehicle_that_is_simulated_elsewhere_is_not_flown_by_the_simulation():
    said = refusal(ROOT / "launch/sim.launch", f"scenario:={ROOT}/config/scenarios/external.yaml")
    assert "external.yaml: vehicle: external is simulated elsewhere: start external.launch" in said


def test_a_guard_that_forbids_the_search_to_turn_is_told(tmp_path):
    (tmp_path / "drone.yaml").write_text("setpoint_guard: {max_yaw_rate_radps: 0.3}")
    assert "max_yaw_rate_radps 0.3 is not above ingress_navigator/navigator/limits/yaw_rate_radps 0.5" in run(
        "check_overlay", tmp_path / "drone.yaml").stderr


def test_a_reference_that_is_not_there_is_one_line(tmp_path):
    done = run("check_overlay", "--reference", tmp_path / "none.png")
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and "no such file" in done.stderr


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
