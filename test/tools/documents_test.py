"""Documents: every link leads somewhere, every command can be pasted, those of the README run, and Doxygen reports nothing."""
import functools
import os
import pathlib
import re
import shlex
import shutil
import signal
import socket
import subprocess
import time
import xml.etree.ElementTree as ElementTree

import pytest

import bench_report
from repository import ROOT, call, load, run

DOCUMENTS = sorted([ROOT / "README.md", *ROOT.glob("doc/**/*.md")])
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")


def outside_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S))


def anchors(text):
    """Anchors as GitHub makes them from headings."""
    headings = re.findall(r"^#+ (.*)$", text, flags=re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def test_every_reason_of_refusal_is_explained():
    source = (ROOT / "src/detection/detection_trace.cpp").read_text(encoding="utf-8")
    names = set(re.findall(r'^    \{"(\w+)", "', source, flags=re.M)) - {"none", "unknown"}
    table = dict(re.findall(r"^\| `(\w+)` \| (.+) \|$", (ROOT / "doc/detection.md").read_text(encoding="utf-8"), flags=re.M))
    page = dict(re.findall(r'^    "(\w+)": "(.+)",$', (ROOT / "tools/report_replay.py").read_text(encoding="utf-8"), flags=re.M))
    assert len(names) > 15 and names <= set(table)
    assert page == {name: table[name] for name in page} and names <= set(page)


def test_the_readme_says_what_an_image_costs_as_the_benchmark_does():
    table = (ROOT / "doc/detection.md").read_text(encoding="utf-8").split("Processor time, ms an image")[1].split("\nWhat came")[0]
    rows = re.findall(r"^\| (\w+) \| ([\d.]+) \| ([\d.]+|–) \| [\d.]+ \| [\d.]+ \| [\d.]+ \| ([\d.]+) \| [\d.]+ \|$",
                      table, flags=re.M)
    costs = {f"{subject}/{sequence}": float(ms) for sequence, *times in rows
             for subject, ms in zip(("search", "track", "apriltag_decimate_1"), times) if ms != "–"}
    assert bench_report.readme_row(costs) in (ROOT / "README.md").read_text(encoding="utf-8")


FOREIGN = "No module named", "Using PYTHON_EXECUTABLE", "RLException", "exit code"  # what Python, CMake and roslaunch say


def longest_run(words, text):
    """Length of the longest sequence of `words` that occurs in `text`."""
    runs = ((begin, end) for begin in range(len(words)) for end in range(begin + 1, len(words) + 1))
    return max((end - begin for begin, end in runs if " ".join(words[begin:end]) in text), default=0)


def test_what_troubleshooting_quotes_is_said_somewhere():
    """At least half of the longest stretch without numbers and names: sources have formats for the rest."""
    sources = [file for folder in ("include", "src", "tools", "nodes", "scripts") for file in (ROOT / folder).rglob("*")]
    joined = " ".join(re.sub(r'"\s*\n\s*f?"', "", file.read_text(encoding="utf-8")) for file in sources
                      if file.is_file() and file.suffix in (".cpp", ".hpp", ".py", ""))
    text = re.sub(r"\s+", " ", joined)
    tables = re.findall(r"^\| said \|.*?\n\n", (ROOT / "doc/troubleshooting.md").read_text(encoding="utf-8"), flags=re.M | re.S)
    quoted = [quote for table in tables for row in table.splitlines()[2:] for quote in re.findall(r"`([^`]+)`", row.split(" | ")[0])
              if not quote.startswith((*FOREIGN, "check-frames"))]
    assert len(quoted) > 40
    for quote in quoted:
        words = max((piece.split() for piece in re.split(r"…|/\w[\w/]*|'[^']*'|[\d.]+|\b\w+_\w+\b|[():;,\[\]]", quote)), key=len)
        assert 2 * longest_run(words, text) >= len(words), quote


@pytest.mark.parametrize("document", DOCUMENTS, ids=lambda file: file.name)
def test_links_lead_somewhere(document):
    for link in LINK.findall(outside_code(document.read_text())):
        path, _, anchor = link.partition("#")
        if path.startswith(("http://", "https://")):
            continue
        target = (document.parent / path).resolve() if path else document
        assert target.exists(), f"{document.name}: {link}"
        assert not anchor or anchor in anchors(target.read_text()), f"{document.name}: {link}"


def test_one_thing_has_one_name():
    """Uses the glossary's terms: sign known, sign unknown."""
    folders = ("src", "include", "msg", "tools", "nodes")
    files = [*DOCUMENTS, *(file for folder in folders for file in (ROOT / folder).rglob("*") if file.is_file() and file.suffix != ".pyc")]
    others = re.compile(r"\b(sign open|side (open|certain)|signs?\b[^.;\n]*\bcertain)\b")
    assert not [f"{file}: {found[0]}" for file in files for found in others.finditer(file.read_text(encoding="utf-8"))]


def files_named(cell, *folders):
    """Names in backquotes that look like files. A name without a folder lies beside the previous one."""
    folder = ""
    for name in re.findall(r"`([\w/]+\.(?:hpp|cpp|py|cfg))`", cell):
        folder, _, file = name.rpartition("/") if "/" in name else (folder, "", name)
        yield f"{folder}/{file}", any((ROOT / root / folder / file).is_file() for root in folders)


def test_each_part_of_the_paper_names_files_and_tests_that_are_there():
    rows = re.findall(r"^\| P(\d+) \|[^|]*\|([^|]*)\|([^|]*)\|$", (ROOT / "doc/architecture.md").read_text(), flags=re.M)
    assert [int(row[0]) for row in rows] == list(range(1, 25))
    for number, file, test in rows:
        files = [*files_named(file, ".", "include/window_ingress", "src")]
        tests = [*files_named(test, ".", "test/unit")]
        assert files and tests and all(there for _, there in files + tests), f"P{number}: {files} {tests}"


def test_every_document_is_reached_from_the_readme():
    reached, ahead = set(), [ROOT / "README.md"]
    while ahead:
        document = ahead.pop()
        if document in reached or document.suffix != ".md":
            continue
        reached.add(document)
        ahead += [(document.parent / link.partition("#")[0]).resolve() for link in LINK.findall(document.read_text())
                  if not link.startswith(("http", "#"))]
    assert set(DOCUMENTS) <= reached, set(DOCUMENTS) - reached


def test_each_node_that_is_launched_stands_in_the_table():
    launched = {node.get("type") for file in ROOT.glob("launch/*.launch")
                for node in ElementTree.parse(file).getroot().iter("node") if node.get("pkg") == "window_ingress"}
    rows = re.findall(r"^\| `([\w.]+)` \|", (ROOT / "doc/ros_api.md").read_text(encoding="utf-8"), flags=re.M)
    assert launched | {file.name for file in ROOT.glob("nodes/*.py")} <= set(rows)


def test_doxygen_has_nothing_to_say(tmp_path):
    if not shutil.which("doxygen"):
        pytest.skip("doxygen is not installed")
    settings = (ROOT / "doc/Doxyfile").read_text() + f"\nOUTPUT_DIRECTORY = {tmp_path}\n"
    (tmp_path / "Doxyfile").write_text(settings)
    done = call("doxygen", tmp_path / "Doxyfile", cwd=ROOT, timeout=600)
    assert done.returncode == 0 and not done.stderr, done.stderr
    assert (tmp_path / "html/index.html").is_file()


# --- commands that are printed -------------------------------------------------------------------------------------
def printed_commands(document):
    blocks = re.findall(r"^ *```bash\n(.*?)^ *```", document.read_text(encoding="utf-8"), flags=re.M | re.S)
    lines = "\n".join(blocks).replace("\\\n", " ").replace("&&", "\n").splitlines()
    return [" ".join(shlex.split(line, comments=True)) for line in lines if shlex.split(line, comments=True)]


def readme_commands():
    return printed_commands(ROOT / "README.md")


INGRESS = load("scripts/ingress")
ROOMS = "scripts", "dev", "tools", "nodes"
ELSEWHERE = r"(roslaunch mavros|apt-get|rosrun gscam|rosrun plotjuggler) "  # of other packages
ROS = ("rosrun", "rostopic", "rosnode", "rosservice", "rosbag", "roslaunch")


@functools.lru_cache(maxsize=None)
def explained(tool):
    """All text about the tool's options: its help, or the source of a script."""
    script = next((ROOT / folder / tool for folder in ROOMS if (ROOT / folder / tool).is_file()), None)
    return script.read_text(encoding="utf-8") if script else run(tool, "--help").stdout


def arguments_of(launch_file):
    return {arg.get("name") for arg in ElementTree.parse(ROOT / "launch" / launch_file).getroot().findall("arg")}


@pytest.mark.parametrize("document", [file for file in DOCUMENTS if printed_commands(file)], ids=lambda file: file.name)
def test_printed_commands_can_be_pasted(document):
    """Checks, for the repository's folder after a build, that commands exist and have these options."""
    for command in printed_commands(document):
        if re.match(ELSEWHERE, command):
            continue
        first, *words = command.split()
        assert re.match(r"(\./)?(scripts|dev)/", first), f"{command}: does not begin with ./scripts/ or ./dev/"
        assert (ROOT / first).is_file(), command
        if first.endswith("/ingress"):
            tool, words = INGRESS.parse(words)
        else:
            tool = words.pop(0) if first.endswith("/run") else pathlib.Path(first).name
        if tool == "roslaunch":
            assert words[0] == "window_ingress" and {word.split(":=")[0] for word in words[2:]} <= arguments_of(words[1]), command
        elif tool not in ROS:
            options = {word.split("=")[0] for word in words if word.startswith("--")}
            assert explained(tool), f"{command}: no such tool"
            assert all(re.search(rf"{option}\b", explained(tool)) for option in options), command
        if tool == "rosservice":
            assert f"~{words[1].split('/')[-1]}`" in (ROOT / "doc/ros_api.md").read_text(encoding="utf-8"), command
        assert all((ROOT / word).exists() for word in words if word.startswith("config/") and "*" not in word), command


OVERLAYS = [(file.name, block) for file in DOCUMENTS
            for block in re.findall(r"^```yaml\n(.*?)^```", file.read_text(encoding="utf-8"), flags=re.M | re.S)
            if re.match(r"(#.*\n)*(vehicle|window_detector|homography_pose|ingress_navigator|setpoint_guard):", block)]


@pytest.mark.parametrize("document, text", OVERLAYS, ids=[document for document, _ in OVERLAYS])
def test_printed_parameter_files_can_be_given(document, text, tmp_path):
    text = text.replace("/home/me/window.png", str(ROOT / "doc/detection.png"))  # any picture that is there
    (tmp_path / document).with_suffix(".yaml").write_text(text)
    done = run("check_overlay", (tmp_path / document).with_suffix(".yaml"))
    assert done.returncode == 0, done.stderr


def checked_elsewhere(command, _):
    """Checks only the syntax of scripts that build, test or measure everything. scripts/test runs demo and
    check_install; bench, build_deb and check_deb take long and are run by hand."""
    done = call("bash", "-n", command.split()[0], cwd=ROOT)
    assert done.returncode == 0, done.stderr


def runs_a_tool(command, folder):
    """Runs this command with stand-ins for the user's files, fewer flights, and another output folder."""
    words = command.replace("1..20", "1..1").replace("out/demo/detection.png", "doc/detection.png").split()
    words = [str(folder / word) if word.startswith("out/") else word for word in words]
    done = call(*words, cwd=ROOT, timeout=600)
    assert done.returncode == 0, f"{words}\n{done.stderr}"


def launches(command, folder):
    (folder / "my_drone.yaml").write_text("homography_pose: {pose: {opening_width_m: 1.3, opening_height_m: 1.1}}\n"
                                          "vehicle: {half_length_m: 0.3, half_width_m: 0.3, half_height_m: 0.1}\n")
    shutil.copy(ROOT / "doc/detection.png", folder / "window.jpg")
    words = command.replace("/home/me", str(folder)).split()
    done = call(*words[:2], "--nodes", *words[2:], cwd=ROOT)
    assert done.returncode == 0 and "/setpoint_guard" in done.stdout, done.stderr


def calls_a_service(command, folder):
    """Calls a service of the nodes of the simulated world."""
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        port = probe.getsockname()[1]
    environment = {**os.environ, "ROS_MASTER_URI": f"http://localhost:{port}", "ROS_HOSTNAME": "localhost",
                   "ROS_HOME": str(folder), "ROS_LOG_DIR": str(folder / "log")}
    with open(folder / "launch.log", "w", encoding="utf-8") as log:
        launched = subprocess.Popen([ROOT / "scripts/run", "roslaunch", "-p", str(port), "window_ingress", "sim.launch"],
                                    env=environment, stdout=log, stderr=log)
    try:
        end = time.monotonic() + 60.0
        while True:
            done = call(*command.split(), cwd=ROOT, env=environment)
            if done.returncode == 0 or time.monotonic() > end:
                break
            time.sleep(0.5)  # until the nodes are up
        assert done.returncode == 0 and "message: " in done.stdout, done.stdout + done.stderr
    finally:
        launched.send_signal(signal.SIGINT)
        launched.wait(30)


def is_of_mavros(command, _):
    """MAVROS is not installed here: the command must be the same as on the page of autopilots."""
    assert f"{command} " in (ROOT / "doc/autopilots.md").read_text(encoding="utf-8")


CHECKS = [(r"roslaunch mavros ", is_of_mavros),
          (r"\./(scripts/(demo|test|bench|build)|dev/(build_deb|check_deb|check_install))\b", checked_elsewhere),
          (r"\./scripts/run roslaunch window_ingress", launches),
          (r"\./scripts/run rosservice call", calls_a_service),
          (r"\./scripts/(run|ingress) \w+", runs_a_tool)]


@pytest.mark.parametrize("command", readme_commands())
def test_commands_of_the_readme(command, tmp_path):
    checks = [check for pattern, check in CHECKS if re.match(pattern, command)]
    assert checks, f"no rule tells how to check: {command}"
    checks[0](command, tmp_path)
