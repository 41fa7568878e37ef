"""plot_flight, plot_miss, plot_gusts: numbers are right, drawings are complete, and invalid input is refused by name."""
import csv
import math
import pathlib
import re

import cv2
import numpy
import pytest

from ingress_tools import campaign_data, flight_data
from repository import rows_of, run

COLUMNS = ("time_s", "state", *flight_data.LOG_COLUMNS[1:], "reason")
BAG_WRITER = pathlib.Path(__file__).with_name("write_flight_bag.py")


def state_at(t):
    return "SEARCH" if t < 1 else "APPROACH" if t < 4 else "COMMIT" if t < 6 else "PASSED"


def rows_of_flight():
    """A flight along y = 0.1 - 0.02 * t from x = -5 at 1 m/s. It crosses the plane after 5 s at y = 0, z = 0.05."""
    for i in range(70):
        t = 0.1 * i
        row = dict.fromkeys(COLUMNS, "")
        row.update(time_s=t, state=state_at(t), x_m=-5 + t, y_m=0.1 - 0.02 * t, z_m=0.05, heading_rad=-0.2 + 0.04 * t,
                   vx_mps=1, vy_mps=0, vz_mps=0, reason=f"{t:.1f} s flown")
        if i % 3 == 0 and 1 < t < 4:
            row.update(image_s=t - 0.03, image_yaw_rad=0.2 - 0.04 * t, image_trusted=int(t > 2), image_width_m=1.2,
                       image_height_m=1.0, image_left_px=80, image_right_px=78, error_yaw_rad=0.001)
        if t >= 4:
            row["predicted_miss_m"] = 0.12
        yield row


def write(file, rows, columns=COLUMNS):
    with open(file, "w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, columns, extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)
    return file


def share_of(picture, colour):
    """Fraction of a picture that has exactly this colour."""
    rgb = [int(colour[i:i + 2], 16) for i in (1, 3, 5)]
    return float(numpy.mean(numpy.all(picture == rgb[::-1], axis=2)))


@pytest.fixture(name="log")
def fixture_log(tmp_path):
    return write(tmp_path / "flight_1.csv", rows_of_flight())


def test_a_log_is_read_as_it_was_flown(log):
    flight = flight_data.read_flight(str(log))
    assert flight.crossing() == pytest.approx((5.0, 0.0, 0.05), abs=1e-9)
    assert flight.predicted_miss == 0.12 and flight.is_truth
    assert [(name, round(begin, 1)) for name, begin, _ in flight.spans()] == [
        ("SEARCH", 0.0), ("APPROACH", 1.0), ("COMMIT", 4.0), ("PASSED", 6.0)]
    assert len(flight.images) == 10 and flight.images.trusted.sum() == 7
    assert flight.images.time[0] == pytest.approx(1.17)
    times, angle = flight.filtered
    assert angle == pytest.approx(0.201 - 0.04 * times)
    assert flight.knows(numpy.array([-0.2, 0.0, 6.9, 7.2])).tolist() == [False, True, True, False]


def test_a_log_as_fly_writes_it_is_drawn_with_its_states(tmp_path):
    scenario = tmp_path / "near.yaml"
    scenario.write_text("time_limit_sec: 20\nglass: excluded\nunverified_opening: allow\n"
                        "start: {distance_m: 2.5, off_axis_rad: 0.1}\n")
    flown = run("fly", "--scenario", scenario, "--output", tmp_path / "fly", "--log", tmp_path / "log")
    assert flown.returncode == 0, flown.stderr
    done = run("plot_flight", tmp_path / "log/flight_1.csv")
    assert done.returncode == 0, done.stderr
    row = rows_of(tmp_path / "fly/flights.csv")[0]
    flight = flight_data.read_flight(str(tmp_path / "log/flight_1.csv"))
    assert flight.predicted_miss == pytest.approx(float(row["predicted_miss_m"]), abs=1e-4)
    assert flight.crossing()[:3] == pytest.approx([float(row[n]) for n in ("time_s", "offset_y_m", "offset_z_m")], abs=2e-3)
    picture = cv2.imread(str(tmp_path / "log/flight_1.png"))
    for state in {name for name, begin, end in flight.spans() if end - begin > 0.3}:
        assert share_of(picture, flight_data.STATE_COLOURS[state]) > 2e-4, state
    absent = set(flight_data.STATE_COLOURS) - {name for name, _, _ in flight.spans()} - {"ABORTED"}  # black, as text is
    assert all(share_of(picture, flight_data.STATE_COLOURS[state]) < 1e-5 for state in absent)


def test_the_last_line_says_how_it_ended(log, tmp_path):
    done = run("plot_flight", log, "--output", tmp_path / "a.png", "--window-size", "1.2,1.0", "--title", "my flight")
    assert done.returncode == 0, done.stderr
    assert f"plot_flight: see {tmp_path / 'a.png'}" in done.stderr
    assert "crossed at 5.00 s" in done.stdout and "actual miss 5.0 cm, predicted at most 12.0 cm" in done.stdout
    assert "APPROACH 3.0 s" in done.stdout and done.stdout.endswith("; ended in PASSED: 6.9 s flown\n")
    cut = run("plot_flight", log, "--output", tmp_path / "b.png", "--from", "1", "--to", "3")
    assert "no crossing of the plane in this part; no commit in this part" in cut.stdout and "COMMIT" not in cut.stdout
    assert re.search(r"until 3\.0 s, in \w+$", cut.stdout.strip()), cut.stdout
    picture = cv2.imread(str(tmp_path / "b.png"))
    assert share_of(picture, flight_data.STATE_COLOURS["APPROACH"]) > 0.005
    assert share_of(picture, flight_data.STATE_COLOURS["PASSED"]) == 0.0


def test_a_miss_beyond_the_prediction_is_said(tmp_path):
    rows = [dict(row, predicted_miss_m=0.02 if row["predicted_miss_m"] else "") for row in rows_of_flight()]
    done = run("plot_flight", write(tmp_path / "f.csv", rows))
    assert "NOT within it" in done.stdout


def test_a_flight_that_never_saw_the_window_is_drawn_too(tmp_path):
    blank = ("image_s", "image_yaw_rad", "image_trusted", "image_width_m", "image_height_m", "image_left_px", "image_right_px",
             "error_yaw_rad", "predicted_miss_m")
    rows = [dict(row, state="SEARCH", x_m=-5, y_m=0.1, **dict.fromkeys(blank, "")) for row in rows_of_flight()]
    rows[-1].update(state="ABORTED", reason="turned 3 times; nothing found")
    done = run("plot_flight", write(tmp_path / "f.csv", rows))
    assert done.returncode == 0, done.stderr
    assert "never crossed the plane; no prediction" in done.stdout
    assert done.stdout.endswith("ended in ABORTED: turned 3 times; nothing found\n")
    assert share_of(cv2.imread(str(tmp_path / "f.png")), flight_data.STATE_COLOURS["SEARCH"]) > 0.005


def broken(name, log):
    rows = list(rows_of_flight())
    if name == "missing columns":
        write(log, rows, [c for c in COLUMNS if c not in ("heading_rad", "image_s")])
    elif name == "empty":
        log.write_text("")
    elif name == "no rows":
        write(log, [])
    elif name == "not a number":
        write(log, rows[:5] + [dict(rows[5], x_m="nan")])
    elif name == "cut off":
        write(log, rows)
        log.write_text(log.read_text()[:-60])
    elif name == "campaign":
        log.write_text("seed,outcome,time_s\n1,PASSED,8\n")
    elif name == "binary":
        log.write_bytes(bytes(range(256)))
    elif name == "missing":
        log.unlink()
    elif name == "folder":
        log.unlink()
        log.mkdir()


@pytest.mark.parametrize("name, words", [
    ("missing", ["no such file", "fly --log"]), ("folder", ["is a folder"]), ("empty", ["no column state", "fly --log"]),
    ("no rows", ["0 rows"]), ("missing columns", ["heading_rad, image_s"]), ("not a number", [":7:", "x_m"]),
    ("cut off", [":71:", "cut off"]), ("campaign", ["plot_miss"]), ("binary", ["csv"])])
def test_what_cannot_be_used_is_one_line_and_code_2(name, words, log):
    broken(name, log)
    done = run("plot_flight", log)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert str(log) in done.stderr and all(word in done.stderr for word in words), done.stderr
    assert not log.with_suffix(".png").exists()


def test_a_picture_that_cannot_be_written_is_code_1(log, tmp_path):
    (tmp_path / "a_file").write_text("")
    done = run("plot_flight", log, "--output", tmp_path / "a_file/a.png")
    assert done.returncode == 1 and "a_file" in done.stderr and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.parametrize("truth", ["truth", "no_truth"])
def test_bags_with_and_without_the_truth_tell_the_same(truth, tmp_path):
    bag = tmp_path / "flight.bag"
    written = run("python3", BAG_WRITER, bag, truth)
    assert written.returncode == 0, written.stderr
    done = run("plot_flight", bag)
    assert done.returncode == 0, done.stderr
    assert "crossed at 5.00 s, y +0.100 m, z +0.050 m" in done.stdout, done.stdout
    assert "actual miss 10.0 cm, predicted at most 12.0 cm" in done.stdout
    idle = [float(seconds) for seconds in re.findall(r"IDLE ([\d.]+) s", done.stdout)]
    assert all(seconds < 2.0 for seconds in idle), done.stdout  # messages before /clock ran have no time
    assert "APPROACH 3.0 s, COMMIT 2.0 s" in done.stdout and "ended in PASSED: as the test says" in done.stdout
    assert ("referee: PASSED: went through" in done.stdout) == (truth == "truth")
    picture = cv2.imread(str(tmp_path / "flight.png"))
    assert share_of(picture, flight_data.STATE_COLOURS["COMMIT"]) > 1e-3


@pytest.mark.parametrize("what, words", [
    ("no_state", ["IngressState", "/state"]), ("no_odom", ["Odometry", "--odom"]),
    ("no_pose", ["trusted pose", "window_pose"]), ("two_odoms", ["several topics for --odom", "/mavros/odometry/in"])])
def test_bags_without_what_is_needed_are_refused_by_name(what, words, tmp_path):
    bag = tmp_path / "flight.bag"
    assert run("python3", BAG_WRITER, bag, what).returncode == 0
    done = run("plot_flight", bag)
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr


def test_topics_of_a_bag_can_be_named(tmp_path):
    bag = tmp_path / "flight.bag"
    assert run("python3", BAG_WRITER, bag, "two_odoms").returncode == 0
    assert run("plot_flight", bag, "--odom", "/mavros/local_position/odom").returncode == 0
    other = run("plot_flight", bag, "--odom", "/nowhere")
    assert other.returncode == 2 and "no topic /nowhere" in other.stderr
    wrong = run("plot_flight", bag, "--odom", "/window_pose")
    assert wrong.returncode == 2 and "not nav_msgs/Odometry" in wrong.stderr


def test_a_bag_that_is_none_is_refused(tmp_path):
    bag = tmp_path / "flight.bag"
    bag.write_text("no bag at all")
    done = run("plot_flight", bag)
    assert done.returncode == 2 and str(bag) in done.stderr and done.stderr.count("\n") == 1


def flights(folder, rows):
    folder.mkdir(parents=True)
    columns = ("seed", "outcome", "offset_y_m", "offset_z_m", "predicted_miss_m", "reason")
    write(folder / "flights.csv", [dict(zip(columns, row)) for row in rows], columns)
    return folder


def test_miss_counts_within_and_the_median_ratio(tmp_path):
    place = flights(tmp_path / "a", [(1, "PASSED", 0.02, -0.01, 0.10, "a, b"), (2, "PASSED", -0.01, 0.05, 0.10, ""),
                                     (3, "PASSED", 0.03, 0.20, 0.10, ""), (4, "ABORTED", "", "", "", "why"),
                                     (5, "COLLISION", "", "", 0.1, "")])
    done = run("plot_miss", place, "--output", tmp_path / "miss.png")
    assert done.returncode == 0, done.stderr
    low, high = campaign_data.wilson95(2, 3)
    assert f"2 of 3 = 66.7 % (95 %: {100 * low:.1f} to {100 * high:.1f} %)" in done.stdout
    assert "median predicted / actual: 2.0" in done.stdout and "2 of 5" in done.stdout
    assert cv2.imread(str(tmp_path / "miss.png")).shape[1] > 800


def test_wilson_is_the_one_of_the_tools():
    assert campaign_data.wilson95(10, 10) == pytest.approx((0.7225, 1.0), abs=1e-4)
    assert campaign_data.wilson95(0, 0) == (0.0, 1.0)
    assert all(math.isfinite(v) for v in campaign_data.wilson95(0, 1))


def test_gusts_table_has_a_row_a_speed_and_series(tmp_path):
    calm = flights(tmp_path / "calm", [(i, "PASSED", 0.03, 0.04, 0.1, "") for i in range(10)])
    windy = flights(tmp_path / "windy", [(i, "PASSED" if i else "COLLISION", 0.06, 0.08, 0.1, "") for i in range(10)])
    done = run("plot_gusts", "--output", tmp_path / "g.png", "--series", "on", f"3={windy}", f"0={calm}", "--series", "off",
               f"3={windy / 'flights.csv'}")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[2:] == ["| 0 | on | 10 | 100.0 % | 72.2 to 100.0 % | 0 | 5.0 |",
                                            "| 3 | on | 10 | 90.0 % | 59.6 to 98.2 % | 1 | 10.0 |",
                                            "| 3 | off | 10 | 90.0 % | 59.6 to 98.2 % | 1 | 10.0 |"]
    assert share_of(cv2.imread(str(tmp_path / "g.png")), "#e67e22") > 1e-5


@pytest.mark.parametrize("tool, arguments, code, words", [
    ("plot_miss", ["NOWHERE"], 2, ["NOWHERE", "fly --output"]),
    ("plot_miss", ["EMPTY"], 2, ["no flights"]),
    ("plot_miss", ["OTHER"], 2, ["predicted_miss_m"]),
    ("plot_miss", ["ABORTED"], 1, ["none of 1 flights"]),
    ("plot_miss", ["TORN"], 2, [":2:", "no number"]),
    ("plot_gusts", ["--series", "on"], 2, ["SPEED=PLACE"]),
    ("plot_gusts", ["--series", "on", "fast=ABORTED"], 2, ["fast=", "SPEED=PLACE"]),
    ("plot_gusts", ["--series", "on", "-1=ABORTED"], 2, ["-1="]),
    ("plot_gusts", ["--series", "on", "3=NOWHERE"], 2, ["NOWHERE"])])
def test_tables_that_cannot_be_used_are_named(tool, arguments, code, words, tmp_path):
    flights(tmp_path / "EMPTY", [])
    flights(tmp_path / "ABORTED", [(1, "ABORTED", "", "", "", "")])
    flights(tmp_path / "TORN", [(1, "PASSED", "0.0x", "0", "0.1", "")])
    write(tmp_path / "OTHER", [{"seed": 1}], ["seed"])
    done = run(tool, *arguments, "--output", "out.png", cwd=tmp_path)
    assert done.returncode == code and done.stderr.count("\n") == 1, done.stderr
    assert all(word in done.stderr for word in words), done.stderr
    assert not (tmp_path / "out.png").exists()
