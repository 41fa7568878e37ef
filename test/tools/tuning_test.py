"""Tuning tools and the reference tool: on generated images without a display, and with one if Xvfb is installed."""
import csv
import os
import re
import shutil
import subprocess
import time

import cv2
import numpy
import pytest
import yaml

from repository import ROOT, run

WIDTH, HEIGHT, FOCAL = 320, 240, 250.0
OPENING = (1.2, 1.0)  # m
BLIND = "window_detector: {detector: {gates: {min_area: 0.5}}}\n"  # larger than any window


def answer(*command, **environment):
    done = run(*command, env={**os.environ, **environment})
    return done.returncode, done.stdout, done.stderr


def corners_at(x, z):
    """Corners of a window that faces the camera, `x` to its right, `z` ahead [m]; pixels, clockwise from top left."""
    half_w, half_h = FOCAL * OPENING[0] / 2 / z, FOCAL * OPENING[1] / 2 / z
    cx, cy = (WIDTH - 1) / 2 + FOCAL * x / z, (HEIGHT - 1) / 2
    return [(cx - half_w, cy - half_h), (cx + half_w, cy - half_h), (cx + half_w, cy + half_h), (cx - half_w, cy + half_h)]


def window_image(corners, seed=1):
    image = numpy.full((HEIGHT, WIDTH, 3), 190, numpy.uint8)
    if corners:
        (left, top), _, (right, bottom), _ = [(round(x), round(y)) for x, y in corners]
        image[top - 9:bottom + 10, left - 9:right + 10] = (20, 95, 225)
        image[top:bottom + 1, left:right + 1] = (60, 50, 45)
    noise = numpy.random.default_rng(seed).normal(0.0, 2.0, image.shape)
    return numpy.clip(image + noise, 0, 255).astype(numpy.uint8)


VIEWS = [(0.3 * (i % 5 - 2), 2.6 + 0.2 * (i % 3)) for i in range(12)]
NAMES = "abcdefghijkl"


@pytest.fixture(scope="module")
def labelled(tmp_path_factory):
    """A folder with twelve images of a window, two of a wall, and labels.csv."""
    folder = tmp_path_factory.mktemp("labelled")
    with open(folder / "labels.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["file", "label", *(axis + str(i) for i in range(1, 5) for axis in "xy")])
        for name, view in zip(NAMES, VIEWS):
            cv2.imwrite(str(folder / f"{name}.png"), window_image(corners_at(*view), ord(name)))
            table.writerow([f"{name}.png", "window", *(f"{value:.2f}" for corner in corners_at(*view) for value in corner)])
        for name in ("wall_x", "wall_y"):
            cv2.imwrite(str(folder / f"{name}.png"), window_image(None, ord(name[-1])))
            table.writerow([f"{name}.png", "none", *[""] * 8])
    return folder


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    """The same views as a flight with calibration and truth, one image a second."""
    file = tmp_path_factory.mktemp("bag") / "views.bag"
    numpy.savez(file.with_suffix(".npz"), pictures=[window_image(corners_at(*view), i) for i, view in enumerate(VIEWS)], views=VIEWS)
    script = f"""
import numpy, rosbag, rospy
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import CameraInfo, Image
data = numpy.load({str(file.with_suffix(".npz"))!r})
with rosbag.Bag({str(file)!r}, "w") as bag:
    for i, (image, (x, z)) in enumerate(zip(data["pictures"], data["views"])):
        stamp = rospy.Time(100 + i)
        message = Image(height={HEIGHT}, width={WIDTH}, step={3 * WIDTH}, encoding="bgr8", data=image.tobytes())
        info = CameraInfo(height={HEIGHT}, width={WIDTH}, distortion_model="plumb_bob", D=[0.0] * 5)
        info.K = [{FOCAL}, 0, {(WIDTH - 1) / 2}, 0, {FOCAL}, {(HEIGHT - 1) / 2}, 0, 0, 1]
        info.P = [{FOCAL}, 0, {(WIDTH - 1) / 2}, 0, 0, {FOCAL}, {(HEIGHT - 1) / 2}, 0, 0, 0, 1, 0]
        info.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
        truth = PoseStamped()
        truth.pose.position.x, truth.pose.position.z = x, z
        q = truth.pose.orientation
        q.x, q.y, q.z, q.w = 0.5, -0.5, 0.5, 0.5
        for topic, item in (("/camera/image_raw", message), ("/camera/camera_info", info), ("/truth", truth)):
            item.header.stamp, item.header.frame_id = stamp, "camera"
            bag.write(topic, item, stamp)
"""
    code, _, errors = answer("python3", "-c", script)
    assert code == 0, errors
    return file


@pytest.fixture
def blind(tmp_path):
    file = tmp_path / "blind.yaml"
    file.write_text(BLIND)
    return file


# --- tune_detector
def test_settings_are_tried_and_saved_for_nodes_and_tools(labelled, tmp_path):
    saved, sheet = tmp_path / "my.yaml", tmp_path / "stages.jpg"
    code, said, errors = answer("tune_detector", labelled, "--headless", "--set", "edges/floor=4.5", "--set", "preprocess/equalise=true",
                             "--set", "max_candidates=30", "--output", saved, "--sheet", sheet)
    assert code == 0, errors
    assert re.search(r"windows in 12 of 14 images, median \d+\.\d ms\n", said), said
    assert "a.png (1 of 14): window, score" in said and "lines" in said
    assert "wall_x.png (13 of 14): no window" in said
    assert yaml.safe_load(saved.read_text()) == {"window_detector": {"detector": {
        "edges": {"floor": 4.5}, "preprocess": {"equalise": True}, "max_candidates": 30}}}
    assert cv2.imread(str(sheet)).shape[1] > 1000
    code, _, errors = answer("tune_detector", labelled, "--headless", "--sheet", labelled / "a.png")
    assert code == 2 and "a.png is there already: --overwrite" in errors
    code, said, errors = answer("tune_detector", labelled / "a.png", "--headless", "--params", saved, "--set", "gates/min_area=0.5")
    assert code == 0 and "windows in 0 of 1 images" in said, errors
    code, _, errors = answer("detect_images", "--output", tmp_path / "found.csv", "--params", saved, labelled)
    assert code == 0, errors


def test_a_bag_is_a_source_too(bag):
    code, said, errors = answer("tune_detector", bag, "--headless", "--every", "3")
    assert code == 0, errors
    assert "windows in 4 of 4 images" in said and "image 9 of /camera/image_raw" in said


@pytest.mark.parametrize("arguments, words", [
    ([], "no SOURCE"), (["/nowhere.png", "--headless"], "no such image"), (["/camera/image_raw", "--headless"], "no ROS master"),
    (["LABELLED", "--headless", "--set", "edges/flor=1"], "edges/flor"), (["LABELLED", "--headless", "--set", "edges/floor=1e9"], "is not within"),
    (["LABELLED", "--headless", "--params", "/nowhere.yaml"], "/nowhere.yaml"), (["LABELLED"], "--output is missing"),
    (["LABELLED", "--output", "x.yaml"], "no display"), (["LABELLED", "--headless", "--output", "/proc/x.yaml"], "cannot be written")])
def test_tune_detector_says_what_is_wrong(labelled, arguments, words):
    code, _, errors = answer("tune_detector", *[str(labelled) if a == "LABELLED" else a for a in arguments],
                          ROS_MASTER_URI="http://localhost:1", DISPLAY="", WAYLAND_DISPLAY="")
    assert code == 2 and words in errors and len(errors.strip().splitlines()) == 1, errors


def test_a_display_that_is_gone_is_said(labelled, tmp_path):
    for tool, source in (("tune_detector", labelled), ("make_reference", next(labelled.glob("*.png")))):
        code, _, errors = answer(tool, source, "--output", tmp_path / "x.yaml", DISPLAY=":4711", WAYLAND_DISPLAY="")
        assert code == 2 and "there is no display" in errors and len(errors.strip().splitlines()) == 1, errors


@pytest.fixture(name="display")
def fixture_display(screen):
    """A display with a simulated user who types and clicks."""
    if not shutil.which("xdotool"):
        pytest.skip("xdotool is not installed")
    return screen


def titled(display, title):
    """A window, once it has this title."""
    return subprocess.run(["xdotool", "search", "--sync", "--onlyvisible", "--name", title], env={**os.environ, "DISPLAY": display},
                          timeout=60, capture_output=True, text=True, check=True).stdout.split()[0]


def press(display, window, action):
    """A key, or a click "x,y". The caller waits for its effect: highgui keeps only the last key between two polls."""
    if "," in action:
        command = ["mousemove", "--window", window, *action.split(","), "click", "1"]
    else:
        command = ["key", "--window", window, action]
    subprocess.run(["xdotool", *command], env={**os.environ, "DISPLAY": display}, timeout=60, check=True)


def test_trackbars_open_and_what_they_show_is_saved(labelled, tmp_path, display):
    saved = tmp_path / "my.yaml"
    process = subprocess.Popen([str(ROOT / "scripts/run"), "tune_detector", str(labelled), "--output", str(saved), "--set",
                                "edges/floor=4.5"], env={**os.environ, "DISPLAY": display}, stdout=subprocess.PIPE, text=True)
    try:
        stages = titled(display, r"a\.png \(")
        titled(display, "parameters: preprocess")
        for key, shown in (("g", "parameters: edges"), ("n", r"b\.png \(")):
            press(display, stages, key)
            titled(display, shown)
        press(display, stages, "s")
        end = time.monotonic() + 30.0
        while not saved.exists() and time.monotonic() < end:
            time.sleep(0.05)
        press(display, stages, "q")
        said, _ = process.communicate(timeout=60)
    finally:
        process.kill()
    assert process.returncode == 0
    assert yaml.safe_load(saved.read_text()) == {"window_detector": {"detector": {"edges": {"floor": 4.5}}}}, said


# --- tune_from_bag
def tune(*arguments):
    return answer("tune_from_bag", "--trials", 40, "--names", "gates/min_area,min_score", *arguments)


def test_bad_thresholds_are_mended_and_the_changed_keys_written(labelled, blind, tmp_path):
    saved = tmp_path / "better.yaml"
    code, said, errors = tune("--labels", labelled / "labels.csv", "--images", labelled, "--params", blind, "--output", saved)
    assert code == 0, said + errors
    assert "held out (groups drawn with seed 1)" in said
    assert "held out, before: recall 0.0 %" in said and "held out, after:  recall 100.0 %" in said
    assert "- gates/min_area: 0.5\n+ gates/min_area: 0." in said
    assert "40 of 40 settings tried; best F1 1.000" in errors
    tuned = yaml.safe_load(saved.read_text())["window_detector"]["detector"]
    assert set(tuned) <= {"gates", "min_score"} and tuned["gates"]["min_area"] < 0.2
    code, said, errors = answer("tune_detector", labelled, "--headless", "--params", saved)
    assert code == 0 and "windows in 12 of 14 images" in said, errors


def test_bags_with_truth_are_labelled_images(bag, blind, tmp_path):
    code, said, errors = tune("--bag", bag, "--truth", "/truth", "--window-size", "1.2,1.0", "--params", blind, "--output", tmp_path / "b.yaml")
    assert code == 0, said + errors
    assert "held out, after:  recall 100.0 %" in said


def test_nothing_is_written_where_nothing_is_better(labelled, tmp_path):
    saved = tmp_path / "none.yaml"
    code, said, errors = answer("tune_from_bag", "--trials", 15, "--labels", labelled / "labels.csv", "--images", labelled, "--output", saved)
    assert code == 1 and "nothing written" in said and "ms an image" in said, said + errors
    assert "warning: no --reference: any window counts" in errors
    assert not saved.exists()


@pytest.mark.parametrize("arguments, words", [
    ([], "'--output' is required"), (["--output", "x"], "either --labels or --bag"),
    (["--output", "x", "--labels", "/nowhere.csv", "--images", "/"], "/nowhere.csv"), (["--output", "x", "--labels", "a"], "go together"),
    (["--output", "x", "--bag", "a.bag"], "--truth and --window-size"),
    (["--output", "x", "--bag", "/nowhere.bag", "--truth", "/t", "--window-size", "1,1"], "/nowhere.bag"),
    (["--output", "x", "--labels", "LABELS", "--images", "FOLDER", "--names", "edges/flor"], "edges/flor"),
    (["--output", "x", "--labels", "LABELS", "--images", "FOLDER", "--held-out", "2"], "--held-out")])
def test_tune_from_bag_says_what_is_wrong(labelled, arguments, words):
    known = {"LABELS": labelled / "labels.csv", "FOLDER": labelled}
    code, _, errors = answer("tune_from_bag", *[known.get(a, a) for a in arguments])
    assert code == 2 and words in errors and len(errors.strip().splitlines()) == 1, errors


# --- existing output
@pytest.mark.parametrize("command, there", [
    (("make_reference", "IMAGE", "--output", "window.png"), "window.png"), (("make_reference", "IMAGE", "--output", "window.png"), "window.yaml"),
    (("make_reference", "IMAGE", "--output", "window.png"), "window_understood.png"), (("tune_detector", "FOLDER", "--output", "my.yaml"), "my.yaml"),
    (("tune_from_bag", "--labels", "LABELS", "--images", "FOLDER", "--output", "my.yaml"), "my.yaml")])
def test_a_file_that_is_there_is_not_replaced_and_that_is_said_before_anybody_clicks(labelled, tmp_path, command, there):
    known = {"IMAGE": labelled / "a.png", "LABELS": labelled / "labels.csv", "FOLDER": labelled}
    (tmp_path / there).write_text("homography_pose: {pose: {opening_width_m: 0.5}}\n")
    code, _, errors = answer(*[known.get(part, tmp_path / part if "." in part else part) for part in command], DISPLAY="", WAYLAND_DISPLAY="")
    assert code == 2 and errors == f"{command[0]}: {tmp_path / there} is there already: --overwrite replaces it, or give another name\n"
    assert "0.5" in (tmp_path / there).read_text() and len(list(tmp_path.iterdir())) == 1


def test_a_file_that_is_there_is_replaced_where_that_is_asked_for(labelled, blind, tmp_path):
    reference = ("make_reference", labelled / "a.png", "--output", tmp_path / "my.png", "--corners", flat(corners_at(*VIEWS[0])))
    settings = ("tune_detector", labelled / "a.png", "--headless", "--set", "edges/floor=4.5", "--output", tmp_path / "my.yaml")
    thresholds = ("tune_from_bag", "--trials", 40, "--names", "gates/min_area,min_score", "--labels", labelled / "labels.csv", "--images", labelled,
                  "--params", blind, "--output", tmp_path / "my.yaml")
    for command, written in ((reference, "corners"), (settings, "floor"), (thresholds, "min_area")):
        (tmp_path / "my.yaml").write_text("{}\n")
        code, _, errors = answer(*command, "--overwrite")
        assert code == 0 and written in (tmp_path / "my.yaml").read_text(), errors


# --- make_reference
def flat(corners):
    return ",".join(f"{value:.2f}" for corner in corners for value in corner)


def test_a_reference_is_made_from_four_corners(labelled, tmp_path):
    written = tmp_path / "below" / "target.png"
    code, said, errors = answer("make_reference", labelled / "a.png", "--output", written, "--corners", flat(corners_at(*VIEWS[0])))
    assert code == 0 and not errors, errors
    assert f"config:=\"{written.with_suffix('.yaml')}\"" in said
    kept = yaml.safe_load(written.with_suffix(".yaml").read_text())["window_detector"]["reference"]
    assert kept["picture"] == str(written)
    assert numpy.allclose(kept["corners"], numpy.array(corners_at(*VIEWS[0])).ravel(), atol=0.01)
    understood = cv2.imread(str(written.with_name("target_understood.png")))
    x, y = (round(value) for value in corners_at(*VIEWS[0])[0])
    assert understood[y, x + 20, 1] > 150, "the inner border is drawn in green"
    code, said, errors = answer("tune_detector", labelled, "--headless", "--reference", written, "--reference-corners", flat(corners_at(*VIEWS[0])))
    assert code == 0 and "windows in 12 of 14 images" in said and ", distance 0.0" in said, said + errors


def test_corners_are_fitted_to_the_edges_near_them(labelled, tmp_path):
    true = corners_at(*VIEWS[0])
    rough = [(x + dx, y + dy) for (x, y), (dx, dy) in zip(true, ((2, 1), (-2, 2), (1, -2), (2, 2)))]
    code, _, errors = answer("make_reference", labelled / "a.png", "--output", tmp_path / "a.png", "--fit", "--corners", flat(rough))
    assert code == 0, errors
    kept = yaml.safe_load((tmp_path / "a.yaml").read_text())["window_detector"]["reference"]["corners"]
    assert numpy.abs(numpy.array(kept) - numpy.round(numpy.array(true)).ravel()).max() < 1.0


def test_a_fit_says_how_far_each_side_moved(labelled, tmp_path):
    code, said, errors = answer("make_reference", labelled / "a.png", "--output", tmp_path / "a.png", "--fit", "--corners", flat(corners_at(*VIEWS[0])))
    assert code == 0, errors
    assert re.search(r"moved by the fit: top \d\.\d px, right \d\.\d px, bottom \d\.\d px, left \d\.\d px", said), said


def test_a_side_far_from_where_it_was_clicked_is_refused_by_name(tmp_path):
    """The inner edge on the right is invisible; the frame's outer edge, five pixels away, is visible."""
    image = numpy.full((HEIGHT, WIDTH, 3), 190, numpy.uint8)
    image[60:181, 80:221] = (20, 95, 225)
    image[69:172, 89:216] = (60, 50, 45)
    image[69:172, 211:221] = (58, 49, 44)
    cv2.imwrite(str(tmp_path / "frame.png"), image)
    code, _, errors = answer("make_reference", tmp_path / "frame.png", "--output", tmp_path / "a.png", "--fit", "--corners",
                          "88.5,68.5,215.5,68.5,215.5,171.5,88.5,171.5")
    assert code == 1 and "the right side would move by 5" in errors and "more than 3.0" in errors, errors
    assert not (tmp_path / "a.png").exists()


def test_the_corners_of_the_page_are_fitted_in_a_deep_frame(tmp_path):
    """The edge of the frame's shaded side is stronger, four pixels beside the front edge."""
    said_there = re.search(r"ingress reference photo.jpg --output window.png --corners (\S+) --fit", (ROOT / "doc/window.md").read_text(encoding="utf-8"))[1]
    left, top, right, _, _, bottom, *_ = (int(number) for number in said_there.split(","))
    image = numpy.full((480, 640, 3), 190, numpy.uint8)
    for grow, colour in ((16, (60, 160, 215)), (0, (50, 135, 190)), (-4, (60, 60, 45))):
        image[top - grow:bottom + grow + 1, left - grow:right + grow + 1] = colour
    cv2.imwrite(str(tmp_path / "photo.png"), image)
    code, said, errors = answer("make_reference", tmp_path / "photo.png", "--output", tmp_path / "a.png", "--fit", "--corners", said_there)
    assert code == 0, errors
    moved = re.search(r"moved by the fit: top (\S+) px, right (\S+) px, bottom (\S+) px, left (\S+) px", said)
    assert max(map(float, moved.groups())) < 1.0, said


@pytest.mark.parametrize("off, said", [((6, 0), "poor corners: "), ((25, 9), "poor corners: "), ((1, 0), "")])
def test_corners_that_are_saved_beside_the_edges_are_said_to_be(labelled, tmp_path, off, said):
    corners = [(x + off[0], y + off[1]) for x, y in corners_at(*VIEWS[0])]
    code, done, errors = answer("make_reference", labelled / "a.png", "--output", tmp_path / "a.png", "--corners", flat(corners))
    assert code == 0 and (tmp_path / "a.png").exists()
    assert (f"warning: {said}" in errors) if said else not errors, errors
    sides = re.search(r"beside the edges near them: top (\S+) px, right (\S+) px, bottom (\S+) px, left (\S+) px", done)
    assert (sides is None) if said else max(map(float, sides.groups())) < 2.0, done


def test_a_side_without_a_straight_edge_is_refused(labelled, tmp_path):
    image = cv2.imread(str(labelled / "a.png"))
    (left, top), _, (right, bottom), _ = [(round(x), round(y)) for x, y in corners_at(*VIEWS[0])]
    image[top + 20:bottom - 20, left - 12:left + 12] = (60, 50, 45)  # an occluder
    cv2.imwrite(str(tmp_path / "hidden.png"), image)
    code, _, errors = answer("make_reference", tmp_path / "hidden.png", "--output", tmp_path / "a.png", "--fit", "--corners", flat(corners_at(*VIEWS[0])))
    assert code == 1 and "% of one side lie on a straight edge" in errors and "correct the corners" in errors, errors


@pytest.mark.parametrize("off, times", [(0, 1), (15, 2)], ids=["good corners", "poor corners are saved by the second Enter only"])
def test_corners_are_clicked(labelled, tmp_path, display, off, times):
    true = [(round(x) + off, round(y)) for x, y in corners_at(*VIEWS[0])]
    process = subprocess.Popen([str(ROOT / "scripts/run"), "make_reference", str(labelled / "a.png"), "--output", str(tmp_path / "a.png")],
                               env={**os.environ, "DISPLAY": display}, stdout=subprocess.PIPE, text=True)
    try:
        for name, (x, y) in zip(("top left", "top right", "bottom right", "bottom left"), true):
            press(display, titled(display, f"click the {name} inner corner"), f"{x},{y}")
        for _ in range(times):
            assert process.poll() is None and not (tmp_path / "a.png").exists()
            press(display, titled(display, "four corners"), "Return")
            time.sleep(1.0)  # until the tool has polled it
        process.communicate(timeout=120)
    finally:
        process.kill()
    assert process.returncode == 0
    kept = yaml.safe_load((tmp_path / "a.yaml").read_text())["window_detector"]["reference"]["corners"]
    assert numpy.abs(numpy.array(kept) - numpy.array(true).ravel()).max() < 3.0


def test_a_large_image_and_the_keys_beside_it_are_on_the_screen_of_a_laptop(labelled, tmp_path, display):
    cv2.imwrite(str(tmp_path / "large.png"), cv2.resize(cv2.imread(str(labelled / "a.png")), (1280, 720)))
    with subprocess.Popen([str(ROOT / "scripts/run"), "make_reference", str(tmp_path / "large.png"), "--output", str(tmp_path / "a.png")],
                          env={**os.environ, "DISPLAY": display}) as process:
        window = titled(display, "click the top left inner corner")
        size = subprocess.run(["xdotool", "getwindowgeometry", "--shell", window], env={**os.environ, "DISPLAY": display}, timeout=60,
                              capture_output=True, text=True, check=True).stdout
        process.kill()
    assert int(re.search(r"WIDTH=(\d+)", size)[1]) <= 1366, size


@pytest.mark.parametrize("arguments, words", [
    ([], "no image given"), (["/nowhere.png"], "/nowhere.png"), (["IMAGE"], "no display"),
    (["IMAGE", "--corners", "1,2,3"], "--corners"), (["IMAGE", "--corners", "1,1,5,5,5,1,1,5"], "not a convex quadrilateral"),
    (["IMAGE", "--corners", "10,10,900,10,900,90,10,90"], "corners")])
def test_make_reference_says_what_is_wrong(labelled, arguments, words):
    code, _, errors = answer("make_reference", *[labelled / "a.png" if a == "IMAGE" else a for a in arguments], DISPLAY="", WAYLAND_DISPLAY="")
    assert code == 2 and words in errors and len(errors.strip().splitlines()) == 1, errors
