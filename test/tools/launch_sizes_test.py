"""Launch files fly by the sizes of opening and vehicle that the user gives, and say which these are."""
import json

import cv2
import numpy
import pytest

from launch_support import NEEDED, SIZE, VEHICLE, dump, photograph, refusal
from repository import ROOT, run


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


@pytest.mark.parametrize("width, free", [(1.3, "0.05 m free on each side, 0.43 m above and below"), (1.1, "it does not fit")])
def test_a_size_that_the_scenario_gives_is_not_assumed(tmp_path, width, free):
    (tmp_path / "wide.yaml").write_text(f"vehicle: {{half_width_m: 0.6}}\nwindow: {{width_m: {width}}}\n")
    assert run("check_overlay", "--scenario", tmp_path / "wide.yaml").stderr == (
        f"check_overlay: a vehicle of 0.4 x 1.2 x 0.14 m (length, width, height) through {width} x 1 m: {free}\n")


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
    assert "measure it and give window_size" not in run("check_overlay", config, "--needs-window-size", "true", "--window-size", "abc").stderr


@pytest.mark.parametrize("vehicle", [{}, {"half_width_m": 0.3, "half_height_m": 0.1}])
def test_a_drone_does_not_fly_by_the_size_of_somebody_elses_vehicle(tmp_path, vehicle):
    (tmp_path / "drone.yaml").write_text(json.dumps({"vehicle": vehicle}))
    launch = (ROOT / "launch/px4.launch", "window_size:=1.2,1.0", f"config:={tmp_path}/drone.yaml")
    done = run("roslaunch", "--nodes", *launch)
    width = 2 * vehicle.get("half_width_m", 0.25)
    assert done.returncode == 0 and f" is missing: assuming 0.5 x {width:g} x " in done.stderr
    done = run("roslaunch", "--nodes", *launch, "fly:=false")
    assert done.returncode == 0 and "warning: no reference image" in done.stderr


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
