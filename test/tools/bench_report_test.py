"""The report of measurements whose ratios are known."""
import json
import sys

import pytest

import bench_report as report
from repository import call


def runs(name, milliseconds, found=1.0):
    return [{"run_name": name, "run_type": "iteration", "cpu_time": ms, "found": found} for ms in milliseconds]


def write_times(folder, track_ms=0.1, found=1.0):
    rows = (runs("search/brick_wall", [3.0, 2.0, 90.0]) + runs("track/brick_wall", [track_ms], found)
            + runs("composition/brick_wall", [24.0]) + runs("apriltag_decimate_2/brick_wall", [12.0])
            + runs("stage_edges/brick_wall", [0.5]))
    rows.append({"run_name": "aruco/brick_wall", "run_type": "iteration", "error_occurred": True})
    rows.append({"run_name": "search/brick_wall", "run_type": "aggregate", "cpu_time": 1.0})
    (folder / "times.json").write_text(json.dumps({"benchmarks": rows}))


def report_of(folder, *more):
    return call(sys.executable, report.__file__, folder, "--json", folder / "bench.json", *more)


def test_medians_not_means_and_no_aggregates(tmp_path):
    write_times(tmp_path)
    times = report.read_times(str(tmp_path))
    assert times["search/brick_wall"] == {"ms": 3.0, "fastest_ms": 2.0, "found": 1.0}
    assert "aruco/brick_wall" not in times


def test_ratios_are_ours_over_the_peer(tmp_path):
    write_times(tmp_path)
    done = report_of(tmp_path)
    assert done.returncode == 0, done.stderr
    ratios = json.loads((tmp_path / "bench.json").read_text())["ratios"]["brick_wall"]
    assert ratios["search"]["composition"] == pytest.approx(1 / 8)
    assert ratios["search"]["apriltag_decimate_2"] == pytest.approx(1 / 4)
    assert ratios["track"]["composition"] == pytest.approx(1 / 240)
    assert "1/240.0" in done.stdout and done.stdout.endswith("bench: no bound is broken\n")


def test_a_slow_track_breaks_the_bound(tmp_path):
    write_times(tmp_path, track_ms=2.6)
    done = report_of(tmp_path)
    assert done.returncode == 1
    assert "track on brick_wall" in done.stderr


def test_a_track_that_was_lost_is_no_track(tmp_path):
    write_times(tmp_path, track_ms=30.0, found=0.0)
    done = report_of(tmp_path)
    assert done.returncode == 1
    assert "track on brick_wall follows 0 %" in done.stderr
    assert "track" not in json.loads((tmp_path / "bench.json").read_text())["ratios"]["brick_wall"]


def test_instructions_are_those_of_an_image(tmp_path):
    folder = tmp_path / "callgrind"
    folder.mkdir()
    (folder / "counted.log").write_text(
        "search/brick pictures=2 found=0\ntrack/brick pictures=1 found=1\ntrack/lens pictures=2 found=0\n")
    (folder / "out.1").write_text("desc: Trigger: Client Request: search/brick\ntotals: 3000\n")
    (folder / "out.2").write_text("desc: Trigger: Client Request: track/brick\ntotals: 70\n")
    (folder / "out.4").write_text("desc: Trigger: Client Request: track/lens\ntotals: 900\n")
    (folder / "out.3").write_text("desc: Trigger: Program termination\ntotals: 5\n")
    assert report.read_instructions(str(tmp_path)) == {"search/brick": 1500, "track/brick": 70}


def test_document_keeps_what_is_outside_of_the_marks(tmp_path):
    write_times(tmp_path)
    doc = tmp_path / "doc.md"
    doc.write_text(f"before\n{report.BEGIN}\nold\n{report.END}\nafter\n")
    for _ in range(2):
        assert report_of(tmp_path, "--doc", str(doc)).returncode == 0
        text = doc.read_text()
        assert text.startswith("before\n") and text.endswith("\nafter\n") and "old" not in text
        assert text.count(report.BEGIN) == 1 and text.count("| brick_wall |") == 4


def test_document_without_marks_is_refused_and_kept(tmp_path):
    write_times(tmp_path)
    doc = tmp_path / "doc.md"
    doc.write_text("no marks\n")
    done = report_of(tmp_path, "--doc", str(doc))
    assert done.returncode == 2 and len(done.stderr.strip().splitlines()) == 1
    assert doc.read_text() == "no marks\n"


def write_all_times(folder):
    rows = [row for sequence, ms in (("plaster", 4.8), ("brick", 15.2), ("siding", 5.0), ("lens", 8.2))
            for row in runs(f"search/{sequence}", [ms]) + runs(f"track/{sequence}", [ms / 10]) + runs(f"apriltag_decimate_1/{sequence}", [20.0])]
    rows += runs("search/away", [48.0], found=0.0) + runs("track/away", [47.0], found=0.0)  # nothing is there: no bound is broken
    (folder / "times.json").write_text(json.dumps({"benchmarks": rows}))


def test_the_readme_gets_its_sentence_and_keeps_the_rest(tmp_path):
    write_all_times(tmp_path)
    readme = tmp_path / "README.md"
    readme.write_text("Here an image of 640 × 480 takes 1 to 2 ms to search and\n  9 ms; AprilTag 3 at full size takes 3 to 4 ms there. After.\n")
    assert report_of(tmp_path, "--readme", str(readme)).returncode == 0
    assert readme.read_text() == ("Here an image of 640 × 480 takes 5 to 15 ms to search, up to\n  10 times as long where the target is not in view but "
                                  "other rectangles are, and 0.5 to 2 ms once the window is tracked; AprilTag 3 at full size takes 20 to 20 ms there. After.\n")
    readme.write_text("nothing of it\n")
    assert report_of(tmp_path, "--readme", str(readme)).returncode == 2


def test_nothing_measured_is_said(tmp_path):
    done = report_of(tmp_path)
    assert done.returncode == 2
    assert "nothing" in done.stderr
