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

from repository import NOMINAL, ROOT, assert_refused, run

TOOLS = ["detect_images", "draw_stages", "fly", "replay_bag", "survey_detector", "survey_tracker"]


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
    scenario.write_text("time_limit_sec: 1\nglass: excluded\ncamera: {width_px: 64, height_px: 48}\n")
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
