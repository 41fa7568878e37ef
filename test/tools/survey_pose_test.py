"""The survey of the pose: repeatable, near the bound, refuses what it cannot use; its plots and table."""
import csv
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def survey(*arguments):
    return subprocess.run([str(ROOT / "scripts/run"), "survey_pose", *map(str, arguments)], capture_output=True,
                          text=True, timeout=120, check=False)


def draw(folder, *arguments):
    return survey("--draws", 50, "--at", "3,6", "--yaw", "10,30", "--noise", "0.3", "--output", folder, *arguments)


def cells(folder):
    with open(folder / "cells.csv", newline="") as file:
        return list(csv.DictReader(file))


def test_same_seed_same_cells_and_near_the_bound(tmp_path):
    done = draw(tmp_path / "a")
    assert done.returncode == 0, done.stderr
    assert "of 4 cells with sigma_u < yaw / 3" in done.stdout
    assert draw(tmp_path / "b").returncode == 0
    assert cells(tmp_path / "a") == cells(tmp_path / "b")
    assert draw(tmp_path / "c", "--seed", 9).returncode == 0
    assert cells(tmp_path / "c") != cells(tmp_path / "a")
    for cell in cells(tmp_path / "a"):
        assert float(cell["ours_yaw_rmse_deg"]) < 1.5 * float(cell["yaw_bound_deg"])
        assert int(cell["draws"]) == 50


def test_plots_and_table(tmp_path):
    assert draw(tmp_path).returncode == 0
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- methods: begin -->\nold\n<!-- methods: end -->\nafter\n")
    plot = [str(ROOT / "tools/plot_pose.py"), str(tmp_path)]
    done = subprocess.run(["/usr/bin/python3", *plot, "--doc", str(page)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "pose_bound.png").stat().st_size > 1000
    assert (tmp_path / "pose_methods.png").stat().st_size > 1000
    text = page.read_text()
    assert text.startswith("before") and text.endswith("after\n") and "old" not in text and "| 3 | 10 |" in text
    missing = subprocess.run(["/usr/bin/python3", plot[0], str(tmp_path / "none")], capture_output=True, text=True, check=False)
    assert missing.returncode == 2 and "cells.csv" in missing.stderr


@pytest.mark.parametrize("arguments, word", [
    ([], "--output"),
    (["--output", "OUT", "--draws", "0"], "--draws"),
    (["--output", "OUT", "--at", "3,x"], "--at"),
    (["--output", "OUT", "--yaw", "89"], "--yaw"),
    (["--output", "OUT", "--noise", "nan"], "--noise"),
    (["--output", "OUT", "--window-size", "1"], "--window-size"),
    (["--output", "OUT", "--at", "0.3"], "does not fit"),
    (["--output", "OUT", "--load", "NOWHERE"], "--window-size"),
    (["--output", "OUT", "--load", "NOWHERE", "--window-size", "1,1"], "NOWHERE"),
])
def test_wrong_usage_is_one_line_and_code_2(arguments, word, tmp_path):
    done = survey(*[str(tmp_path / "out") if a == "OUT" else a for a in arguments])
    assert done.returncode == 2
    assert word in done.stderr and done.stderr.count("\n") == 1
