"""Helpers of the tests of tools: paths, calls, and reading of output."""
import csv
import importlib.machinery
import importlib.util
import pathlib
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOMINAL = ROOT / "config/scenarios/nominal.yaml"


def call(*command, timeout=300, **options):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=timeout, check=False, **options)


def run(tool, *arguments, **options):
    """Runs a tool as a user does."""
    return call(ROOT / "scripts/run", tool, *arguments, **options)


def assert_refused(result, code, *words):
    """Checks the exit code, and that one line says what is wrong and where."""
    lines = [line for line in result.stderr.splitlines() if line.strip()]
    assert result.returncode == code, result.stderr
    assert len(lines) == 1, result.stderr
    for word in words:
        assert str(word) in lines[0], result.stderr


def load(program):
    """Loads a program as a module; its name may have no suffix."""
    loader = importlib.machinery.SourceFileLoader(program.rpartition("/")[2].partition(".")[0], str(ROOT / program))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module


def rows_of(file):
    with open(file, newline="", encoding="utf-8") as stream:
        return list(csv.DictReader(stream))


def timeless(file):
    """The rows of a survey without columns that differ from run to run."""
    return [{name: value for name, value in row.items() if name != "milliseconds"} for row in rows_of(file)]
