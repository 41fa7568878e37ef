"""Every program lies in the folder for its kind, and every path to it is right."""
import re

import pytest

from repository import ROOT, call

ROOMS = "scripts", "dev", "tools", "nodes"
PLACE = re.compile(rf"(?<![\w/.}}\])-])(?<!#include \")(?:\./)?((?:{'|'.join(ROOMS)})/\w[\w./]*\w)")
READ = "scripts", "dev", "tools", "nodes", "doc", "cmake", "launch", "config", "src", "test", ".ci"


def texts():
    files = [file for folder in READ for file in (ROOT / folder).rglob("*")] + list(ROOT.glob("*.*"))
    for file in files:
        if file.is_file() and "__pycache__" not in file.parts:
            try:
                yield file, file.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                pass  # an image


def test_scripts_are_what_a_user_calls():
    assert {file.name for file in (ROOT / "scripts").iterdir() if file.is_file()} == {
        "setup", "build", "test", "demo", "bench", "run", "ingress", "env.sh", "ingress_completion.bash"}


def test_what_is_named_is_there():
    named = [(file, place) for file, text in texts() for place in PLACE.findall(text)]
    assert len(named) > 200
    assert not [f"{file}: {place}" for file, place in named if not (ROOT / place).exists()]


@pytest.mark.parametrize("file", [file for room in ROOMS for file in (ROOT / room).iterdir() if file.is_file()], ids=lambda file: file.name)
def test_a_program_can_be_run_and_read(file):
    first = file.read_text(encoding="utf-8").split("\n")[0]
    assert (file.stat().st_mode & 0o100 != 0) == first.startswith("#!"), f"{file}: {first}"
    if first.endswith("bash"):
        assert call("bash", "-n", file).returncode == 0
