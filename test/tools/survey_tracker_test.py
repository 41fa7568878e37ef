"""The survey of the tracker: repeatable; what it cannot do it says."""
import csv
import pathlib
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]


def survey(*arguments):
    return subprocess.run([str(ROOT / "scripts/run"), "survey_tracker", *map(str, arguments)], capture_output=True,
                          text=True, timeout=120, check=False)


@pytest.fixture
def scenario(tmp_path):
    file = tmp_path / "small.yaml"
    file.write_text("camera: {width_px: 320, height_px: 240, rate_hz: 20}\n")
    return file


def rows(folder):
    with open(folder / "small.csv", newline="") as file:
        return [{k: v for k, v in row.items() if k != "milliseconds"} for row in csv.DictReader(file)]


def test_same_arguments_same_rows(scenario, tmp_path):
    for name in ("a", "b"):
        done = survey("--scenario", scenario, "--flights", 1, "--speed", 4, "--output", tmp_path / name)
        assert done.returncode == 0, done.stderr
        assert "| small | over 3 m |" in done.stdout
    assert rows(tmp_path / "a") == rows(tmp_path / "b")
    planes = [float(row["plane_m"]) for row in rows(tmp_path / "a")]
    assert planes == sorted(planes, reverse=True)
    assert min(planes) < 0.7


@pytest.mark.parametrize("option, value", [("--flights", "0"), ("--speed", "0"), ("--end", "9"), ("--wobble", "nan")])
def test_bad_usage_is_refused_in_one_line(option, value, scenario, tmp_path):
    done = survey("--scenario", scenario, "--output", tmp_path, option, value)
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert option in done.stderr
