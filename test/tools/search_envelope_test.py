"""tools/search_envelope: a search is repeatable, can be resumed, and finds, simplifies and keeps contacts."""
import re

import pytest
import yaml

from repository import ROOT, call, rows_of, run

CALM = "glass: excluded\nunverified_opening: allow\nstart: {distance_m: [3.0, 3.5], off_axis_rad: [-0.1, 0.1]}\n"
# No safeguard stands behind the brake: the vehicle obeys random velocities.
DEADLY = CALM + "time_limit_sec: 30\nfaults: [{unit: cmd_vel, kind: garbage, at_sec: [2.0, 4.0], duration_sec: 20.0}]\n"


def search(folder, *arguments):
    """Called like `ingress evaluate envelope` in a workspace: by catkin's relay, which has no module name."""
    return call(ROOT / "scripts/ingress", "evaluate", "envelope", "--output", folder, "--jobs", "2", *arguments)


def envelope_in(folder, text):
    file = folder / "envelope.yaml"
    file.write_text(text)
    return file


def test_a_search_repeats_and_one_that_is_broken_off_goes_on(tmp_path):
    envelope = envelope_in(tmp_path, CALM)
    assert search(tmp_path / "whole", "--envelope", envelope, "--flights", "12").returncode == 0
    assert search(tmp_path / "again", "--envelope", envelope, "--flights", "12").returncode == 0
    assert (tmp_path / "whole/search.csv").read_bytes() == (tmp_path / "again/search.csv").read_bytes()
    refused = search(tmp_path / "again", "--envelope", envelope, "--flights", "15")
    assert refused.returncode == 2 and "--resume" in refused.stderr
    done = search(tmp_path / "again", "--envelope", envelope, "--flights", "15", "--resume")
    assert done.returncode == 0, done.stderr
    rows = rows_of(tmp_path / "again/search.csv")
    assert [int(row["seed"]) for row in rows] == list(range(10000001, 10000016))
    assert {row["outcome"] for row in rows} == {"PASSED"}
    assert all(0.0 <= float(row["start/distance_m"]) <= 1.0 for row in rows)


def test_a_contact_is_found_shrunk_and_kept_as_a_scenario_that_repeats(tmp_path):
    done = search(tmp_path / "out", "--envelope", envelope_in(tmp_path, DEADLY), "--flights", "3")
    finds = sorted((tmp_path / "out/finds").glob("*.yaml"))
    assert done.returncode == 1 and finds, done.stderr
    for find in finds:
        scenario = yaml.safe_load(find.read_text())
        assert isinstance(scenario["start"]["distance_m"], float)
        outcome = find.read_text().split(":", 1)[0].lstrip("# ")
        again = run("fly", "--scenario", find, "--seeds", find.stem, "--no-pictures", "--output", tmp_path / "fly", "--overwrite")
        assert again.returncode == 0, again.stderr
        assert (tmp_path / "fly/flights.csv").read_text().splitlines()[1].split(",")[1] == outcome


@pytest.mark.parametrize("find", sorted((ROOT / "test/envelope").glob("*.yaml")), ids=lambda find: find.stem)
def test_what_was_found_once_touches_nothing_any_more(tmp_path, find):
    for seed in re.findall(r"--seeds (\d+)", find.read_text()):
        assert run("fly", "--scenario", find, "--seeds", seed, "--no-pictures", "--output", tmp_path / seed).returncode == 0
        assert (tmp_path / seed / "flights.csv").read_text().splitlines()[1].split(",")[1] in ("PASSED", "ABORTED"), seed


@pytest.mark.parametrize("arguments, said", [
    (["--envelope", "missing.yaml"], "missing.yaml: no such file"),
    (["--shard", "3/2"], "--shard"),
    (["--flights", "0"], "--flights"),
])
def test_wrong_usage_is_refused(tmp_path, arguments, said):
    done = search(tmp_path / "out", *arguments)
    assert done.returncode == 2 and said in done.stderr


def test_a_scenario_without_ranges_is_no_envelope(tmp_path):
    done = search(tmp_path / "out", "--envelope", envelope_in(tmp_path, "time_limit_sec: 30\n"))
    assert done.returncode == 2 and "has no ranges to search" in done.stderr


def test_only_whole_numbers_have_ranges_of_whole_numbers():
    """A kept find has a value of its range's type; a flight uses the type of the key."""
    text = (ROOT / "config/envelope.yaml").read_text()
    assert set(re.findall(r"(\w+): \[-?\d+, -?\d+\]", text)) == {"texture_seed"}
