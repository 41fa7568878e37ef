"""What the tools answer to bad input: one clear line on stderr and the exit code of interfaces: 2 for wrong usage or
unreadable input, 1 for a job that failed."""
import pathlib
import re
import shutil
import subprocess
import time

import cv2
import numpy
import pytest
import rosbag

from repository import NOMINAL, ROOT, run

TOOLS = ["detect_images", "draw_stages", "fly", "replay_bag", "survey_detector", "survey_tracker"]


def assert_refused(result, code, *words):
    """Checks the exit code, and that one line says what is wrong and where."""
    lines = [line for line in result.stderr.splitlines() if line.strip()]
    assert result.returncode == code, result.stderr
    assert len(lines) == 1, result.stderr
    for word in words:
        assert str(word) in lines[0], result.stderr


@pytest.fixture
def image(tmp_path):
    file = tmp_path / "plain.png"
    cv2.imwrite(str(file), numpy.full((120, 160, 3), 128, numpy.uint8))
    return file


@pytest.mark.parametrize("tool", TOOLS)
def test_help_explains_and_succeeds(tool):
    result = run(tool, "--help")
    assert result.returncode == 0
    assert "--output" in result.stdout


def test_a_shard_without_flights_is_done_at_once(tmp_path):
    result = run("fly", "--scenario", NOMINAL, "--seeds", "1..1", "--shard", "2/2", "--output", tmp_path)
    assert result.returncode == 0, result.stderr
    assert len((tmp_path / "flights.csv").read_text().splitlines()) == 1
    assert '"flights": 0' in (tmp_path / "summary.json").read_text()


def test_a_full_disk_ends_the_flights_with_one_line(tmp_path):
    (tmp_path / "flights.csv").symlink_to("/dev/full")
    scenario = tmp_path / "short.yaml"
    scenario.write_text("time_limit_sec: 1\ncamera: {width_px: 64, height_px: 48}\n")
    assert_refused(run("fly", "--scenario", scenario, "--seeds", "1..3", "--output", tmp_path, "--overwrite"), 1, "is the disk full?")


def test_a_log_that_cannot_be_written_is_a_failed_job(tmp_path):
    (tmp_path / "flight_1.csv").symlink_to("/dev/full")
    done = run("fly", "--scenario", NOMINAL, "--no-pictures", "--output", tmp_path / "out", "--log", tmp_path)
    assert done.returncode == 1
    assert f"{tmp_path}/flight_1.csv: cannot be written; is the disk full?" in done.stderr


@pytest.mark.parametrize("tool, words, table", [
    ("detect_images", ["--output", "OUT/found.csv", *["IMAGE"] * 2000], "found.csv"),
    ("survey_detector", ["--output", "OUT", "--scenario", NOMINAL, "--frames", "2000"], "frames.csv"),
    ("survey_openness", ["--output", "OUT", "--synthetic", "2000"], "openness.csv")])
def test_a_tool_that_is_broken_off_leaves_whole_rows(tmp_path, image, tool, words, table):
    words, table = [str(word).replace("OUT", str(tmp_path)).replace("IMAGE", str(image)) for word in words], tmp_path / table
    with subprocess.Popen([ROOT / "scripts/run", tool, *words], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        while process.poll() is None and not (table.is_file() and table.stat().st_size):
            time.sleep(0.02)
        assert process.poll() is None, "was done before it could be broken off"
        process.kill()
    header, *rows = table.read_text().splitlines(keepends=True)
    assert rows and {row.count(",") for row in rows} == {header.count(",")} and rows[-1].endswith("\n")


@pytest.mark.parametrize("tool", TOOLS)
def test_unknown_option_is_wrong_usage(tool):
    assert_refused(run(tool, "--no-such-option"), 2, "no-such-option")


def test_an_option_mistyped_is_answered_with_the_nearest():
    assert_refused(run("fly", "--seed", "1..3"), 2, "unrecognised option '--seed'; did you mean '--seeds'?")


def test_a_value_without_its_option_is_wrong_usage():
    assert_refused(run("fly", NOMINAL), 2, "give it after its option")


def test_missing_image_is_named(tmp_path):
    missing = tmp_path / "missing.png"
    assert_refused(run("detect_images", "--output", tmp_path / "out.csv", missing), 2, missing)


@pytest.mark.parametrize("ending, share", [("png", 0.2), ("jpg", 0.8)])
def test_unreadable_image_is_named_and_the_others_are_done(tmp_path, image, ending, share):
    broken = tmp_path / f"broken.{ending}"
    whole = cv2.imencode(f".{ending}", cv2.imread(str(image)))[1].tobytes()
    broken.write_bytes(whole[:int(share * len(whole))])
    output = tmp_path / "out.csv"
    result = run("detect_images", "--output", output, broken, image)
    assert result.returncode == 1 and "Premature" not in result.stderr
    assert sum(str(broken) in line for line in result.stderr.splitlines()) == 1
    rows = output.read_text().splitlines()
    assert len(rows) == 3
    assert rows[2].startswith(str(image)) or rows[2].startswith(image.name)


def test_output_that_cannot_be_written_to_is_a_failed_job(image):
    if not pathlib.Path("/dev/full").exists():
        pytest.skip("no /dev/full here")
    assert_refused(run("detect_images", "--output", "/dev/full", image), 1, "/dev/full")


@pytest.mark.parametrize("words", [
    ("detect_images", "FILE", "--output", "FILE"), ("draw_stages", "FILE", "--output", "FILE"), ("make_reference", "FILE", "--output", "FILE"),
    ("tune_detector", "FILE", "--headless", "--output", "FILE"), ("learn_vehicle", "FILE", "--output", "FILE"),
    ("detect_images", "--output", "FILE", "nowhere.jpg")])  # the csv's name forgotten
def test_what_is_read_is_not_overwritten(words, image):
    before = image.read_bytes()
    assert_refused(run(*(str(image) if word == "FILE" else word for word in words)), 2, f"--output {image}")
    assert image.read_bytes() == before


@pytest.mark.parametrize("tool, words, code", [
    ("search_envelope", ["--flights", "10", "--output", "FILE"], 1), ("gust_table", ["--output", "FILE"], 1),
    ("plot_filter", ["--runs", "12", "--output", "FILE/x.png"], 1), ("plot_filter", ["--runs", "0", "--output", "x.png"], 2),
    ("plot_openness", ["nowhere.csv", "x.png"], 1), ("plot_openness", ["FILE", "x.png"], 2),
    ("draw_stages", ["FILE", "--output", "sheet.xyz"], 2)])
def test_what_cannot_be_read_or_written_is_a_line_no_traceback(tool, words, code, image):
    text = image.with_suffix(".csv")
    text.write_text("a,b\n1,2\n")
    done = run(tool, *(word.replace("FILE", str(image if tool == "draw_stages" else text)) for word in words))
    assert done.returncode == code and "Traceback" not in done.stderr and "OpenCV(" not in done.stderr, done.stderr
    assert re.match(rf"{tool}: \S", done.stderr.splitlines()[-1]), done.stderr


def test_folder_of_the_output_is_made(tmp_path, image):
    output = tmp_path / "new" / "out.csv"
    assert run("detect_images", "--output", output, image).returncode == 0
    assert len(output.read_text().splitlines()) == 2
    sheet = tmp_path / "newer" / "sheet.jpg"
    assert run("draw_stages", "--output", sheet, image).returncode == 0 and sheet.is_file()


def test_camera_without_calibration_is_refused(tmp_path, image):
    camera = tmp_path / "camera.yaml"
    zeros = "[" + ", ".join(["0"] * 9) + "]"
    camera.write_text(
        "image_width: 160\nimage_height: 120\ncamera_name: test\n"
        f"camera_matrix: {{rows: 3, cols: 3, data: {zeros}}}\n"
        "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n"
        f"rectification_matrix: {{rows: 3, cols: 3, data: {zeros}}}\n"
        "projection_matrix: {rows: 3, cols: 4, data: [" + ", ".join(["0"] * 12) + "]}\n")
    result = run("detect_images", "--output", tmp_path / "out.csv", "--camera", camera, "--window-size", "1,1", image)
    assert_refused(result, 2, camera, "uncalibrated")


def test_missing_camera_file_is_named(tmp_path, image):
    camera = tmp_path / "camera.yaml"
    result = run("detect_images", "--output", tmp_path / "out.csv", "--camera", camera, "--window-size", "1,1", image)
    assert_refused(result, 2, camera)


def test_size_without_camera_is_refused_as_it_brings_no_pose(tmp_path, image):
    result = run("detect_images", "--output", tmp_path / "out.csv", "--window-size", "1,1", image)
    assert_refused(result, 2, "--window-size needs --camera")


def test_grey_image_beside_a_coloured_reference_is_said_to_be_found_by_geometry_alone(tmp_path):
    picture = numpy.full((240, 320, 3), 160, numpy.uint8)
    cv2.rectangle(picture, (80, 60), (240, 180), (0, 120, 240), 12)
    cv2.rectangle(picture, (86, 66), (234, 174), (30, 30, 30), -1)
    coloured, grey = tmp_path / "coloured.png", tmp_path / "grey.png"
    cv2.imwrite(str(coloured), picture)
    cv2.imwrite(str(grey), cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY))
    arguments = ("--output", tmp_path / "out.csv", "--reference", coloured,
                 "--reference-corners", "86,66,234,66,234,174,86,174")
    assert "geometry alone" not in run("detect_images", *arguments, coloured).stderr
    assert "warning: 1 found by geometry alone" in run("detect_images", *arguments, grey).stderr


def test_bad_parameter_file_is_named_with_line_and_key(tmp_path, image):
    params = tmp_path / "params.yaml"
    params.write_text("window_detector:\n  detector: {no_such_key: 1}\n")
    result = run("detect_images", "--output", tmp_path / "out.csv", "--params", params, image)
    assert_refused(result, 2, f"{params}:2", "window_detector/detector/no_such_key")


def test_typo_in_scenario_is_named_with_line_and_key(tmp_path):
    scenario = tmp_path / "typo.yaml"
    text = NOMINAL.read_text()
    scenario.write_text(text + "\nwindwo: 1\n")
    line = len(text.splitlines()) + 2
    result = run("fly", "--scenario", scenario, "--output", tmp_path / "out")
    assert_refused(result, 2, f"{scenario}:{line}", "windwo")


def test_missing_scenario_is_named(tmp_path):
    scenario = tmp_path / "nowhere.yaml"
    assert_refused(run("fly", "--scenario", scenario, "--output", tmp_path / "out"), 2, scenario)


def test_seeds_that_are_no_range_are_wrong_usage(tmp_path):
    assert_refused(run("fly", "--scenario", NOMINAL, "--seeds", "3..x", "--output", tmp_path / "out"), 2, "3..x")


def test_missing_bag_is_named(tmp_path):
    bag = tmp_path / "missing.bag"
    assert_refused(run("replay_bag", "--bag", bag, "--output", tmp_path / "out"), 2, bag)


@pytest.mark.parametrize("content", [b"", b"this is no bag at all\n" * 100])
def test_file_that_is_no_bag_is_named(tmp_path, content):
    bag = tmp_path / "garbage.bag"
    bag.write_bytes(content)
    assert_refused(run("replay_bag", "--bag", bag, "--output", tmp_path / "out"), 2, bag)


def test_a_folder_is_no_bag(tmp_path):
    assert_refused(run("replay_bag", "--bag", tmp_path, "--output", tmp_path / "out"), 2, f"{tmp_path}: is a folder; name one bag in it")


def test_truncated_bag_is_named(tmp_path):
    from std_msgs.msg import String

    whole = tmp_path / "whole.bag"
    with rosbag.Bag(str(whole), "w") as bag:
        for i in range(200):
            bag.write("/text", String("x" * 100))
    cut = tmp_path / "cut.bag"
    cut.write_bytes(whole.read_bytes()[: whole.stat().st_size // 2])
    assert_refused(run("replay_bag", "--bag", cut, "--output", tmp_path / "out"), 2, cut)


def test_bag_without_images_says_what_is_missing(tmp_path):
    from std_msgs.msg import String

    file = tmp_path / "text.bag"
    with rosbag.Bag(str(file), "w") as bag:
        bag.write("/text", String("hello"))
    assert_refused(run("replay_bag", "--bag", file, "--output", tmp_path / "out"), 2, file, "image")


def test_unknown_tool_is_named():
    assert_refused(run("no_such_tool"), 2, "no_such_tool")


def test_run_works_from_any_folder(tmp_path):
    result = run("fly", "--help", cwd=tmp_path)
    assert result.returncode == 0 and "--scenario" in result.stdout


@pytest.mark.parametrize("distance", ["-4", "nan"])
def test_stages_refuse_a_distance_that_is_none(tmp_path, distance):
    result = run("draw_stages", "--scenario", NOMINAL, "--distance", distance, "--output", tmp_path / "sheet.jpg")
    assert_refused(result, 2, "--distance")


def test_stages_refuse_an_angle_without_a_distance(tmp_path):
    result = run("draw_stages", "--scenario", NOMINAL, "--off-axis", "0.3", "--output", tmp_path / "sheet.jpg")
    assert_refused(result, 2, "--off-axis", "--distance")


def test_what_is_not_there_is_said_with_what_builds_it():
    assert_refused(run("no_such_tool"), 2, "no tool, node or command 'no_such_tool'", "scripts/build")


def reference_of(tmp_path, image, text):
    file = tmp_path / "window.yaml"
    file.write_text(text.format(image))
    return run("detect_images", "--output", tmp_path / "found.csv", "--params", file, image)


def test_a_reference_without_corners_is_said_to_be_guessed(tmp_path, image):
    cv2.imwrite(str(tmp_path / "window.png"), cv2.rectangle(numpy.full((120, 160, 3), 190, numpy.uint8), (40, 30), (120, 90), (20, 95, 225), 6))
    for options, code in ((["check_overlay"], 0), (["detect_images", "--output", tmp_path / "out.csv", image], 0)):
        said = run(*options, "--reference", tmp_path / "window.png")
        assert said.returncode == code and "warning: the opening in the reference image is guessed" in said.stderr, said.stderr


def test_overlays_are_not_drawn_among_the_photographs(tmp_path, image):
    done = run("detect_images", "--output", tmp_path / "found.csv", "--overlay", image.parent, image.parent)
    assert_refused(done, 2, "--overlay", "the input images are there")
    assert not (tmp_path / "plain.png.png").exists()


def test_one_overlay_does_not_replace_another(tmp_path, image):
    twin = tmp_path / "other" / image.name
    twin.parent.mkdir()
    shutil.copy(image, twin)
    command = "detect_images", "--output", tmp_path / "found.csv", "--overlay", tmp_path / "overlays"
    assert_refused(run(*command, image, twin), 2, str(image), str(twin), "run each folder by itself")
    assert run(*command, image, image.parent).returncode == 0, "one photograph, named twice"


def test_a_table_replaces_nothing_but_a_table(tmp_path, image):
    drone = tmp_path / "drone.yaml"
    drone.write_text("vehicle: {half_width_m: 0.3}\n")
    for option in ("--output", "--candidates"):
        tables = {"--output": tmp_path / "found.csv", option: drone}
        done = run("detect_images", *[word for pair in tables.items() for word in pair], image)
        assert_refused(done, 2, option, "end its name with .csv")
    assert drone.read_text().startswith("vehicle")
    table = tmp_path / "found.csv"
    assert_refused(run("detect_images", "--output", table, "--candidates", table, image), 2, "is also --output")


def test_a_good_parameter_file_is_named_on_a_line(tmp_path):
    (tmp_path / "drone.yaml").write_text("vehicle: {half_width_m: 0.3}\n")
    assert run("check_overlay", tmp_path / "drone.yaml").stdout == f"{tmp_path}/drone.yaml\n"


def test_a_reference_file_is_taken_as_params(tmp_path, image):
    whole = "window_detector: {{reference: {{picture: '{}', corners: [40.5, 30, 120, 30, 120, 90, 40, 90]}}}}"
    done = reference_of(tmp_path, image, whole)
    assert done.returncode == 0 and "a window in 0 of 1 images" in done.stdout, done.stderr
    assert_refused(reference_of(tmp_path, image, "window_detector: {{reference: {{picture: '{}', corners: [1, 2]}}}}"), 2, "eight numbers")
    nowhere = "window_detector: {{reference: {{picture: '{}.none'}}}}"
    assert_refused(reference_of(tmp_path, image, nowhere), 2, "no such file")


OVERLAY_TOOLS = {
    "detect_images": ("--output", "OUT/found.csv", "IMAGE"), "draw_stages": ("--scenario", NOMINAL, "--output", "OUT/sheet.jpg"),
    "fly": ("--scenario", NOMINAL, "--output", "OUT"), "make_reference": ("IMAGE", "--output", "OUT/reference.png", "--corners", "1,1,9,1,9,9,1,9"),
    "survey_detector": ("--scenario", NOMINAL, "--frames", "1", "--output", "OUT"), "survey_filter": ("--runs", "2", "--output", "OUT"),
    "survey_openness": ("--synthetic", "1", "--output", "OUT"), "survey_tracker": ("--scenario", NOMINAL, "--output", "OUT"),
    "tune_detector": ("IMAGE", "--headless"), "check_overlay": ()}


@pytest.mark.parametrize("tool", OVERLAY_TOOLS)
@pytest.mark.parametrize("text, meant", [
    ("navigator: {vehicle: {half_width_m: 0.45}}", "did you mean 'ingress_navigator: {navigator: ..}'?"),
    ("detector: {min_score: 0.5}", "did you mean 'window_detector: {detector: ..}'?"),
    ("ingress_navigater: {rate_hz: 40}", "did you mean 'ingress_navigator'?"),
    ("ingress_navigator: {navigator: {vehicle: {half_width_m: 0.45}}}", "it is now 'vehicle: {..}'")])
def test_an_overlay_with_keys_that_nobody_reads_is_refused_by_every_tool(tmp_path, image, tool, text, meant):
    file = tmp_path / "overlay.yaml"
    file.write_text(text)
    words = [str(word).replace("OUT", str(tmp_path / "out")).replace("IMAGE", str(image)) for word in OVERLAY_TOOLS[tool]]
    options = [file] if tool == "check_overlay" else ["--params", file]
    assert_refused(run(tool, *words, *options), 2, f"{file}:1: {text.split(':')[0]}", meant)


def test_what_the_operator_says_of_vehicle_and_opening_counts_more_than_the_scenario(tmp_path):
    """Nothing passes with a vehicle as wide as the opening; the scenario's vehicle passes."""
    file = tmp_path / "wide.yaml"
    file.write_text("vehicle: {half_width_m: 0.6}\n")
    result = run("fly", "--scenario", NOMINAL, "--no-pictures", "--params", file, "--output", tmp_path / "out")
    assert result.returncode == 0, result.stderr
    assert "too small for the vehicle" in (tmp_path / "out" / "flights.csv").read_text()
