"""What doc/ros_api.md says of ROS 2: names that ROS 2 takes, and the core in a program without ROS."""
import re

import pytest

from repository import ROOT, call, run

INTERFACES = sorted(file for kind in ("msg", "srv", "action") for file in (ROOT / kind).glob(f"*.{kind}"))
EXAMPLE = ROOT / "test/install/without_ros"


@pytest.mark.parametrize("file", INTERFACES, ids=lambda file: file.name)
def test_names_are_valid_in_ros_2(file):
    assert re.fullmatch(r"[A-Z][A-Za-z0-9]*", file.stem)
    lines = [line.split("#")[0].strip() for line in file.read_text(encoding="utf-8").splitlines()]
    fields = [line.split(maxsplit=1) for line in lines if line and line != "---"]
    for _, rest in fields:
        name, is_constant = re.split(r"[\s=]", rest)[0], "=" in rest
        assert re.fullmatch(r"[A-Z](_?[A-Z0-9]+)*" if is_constant else r"[a-z](_?[a-z0-9]+)*", name), rest


def test_the_example_without_ros_flies():
    done = run("flies_without_ros")
    assert done.returncode == 0, done.stdout + done.stderr
    assert re.match(r"[A-Z]+, \d\.\d\d m before the window, -?\d\.\d\d m to the left of its axis$", done.stdout), done.stdout


def test_the_example_configures_with_the_core_as_part_of_it(tmp_path):
    done = call("cmake", "-S", EXAMPLE, "-B", tmp_path)
    assert done.returncode == 0 and "catkin" not in done.stdout, done.stdout + done.stderr
