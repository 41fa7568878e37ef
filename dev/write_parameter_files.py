#!/usr/bin/env python3
"""Writes config/*.yaml, config/WindowDetector.cfg, doc/parameters.md and the tables of doc/scenarios.md from the
parameter structs of the headers: write_parameter_files.py [--check]

Each struct lists its fields and ranges in `visit`; default and meaning are at the member. Run this after a change of a
parameter; a unit test fails if files and structs differ.
"""
import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WIDTH = 116

MEMBER = re.compile(r"^  ([\w:]+(?:<\w+>)?) (\w+)(?: = ([^;]+)|\{([^;]*)\})?;\s*(?:///<\s*(.*))?$")
FIELD = re.compile(r'field\("(\w+)",\s*self\.(\w+)(?:,\s*([^,()]+),\s*([^,()]+))?\)')
GROUP = re.compile(r'field\.group\("(\w+)",\s*self\.(\w+)\)')
CHOICE = re.compile(r'field\.choice\("(\w+)",\s*self\.(\w+),\s*\{([^}]*)\}\)')
LIST = re.compile(r'field\.list\("(\w+)",\s*self\.(\w+)\)')
INLINE = re.compile(r"((?:\w+::)?\w+)::visit\(self\.(\w+),\s*field\)")


class Struct:
    def __init__(self, space, about):
        self.space, self.about = space, about
        self.members = {}  # name -> (type, default, comment)
        # ("field", name, member, minimum, maximum) | ("choice", name, member, words) | ("group"|"list"|"inline", name, member)
        self.visits = []


def read_structs():
    structs = {}
    public = ROOT / "include/window_ingress", ROOT.glob("include/window_ingress/**/*.hpp")
    private = ROOT / "src", ROOT.glob("src/**/*.hpp")
    for root, headers in (public, private):
        for header in sorted(headers):
            for name, struct in structs_of(header.read_text(), header.relative_to(root).parts[0]):
                structs[struct.space, name] = struct
    return structs


def structs_of(text, space):
    for match in re.finditer(r"((?:^/// [^\n]*\n)*)^struct (\w+) \{\n(.*?)^\};", text, re.M | re.S):
        if "visit(Self" not in match[3]:
            continue
        about = " ".join(line[4:] for line in match[1].splitlines())
        struct = Struct(space, about)
        body = re.sub(r"=\n\s+", "= ", match[3])
        read_members(struct, body)
        body = body[body.index("visit(Self"):]
        for statement in re.split(r";\s", body):
            read_visit(struct, " ".join(statement.split()))
        yield match[2], struct


def read_members(struct, body):
    name = None
    for line in body.splitlines():
        further = re.match(r"^\s+///<\s*(.*)$", line)
        member = MEMBER.match(line)
        if further and name:
            kind, default, comment = struct.members[name]
            struct.members[name] = (kind, default, f"{comment} {further[1]}".strip())
        elif member:
            name = member[2]
            struct.members[name] = (member[1], member[3] or member[4], member[5] or "")
        elif not line.strip().startswith("///"):
            name = None


def read_visit(struct, statement):
    for pattern, kind in ((FIELD, "field"), (CHOICE, "choice"), (GROUP, "group"), (LIST, "list")):
        match = pattern.search(statement)
        if match:
            struct.visits.append((kind, *match.groups()))
            return
    match = INLINE.search(statement)
    if match:
        struct.visits.append(("inline", match[1], match[2]))


def find(structs, space, kind):
    *outer, name = kind.split("::")
    return structs[outer[-1] if outer else space, name]


def default_of(kind, default):
    if kind == "std::string":
        return default or '""'
    if kind.startswith("std::vector"):
        return "[]"
    return default


def yaml_number(text):
    """YAML 1.1 reads 1e-3 as text."""
    return re.sub(r"^(-?\d+)(e)", r"\1.0\2", text)


def yaml_lines(structs, struct, indent):
    for visit in struct.visits:
        if visit[0] == "field":
            _, name, member, minimum, maximum = visit
            kind, default, comment = struct.members[member]
            limits = f" ({minimum} .. {maximum})" if minimum else ""
            yield commented(f"{indent}{name}: {yaml_number(default_of(kind, default))}", comment + limits)
        elif visit[0] == "choice":
            _, name, member, words = visit
            kind, default, comment = struct.members[member]
            yield commented(f"{indent}{name}: {default_of(kind, default)}", f"{comment} ({words.replace(chr(34), '')})")
        else:
            _, name, member = visit
            kind = struct.members[member][0] if visit[0] == "group" else name
            child = find(structs, struct.space, kind)
            if visit[0] == "inline":
                yield from yaml_lines(structs, child, indent)
                continue
            yield commented(f"{indent}{name}:", child.about)
            yield from yaml_lines(structs, child, indent + "  ")


def commented(line, comment):
    if not comment:
        return line
    wrapped = f"{line}{' ' * max(2, 34 - len(line))}# {comment}"
    if len(wrapped) <= WIDTH:
        return wrapped
    indent = " " * (len(line) - len(line.lstrip()))
    rows, row = [], f"{indent}#"
    for word in comment.split():
        if len(row) + 1 + len(word) > WIDTH:
            rows.append(row)
            row = f"{indent}#"
        row += f" {word}"
    return "\n".join([*rows, row, line])


def yaml_file(structs, kind, title):
    lines = [f"# {title}", "# Each line: default, meaning [unit] (range). Written by dev/write_parameter_files.py. Tools do not read this file.",
             *OWN_FILE.get(kind, ["# Put changed values into your own file: config:=FILE for launch files, --params FILE for tools."]),
             *yaml_lines(structs, find(structs, "configuration", kind), "")]
    return "\n".join(lines) + "\n"


CFG_TYPES = {"double": "double_t", "int": "int_t", "bool": "bool_t"}


def cfg_text(kind, comment, minimum, maximum):
    """Meaning, unit and range, as rqt_reconfigure shows them."""
    text = comment.replace('"', "'").replace(";", ",")
    if kind == "double" and "[" not in text:
        text += " [-]"
    return f"{text} ({minimum} .. {maximum})" if minimum else text


def cfg_lines(structs, struct, prefix, group):
    """Parameters of one struct. Each struct below it gets its own group (a tab)."""
    for visit in struct.visits:
        if visit[0] == "group":
            child = find(structs, struct.space, struct.members[visit[2]][0])
            yield f'\n{visit[1]} = {group}.add_group("{visit[1]}", type="tab")'
            yield from cfg_lines(structs, child, f"{prefix}{visit[1]}_", visit[1])
            continue
        if visit[0] != "field":
            sys.exit(f"WindowDetector.cfg: no rule for a {visit[0]} ({prefix}{visit[1]})")
        _, name, member, minimum, maximum = visit
        kind, default, comment = struct.members[member]
        value = default.capitalize() if kind == "bool" else default
        limits = f", {minimum}, {maximum}" if minimum else ""
        yield (f'{group}.add("{prefix}{name}", {CFG_TYPES[kind]}, 0,\n'
               f'        "{cfg_text(kind, comment, minimum, maximum)}",\n        {value}{limits})')


def cfg_file(structs):
    head = ["#!/usr/bin/env python3", "# Live tuning of the detector, a tab for each stage. Written by dev/write_parameter_files.py.",
            "from dynamic_reconfigure.parameter_generator_catkin import ParameterGenerator, bool_t, double_t, int_t", "",
            "gen = ParameterGenerator()", ""]
    tail = ["", 'exit(gen.generate("window_ingress", "window_ingress", "WindowDetector"))']
    return "\n".join([*head, *cfg_lines(structs, find(structs, "detection", "DetectorParams"), "", "gen"), *tail]) + "\n"


def doc_row(struct, visit):
    kind, default, comment = struct.members[visit[2]]
    unit = re.search(r" ?\[([^\]]*)\]", comment)
    meaning = comment.replace(unit[0], "", 1) if unit else comment
    if visit[0] == "choice":
        allowed = visit[3].replace('"', "")
    elif visit[0] == "group":
        default, allowed = "{" + ", ".join(f"{c}: {v.strip()}" for c, v in zip("rgb", default.split(","))) + "}", "colour"
    elif visit[3]:
        allowed = " … ".join(f"{float(limit):g}" for limit in visit[3:5]) + (" (whole)" if kind == "int" else "")
    else:
        allowed = {"bool": "true, false", "std::string": "text"}.get(kind, "")
    default = f"{float(default):g}" if kind in ("double", "int") else (default_of(kind, default) or "").strip('"')
    return f"| `{visit[1]}` | {unit[1] if unit else '-' if kind in ('double', 'int') else ''} | {default} | {allowed} | {meaning[:1].upper() + meaning[1:]} |"


def doc_rows(structs, struct):
    for visit in struct.visits:
        if visit[0] == "inline":
            yield from doc_rows(structs, find(structs, struct.space, visit[1]))
        elif visit[0] != "list":
            yield doc_row(struct, visit)


def doc_tables(structs, kind):
    """(section name, rows) of every struct that a scenario file may hold."""
    struct = find(structs, "simulation", kind)
    for visit in struct.visits:
        if visit[0] not in ("group", "list"):
            continue
        inner = re.sub(r"std::vector<(\w+)>", r"\1", struct.members[visit[2]][0])
        if inner != "ColourParams":
            rows = find(structs, "simulation", inner)
            yield visit[1], list(doc_rows(structs, rows))
            yield from doc_tables(structs, inner)


def scenarios_page(structs):
    text = (ROOT / "doc" / "scenarios.md").read_text()
    head = "| key | unit | default | allowed | meaning |\n|---|---|---|---|---|\n"
    for section, rows in doc_tables(structs, "Scenario"):
        pattern = re.compile(rf"(\n## `{section}`\n(?:(?!\n## ).)*?\n)\| key \|.*?\n(?=\n|\Z)", re.S)
        if not pattern.search(text):
            sys.exit(f"doc/scenarios.md: no section '## `{section}`' with a table; add one")
        text = pattern.sub(lambda found: found[1] + head + "\n".join(rows) + "\n", text, count=1)
    return text


NODES = {  # node -> its struct and file
    "window_detector": ("DetectorNodeParams", "detector.yaml"),
    "homography_pose": ("PoseNodeParams", "pose.yaml"),
    "ingress_navigator": ("NavigatorNodeParams", "navigator.yaml"),
    "setpoint_guard": ("GuardParams", "guard.yaml"),
    "world": ("WorldNodeParams", "world.yaml"),
    "vehicle": ("navigation::VehicleParams", "vehicle.yaml"),
}
TITLES = {"vehicle": "Parameters of the vehicle, shared by all nodes, below the name 'vehicle'."}
OWN_FILE = {"WorldNodeParams": []}  # set by the arguments of sim.launch and the scenario, not by a file
PARAMETERS_HEAD = """# Parameters

Every parameter of every node, by its `rosparam` name below the node's name. The vehicle's parameters stand below `vehicle`.
`dev/write_parameter_files.py` writes this page and the yaml files in `config/` from the parameter structs of the headers.
A node that starts with an unknown key or a value out of range refuses it by name. How to choose values:
[those that matter](getting_started.md#the-parameters-that-matter), [tuning the detector](window.md#tune), [navigation](navigation.md), [pose](pose.md). The detector's parameters (`detector/…`) can
be changed at run time with dynamic_reconfigure.
"""


def parameter_rows(structs, struct, prefix):
    """(rows of one struct, [(heading, meaning, rows)] of the structs that it holds)."""
    rows, inner = [], []
    for visit in struct.visits:
        if visit[0] in ("field", "choice"):
            rows.append(doc_row(struct, visit).replace("| `", f"| `{prefix}", 1))
            continue
        _, name, member = visit
        kind = struct.members[member][0] if visit[0] == "group" else name
        child = find(structs, struct.space, kind)
        child_rows, below = parameter_rows(structs, child, prefix if visit[0] == "inline" else f"{prefix}{name}/")
        if visit[0] == "inline":
            rows += child_rows
        elif child_rows:
            inner.append((f"{prefix}{name}", child.about, child_rows))
        inner += below
    return rows, inner


def parameters_page(structs):
    table = "| parameter | unit | default | allowed | meaning |\n|---|---|---|---|---|\n"
    text = PARAMETERS_HEAD
    for node, (kind, file) in NODES.items():
        rows, inner = parameter_rows(structs, find(structs, "configuration", kind), "")
        text += f"\n## {node}\n\n`config/{file}`\n"
        for title, about, section in [(None, "", rows), *inner]:
            if section:
                text += (f"\n### `{title}`\n" if title else "") + (f"\n{about}\n" if about else "") + "\n" + table
                text += "\n".join(section) + "\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="writes nothing; exit code 1 if a file differs")
    options = parser.parse_args()
    structs = read_structs()
    files = {
        "../doc/scenarios.md": scenarios_page(structs),
        "../doc/parameters.md": parameters_page(structs),
        **{file: yaml_file(structs, kind, TITLES.get(node, f"Parameters of the node {node}.")) for node, (kind, file) in NODES.items()},
        "WindowDetector.cfg": cfg_file(structs),
    }
    stale = [name for name, text in files.items()
             if not (ROOT / "config" / name).exists() or (ROOT / "config" / name).read_text() != text]
    if options.check:
        if stale:
            sys.exit(f"config/: {', '.join(stale)} differ from the structs; run dev/write_parameter_files.py")
        return
    for name in stale:
        (ROOT / "config" / name).write_text(files[name])
        print((ROOT / 'config' / name).resolve().relative_to(ROOT), "written")
    (ROOT / "config" / "WindowDetector.cfg").chmod(0o755)


if __name__ == "__main__":
    main()
