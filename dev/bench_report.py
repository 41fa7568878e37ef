#!/usr/bin/env python3
"""Writes the measurements of scripts/bench to a JSON file and prints tables; exits 1 if a bound does not hold."""
import argparse
import collections
import glob
import json
import os
import re
import statistics
import sys

OURS = ["search", "track"]
PEERS = {"composition": "composition", "composition_without_hough": "without Hough",
         "apriltag_decimate_2": "AprilTag 3, decimate 2", "apriltag_decimate_1": "AprilTag 3, decimate 1",
         "aruco": "ArUco"}
COMPARED = ["composition", "composition_without_hough", "apriltag_decimate_2", "aruco"]
# (ours, peer, sequences, largest allowed ratio of times). The bounds are wide, because a loaded machine must not break them.
# They detect regressions; the aims are lower, see doc/detection.md.
BOUNDS = [("track", "composition", ["plaster", "brick_wall", "flight"], 1 / 12), ("track", "composition", ["brick", "lens"], 1 / 7),
          ("search", "composition", ["brick_wall"], 1 / 2.2), ("search", "apriltag_decimate_2", ["brick_wall"], 1 / 1.6)]
POSE_METHODS = {"ours": "ours: both solutions, spreads, aspect, attitude", "ours_size_unknown": "ours, size unknown",
                "ippe": "solvePnP IPPE", "iterative": "solvePnP ITERATIVE", "homography": "findHomography, decomposed"}
POSE_LIMIT_US = 150.0
LEAST_FOLLOWED = 0.9  # share of the images; a search in every image is no track
STAGES = ["preprocess", "edges", "lines", "closing", "contours", "segment_quads", "all_to_candidates",
          "appearance_of_all", "borders_of_one"]
OF_README = ["plaster", "brick", "siding", "lens"]  # 640 x 480
WITHOUT_TARGET = "away"  # sequence without a target
ROW = re.compile(r"an image of 640 × 480 takes .*? AprilTag 3 at full size takes .*? there", re.S)
BEGIN, END = "<!-- measured: begin -->", "<!-- measured: end -->"


def load(path, otherwise):
    if not os.path.exists(path) or not os.path.getsize(path):
        return otherwise
    with open(path) as file:
        return json.load(file)


def read_times(folder, file="times.json"):
    """{"subject/sequence": {"ms", "fastest_ms", "found"}}: processor time, median over the repetitions."""
    runs = collections.defaultdict(list)
    raw = load(os.path.join(folder, file), {"benchmarks": []})
    for run in raw["benchmarks"]:
        if run["run_type"] == "iteration" and not run.get("error_occurred"):
            runs[run["run_name"]].append(run)
    return {name: {"ms": statistics.median(run["cpu_time"] for run in of_name),
                   "fastest_ms": min(run["cpu_time"] for run in of_name),
                   "found": statistics.mean(run["found"] for run in of_name)} for name, of_name in runs.items()}


def followed_times(times):
    return {name: of["ms"] for name, of in times.items() if not is_lost(name, of["found"])}


def read_instructions(folder):
    """{"subject/sequence": instructions per image}, without lost tracks."""
    counted = os.path.join(folder, "callgrind", "counted.log")
    if not os.path.exists(counted):
        return {}
    with open(counted) as file:
        lines = [re.match(r"(\S+) pictures=(\d+) found=(\d+)", line).groups() for line in file]
    images = {name: int(count) for name, count, found in lines if not is_lost(name, int(found) / int(count))}
    result = {}
    for path in glob.glob(os.path.join(folder, "callgrind", "out.*")):
        with open(path, errors="replace") as file:
            text = file.read()
        name = re.search(r"Client Request: (\S+)", text)
        total = re.search(r"^(?:totals|summary): (\d+)", text, re.M)
        if name and total and name.group(1) in images:
            result[name.group(1)] = round(int(total.group(1)) / images[name.group(1)])
    return result


def is_lost(name, found):
    return name.startswith("track/") and found < LEAST_FOLLOWED


def ratios_of(costs):
    """{sequence: {ours: {peer: cost of ours over cost of peer}}}"""
    result = collections.defaultdict(lambda: collections.defaultdict(dict))
    for name, cost in sorted(costs.items()):
        subject, sequence = name.split("/")
        for peer in COMPARED if subject in OURS else ():
            if costs.get(f"{peer}/{sequence}"):
                result[sequence][subject][peer] = cost / costs[f"{peer}/{sequence}"]
    return result


def sequences_of(costs):
    return sorted({name.split("/")[1] for name in costs})


def table(title, head, rows):
    lines = [title, "", "| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return lines + ["| " + " | ".join(row) + " |" for row in rows] + [""]


def as_fraction(ratio):
    if ratio is None:
        return "–"
    return f"1/{1 / ratio:.1f}" if ratio < 1 else f"{ratio:.1f}"


def cost_table(title, costs, form):
    columns = [name for name in OURS + list(PEERS) if any(key.startswith(name + "/") for key in costs)]
    rows = [[sequence] + [form(costs.get(f"{name}/{sequence}")) for name in columns] for sequence in sequences_of(costs)]
    return table(title, ["images"] + [PEERS.get(name, name) for name in columns], rows)


def ratio_table(title, ratios):
    rows, head = [], ["images"]
    peers = [peer for peer in COMPARED if any(peer in of_ours for s in ratios.values() for of_ours in s.values())]
    ours = [name for name in OURS if any(name in of_sequence for of_sequence in ratios.values())]
    head += [f"{name} / {PEERS[peer]}" for name in ours for peer in peers]
    for sequence, of_sequence in sorted(ratios.items()):
        rows.append([sequence] + [as_fraction(of_sequence.get(name, {}).get(peer)) for name in ours for peer in peers])
    return table(title, head, rows)


def found_table(times):
    columns = OURS + ["composition", "composition_without_hough"]
    rows = [[sequence] + [percent(times.get(f"{name}/{sequence}", {}).get("found")) for name in columns]
            for sequence in sequences_of(times)]
    head = ["images", "search: something found", "track: followed"]
    return table("What came of it, % of the images", head + [f"{PEERS[name]}: something found" for name in columns[2:]], rows)


def stage_table(times):
    rows = [[sequence] + [milliseconds(times.get(f"stage_{stage}/{sequence}", {}).get("ms")) for stage in STAGES]
            for sequence in sequences_of(times)]
    return table("Stages, ms an image", ["images"] + [stage.replace("_", " ") for stage in STAGES], rows)


def percent(value):
    return "–" if value is None else f"{100 * value:.0f}"


def milliseconds(value):
    return "–" if value is None else f"{value:.2f}" if value >= 0.1 else f"{value:.3f}"


def millions(value):
    return "–" if value is None else f"{value / 1e6:.1f}" if value >= 1e6 else f"{value / 1e6:.2f}"


def read_pose_times(folder):
    """{method: microseconds}"""
    per_ms = {"ns": 1e-6, "us": 1e-3, "ms": 1.0}
    raw = load(os.path.join(folder, "pose.json"), {"benchmarks": []})
    to_us = 1e3 * per_ms[raw["benchmarks"][0]["time_unit"]] if raw["benchmarks"] else 1.0
    return {name.split("/")[1]: of["ms"] * to_us for name, of in read_times(folder, "pose.json").items()}


def pose_table(pose):
    rows = [[POSE_METHODS[name], f"{pose[name]:.0f}", as_fraction(pose["ours"] / pose[name])]
            for name in POSE_METHODS if name in pose]
    return table("Pose from one image, microseconds", ["method", "time", "ours / it"], rows)


def allocation_table(allocations):
    rows = [[name.replace("/", ", "), f"{a['ours']:.1f}", f"{a['opencv']:.1f}", f"{a['bytes'] / 1e3:.0f}"]
            for name, a in allocations.items() if name.split("/")[0] in OURS]
    return table("Allocations an image in steady state", ["what", "ours", "inside OpenCV", "kB of all"], rows)


def memory_lines(memory, node):
    lines = []
    for what, of in (("search and track", memory), ("detector node", node)):
        if of:
            lines.append(f"Memory of {what}, {of['pictures']} images: {of['start_mb']:.0f} MB at the start, "
                         f"{of['tenth_mb']:.0f} MB after a tenth, {of['end_mb']:.0f} MB at the end.")
    return lines + [""] if lines else []


def broken_bounds(ratios, times, pose):
    broken = []
    if pose and pose["ours"] > max(POSE_LIMIT_US, pose["iterative"]):
        broken.append(f"pose: {pose['ours']:.0f} us, more than {POSE_LIMIT_US:.0f} us and than solvePnP ITERATIVE")
    for ours, peer, sequences, limit in BOUNDS:
        for sequence in sequences:
            ratio = ratios.get(sequence, {}).get(ours, {}).get(peer)
            if ratio is not None and ratio > limit:
                broken.append(f"{ours} on {sequence}: {as_fraction(ratio)} of {PEERS[peer]}, more than {as_fraction(limit)}")
    for name, of in times.items():
        if is_lost(name, of["found"]) and name != f"track/{WITHOUT_TARGET}":
            broken.append(f"{name.replace('/', ' on ')} follows {100 * of['found']:.0f} % of the images")
    return broken


def tables_of(result):
    lines = []
    if result["times"]:
        costs = followed_times(result["times"])
        lines += ratio_table("Ratios of processor time, same run", result["ratios"])
        lines += cost_table("Processor time, ms an image (medians; only their ratios carry over)", costs, milliseconds)
        lines += found_table(result["times"]) + stage_table(result["times"])
    if result["instructions"]:
        lines += ratio_table("Ratios of instructions", result["instruction_ratios"])
        lines += cost_table("Instructions, millions an image", result["instructions"], millions)
    if result["pose"]:
        lines += pose_table(result["pose"])
    if result["allocations"]:
        lines += allocation_table(result["allocations"])
    return lines + memory_lines(result["memory"], result["node"])


def write_doc(path, lines):
    with open(path) as file:
        text = file.read()
    if text.count(BEGIN) != 1 or text.count(END) != 1:
        refuse(f"{path}: {BEGIN} and {END} must each appear exactly once")
    before, rest = text.split(BEGIN)
    after = rest.split(END)[1]
    with open(path, "w") as file:
        file.write(before + BEGIN + "\n" + "\n".join(lines) + END + after)


def readme_row(costs):
    """Sentence of the README for the times {"subject/sequence": ms}."""
    def between(subject):
        of_all = [costs[f"{subject}/{sequence}"] for sequence in OF_README]
        return " to ".join(f"{ms:.0f}" if ms >= 1 else f"{ms:.1f}" for ms in (min(of_all), max(of_all))) + " ms"
    times = costs[f"search/{WITHOUT_TARGET}"] / min(costs[f"search/{sequence}"] for sequence in OF_README)
    return (f"an image of 640 × 480 takes {between('search')} to search, up to\n  {times:.0f} times as long where the target is not in view but other "
            f"rectangles are, and {between('track')} once the window is tracked; "
            f"AprilTag 3 at full size takes {between('apriltag_decimate_1')} there")


def write_readme(path, costs):
    with open(path) as file:
        text = file.read()
    if len(ROW.findall(text)) != 1:
        refuse(f"{path}: the sentence on the cost of an image must appear exactly once")
    with open(path, "w") as file:
        file.write(ROW.sub(readme_row(costs), text))


def refuse(text):
    print(f"bench_report: {text}", file=sys.stderr)
    sys.exit(2)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", help="folder that the benchmarks wrote")
    parser.add_argument("--json", required=True, help="file to write")
    parser.add_argument("--doc", help="Markdown file whose tables are replaced")
    parser.add_argument("--readme", help="Markdown file whose sentence on the cost of an image is replaced")
    arguments = parser.parse_args()
    folder = arguments.folder
    times, instructions = read_times(folder), read_instructions(folder)
    result = {"times": times, "ratios": ratios_of(followed_times(times)),
              "instructions": instructions, "instruction_ratios": ratios_of(instructions),
              "pose": read_pose_times(folder),
              "allocations": load(os.path.join(folder, "allocations.json"), {}),
              "memory": load(os.path.join(folder, "memory.json"), {}), "node": load(os.path.join(folder, "node.json"), {})}
    result["broken_bounds"] = broken_bounds(result["ratios"], times, result["pose"])
    with open(arguments.json, "w") as file:
        json.dump(result, file, indent=1)
    lines = tables_of(result)
    if not lines:
        refuse(f"{folder}: nothing was measured")
    print("\n".join(lines))
    if arguments.doc:
        write_doc(arguments.doc, lines)
    if arguments.readme:
        write_readme(arguments.readme, followed_times(times))
    for text in result["broken_bounds"]:
        print(f"bench: bound broken: {text}", file=sys.stderr)
    if not result["broken_bounds"]:
        print("bench: no bound is broken")
    sys.exit(1 if result["broken_bounds"] else 0)


if __name__ == "__main__":
    main()
