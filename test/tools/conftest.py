"""Fixtures that several tests of tools need."""
import os
import shutil
import subprocess
import sys

import cv2
import numpy
import pytest
from repository import ROOT

sys.path[:0] = [str(ROOT / "tools"), str(ROOT / "dev")]


@pytest.fixture(name="screen")
def fixture_screen():
    """A virtual screen: the name of its display. Skips if Xvfb (package xvfb) is not installed."""
    if not shutil.which("Xvfb"):
        pytest.skip("Xvfb is not installed")
    read, write = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1600x1200x24"], pass_fds=[write],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as number:
        yield f":{number.readline().strip()}"  # said when it is ready
    server.terminate()
    server.wait(timeout=20)


@pytest.fixture(name="image")
def fixture_image(tmp_path):
    """A small picture without a window."""
    file = tmp_path / "plain.png"
    cv2.imwrite(str(file), numpy.full((120, 160, 3), 128, numpy.uint8))
    return file
