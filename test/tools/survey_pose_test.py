"""The survey of the pose is repeatable, near the bound, and refuses unusable input; its plots and table."""
import pytest

from repository import ROOT, rows_of, run


def draw(folder, *arguments):
    return run("survey_pose", "--draws", 50, "--at", "3,6", "--yaw", "10,30", "--noise", "0.3", "--output", folder, *arguments)


def test_same_seed_same_cells_and_near_the_bound(tmp_path):
    done = draw(tmp_path / "a")
    assert done.returncode == 0, done.stderr
    assert "of 4 cells with sigma_u < yaw / 3" in done.stdout
    assert draw(tmp_path / "b").returncode == 0
    assert rows_of(tmp_path / "a/cells.csv") == rows_of(tmp_path / "b/cells.csv")
    assert draw(tmp_path / "c", "--seed", 9).returncode == 0
    assert rows_of(tmp_path / "c/cells.csv") != rows_of(tmp_path / "a/cells.csv")
    for cell in rows_of(tmp_path / "a/cells.csv"):
        assert float(cell["ours_yaw_rmse_deg"]) < 1.5 * float(cell["yaw_bound_deg"])
        assert int(cell["draws"]) == 50


def test_plots_and_table(tmp_path):
    assert draw(tmp_path).returncode == 0
    page = tmp_path / "page.md"
    page.write_text("before\n<!-- methods: begin -->\nold\n<!-- methods: end -->\nafter\n")
    plot = ROOT / "tools/plot_pose.py"
    done = run("python3", plot, tmp_path, "--doc", page)
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "pose_bound.png").stat().st_size > 1000
    assert (tmp_path / "pose_methods.png").stat().st_size > 1000
    text = page.read_text()
    assert text.startswith("before") and text.endswith("after\n") and "old" not in text and "| 3 | 10 |" in text
    missing = run("python3", plot, tmp_path / "none")
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
    done = run("survey_pose", *[tmp_path / "out" if a == "OUT" else a for a in arguments])
    assert done.returncode == 2
    assert word in done.stderr and done.stderr.count("\n") == 1
