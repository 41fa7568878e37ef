"""ingress detect: what it refuses, leaves out and warns of."""
import shutil

import cv2
import numpy
import pytest

from repository import assert_refused, rows_of, run


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


def test_a_size_that_contradicts_the_reference_and_a_camera_of_another_size_are_said(tmp_path, image):
    camera = tmp_path / "camera.yaml"
    camera.write_text("image_width: 320\nimage_height: 240\ncamera_name: c\ncamera_matrix: {rows: 3, cols: 3, data: [300, 0, 160, 0, 300, 120, 0, 0, 1]}\n"
                      "distortion_model: plumb_bob\ndistortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n")
    picture = numpy.full((240, 320, 3), 160, numpy.uint8)
    cv2.rectangle(picture, (80, 60), (240, 180), (0, 120, 240), 12)
    small, large = tmp_path / "small.png", tmp_path / "large.png"
    cv2.imwrite(str(small), picture)
    cv2.imwrite(str(large), cv2.resize(picture, (640, 480)))
    arguments = ("--output", tmp_path / "out.csv", "--camera", camera, "--reference", small, "--reference-corners", "86,66,234,66,234,174,86,174")
    right = run("detect_images", *arguments, "--window-size", "1.37,1.0", small)
    assert right.returncode == 0 and "warning" not in right.stderr, right.stderr
    swapped = run("detect_images", *arguments, "--window-size", "1.0,1.37", small, large)
    assert "warning: the opening, 1 x 1.37 m, is 0.73 times as wide as it is high, but 1.37 times in the reference image" in swapped.stderr
    assert "warning: 1 without lens and pose: not 320 x 240 px, as --camera says" in swapped.stderr


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


def window_picture():
    """A window with an orange frame, left of the middle."""
    picture = numpy.full((240, 320, 3), 160, numpy.uint8)
    cv2.rectangle(picture, (40, 60), (200, 180), (0, 120, 240), 12)
    return cv2.rectangle(picture, (46, 66), (194, 174), (30, 30, 30), -1)


def test_a_photograph_is_turned_as_viewers_show_it(tmp_path):
    lying = cv2.imencode(".jpg", cv2.rotate(window_picture(), cv2.ROTATE_90_COUNTERCLOCKWISE))[1].tobytes()
    turn_clockwise = b"\xff\xe1\x00\x22Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0"  # EXIF: orientation 6
    (tmp_path / "held_upright.jpg").write_bytes(lying[:2] + turn_clockwise + lying[2:])
    cv2.imwrite(str(tmp_path / "reference.png"), window_picture())
    done = run("detect_images", "--output", tmp_path / "out.csv", "--reference", tmp_path / "reference.png",
               "--reference-corners", "46,66,194,66,194,174,46,174", tmp_path / "held_upright.jpg")
    assert done.returncode == 0, done.stderr
    row = rows_of(tmp_path / "out.csv")[0]
    assert abs(float(row["x1"]) - 46) < 1 and abs(float(row["y1"]) - 66) < 1


def test_what_is_left_out_of_a_folder_and_what_is_nearly_black_is_said(tmp_path, image):
    shutil.copy(image, tmp_path / "plain.webp")
    cv2.imwrite(str(tmp_path / "twelve_bits.png"), window_picture().astype(numpy.uint16) * 16)
    done = run("detect_images", "--output", tmp_path / "new" / "out.csv", tmp_path)
    assert done.returncode == 0 and "of 2 images" in done.stdout
    assert f"left out 1 whose names do not end as an image's, e.g. {tmp_path}/plain.webp" in done.stderr
    assert f"warning: {tmp_path}/twelve_bits.png is nearly black" in done.stderr
