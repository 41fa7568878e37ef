"""The fault matrix is complete, and its table agrees with the results."""
import re
import textwrap
import xml.etree.ElementTree as ElementTree

import pytest

from repository import ROOT, load

matrix = load("dev/fault_matrix")


def test_every_row_is_there_once_and_is_readable():
    rows = matrix.read_rows()
    assert [row["row"] for row in rows] == [f"M{i:02}" for i in range(1, 96)]
    assert {row["level"] for row in rows} == {"unit", "ros", "world"}
    assert all(row["fault"] and row["expected"] and row["node"] for row in rows)


def test_rows_name_tests_that_exist():
    sources = "".join(file.read_text() for file in (ROOT / "test").rglob("*_test.cpp"))
    for row in matrix.read_rows():
        for kind, name, *rest in map(str.split, matrix.tests_of(row)):
            if kind == "ros":
                assert any((ROOT / "test" / folder / name).is_file() for folder in ("faults/ros", "ros")), row
            elif kind == "command":
                assert (ROOT / "dev" / name).is_file() and (ROOT / "test/faults/ros" / f"{rest[0]}.py").is_file(), row
            elif kind == "world":
                assert any((ROOT / folder / name).is_file() for folder in ("test/faults/world", "config/scenarios")), row
            else:
                for wanted in rest[0].split(":"):
                    suite, test = ("Fault", wanted) if "." not in wanted else wanted.split(".")
                    assert re.search(rf"TEST(_F)?\({suite},\s+{test.strip('*')}", sources), (row, wanted)


def test_rows_are_chosen_by_number_level_and_node():
    rows = [{"row": "M01", "level": "unit", "node": "window_detector"}, {"row": "M12", "level": "ros", "node": "homography_pose"}]
    assert [row["row"] for row in matrix.chosen(rows, [])] == ["M01", "M12"]
    assert [row["row"] for row in matrix.chosen(rows, ["M1?"])] == ["M12"]
    assert [row["row"] for row in matrix.chosen(rows, ["unit"])] == ["M01"]
    assert [row["row"] for row in matrix.chosen(rows, ["pose"])] == ["M12"]
    with pytest.raises(matrix.Usage):
        matrix.chosen(rows, ["M99"])


REPORT = """<testsuites><testsuite name="Fault">
  <testcase name="M01_Good" classname="Fault" status="run" time="0.5"><properties>
    <property name="seen" value="3 refused"/></properties></testcase>
  <testcase name="M02_Bad" classname="Fault" status="run" time="0.1"><failure message="Value of: x&#10;expected 3"/></testcase>
  <testcase name="M03_Left" classname="Fault" result="skipped" status="run" time="0"/>
  <testcase name="test_crash" classname="a.Ros" time="1.5"><error type="X">Traceback (most recent call last):
  File "x.py", line 3
AssertionError: not within 20 s: odometry
</error></testcase></testsuite></testsuites>"""


@pytest.fixture
def cases(tmp_path):
    (tmp_path / "report.xml").write_text(REPORT)
    return {case.name.rsplit(".", 1)[-1]: case for case in matrix.cases_in(tmp_path)}


def test_outcomes_are_what_the_reports_say(cases):
    assert matrix.outcome_of([cases["M01_Good"]]) == matrix.Outcome(True, "3 refused", 0.5)
    failed = matrix.outcome_of([cases["M01_Good"], cases["M02_Bad"]])
    assert not failed.passed and "Value of: x expected 3" in failed.seen
    assert not matrix.outcome_of([cases["M03_Left"]]).passed, "a test that did not run shows nothing"
    assert not matrix.outcome_of([]).passed
    assert matrix.outcome_of([cases["test_crash"]]).seen == "a.Ros.test_crash: AssertionError: not within 20 s: odometry"


def test_an_unreadable_report_is_a_failure(tmp_path):
    (tmp_path / "report.xml").write_text("<testsuites>")
    assert not matrix.outcome_of(matrix.cases_in(tmp_path)).passed
    with pytest.raises(ElementTree.ParseError):
        ElementTree.parse(tmp_path / "report.xml")


def test_notes_come_back_by_row(tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "test" / "faults"))
    import fault_notes
    monkeypatch.setenv("FAULT_NOTES", str(tmp_path / "notes"))
    fault_notes.note("M15", "31 frames")
    fault_notes.note("M15", "0 restarts")
    monkeypatch.delenv("FAULT_NOTES")
    fault_notes.note("M16", "nobody asks")
    assert matrix.notes_in(tmp_path / "notes") == {"M15": "31 frames; 0 restarts"}


def row(number, **keys):
    return {"row": number, "fault": "a | b", "expected": "c", "node": "all", "level": "unit", **keys}


def test_no_row_is_left_out_silently():
    assert matrix.line_of(row("M01"), []).result == "no test"
    assert matrix.line_of(row("M01", why_not="needs hardware"), []).seen == "needs hardware"
    assert matrix.line_of(row("M01", test="unit faults X"), [])[2:4] == ("not run", "unit faults X")
    good, bad = matrix.Outcome(True, "fine", 1.0), matrix.Outcome(False, "it fell", 2.0)
    assert matrix.line_of(row("M01"), [good, good])[2:] == ("met", "fine; fine", 2.0)
    assert matrix.line_of(row("M01"), [good, bad])[2:] == ("NOT MET", "it fell", 3.0)
    assert "known (it fell)" in matrix.line_of(row("M01", why_not="known"), [bad]).seen


def test_the_document_keeps_rows_that_were_not_run(tmp_path):
    document = tmp_path / "faults.md"
    document.write_text(f"before\n{matrix.BEGIN}\n| M02 | old | met | long ago | 1.0 |\n{matrix.END}\nafter\n")
    rows = [row("M01"), row("M02"), row("M03")]
    matrix.write_document([matrix.line_of(rows[0], [matrix.Outcome(True, "fine", 1.0)])], rows, document)
    text = document.read_text()
    assert text.startswith("before\n") and text.endswith("\nafter\n")
    assert "| M01 | a \\| b | met | fine | 1.0 |" in text
    assert "long ago" in text and "| M03 | a \\| b | no test |" in text
    assert "2 of 3 rows met." in text
    document.write_text(textwrap.dedent("no marks"))
    with pytest.raises(matrix.Usage):
        matrix.write_document([], rows, document)
