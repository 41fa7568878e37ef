"""The sources keep to what Ubuntu 20.04 has: GCC 9, OpenCV 4.2, Eigen 3.3, CMake 3.16, Python 3.8."""
import ast
import re

import pytest

from repository import ROOT

FOLDERS = "cmake", "config", "dev", "include", "nodes", "scripts", "src", "test", "tools"
# Names that came later. What C++20 brought the compiler refuses itself.
LATER_IN_CPP = {
    "GCC 9": r"std::(from|to)_chars\b|\bhardware_(con|de)structive_interference_size\b",
    "OpenCV 4.2": r"cv::(SIFT|USAC_\w+|stackBlur|hasNonZero|pollKey|FaceDetectorYN|calibrateRobotWorldHandEye|initInverseRectificationMap|VTraits)\b",
    "Eigen 3.3": r"Eigen::(seqN?|all|last|lastN|placeholders|(Row)?VectorX<|MatrixX<|Vector[234]<|Matrix[234]<)|\.reshaped\(",
    "googletest 1.10": r"\bGTEST_FLAG_(SET|GET)\b",
}
LATER_IN_CMAKE = {"CMake 3.16": r"\bcmake_(path|language)\(|FIND_PACKAGE_ARGS|PROJECT_IS_TOP_LEVEL|\$<(PATH|LIST):|\$<CONFIG:[^>]*,"}
LATER_IN_PYTHON = {
    "Python 3.8": r"\.remove(prefix|suffix)\(|\bfunctools\.cache\b|\bmath\.(lcm|nextafter|ulp|cbrt|exp2)\b|\bimport (zoneinfo|graphlib|tomllib)\b"
                  r"|\bzip\([^)]*strict=|\bitertools\.(pairwise|batched)\b|\.bit_count\(\)|\bdatetime\.UTC\b|\bStrEnum\b|\bExceptionGroup\b",
}


def files_where(fits):
    return [file for folder in FOLDERS for file in sorted((ROOT / folder).rglob("*")) if file.is_file() and fits(file)]


def is_python(file):
    return file.suffix == ".py" or (file.suffix in ("", ".cfg") and file.read_bytes().startswith(b"#!/usr/bin/env python3"))


CPP = files_where(lambda file: file.suffix in (".cpp", ".hpp"))
CMAKE = [ROOT / "CMakeLists.txt", *files_where(lambda file: file.suffix == ".cmake")]
PYTHON = files_where(is_python)


@pytest.mark.parametrize("files, later", [(CPP, LATER_IN_CPP), (CMAKE, LATER_IN_CMAKE), (PYTHON, LATER_IN_PYTHON)], ids=["C++", "CMake", "Python"])
def test_no_name_is_later(files, later):
    assert len(files) > 2
    found = [f"{file.relative_to(ROOT)}: {name[0]}: not in {version}" for file in files if file.name != "oldest_toolchain_test.py"
             for version, names in later.items() for name in re.finditer(names, file.read_text(encoding="utf-8"))]
    assert not found


def test_python_3_8_parses_every_program():
    for file in PYTHON:
        ast.parse(file.read_text(encoding="utf-8"), str(file), feature_version=(3, 8))


def test_cmake_asks_for_no_more():
    asked = re.search(r"cmake_minimum_required\(VERSION ([\d.]+)\)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))
    assert tuple(map(int, asked[1].split("."))) <= (3, 16)
