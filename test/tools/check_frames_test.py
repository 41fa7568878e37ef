"""check_frames flies in the simulated world behind the real guard and finds axes as in REP 103. It also finds wrong ones."""
import math

import pytest

from repository import ROOT, load, run


@pytest.fixture(scope="module")
def tool():
    return load("tools/check_frames")


def test_the_simulated_vehicle_goes_where_rep_103_wants(tmp_path):
    done = run("check_frames", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("OK     0.2 m/s along") == 6
    assert "0.2 m/s along +y of base_link: odometry moved" in done.stdout
    assert "turning left, yaw rate above 0: yaw grew by" in done.stdout
    assert "ERROR" not in done.stdout


def test_ways_are_turned_into_the_body(tool):
    assert tool.in_body((0.0, 1.0, 2.0), math.pi / 2) == pytest.approx((1.0, 0.0, 2.0))
    assert tool.main_axis((0.1, -0.5, 0.1))[0] == "-y"
    assert tool.main_axis((0.0, 0.0, 0.0)) == ("+x", 0.0)
    assert tool.turned(3.1, -3.1) == pytest.approx(2 * math.pi - 6.2)


@pytest.mark.parametrize("moved, fine, said", [((0.3, 0.01, 0.0), True, "along +x"), ((0.0, -0.3, 0.0), False, "along -y; REP 103 wants +x"),
                                               ((0.2, 0.2, 0.0), False, "REP 103 wants +x")])
def test_a_wrong_axis_is_named(tool, capsys, moved, fine, said):
    assert tool.say("carried forward", moved, "+x", "base_link", 0.8) == fine
    out = capsys.readouterr().out
    assert said in out and out.startswith("OK" if fine else "ERROR")


def test_a_turn_the_wrong_way_is_named(tool, capsys):
    assert not tool.judge_turn("turned left", -0.5)
    assert "yaw shrank by 29 deg; REP 103 wants it to grow" in capsys.readouterr().out


def test_without_a_master_there_is_nothing_to_watch():
    done = run("env", "ROS_MASTER_URI=http://localhost:1", ROOT / "scripts/run", "check_frames", "--by-hand")
    assert done.returncode == 2
    assert "no master at ROS_MASTER_URI=http://localhost:1" in done.stderr
