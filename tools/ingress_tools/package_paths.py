"""Finds tools and files of the package: in a clone, in a catkin workspace, or installed."""
import os
import pathlib
import sys

TOOLS = pathlib.Path(__file__).resolve().parents[1]
ROOT = TOOLS.parent
RUN = ROOT / "scripts" / "run"  # only in a clone
PACKAGE = "window_ingress"


def is_clone():
    return RUN.is_file()


def share():
    """The folder that holds config/ and launch/."""
    return ROOT if is_clone() else ROOT.parent / "share" / PACKAGE


def folders():
    """Folders with programs, the nearest first."""
    called = pathlib.Path(os.path.abspath(sys.argv[0])).parent  # a devel space calls scripts through a relay
    yield from (called, called.parent / "lib" / PACKAGE)
    if is_clone():
        yield from (ROOT / "build/ros/devel/lib" / PACKAGE, ROOT / "build/core")
    yield TOOLS
    for prefix in filter(None, os.environ.get("CMAKE_PREFIX_PATH", "").split(":")):
        yield pathlib.Path(prefix) / "lib" / PACKAGE


def program(name):
    """The file of a tool or script; None if it is neither built nor installed."""
    for folder in folders():
        file = folder / name
        if file.is_file() and os.access(file, os.X_OK):
            return file
    return None


def command(name):
    """The command that runs a tool or script: in a clone with scripts/run, which sets up the environment."""
    file = program(name)
    if file is None:
        raise FileNotFoundError(f"'{name}' is not built" if is_clone() else f"'{name}' is not installed")
    its_own = is_clone() and ROOT in file.parents and (TOOLS == file.parent or ROOT / "build" in file.parents)
    return [str(RUN), name] if its_own else [str(file)]
