"""scripts/setup on other systems: which it supports, and its messages otherwise. apt and dpkg are replaced."""
import os
import pathlib
import re
import shutil

import pytest

from repository import call

SETUP = pathlib.Path(__file__).resolve().parents[2] / "scripts/setup"
LISTS = dict(re.findall(r'^(\w+)="\n([^"]*)"', SETUP.read_text(encoding="utf-8"), flags=re.M))
UNSTABLE = 'PRETTY_NAME="Debian GNU/Linux sid"\nID=debian\n'


def system(name, number):
    return f'PRETTY_NAME="{name} {number}"\nID={name}\nVERSION_ID="{number}"\n'


@pytest.fixture(name="setup")
def fixture_setup(tmp_path):
    """Calls scripts/setup on a system where nothing is installed, or everything but `missing`, and packages in `absent` do not
    exist. Returns (done, the packages that it installed)."""
    def install(os_release, *more, absent=(), missing=None):
        query = "exit 1" if missing is None else f'case " {" ".join(missing)} " in *" ${{!#}} "*) exit 1 ;; *) echo -n installed ;; esac'
        tools = {"dpkg-query": query, "id": "echo 0", "apt-get": f'echo "$@" >>{tmp_path}/apt',
                 "apt-cache": f'case " {" ".join(absent)} " in *" ${{!#}} "*) exit 100 ;; esac'}
        for name, text in tools.items():
            (tmp_path / name).write_text(f"#!/bin/bash\n{text}\n")
            (tmp_path / name).chmod(0o755)
        (tmp_path / "os-release").write_text(os_release)
        done = call(SETUP, *more, env={**os.environ, "PATH": f"{tmp_path}:/usr/bin:/bin", "OS_RELEASE": str(tmp_path / "os-release")})
        asked = (tmp_path / "apt").read_text().splitlines() if (tmp_path / "apt").exists() else []
        installed = [word for line in asked if line.startswith("install ") for word in line.split()[1:] if word[0] != "-"]
        return done, installed
    return install


@pytest.mark.parametrize("os_release, packages", [
    (system("debian", "12"), "debian"), (system("debian", "13"), "debian"), (UNSTABLE, "debian"),
    (system("ubuntu", "20.04"), "ubuntu_20_04"), (system("ubuntu", "22.04"), "debian")], ids=["12", "13", "unstable", "20.04", "22.04"])
def test_installs_its_list_and_what_is_asked_for(setup, os_release, packages):
    done, installed = setup(os_release, "doxygen")
    assert done.returncode == 0, done.stderr
    assert ("untried" in done.stderr) == ("22.04" in os_release)
    assert "libosmesa6-dev" in installed and installed == [*LISTS[packages].split(), "doxygen"]


@pytest.mark.parametrize("name, number, reason", [
    ("fedora", "42", ""), ("debian", "11", ""), ("ubuntu", "24.04", "no packages of ROS 1")])
def test_refuses_another_system_in_one_line(setup, name, number, reason):
    done, installed = setup(system(name, number))
    assert done.returncode == 2 and not installed
    assert done.stderr.count("\n") == 1 and done.stderr.startswith(f"setup: {name} {number} is not supported")
    assert "Debian 12 and 13" in done.stderr and "Ubuntu 20.04" in done.stderr and reason in done.stderr


def test_takes_egl_where_there_is_no_osmesa(setup):
    done, installed = setup(UNSTABLE, "doxygen", absent=["libosmesa6-dev"])
    assert done.returncode == 0 and "draws by EGL" in done.stdout
    expected = [package for package in LISTS["debian"].split() if package != "libosmesa6-dev"]
    assert installed == [*expected, "doxygen", "libegl-dev", "libegl-mesa0", "libgl1-mesa-dri"]


def test_has_nothing_to_do_where_egl_is_installed_and_there_is_no_osmesa(setup):
    done, installed = setup(UNSTABLE, absent=["libosmesa6-dev"], missing=["libosmesa6-dev"])
    assert done.returncode == 0 and not installed and not done.stdout
    done, installed = setup(system("debian", "12"), missing=["libosmesa6-dev"])
    assert done.returncode == 0 and installed == ["libosmesa6-dev"]


def test_names_what_the_system_does_not_have_and_installs_nothing(setup):
    done, installed = setup(UNSTABLE, absent=["libosmesa6-dev", "rviz", "parallel"])
    assert done.returncode == 2 and not installed
    assert "Debian GNU/Linux sid has no parallel rviz; nothing installed" in done.stderr


def test_an_option_is_none_of_apt(setup):
    done, installed = setup(system("debian", "12"), "--reinstall")
    assert done.returncode == 2 and not installed and "scripts/setup [MORE PACKAGES...]" in done.stderr


@pytest.mark.parametrize("option", ["-h", "--help"])
@pytest.mark.parametrize("script", ["setup", "build", "run", "test", "bench", "demo"])
def test_who_asks_a_script_for_help_gets_it(script, option):
    done = call(SETUP.parent / script, option)
    assert done.returncode == 0 and not done.stderr and f"scripts/{script}" in done.stdout


@pytest.mark.parametrize("script, arguments", [("build", ["--test"]), ("bench", ["fast"]), ("demo", ["5"]), ("test", ["pose"]), ("run", ["--x"]), ("run", [])])
def test_a_script_that_takes_no_such_argument_says_so_and_does_nothing(script, arguments):
    done = call(SETUP.parent / script, *arguments)
    assert done.returncode == 2 and not done.stdout and f"scripts/{script}" in done.stderr


@pytest.mark.parametrize("arguments", [["--seed"], ["--seed", "two"], ["--scenario"], ["--scenario", "nominal"]])
def test_the_demo_refuses_a_wrong_value_in_one_line_before_it_installs(arguments):
    done = call(SETUP.parent / "demo", *arguments)
    assert done.returncode == 2 and not done.stdout and done.stderr.startswith(f"demo: {arguments[0]} needs a "), done.stderr
    assert len(done.stderr.splitlines()) == 1


@pytest.mark.parametrize("arguments", [[], ["trixie"], ["trixie", "amd64", "--steps", "core,flight"], ["trixie", "amd64", "--florp"]])
def test_check_platform_refuses_what_it_cannot_do(arguments):
    done = call(SETUP.parents[1] / "dev/check_platform", *arguments)
    assert done.returncode == 2 and not done.stdout and "setup, core, unit, ros, ros_tests, demo" in done.stderr


@pytest.mark.parametrize("arguments, said", [(["--help"], "[SUITE [FILE.deb [MIRROR]]]"), (["trixie", "/none.deb"], "check_deb: no package /none.deb")])
def test_check_deb_refuses_what_it_cannot_do(arguments, said):
    done = call(SETUP.parents[1] / "dev/check_deb", *arguments)
    assert done.returncode == 2 and not done.stdout and said in done.stderr


def test_every_check_of_the_test_script_can_be_named():
    text = (SETUP.parent / "test").read_text(encoding="utf-8")
    assert re.findall(r"^check (\w+) ", text, flags=re.M) == text.splitlines()[2].split(": ")[1].split()


def test_an_installation_that_fails_leaves_nothing_in_the_repository(tmp_path):
    """dev/check_install with a build that fails half-way: roslaunch would find its files."""
    for folder in ("dev", "scripts", "build/ros"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "build/ros/CMakeCache.txt").write_text("")
    (tmp_path / "dev/check_install").write_bytes((SETUP.parents[1] / "dev/check_install").read_bytes())
    (tmp_path / "scripts/env.sh").write_text(f'root={tmp_path} build_ros={tmp_path}/build/ros\ncmake() {{ mkdir "$2/install"; return 1; }}\n')
    done = call("bash", tmp_path / "dev/check_install")
    assert done.returncode == 1 and not done.stderr
    assert [file.name for file in (tmp_path / "build/ros").iterdir()] == ["CMakeCache.txt"]


@pytest.mark.parametrize("folder, is_taken", [("my drone", False), ("ingress(1)", False), ("a:b", False), ("it's", False), ("v2+é_x-1.0", True)])
def test_a_clone_in_a_folder_that_catkin_cannot_take_is_refused_at_once(tmp_path, folder, is_taken):
    shutil.copytree(SETUP.parent, tmp_path / folder / "scripts")
    for script in ("setup", "build", "demo", "test"):
        done = call(tmp_path / folder / "scripts" / script, "--help")
        refused = f"{script}: catkin cannot build in '{tmp_path}/{folder}': move the clone to a path without blanks, quotes, brackets and the like\n"
        assert (done.returncode, done.stderr) == ((0, "") if is_taken else (2, refused))


@pytest.mark.parametrize("command, said", [
    (["run", "roslaunch", "window_ingress", "sim.launch"], "run: no nodes of window_ingress; is the package built? (scripts/build)\n"),
    (["run", "roslaunch9", "window_ingress", "sim.launch"], "run: no 'roslaunch9' here; ./scripts/setup installs ROS\n"),
    (["run", "fly"], "run: no tool, node or command 'fly'; is the package built? (scripts/build)\n")])
def test_who_comes_too_early_is_told_what_comes_before(tmp_path, command, said):
    shutil.copytree(SETUP.parent, tmp_path / "scripts")
    done = call(tmp_path / "scripts" / command[0], *command[1:], env={"PATH": "/usr/bin:/bin", "HOME": str(tmp_path)})
    assert done.returncode == 2 and done.stderr == said
