"""print_window: the printed frame is true to scale, complete, and agrees with its reference and parameter file."""
import re

import cv2
import numpy
import pytest
import yaml

from repository import load, run

printer = load("tools/print_window")

ORANGE, DPI = "#e15f14", 50.8  # two pixels a millimetre


def printed(figure):
    """The printed sheet: true where it is coloured; rows from the top."""
    figure.set_dpi(DPI)
    figure.canvas.draw()
    pixels = numpy.asarray(figure.canvas.buffer_rgba())[:, :, :3].astype(int)
    printer.plt.close(figure)
    return (pixels[:, :, 0] - pixels[:, :, 2]) > 100


def glued(window):
    """The sheets cut along their dashed lines and joined as planned; two pixels a millimetre."""
    left, below = (printer.PAGE_MM[0] - printer.TILE_MM[0]) / 2, (printer.PAGE_MM[1] - printer.TILE_MM[1]) / 2 + 4
    width, height = (round(2 * side) for side in printer.TILE_MM)
    top = round(2 * (printer.PAGE_MM[1] - below)) - height
    whole = numpy.zeros((window.rows() * height, window.columns() * width), bool)
    for name, column, row in window.sheets():
        sheet = printed(printer.draw_sheet(window, ORANGE, name, column, row))
        assert sheet.shape == (594, 420)  # A4
        at = (window.rows() - 1 - row) * height
        whole[at:at + height, column * width:(column + 1) * width] = sheet[top:, round(2 * left):][:height, :width]
    return whole


@pytest.mark.parametrize("width, height, frame", [(600, 450, 50), (300, 200, 30), (800, 1000, 60)])
def test_the_sheets_together_are_the_frame_true_to_scale(width, height, frame):
    window = printer.Window(width, height, frame)
    rows, columns = numpy.nonzero(glued(window))
    assert columns.max() - columns.min() + 1 == pytest.approx(2 * (width + 2 * frame), abs=2)
    assert rows.max() - rows.min() + 1 == pytest.approx(2 * (height + 2 * frame), abs=2)
    assert len(rows) == pytest.approx(4 * ((width + 2 * frame) * (height + 2 * frame) - width * height), rel=0.02)


def test_sheets_without_a_bit_of_the_frame_are_left_out():
    window = printer.Window(800, 1000, 60)
    names = [name for name, _, _ in window.sheets()]
    assert (window.columns(), window.rows()) == (5, 5)
    assert {"A1", "E1", "A5", "C1", "A3"} <= set(names) and not {"B3", "C3", "D3"} & set(names)


def test_writes_pdf_reference_and_a_file_that_launch_files_take(tmp_path):
    done = run("print_window", "--output", tmp_path / "new/window.pdf", "--size", "0.5,0.4")
    assert done.returncode == 0 and "at 100 %" in done.stdout, done.stderr
    pdf = (tmp_path / "new/window.pdf").read_bytes()
    boxes = re.findall(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+) ?\]", pdf)
    sheets = len(list(printer.Window(500, 400, 50).sheets()))
    assert len(boxes) == 1 + sheets and f"{sheets} sheets" in done.stdout
    for box in boxes:
        assert [float(side) for side in box] == pytest.approx([595.28, 841.89], abs=0.1)
    parameters = yaml.safe_load((tmp_path / "new/window.yaml").read_text())
    assert parameters["homography_pose"]["pose"] == {"opening_width_m": 0.5, "opening_height_m": 0.4}
    reference = parameters["window_detector"]["reference"]
    image = cv2.imread(reference["picture"])
    left, top, right, _, _, bottom, _, _ = reference["corners"]
    assert (right - left) / (bottom - top) == pytest.approx(1.25, abs=0.01)
    middle = image[round(top) + 40]
    edge = round(left)
    assert middle[edge - 3][2] > 200 and middle[edge - 3][0] < 40 and max(middle[edge + 3]) < 100  # frame, opening
    checked = run("check_overlay", tmp_path / "new/window.yaml")
    assert checked.returncode == 0, checked.stderr


@pytest.mark.parametrize("there", ["window.pdf", "window.png", "window.yaml"])
def test_a_file_that_is_there_is_replaced_only_where_that_is_asked_for(tmp_path, there):
    (tmp_path / there).write_text("of another window", encoding="utf-8")
    command = "print_window", "--output", tmp_path / "window.pdf"
    done = run(*command)
    assert done.returncode == 2 and done.stderr == f"print_window: {tmp_path / there} is there already: --overwrite replaces it, or give another name\n"
    assert [file.name for file in tmp_path.iterdir()] == [there]
    done = run(*command, "--overwrite")
    assert done.returncode == 0 and b"of another window" not in (tmp_path / there).read_bytes(), done.stderr


@pytest.mark.parametrize("arguments, said", [
    (["--output", "window.svg"], "does not end in .pdf"), (["--output", "w.pdf", "--size", "1"], "'1' is not W,H"),
    (["--output", "w.pdf", "--size", "0.01,1"], "0.1 to 3 m"), (["--output", "w.pdf", "--frame", "wide"], "'wide' is no number"),
    (["--output", "w.pdf", "--frame", "1"], "0.01 to 0.3 m"), (["--output", "w.pdf", "--colour", "mud"], "'mud' is no colour"), ([], "--output")])
def test_wrong_usage_is_one_line(arguments, said):
    done = run("print_window", *arguments)
    assert done.returncode == 2 and said in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_a_place_that_cannot_be_written_is_said(tmp_path):
    (tmp_path / "file").write_text("no folder", encoding="utf-8")
    done = run("print_window", "--output", str(tmp_path / "file/window.pdf"))
    assert done.returncode == 1 and str(tmp_path / "file") in done.stderr and done.stderr.count("\n") == 1
