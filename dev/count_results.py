#!/usr/bin/env python3
"""Adds up check files and JUnit reports: lists what failed or was skipped, ends with "N passed, N failed".

Usage: count_results.py FOLDER... ; exits 1 if anything failed or nothing passed.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree


def of_report(path):
    """(name, outcome, text) of each test case of one JUnit file."""
    try:
        root = ElementTree.parse(path).getroot()
    except ElementTree.ParseError as error:
        yield path.name, "failed", f"unreadable report: {error}"
        return
    for case in root.iter("testcase"):
        name = f"{case.get('classname', '')}.{case.get('name', '')}"
        bad = case.find("failure") if case.find("failure") is not None else case.find("error")
        skipped = case.find("skipped")
        if bad is not None:
            yield name, "failed", (bad.get("message") or bad.text or "").strip().splitlines()[:1]
        elif skipped is not None or case.get("status") == "notrun" or case.get("result") == "skipped":
            yield name, "skipped", ((skipped.get("message") if skipped is not None else "") or "").strip()
        else:
            yield name, "passed", ""


def main():
    count = {"passed": 0, "failed": 0, "skipped": 0}
    for folder in map(pathlib.Path, sys.argv[1:]):
        for path in sorted(folder.rglob("*")):
            if path.suffix == ".xml":
                cases = of_report(path)
            elif path.is_file() and not path.suffix:
                cases = [(path.name, path.read_text().strip(), "")]
            else:
                continue
            for name, outcome, text in cases:
                count[outcome] += 1
                if outcome != "passed":
                    print(f"{outcome}: {name} {text}")
    if count["skipped"]:
        print(f"{count['skipped']} skipped, see above")
    print(f"{count['passed']} passed, {count['failed']} failed")
    sys.exit(1 if count["failed"] or not count["passed"] else 0)


if __name__ == "__main__":
    main()
