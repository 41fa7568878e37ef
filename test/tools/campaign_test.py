"""tools/campaign: shards flown by GNU parallel and merged give the same bytes as one process."""
import csv
import json
import os
import re
import signal
import subprocess
import time

from repository import ROOT, call, run

SCENARIO = "time_limit_sec: 1.0\nstart: {distance_m: [2, 3]}\ncamera: {width_px: 64, height_px: 48}\n"
FILES = ["flights.csv", "tracks.csv", "tracks.png", "summary.json"]


def scenario_in(folder, name="short"):
    file = folder / f"{name}.yaml"
    file.write_text(SCENARIO)
    return file


def test_two_shards_joined_are_the_same_bytes_as_one_process(tmp_path):
    scenario = scenario_in(tmp_path)
    done = run("campaign", "--output", tmp_path / "campaign", "--seeds", "1..5", "--shards", "2", scenario)
    assert done.returncode == 0, done.stderr
    assert "| short | 5 |" in done.stdout and f"in {tmp_path}/campaign" in done.stdout and "flights passed" not in done.stdout
    whole = run("fly", "--scenario", scenario, "--seeds", "1..5", "--jobs", "2", "--output",
                tmp_path / "whole")
    assert whole.returncode == 0 and "0 of 5 flights passed: flights.csv" in whole.stdout and f"in {tmp_path}/whole" in whole.stdout, whole.stderr
    for name in FILES:
        assert (tmp_path / "campaign/short" / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name
    assert json.loads((tmp_path / "whole/summary.json").read_text())["flights"] == 5


def fly(scenario, folder, *arguments):
    return run("fly", "--scenario", scenario, "--no-pictures", "--output", folder, *arguments)


def test_shards_share_the_flights_of_a_draws_file(tmp_path):
    scenario, draws = scenario_in(tmp_path), tmp_path / "draws.csv"
    draws.write_text("seed\n" + "".join(f"{seed}\n" for seed in range(11, 15)))
    flown = []
    for shard in ("1/2", "2/2"):
        folder = tmp_path / shard[0]
        assert fly(scenario, folder, "--draws", draws, "--shard", shard).returncode == 0
        flown += [row["seed"] for row in csv.DictReader((folder / "flights.csv").open())]
    assert sorted(flown) == ["11", "12", "13", "14"]
    draws.write_text("seed\n")
    refused = fly(scenario, tmp_path / "none", "--draws", draws)
    assert refused.returncode == 2 and "no flights in it" in refused.stderr, refused.stderr


def test_the_summary_says_what_was_flown(tmp_path):
    params = tmp_path / "params.yaml"
    params.write_text("vehicle: {half_width_m: 0.3}\nwindow_detector: {max_rate_hz: 3, reference: {picture: /my/window.png}}\n"
                      "setpoint_guard: {max_speed_mps: 0.1}\ningress_navigator: {rate_hz: 30, max_silence_sec: 0.2, navigator: {limits: {speed_mps: 0.5}}}\n")
    scenario = scenario_in(tmp_path)
    done = fly(scenario, tmp_path / "out", "--seeds", "4..6", "--params", params)
    assert done.returncode == 0 and "the file says a vehicle of 0.4 x 0.6 x 0.14 m, the world has 0.4 x 0.4 x 0.14 m" in done.stderr, done.stderr
    assert "fly: warning: window_detector/reference is not used" in done.stderr
    assert "fly: warning: not used, because no nodes run: ingress_navigator/max_silence_sec, setpoint_guard/max_speed_mps, window_detector/max_rate_hz\n" in done.stderr
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    assert all(f"fly: warning: {warning}\n" in done.stderr for warning in summary["warnings"]) and len(summary["warnings"]) == 3
    version = re.search(r"VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text().split("project(")[1]).group(1)
    assert {key: summary[key] for key in ("scenario", "seeds", "draws", "params", "pictures", "version")} == {
        "scenario": str(scenario), "seeds": "4..6", "draws": "", "params": str(params), "pictures": False, "version": version}


def test_what_is_not_simulated_without_images_is_said(tmp_path):
    params, closed = tmp_path / "params.yaml", tmp_path / "closed.yaml"
    params.write_text("window_detector: {detector: {min_score: 1.0}}\ningress_navigator: {navigator: {commit: {glass: possible}}}\n")
    closed.write_text(SCENARIO + "window: {closed_by: board}\n")
    ignored, shut = "not used with --no-pictures: ingress_navigator/navigator/commit/glass, window_detector/detector/min_score", "the window is closed"
    for scenario, wanted in ((scenario_in(tmp_path), [ignored]), (closed, [ignored + "; " + shut])):
        checked = run("fly", "--scenario", scenario, "--params", params, "--no-pictures", "--check")
        assert checked.returncode == 0 and all(f"fly: warning: {text}" in checked.stderr for text in wanted), checked.stderr
    assert ignored not in run("fly", "--scenario", closed, "--params", params, "--check").stderr
    in_vain = "nobody is there to answer ~confirm_opening"
    assert in_vain in run("fly", "--scenario", scenario_in(tmp_path), "--check").stderr
    excluded = tmp_path / "excluded.yaml"
    excluded.write_text(SCENARIO + "glass: excluded\n")
    for scenario, options in ((excluded, []), (scenario_in(tmp_path), ["--no-pictures"]), (closed, [])):
        assert in_vain not in run("fly", "--scenario", scenario, *options, "--check").stderr
    done = run("campaign", "--no-pictures", "--seeds", "1..2", "--output", tmp_path / "out", closed, scenario_in(tmp_path))
    assert done.returncode == 0 and f"Warning: {shut}, which nobody sees with --no-pictures (closed)\n" in done.stdout, done.stdout
    assert json.loads((tmp_path / "out/short/summary.json").read_text())["median_time_s"] is None, "none passed"


def test_flights_are_overwritten_only_where_asked_for(tmp_path):
    scenario, out = scenario_in(tmp_path), tmp_path / "out"
    assert fly(scenario, out, "--seeds", "1..3").returncode == 0
    before = {name: (out / name).read_bytes() for name in FILES}
    again = fly(scenario, out, "--seeds", "1..2")
    assert again.returncode == 2 and "--resume" in again.stderr and "--overwrite" in again.stderr and str(out) in again.stderr
    assert fly(scenario, out, "--seeds", "1..2", "--overwrite", "--resume").returncode == 2
    assert {name: (out / name).read_bytes() for name in FILES} == before
    assert fly(scenario, out, "--seeds", "1..2", "--overwrite").returncode == 0
    assert json.loads((out / "summary.json").read_text())["seeds"] == "1..2"


def test_a_campaign_is_overwritten_only_where_asked_for(tmp_path):
    command = [ROOT / "tools/campaign", "--output", tmp_path, "--seeds", "1..2", "--shards", "1", "--no-pictures", scenario_in(tmp_path)]
    assert call(*command).returncode == 0
    again = call(*command)
    assert again.returncode == 2 and "--overwrite" in again.stderr and "short" in again.stderr
    assert call(*command, "--overwrite").returncode == 0


def test_the_table_says_with_which_parameters_and_what_of_them_does_not_count(tmp_path):
    racer = tmp_path / "racer.yaml"
    racer.write_text("vehicle: {half_width_m: 0.35}\n")
    out = ("campaign", "--no-pictures", "--seeds", "1..2", "--output", tmp_path / "out")
    assert run(*out, "--params", racer, scenario_in(tmp_path)).returncode == 0
    table = (tmp_path / "out/table.md").read_text()
    assert f"Flown with `--params {racer}`" in table and "Warning: the file says a vehicle of" in table, table
    other = run(*out, scenario_in(tmp_path, "other"))
    assert other.returncode == 2 and "holds the table of another campaign" in other.stderr
    assert (tmp_path / "out/table.md").read_text() == table
    resumed = run(*out, "--resume", scenario_in(tmp_path, "other"))
    assert resumed.returncode == 2 and "holds short, too" in resumed.stderr and (tmp_path / "out/table.md").read_text() == table
    assert run(*out, "--overwrite", scenario_in(tmp_path, "other")).returncode == 0


def test_ctrl_c_says_how_to_go_on_and_what_goes_on_is_the_same_bytes(tmp_path):
    scenario, out, total = scenario_in(tmp_path), tmp_path / "out", 3000
    command = [ROOT / "scripts/run", "fly", "--scenario", scenario, "--no-pictures", "--seeds", f"1..{total}", "--jobs", "2", "--output", out]
    process = subprocess.Popen([str(part) for part in command], stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # which a script's background ignores
    assert process.stderr.readline() == f"0 of {total} flights so far\n"  # before the first has ended: one with images takes a while
    assert f" of {total} flights, " in process.stderr.readline()
    process.send_signal(signal.SIGINT)
    spoken = process.communicate(timeout=60)[1]
    assert "fly: stopping after the running flights (Ctrl-C again: at once)\n" in spoken
    last = spoken.splitlines()[-1]
    said = re.fullmatch(rf"fly: (\d+) of {total} flown and summed up, continue with --resume", last)
    assert process.returncode == 1 and said, last
    flown = len((out / "flights.csv").read_text().splitlines()) - 1
    summary = json.loads((out / "summary.json").read_text())
    assert flown == int(said.group(1)) == summary["flights"] and (out / "tracks.png").exists()
    wanted = ["--seeds", f"1..{flown + 5}"]
    resumed = fly(scenario, out, *wanted, "--resume")
    assert f"{flown} of {flown + 5} flights are there; seed " in resumed.stderr.splitlines()[0]  # before it flies
    counts = [[*map(int, found)] for found in re.findall(r"^(\d+) of (\d+) flights, (\d+) passed", resumed.stderr, flags=re.M)]
    assert resumed.returncode == 0 and [done for done, *_ in counts] == [flown + i for i in range(1, 6)], resumed.stderr
    assert all(passed <= done <= of == flown + 5 for done, of, passed in counts), resumed.stderr
    assert f"{flown + 5} of {flown + 5} flights are there, none is left to fly; seed " in fly(scenario, out, *wanted, "--resume").stderr
    assert fly(scenario, tmp_path / "whole", *wanted).returncode == 0
    for name in FILES:
        assert (out / name).read_bytes() == (tmp_path / "whole" / name).read_bytes(), name


def test_flights_of_something_else_are_not_gone_on_with(tmp_path):
    scenario, out = scenario_in(tmp_path), tmp_path / "out"
    assert fly(scenario, out, "--seeds", "1..3").returncode == 0
    before = {name: (out / name).read_bytes() for name in FILES}
    fewer = fly(scenario, out, "--seeds", "1..2", "--resume")
    assert fewer.returncode == 2 and "seed 3" in fewer.stderr
    scenario.write_text(SCENARIO.replace("[2, 3]", "[3, 4]").replace("limit_sec: 1.0", "limit_sec: 1.1"))
    other = fly(scenario, out, "--seeds", "1..5", "--resume")
    assert other.returncode == 2 and f"{out} holds flights with another --scenario, --params, --draws or --no-pictures" in other.stderr
    assert fly(scenario, tmp_path / "whole", "--join", out).returncode == 2
    (out / "flown_with.txt").unlink()  # as another build
    other = fly(scenario, out, "--seeds", "1..5", "--resume")
    assert other.returncode == 2 and "seed 3 flown again ends differently" in other.stderr
    assert {name: (out / name).read_bytes() for name in FILES} == before


def test_flights_with_other_parameters_are_not_gone_on_with_even_if_the_last_one_ends_alike(tmp_path):
    scenario, out, params = scenario_in(tmp_path), tmp_path / "out", tmp_path / "params.yaml"
    params.write_text("vehicle: {half_width_m: 0.2}\n")
    assert fly(scenario, out, "--seeds", "1..3", "--params", params).returncode == 0
    assert fly(scenario, out, "--seeds", "1..4", "--params", params, "--resume").returncode == 0
    params.write_text("vehicle: {half_width_m: 0.02}\n")
    other = fly(scenario, out, "--seeds", "1..5", "--params", params, "--resume")
    assert other.returncode == 2 and f"give those that {out}/flown_with.txt shows" in other.stderr, other.stderr


def test_flights_with_and_without_images_are_not_mixed(tmp_path):
    command = [ROOT / "tools/campaign", "--output", tmp_path, "--seeds", "1..2", "--shards", "1", scenario_in(tmp_path)]
    assert call(*command, "--no-pictures").returncode == 0
    assert "Flown with `--no-pictures`." in (tmp_path / "table.md").read_text()
    mixed = call(*command, "--resume")
    assert mixed.returncode == 1 and "--no-pictures" in mixed.stderr, mixed.stderr
    assert not (tmp_path / "table.md").exists()
    assert json.loads((tmp_path / "short/summary.json").read_text())["pictures"] is False


def test_a_campaign_that_was_broken_off_goes_on(tmp_path):
    scenario = scenario_in(tmp_path)
    scenario.write_text(SCENARIO + "glass: excluded\n")
    command = [ROOT / "tools/campaign", "--output", tmp_path, "--seeds", "1..2", "--shards", "2", scenario]
    assert call(*command).returncode == 0
    kept, lost = (tmp_path / "short/shards" / name / "summary.json" for name in ("1_of_2", "2_of_2"))
    before = kept.stat().st_mtime_ns
    lost.unlink()
    assert call(*command, "--resume").returncode == 0
    assert lost.exists() and kept.stat().st_mtime_ns == before
    command[command.index("1..2")] = "1..4"
    assert call(*command, "--resume").returncode == 0  # as after Ctrl-C: summed up, and not all of them
    assert json.loads((tmp_path / "short/summary.json").read_text())["seeds"] == "1..4"
    assert not call(*command, "--resume").stderr


def test_a_campaign_that_is_broken_off_before_its_first_flight_has_ended_goes_on(tmp_path):
    scenario, out = scenario_in(tmp_path), tmp_path / "out"
    scenario.write_text("time_limit_sec: 60.0\n")  # of the usual camera: takes seconds
    command = [str(word) for word in (ROOT / "tools/campaign", "--output", out, "--seeds", "1..2", "--shards", "2", scenario)]
    campaign = subprocess.Popen(command, stderr=subprocess.PIPE, text=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    shards = [out / f"short/shards/{i}_of_2/flights.csv" for i in (1, 2)]
    end = time.monotonic() + 30.0
    while time.monotonic() < end and not all(file.is_file() and file.stat().st_size for file in shards):
        time.sleep(0.05)
    campaign.send_signal(signal.SIGINT)
    assert "campaign: broken off; the table comes when all is flown: go on with --resume\n" in campaign.communicate(timeout=60)[1] and campaign.returncode == 1
    assert not [line for line in call("ps", "-eo", "args").stdout.splitlines() if "bin/fly" in line and str(out) in line], "flies on"
    scenario.write_text(SCENARIO)
    resumed = call(*command, "--resume")
    assert resumed.returncode == 0 and "| short | 2 |" in resumed.stdout, resumed.stderr


def test_flights_whose_header_was_cut_off_are_refused_with_what_to_do(tmp_path):
    scenario, out = scenario_in(tmp_path), tmp_path / "out"
    for name, text in (("flights.csv", "seed,outc"), ("flights.csv", ""), ("tracks.csv", "seed,ti")):
        assert fly(scenario, out, "--seeds", "1..2", "--overwrite").returncode == 0
        (out / name).write_text(text)
        done = fly(scenario, out, "--seeds", "1..2", "--resume")
        assert done.returncode == 2 and f"{name}:" in done.stderr and ("cut off" if text else "empty") in done.stderr, done.stderr
        assert done.stderr.endswith(f"to fly all of them anew: rm {out}/flights.csv\n"), done.stderr
        (out / "flights.csv").unlink()
        assert fly(scenario, out, "--seeds", "1..2", "--resume").returncode == 0


def test_nothing_is_flown_or_replaced_if_one_scenario_is_wrong(tmp_path):
    good, bad = scenario_in(tmp_path), tmp_path / "bad.yaml"
    (tmp_path / "out/short/shards").mkdir(parents=True)
    bad.write_text("start: {distance_m: 500}\n")
    done = run("campaign", "--output", tmp_path / "out", "--seeds", "1..2", "--overwrite", bad, good)
    assert done.returncode == 2 and done.stderr.count("distance_m = 500 is not within") == 1, done.stderr
    assert done.stderr.endswith(f"campaign: nothing flown: see what fly says above of {bad}\n"), done.stderr
    assert [file.name for file in (tmp_path / "out").rglob("*")] == ["short", "shards"]


def test_a_failed_shard_is_an_error_and_no_result(tmp_path):
    command = [ROOT / "tools/campaign", "--output", tmp_path, "--seeds", "1..2", "--shards", "1", scenario_in(tmp_path)]
    assert call(*command).returncode == 0
    (tmp_path / "short/shards/1_of_1/flights.csv").write_text("")
    (tmp_path / "short/shards/1_of_1/summary.json").unlink()
    done = call(*command, "--resume")
    assert done.returncode == 1 and f"campaign: the flights of {tmp_path}/short.yaml cannot be joined" in done.stderr, done.stderr
    assert not (tmp_path / "table.md").exists()


def test_scenarios_flown_elsewhere_are_left_out_with_a_line(tmp_path):
    external = ROOT / "config/scenarios/external.yaml"
    done = run("campaign", "--output", tmp_path / "out", "--seeds", "1..1", "--shards", "1", external, scenario_in(tmp_path))
    assert done.returncode == 0 and "external.yaml left out" in done.stderr and "| short | 1 |" in done.stdout, done.stderr
    assert run("campaign", "--output", tmp_path / "none", external).returncode == 2


def test_wrong_usage_says_what_to_do(tmp_path):
    scenario = scenario_in(tmp_path)
    for arguments, text in [([tmp_path / "none.yaml"], "no such file"), ([scenario, "--shards", "0"], "--shards"),
                            ([scenario, scenario], "same name"), ([scenario, "--seeds", "5..1"], "--seeds: 5..1"),
                            ([scenario, "--output", __file__], "no campaign's"),
                            ([scenario, "--sshloginfile", scenario], "must lie below")]:
        done = run("campaign", "--output", tmp_path / "out", *arguments)
        assert done.returncode == 2 and text in done.stderr, arguments


def test_a_folder_of_something_else_is_not_replaced(tmp_path):
    kept = tmp_path / "short" / "photo.jpg"
    kept.parent.mkdir()
    kept.write_text("")
    done = run("campaign", "--output", tmp_path, "--overwrite", scenario_in(tmp_path))
    assert done.returncode == 2 and f"{kept.parent} is there and no campaign's" in done.stderr and kept.exists()


def test_failures_are_kept_with_bag_and_picture(tmp_path):
    scenario = scenario_in(tmp_path)
    done = run("fly", "--scenario", scenario, "--seeds", "3", "--output", tmp_path / "out",
               "--keep-failures")
    assert done.returncode == 0, done.stderr
    bag = tmp_path / "out/failures/flight_3.bag"
    assert os.path.getsize(tmp_path / "out/failures/flight_3.png") > 1000
    info = run("rosbag", "info", bag)
    for topic in ("/camera/camera_info", "/camera/image_raw/compressed", "/cmd_vel", "/ground_truth/odom", "/imu", "/odom", "/state",
                  "/tf_static"):  # as sim.launch names them, and replay.launch expects them
        assert topic in info.stdout, info.stdout + info.stderr
