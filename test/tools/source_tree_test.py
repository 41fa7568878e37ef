"""The tree of C++ sources: small folders, a self-contained interface, tests that mirror the sources."""
import collections
import re

import pytest

from repository import ROOT

PUBLIC = ROOT / "include/window_ingress"
MAX_FILES_OF_A_KIND = 16
MAX_PUBLIC_HEADERS = 90
INCLUDE = re.compile(r'#include "([^"]+)"')
HEADERS = sorted(PUBLIC.rglob("*.hpp"))


def sources(*folders):
    return [file for folder in folders for file in (ROOT / folder).rglob("*.?pp")]


def included_by(file):
    return INCLUDE.findall(file.read_text(encoding="utf-8"))


def folder_of(file):
    """The part of the package that a source belongs to: detection, navigation, ..."""
    return file.relative_to(PUBLIC if PUBLIC in file.parents else ROOT / "src").parts[0]


def test_no_folder_is_crowded():
    counted = collections.Counter((file.parent, file.suffix) for file in sources("include", "src"))
    assert len(counted) > 40
    assert not {f"{folder.relative_to(ROOT)}: {count} {kind}" for (folder, kind), count in counted.items() if count > MAX_FILES_OF_A_KIND}


def test_the_interface_is_small():
    assert 40 < len(HEADERS) <= MAX_PUBLIC_HEADERS


def test_the_interface_stands_alone():
    """Installed headers include only installed headers."""
    private = [f"{header.relative_to(ROOT)}: {name}" for header in HEADERS for name in included_by(header) if not (ROOT / "include" / name).exists()]
    assert not private


def test_the_interface_is_used_elsewhere():
    """A header that only its own folder uses lies beside its source, unless a public header needs it."""
    users = collections.defaultdict(set)
    for file in sources("include", "src"):
        for name in included_by(file):
            users[name].add(file)
    for header in HEADERS:
        name = str(header.relative_to(ROOT / "include"))
        assert any(folder_of(user) != folder_of(header) or PUBLIC in user.parents for user in users[name]), name


def test_folders_are_compiled_in_one_direction():
    """No folder includes one that includes it, directly or through others."""
    below = {folder_of(file): set() for file in sources("include", "src")}
    for file in sources("include", "src"):
        for name in included_by(file):
            below[folder_of(file)].add(name.replace("window_ingress/", "").split("/")[0])
    left = {folder: names.intersection(below) - {folder} for folder, names in below.items()}
    assert len(left) > 10
    while left:
        lowest = {folder for folder, names in left.items() if not names.intersection(left)}
        assert lowest, f"these include each other: {sorted(left)}"
        left = {folder: names for folder, names in left.items() if folder not in lowest}


@pytest.mark.parametrize("test", sorted((ROOT / "test/unit").rglob("*_test.cpp")), ids=lambda test: test.stem)
def test_a_test_stands_where_its_subject_does(test):
    folder = test.parent.relative_to(ROOT / "test/unit")
    subject = test.name.replace("_test.cpp", "")
    places = [file.parent.relative_to(ROOT / "src") for file in (ROOT / "src" / folder.parts[0]).rglob(f"{subject}.?pp")]
    places += [header.parent.relative_to(PUBLIC) for header in (PUBLIC / folder.parts[0]).rglob(f"{subject}.hpp")]
    assert not places or folder in places


def hidden_names(file):
    """Names in unnamed namespaces of a source: constants, types, and functions with their arguments."""
    for block in re.findall(r"^namespace \{\n(.*?)^\}  // namespace$", file.read_text(encoding="utf-8"), re.M | re.S):
        block = re.sub(r"//.*", "", block)
        for statement in re.findall(r"^(?=[\w[]).*?(?=[;{]|\n\n)", block, re.M | re.S):
            constants = re.findall(r"\b(k[A-Z]\w*)(?= =|,|$|\[)", statement) if re.match(r"(inline )?const", statement) else []
            function = re.search(r"\b(\w+)\(([^()]*)\)", statement)
            kind = re.match(r"(?:template <.*?>\s)?(?:struct|class|enum class) (\w+)", statement)
            if kind:
                yield kind.group(1)
            elif constants:
                yield from constants
            elif function and not statement.startswith(("using", "static_assert")):
                types = re.sub(r" [a-z]\w*(?= =|,|$)", "", function.group(2))
                yield f"{function.group(1)}({types})"


@pytest.mark.parametrize("library, but", [("adapters", ""), ("detection", ""), ("evaluation", ""), ("simulation", ""), ("*", "adapters|detection|evaluation|simulation|nodes|tools|interior|perception")])
def test_unnamed_namespaces_share_no_name(library, but):
    """Sources are compiled in batches, in any combination, so these names must be unique."""
    found = collections.defaultdict(set)
    for file in (ROOT / "src").glob(f"{library}/**/*.cpp"):
        if not but or not re.search(f"/src/({but})/|/interior/", str(file)):
            space = re.search(r"^namespace (window_ingress[\w:]*)", file.read_text(encoding="utf-8"), re.M)
            for name in set(hidden_names(file)):
                found[space and space.group(1), name].add(file.name)
    assert found
    assert not {f"{name}: {sorted(files)}" for (_, name), files in found.items() if len(files) > 1}
