"""replay_bag as people use it: the tables, their report page, and messages about incomplete bags."""
import html.parser
import json
import re

import cv2
import numpy
import pytest

from repository import ROOT, rows_of, run

WRITER = ROOT / "test/ros/write_camera_bag.py"
SIZE = ("--window-size", "1.25,1.0")


def bag_of(folder, *words):
    bag = folder / "flight.bag"
    written = run("python3", WRITER, bag, *words)
    assert written.returncode == 0, written.stderr
    return bag


def replay(bag, output, *options):
    done = run("replay_bag", "--bag", bag, "--output", output, "--overwrite", *options)
    assert done.returncode == 0, done.stderr
    return done


def test_an_earlier_replay_is_replaced_only_when_asked(tmp_path):
    bag = bag_of(tmp_path, "seconds=1")
    without_size = run("replay_bag", "--bag", bag, "--output", tmp_path)
    assert without_size.returncode == 0, "a folder with other files is none"
    assert "the opening's size is missing (--window-size W,H): corners, but no poses" in without_size.stderr
    before = (tmp_path / "frames.csv").read_bytes()
    (tmp_path / "frames.csv").write_text("kept")
    refused = run("replay_bag", "--bag", bag, "--output", tmp_path)
    assert refused.returncode == 2 and f"{tmp_path} holds an earlier replay: --overwrite replaces it" in refused.stderr
    assert (tmp_path / "frames.csv").read_text() == "kept"
    replay(bag, tmp_path)
    assert (tmp_path / "frames.csv").read_bytes() == before


def test_the_frame_of_the_odometry_is_that_of_the_bag_unless_another_is_named(tmp_path):
    bag, params = bag_of(tmp_path, "seconds=1", "map"), tmp_path / "params.yaml"
    done = replay(bag, tmp_path, *SIZE)
    assert "odometry in the frame 'map', as the bag has it" in done.stderr and "refused" not in done.stderr
    assert any(row["filtered_tx"] for row in rows_of(tmp_path / "frames.csv"))
    params.write_text("vehicle: {odom_frame: odom}\n")
    assert "header.frame_id is 'map', expected 'odom'" in replay(bag, tmp_path, *SIZE, "--params", params).stderr


class Page(html.parser.HTMLParser):
    """References, open tags and text of a page."""

    VOID = {"meta", "img", "br", "circle", "path"}

    def __init__(self, file):
        super().__init__()
        self.references, self.open, self.text = [], [], ""
        self.raw = file.read_text(encoding="utf-8")
        self.feed(self.raw)
        assert self.open == [], f"never closed: {self.open}"
        self.text = re.sub(r"\s+", " ", self.text)

    def handle_starttag(self, tag, attrs):
        self.references += [value for name, value in attrs if name in ("src", "href")]
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in self.VOID:
            assert self.open and self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data + " "


def test_the_page_stands_alone_and_says_what_was_used(tmp_path):
    bag = bag_of(tmp_path, "seconds=2")
    replay(bag, tmp_path / "out", *SIZE)
    page = Page(tmp_path / "out/report.html")
    assert "http" not in page.raw and "<script" not in page.raw, "it opens from disk, without a network"
    assert len([r for r in page.references if r.endswith(".jpg")]) > 20
    assert [r for r in page.references if not (tmp_path / "out" / r).is_file()] == []
    for words in ("window found 40 of 40 (100.0 %)", "without calibration 0", "without odometry 0", "without attitude 0",
                  "jumps back in time 0", f"replay_bag --bag {bag}", "/camera/image_raw/compressed sensor_msgs/CompressedImage 40 image",
                  "/odom nav_msgs/Odometry 40 odom", "Angles", "Widths and distance", "Latency"):
        assert words in page.text, words
    assert page.raw.count("<svg") == 9 and "nan" not in page.raw.lower()


def test_the_same_bag_gives_the_same_bytes(tmp_path):
    bag = bag_of(tmp_path, "raw", "seconds=1")
    for name in ("one", "two"):
        replay(bag, tmp_path / name, *SIZE)
    for table in ("frames.csv", "details.csv", "strip.csv"):
        assert (tmp_path / "one" / table).read_bytes() == (tmp_path / "two" / table).read_bytes(), table
    assert len(rows_of(tmp_path / "one/latency.csv")) == len(rows_of(tmp_path / "one/frames.csv")) == 20


def test_raw_and_compressed_and_any_names_of_topics(tmp_path):
    found = {}
    for words in (["raw"], ["compressed"], ["raw", "image=/uav1/eye/image_raw"]):
        replay(bag_of(tmp_path, *words, "seconds=1"), tmp_path / "out", *SIZE)
        found["".join(words)] = [row["detected"] for row in rows_of(tmp_path / "out/frames.csv")]
    replay(bag_of(tmp_path, "seconds=1"), tmp_path / "out", *SIZE, "--image", "camera/image_raw", "--odom", "/odom")
    found["as relative names"] = [row["detected"] for row in rows_of(tmp_path / "out/frames.csv")]
    assert set(map(tuple, found.values())) == {("1",) * 20}


def test_the_reference_is_that_of_the_bag_unless_another_is_given(tmp_path):
    """In front of an orange window: a bag with a blue reference, then the same bag with a photograph of the orange window."""
    bag = bag_of(tmp_path, "seconds=1", "reference")
    orange = numpy.full((480, 640, 3), 190, numpy.uint8)
    cv2.rectangle(orange, (204, 134), (436, 326), (20, 95, 225), -1)
    cv2.rectangle(orange, (220, 150), (420, 310), (60, 50, 45), -1)
    cv2.imwrite(str(tmp_path / "orange.png"), orange)
    given = "--reference", tmp_path / "orange.png", "--reference-corners", "220,150,420,150,420,310,220,310"
    for options, found, said in (((), "0", True), (given, "1", False), (given[:2], None, False)):
        done = replay(bag, tmp_path / "out", *SIZE, *options)
        assert found in {None, *(row["detected"] for row in rows_of(tmp_path / "out/frames.csv"))}
        assert json.loads((tmp_path / "out/replay.json").read_text(encoding="utf-8"))["has_reference"]
        assert ("the reference image is the bag's own" in done.stderr) == said, done.stderr
        assert ("the opening in the reference image is guessed" in done.stderr) == (len(options) == 2), done.stderr


def test_without_a_size_there_is_a_page_without_poses(tmp_path):
    replay(bag_of(tmp_path, "seconds=1", "no_odom"), tmp_path / "out")
    page = Page(tmp_path / "out/report.html")
    assert "no size given" in page.text and "Angles" not in page.text and page.raw.count("<svg") == 2
    assert "without odometry 20" in page.text


def test_a_recorded_loop_is_noticed_and_starts_anew(tmp_path):
    done = replay(bag_of(tmp_path, "seconds=2", "twice"), tmp_path / "out", *SIZE)
    assert "time jumps back by 2.0 s" in done.stderr or "time jumps back by 1.9 s" in done.stderr, done.stderr
    assert json.loads((tmp_path / "out/replay.json").read_text(encoding="utf-8"))["counts"]["jumps_back_in_time"] == 1
    details = rows_of(tmp_path / "out/details.csv")
    tables = [{name: row[name] for name in row if name != "stamp"} for row in details]
    assert tables[:40] == tables[40:], "the second time is as the first"


def test_calibration_that_is_missing_is_said(tmp_path):
    done = run("replay_bag", "--bag", bag_of(tmp_path, "no_info", "seconds=1"), "--output", tmp_path / "out", *SIZE)
    assert done.returncode == 2 and "no calibration" in done.stderr and done.stderr.count("\n") == 1, done.stderr


def refused(bag, output, *options):
    done = run("replay_bag", "--bag", bag, "--output", output, "--overwrite", *SIZE, *options)
    assert done.returncode == 2, done.stderr
    return done.stderr


def test_a_camera_of_another_frame_is_refused_as_in_flight(tmp_path):
    said = refused(bag_of(tmp_path, "rear_info", "seconds=1"), tmp_path / "out")
    assert "frames differ: the image has frame_id 'camera_optical_frame', camera_info on /camera/camera_info 'rear'" in said, said


def test_images_that_are_said_to_be_rectified_need_the_calibration_for_that(tmp_path):
    bag, params = bag_of(tmp_path, "not_rectified", "seconds=1"), tmp_path / "params.yaml"
    replay(bag, tmp_path / "out", *SIZE)
    params.write_text("vehicle: {image_is_rectified: true}\n")
    assert "P is zero, but the images are said to be rectified" in refused(bag, tmp_path / "out", "--params", params)


def test_odometry_that_is_missing_is_said(tmp_path):
    assert "no odometry in the bag: poses of single images only" in replay(bag_of(tmp_path, "no_odom", "seconds=1"), tmp_path / "out", *SIZE).stderr


def test_a_page_needs_its_tables(tmp_path):
    done = run("report_replay.py", tmp_path)
    assert done.returncode != 0 and "frames.csv" in done.stderr
    assert run("report_replay.py").returncode != 0


@pytest.mark.skipif(not (ROOT / "../shared/data/kiosk.bag").is_file(), reason="the shared data are not here")
def test_the_recorded_flight_before_the_kiosk(tmp_path):
    data = ROOT / "../shared/data"
    with open(data / "kiosk_reference.csv", encoding="utf-8") as file:
        corners = ",".join(file.read().splitlines()[1].split(",")[2:])
    replay(data / "kiosk.bag", tmp_path / "out", "--window-size", "1.3,1.1", "--truth", "/ground_truth/window_in_camera",
           "--reference", data / "kiosk_reference.jpg", "--reference-corners", corners)
    page = Page(tmp_path / "out/report.html")
    assert "window found 206 of 240" in page.text and "without odometry 0" in page.text  # one of them cut by the edge
    errors = sorted(float(row["error_corner_px"]) for row in rows_of(tmp_path / "out/frames.csv") if row["error_corner_px"])
    assert errors[len(errors) // 2] < 0.5 and errors[-1] < 3.0
