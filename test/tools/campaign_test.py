"""scripts/campaign: shards flown by GNU parallel and joined are the same bytes as one process."""
import json
import os
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENARIO = "time_limit_sec: 1.0\nstart: {distance_m: [2, 3]}\ncamera: {width_px: 64, height_px: 48}\n"
FILES = ["flights.csv", "tracks.csv", "tracks.png", "summary.json"]


def run(*command):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=300, check=False)


def scenario_in(folder, name="short"):
    file = folder / f"{name}.yaml"
    file.write_text(SCENARIO)
    return file


def test_two_shards_joined_are_the_same_bytes_as_one_process(tmp_path):
    scenario = scenario_in(tmp_path)
    done = run(ROOT / "scripts/campaign", "--output", tmp_path / "campaign", "--seeds", "1..5", "--shards", "2", scenario)
    assert done.returncode == 0, done.stderr
    assert "| short | 5 |" in done.stdout
    whole = run(ROOT / "scripts/run", "fly", "--scenario", scenario, "--seeds", "1..5", "--jobs", "2", "--output",
                tmp_path / "whole")
    assert whole.returncode == 0, whole.stderr
    for name in FILES:
        assert (tmp_path / "campaign/short" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name
    assert json.loads((tmp_path / "whole/summary.json").read_text())["flights"] == 5


def test_a_campaign_that_was_broken_off_goes_on(tmp_path):
    scenario = scenario_in(tmp_path)
    command = [ROOT / "scripts/campaign", "--output", tmp_path, "--seeds", "1..2", "--shards", "2", scenario]
    assert run(*command).returncode == 0
    kept, lost = (tmp_path / "short/shards" / name / "summary.json" for name in ("1_of_2", "2_of_2"))
    before = kept.stat().st_mtime_ns
    lost.unlink()
    assert run(*command, "--resume").returncode == 0
    assert lost.exists() and kept.stat().st_mtime_ns == before
    command[command.index("1..2")] = "1..4"
    other = run(*command, "--resume")
    assert other.returncode == 1 and "other seeds than 1..4" in other.stderr


def test_a_failed_shard_is_an_error_and_no_result(tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("start: {distance_m: 500}\n")
    done = run(ROOT / "scripts/campaign", "--output", tmp_path / "out", "--seeds", "1..2", "--shards", "2", bad)
    assert done.returncode == 1
    assert "distance_m = 500 is not within" in done.stderr
    assert not (tmp_path / "out/table.md").exists()


def test_scenarios_flown_elsewhere_are_left_out_with_a_line(tmp_path):
    external = ROOT / "config/scenarios/external.yaml"
    done = run(ROOT / "scripts/campaign", "--output", tmp_path / "out", "--seeds", "1..1", "--shards", "1", external, scenario_in(tmp_path))
    assert done.returncode == 0 and "external.yaml left out" in done.stderr and "| short | 1 |" in done.stdout, done.stderr
    assert run(ROOT / "scripts/campaign", "--output", tmp_path / "none", external).returncode == 2


def test_wrong_usage_says_what_to_do(tmp_path):
    scenario = scenario_in(tmp_path)
    for arguments, text in [([tmp_path / "none.yaml"], "no such file"), ([scenario, "--shards", "0"], "--shards"),
                            ([scenario, scenario], "same name"),
                            ([scenario, "--sshloginfile", scenario], "must lie below")]:
        done = run(ROOT / "scripts/campaign", "--output", tmp_path / "out", *arguments)
        assert done.returncode == 2 and text in done.stderr, arguments


def test_failures_are_kept_with_bag_and_picture(tmp_path):
    scenario = scenario_in(tmp_path)
    done = run(ROOT / "scripts/run", "fly", "--scenario", scenario, "--seeds", "3", "--output", tmp_path / "out",
               "--keep-failures")
    assert done.returncode == 0, done.stderr
    bag = tmp_path / "out/failures/flight_3.bag"
    assert os.path.getsize(tmp_path / "out/failures/flight_3.png") > 1000
    info = run(ROOT / "scripts/run", "rosbag", "info", bag)
    for topic in ("/camera/camera_info", "/camera/image_raw/compressed", "/cmd_vel", "/ground_truth/odom", "/imu", "/odom", "/state",
                  "/tf_static"):  # as sim.launch names them, and replay.launch expects them
        assert topic in info.stdout, info.stdout + info.stderr
