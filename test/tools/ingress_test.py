"""The command ingress: every sub-command leads to an existing tool, in a clone, in a workspace and installed."""
import os
import re
import shutil
import subprocess

import pytest

from repository import ROOT, call, load

SCRIPTS = ROOT / "scripts"
INGRESS = SCRIPTS / "ingress"
ingress = load("scripts/ingress")


def complete(*words):
    return call(INGRESS, "--complete", *words).stdout.split()


@pytest.mark.parametrize("words", ingress.COMMANDS)
def test_the_target_is_part_of_the_package_and_installed(words):
    tool = ingress.COMMANDS[words][0]
    if (ROOT / "tools" / tool).is_file():  # all of them are installed
        assert os.access(ROOT / "tools" / tool, os.X_OK)
    else:
        assert (ROOT / "src/tools" / f"{tool}.cpp").is_file()


def test_a_reader_that_stops_early_sees_no_traceback():
    for _ in range(3):
        done = call("bash", "-c", f"{INGRESS} --help | true")
        assert done.stderr == ""


def test_what_report_cannot_read_is_said_with_what_can(tmp_path):
    done = call(INGRESS, "report", tmp_path, "--output", tmp_path / "out")
    assert done.returncode == 2 and "is a folder; give a bag" in done.stderr, done.stderr


@pytest.mark.parametrize("words", ingress.COMMANDS)
def test_wrong_usage_is_said_in_one_line(words):
    done = call(INGRESS, *words.split(), "--no-such-option")
    assert done.returncode == 2 and not done.stdout and len(done.stderr.splitlines()) == 1, done.stderr


@pytest.mark.parametrize("words", ingress.COMMANDS)
def test_help_has_one_shape(words):
    """Help says what the tool does, its usage, options, one example with existing options, and exit codes."""
    _, does, example = ingress.COMMANDS[words]
    done = call(INGRESS, *words.split(), "--help", cwd=ROOT)
    assert done.returncode == 0 and not done.stderr
    lines = done.stdout.splitlines()
    assert lines[0] == f"ingress {words}: {does}" and any(line.lower().startswith(f"usage: ingress {words} ") for line in lines), done.stdout
    assert f"Example: ingress {words} {example}" in lines and done.stdout.lower().count("exit code") == 1, done.stdout
    options = set(re.findall(r"(?<![\w-])--[a-z][\w-]*", done.stdout.replace(example, "")))
    assert set(re.findall(r"--[a-z][\w-]*", example)) <= options, done.stdout


def test_the_example_names_files_of_the_package_as_they_are_found_from_anywhere(tmp_path):
    example = next(line for line in call(INGRESS, "fly", "--help", cwd=tmp_path).stdout.splitlines() if line.startswith("Example: "))
    assert os.path.isfile(example.split("--scenario ")[1].split()[0]), example


def test_every_tool_has_a_command():
    tools = {file.stem for file in (ROOT / "src/tools").glob("*.cpp")}
    assert len(tools) > 10 and tools <= {tool for tool, _, _ in ingress.COMMANDS.values()}


@pytest.mark.parametrize("arguments", [[], ["--help"], ["-h"], ["help"]])
def test_alone_it_lists_all_commands_a_line_each(arguments):
    done = call(INGRESS, *arguments)
    assert done.returncode == 0
    for words, (_, text, _) in ingress.COMMANDS.items():
        if " " in words:
            group, member = words.split()
            assert re.search(rf"^  {group} .*\b{member}\b", done.stdout, flags=re.M), words
            assert re.search(rf"^  {member} +{re.escape(text)}$", call(INGRESS, group, "--help").stdout, flags=re.M), words
        else:
            assert re.search(rf"^  {words} +{re.escape(text)}$", done.stdout, flags=re.M), words


@pytest.mark.parametrize("words, nearest", [("flyy", "fly"), ("campain", "campaign"), ("plot fligt", "plot flight"), ("evaluate foto", "evaluate photos")])
def test_an_unknown_command_is_refused_with_the_nearest(words, nearest):
    done = call(INGRESS, *words.split())
    assert done.returncode == 2 and not done.stdout
    assert f"no command '{words}'; the nearest is '{nearest}'" in done.stderr and done.stderr.count("\n") == 1


@pytest.mark.parametrize("words", ingress.COMMANDS)
def test_a_tools_own_name_is_answered_with_its_command(words):
    tool = ingress.COMMANDS[words][0]
    if tool in ingress.names_after(None):
        return  # the command has the tool's name
    for name in (tool, os.path.splitext(tool)[0]):
        done = call(INGRESS, name)
        assert done.returncode == 2 and f"no command '{name}'; that tool is 'ingress {words}'" in done.stderr, done.stderr


def test_a_group_alone_says_what_it_has():
    done = call(INGRESS, "plot")
    assert done.returncode == 2 and "filter, flight, gusts" in done.stderr


def test_completion_lists_everything():
    assert complete("") == [*[words for words in ingress.COMMANDS if " " not in words], *ingress.GROUPS]
    assert complete("p") == ["print-window", "plot"]
    for group in ingress.GROUPS:
        assert complete(group, "") == [words.split()[1] for words in ingress.COMMANDS if words.startswith(f"{group} ")]
    assert "--sshloginfile" in complete("campaign", "--ss")
    assert not complete("campaign", "config/")  # bash completes files


def test_completion_in_bash():
    script = (f"source {SCRIPTS}/ingress_completion.bash; complete -p ingress >&2; COMP_WORDS=({INGRESS} plot mi); COMP_CWORD=2; "
              '_window_ingress_complete; echo "${COMPREPLY[@]}"; COMP_WORDS=(ingress_that_is_not_there x); COMP_CWORD=1; '
              '_window_ingress_complete; echo "${#COMPREPLY[@]}"')
    assert call("bash", "-c", script).stdout.split("\n")[:2] == ["miss", "0"]


def copy_of_the_modules(folder):
    shutil.copytree(ROOT / "tools/ingress_tools", folder / "ingress_tools")


def pretend(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    file.chmod(0o755)


FLY = '#!/bin/sh\necho "$0 flies $*"\nexit 7\n'


def flies(program, fly, **environment):
    done = call(program, "fly", "--seeds", "1..2", env={"PATH": os.environ["PATH"], **environment})
    assert (done.returncode, done.stdout) == (7, f"{fly} flies --seeds 1..2\n"), done.stderr


def test_installed_it_runs_the_tools_beside_it(tmp_path):
    library = tmp_path / "lib/window_ingress"
    pretend(library / "fly", FLY)
    shutil.copy(INGRESS, library)
    copy_of_the_modules(library)
    flies(library / "ingress", library / "fly")
    (tmp_path / "bin").mkdir()
    shutil.copy(INGRESS, tmp_path / "bin")
    flies(tmp_path / "bin/ingress", library / "fly")


def test_in_a_workspace_it_runs_the_tools_of_the_workspace(tmp_path):
    relay = (f"#!/usr/bin/env python3\nfile = {str(INGRESS)!r}\n"
             "exec(compile(open(file).read(), file, 'exec'), {'__file__': file, '__name__': '__main__'})\n")  # like catkin's relay
    library = tmp_path / "devel/lib/window_ingress"
    pretend(library / "fly", FLY)
    for folder in (tmp_path / "devel/bin", library):
        pretend(folder / "ingress", relay)
        flies(folder / "ingress", library / "fly")
    source = tmp_path / "src/window_ingress/scripts"
    source.mkdir(parents=True)
    for name in ("ingress", "run", "env.sh"):
        shutil.copy(SCRIPTS / name, source)
    copy_of_the_modules(source.parent / "tools")
    flies(source / "ingress", library / "fly", CMAKE_PREFIX_PATH=f"{tmp_path}/other:{tmp_path}/devel")
    done = call(source / "run", "fly", "--seeds", "3", env={"PATH": os.environ["PATH"], "CMAKE_PREFIX_PATH": f"{tmp_path}/devel"})
    assert (done.returncode, done.stdout) == (7, f"{library}/fly flies --seeds 3\n")


def test_what_is_not_built_is_named(tmp_path):
    shutil.copy(INGRESS, tmp_path)
    copy_of_the_modules(tmp_path)
    done = call(tmp_path / "ingress", "fly", env={"PATH": os.environ["PATH"]})
    assert done.returncode == 2 and "'fly' is not installed" in done.stderr


@pytest.mark.parametrize("tool, arguments, what", [
    ("survey_filter", ["--runs", "100000"], "100000 approaches"), ("survey_openness", ["--open", "100000"], "100000 approaches"),
    ("survey_detector", ["--scenario", ROOT / "config/scenarios/brick.yaml", "--frames", "100000"], "100000 images"),
    ("survey_tracker", ["--scenario", ROOT / "config/scenarios/nominal.yaml", "--flights", "100000"], "100000 flights")])
def test_what_takes_long_says_how_long(tmp_path, tool, arguments, what):
    command = [ROOT / "scripts/run", tool, *arguments, "--output", tmp_path / "out"]
    with subprocess.Popen([str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
        said = process.stderr.readline()
        process.kill()
    assert re.fullmatch(rf"{tool}: \d+ of {what}, \d+ s left\n", said), said


def test_run_keeps_a_workspace_that_is_sourced(tmp_path):
    messages = tmp_path / "devel/lib/python3/dist-packages"
    messages.mkdir(parents=True)
    (tmp_path / "devel/.catkin").write_text(f"{tmp_path}/src")
    sourced = {**os.environ, "CMAKE_PREFIX_PATH": f"{tmp_path}/devel", "PYTHONPATH": str(messages), "ROS_PACKAGE_PATH": f"{tmp_path}/src"}
    done = call(SCRIPTS / "run", "env", env=sourced)
    for name in ("CMAKE_PREFIX_PATH", "PYTHONPATH", "ROS_PACKAGE_PATH"):
        paths = next(line for line in done.stdout.splitlines() if line.startswith(name + "=")).split("=", 1)[1].split(":")
        assert sourced[name] in paths and len(paths) > 1, name
