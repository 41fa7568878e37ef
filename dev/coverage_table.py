#!/usr/bin/env python3
"""Line coverage by folder of src/: coverage_table.py COVERAGE.json; exits 1 if one of the core is below 90 %."""
import collections
import json
import sys

CORE = ["geometry", "parameters", "detection", "openness", "estimation", "facade", "navigation"]
LEAST = 90.0


def main():
    files = json.load(open(sys.argv[1], encoding="utf-8"))["files"]
    lines = collections.defaultdict(lambda: [0, 0])
    for file in files:
        folder = file["filename"].split("/")[1]
        for name in [folder] + (["core"] if folder in CORE else []):
            lines[name][0] += file["line_covered"]
            lines[name][1] += file["line_total"]
    print("| folder | lines | run | part |\n|---|---|---|---|")
    for name in [*CORE, "core", *sorted(set(lines) - {*CORE, "core"})]:
        ran, all_lines = lines[name]
        print(f"| {name} | {all_lines} | {ran} | {100.0 * ran / max(1, all_lines):.1f} % |")
    print("\nLeast covered files:", file=sys.stderr)
    for file in sorted(files, key=lambda f: f["line_percent"])[:15]:
        print(f"  {file['line_percent']:5.1f} % of {file['line_total']:4} {file['filename']}", file=sys.stderr)
    return 1 if any(lines[name][0] < LEAST / 100.0 * lines[name][1] for name in CORE) else 0


if __name__ == "__main__":
    sys.exit(main())
