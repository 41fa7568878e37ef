"""The survey of the tracker is repeatable and reports what it cannot do."""
import pytest

from repository import run, timeless


@pytest.fixture
def scenario(tmp_path):
    file = tmp_path / "small.yaml"
    file.write_text("camera: {width_px: 320, height_px: 240, rate_hz: 20}\n")
    return file


def test_same_arguments_same_rows(scenario, tmp_path):
    for name in ("a", "b"):
        done = run("survey_tracker", "--scenario", scenario, "--flights", 1, "--speed", 4, "--output", tmp_path / name)
        assert done.returncode == 0, done.stderr
        assert "| small | over 3 m |" in done.stdout
    assert timeless(tmp_path / "a/small.csv") == timeless(tmp_path / "b/small.csv")
    planes = [float(row["plane_m"]) for row in timeless(tmp_path / "a/small.csv")]
    assert planes == sorted(planes, reverse=True)
    assert min(planes) < 0.7


@pytest.mark.parametrize("option, value", [("--flights", "0"), ("--speed", "0"), ("--end", "9"), ("--wobble", "nan")])
def test_bad_usage_is_refused_in_one_line(option, value, scenario, tmp_path):
    done = run("survey_tracker", "--scenario", scenario, "--output", tmp_path, option, value)
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert option in done.stderr
