"""The survey of the detector is repeatable, gives the same from files, and reports missing windows honestly."""
import pytest

from repository import rows_of, run, timeless

SCENARIO = "camera: {width_px: 320, height_px: 240}\nhouse: {texture_seed: [1, 50]}\n"


@pytest.fixture
def scenario(tmp_path):
    file = tmp_path / "small.yaml"
    file.write_text(SCENARIO)
    return file


def test_same_arguments_same_rows_and_the_same_from_files(scenario, tmp_path):
    drawn = run("survey_detector", "--scenario", scenario, "--frames", 3, "--save", tmp_path / "saved", "--output", tmp_path / "a")
    assert drawn.returncode == 0, drawn.stderr
    assert "| small | 3 |" in drawn.stdout
    assert run("survey_detector", "--scenario", scenario, "--frames", 3, "--output", tmp_path / "b").returncode == 0
    assert timeless(tmp_path / "a/frames.csv") == timeless(tmp_path / "b/frames.csv")
    loaded = run("survey_detector", "--load", tmp_path / "saved", "--output", tmp_path / "c")
    assert loaded.returncode == 0, loaded.stderr
    assert timeless(tmp_path / "c/frames.csv") == timeless(tmp_path / "a/frames.csv")
    assert [row["seed"] for row in timeless(tmp_path / "a/frames.csv")] == ["1", "2", "3"]


@pytest.mark.parametrize("tool, words", [("survey_detector", ["--frames", 1]), ("survey_tracker", ["--flights", 1])])
def test_scenarios_of_one_name_are_refused_because_results_would_mix(tool, words, scenario, tmp_path):
    (tmp_path / "other").mkdir()
    other = tmp_path / "other/small.yaml"
    other.write_text(SCENARIO)
    done = run(tool, "--scenario", scenario, other, *words, "--output", tmp_path / "out")
    assert done.returncode == 2 and f"{other}: another file is called small" in done.stderr, done.stderr


def test_exact_distances_in_turn(scenario, tmp_path):
    done = run("survey_detector", "--scenario", scenario, "--frames", 3, "--at", "2,4,8", "--no-reference", "--static-camera",
                  "--antialiasing", "multisampling", "--output", tmp_path)
    assert done.returncode == 0, done.stderr
    assert [float(row["distance_m"]) for row in rows_of(tmp_path / "frames.csv")] == [2.0, 4.0, 8.0]
    assert "hits at 8 m" in done.stdout


def test_without_target_nothing_can_be_hit(scenario, tmp_path):
    done = run("survey_detector", "--scenario", scenario, "--frames", 2, "--without-target", "--output", tmp_path)
    assert done.returncode == 0, done.stderr
    assert {row["verdict"] for row in rows_of(tmp_path / "frames.csv")} <= {"nothing", "false_alarm"}


@pytest.mark.parametrize("arguments, word", [
    (["--output", "OUT"], "--scenario"),
    (["--scenario", "FILE"], "--output"),
    (["--scenario", "FILE", "--output", "OUT", "--distance", "8,2"], "--distance"),
    (["--scenario", "FILE", "--output", "OUT", "--at", "2,x"], "--at"),
    (["--scenario", "FILE", "--output", "OUT", "--off-axis", "90"], "--off-axis"),
    (["--scenario", "FILE", "--output", "OUT", "--frames", "0"], "--frames"),
    (["--scenario", "FILE", "--output", "OUT", "--antialiasing", "none"], "antialiasing"),
    (["--scenario", "/no/such.yaml", "--output", "OUT"], "/no/such.yaml"),
    (["--load", "/no/such/folder", "--output", "OUT"], "truth.csv"),
])
def test_bad_usage_is_refused_in_one_line(arguments, word, scenario, tmp_path):
    places = {"FILE": scenario, "OUT": tmp_path / "out"}
    done = run("survey_detector", *[places.get(a, a) for a in arguments])
    assert done.returncode == 2, done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert word in done.stderr
