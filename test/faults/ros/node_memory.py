#!/usr/bin/env python3
"""What each node takes: resident memory and threads, flight after flight without faults in the simulated world.

Exit code 0 if no node grows, 1 if one does, 2 if nothing could be flown.
"""
import dataclasses
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "ros")]
import rospy  # noqa: E402

import soak  # noqa: E402
from own_system import OwnSystem  # noqa: E402

MAX_GROWTH_MB = 1.0
DOCUMENT = HERE.parents[2] / "doc/robustness.md"
BEGIN, END = "<!-- memory: begin (dev/fault_run node_memory --write-doc) -->", "<!-- memory: end -->"


@dataclasses.dataclass
class Row:
    node: str
    warm_mb: float   # resident, after the first flights
    end_mb: float    # after the last one
    share_mb: float  # then, pages that several processes use divided among them
    threads: int


def share_mb(pid):
    with open(f"/proc/{pid}/smaps_rollup") as file:
        return next(int(line.split()[1]) for line in file if line.startswith("Pss:")) / soak.monitors.MEGABYTE


class Quiet(soak.Soak):
    """Flights without faults."""

    def plan(self):
        return []

    def rows(self):
        warm, last = self.memory[min(soak.WARM_FLIGHTS, len(self.memory)) - 1], self.memory[-1]
        return [Row(node, warm[f"/{node}"][0], last[f"/{node}"][0], share_mb(self.monitor.pid(node)), last[f"/{node}"][1])
                for node in soak.monitors.NODES]


def total(rows):
    return Row("all four", *(sum(getattr(row, field.name) for row in rows) for field in dataclasses.fields(Row)[1:]))


def table(rows, flights):
    lines = [f"| node | resident after {min(soak.WARM_FLIGHTS, flights)} flights | after {flights} | shared pages divided | threads |",
             "|---|---|---|---|---|"]
    return lines + [f"| {row.node} | {row.warm_mb:.1f} MB | {row.end_mb:.1f} MB | {row.share_mb:.1f} MB | {row.threads} |"
                    for row in [*rows, total(rows)]]


def write_document(lines, file=DOCUMENT):
    text = file.read_text(encoding="utf-8")
    before, rest = text.split(BEGIN)
    file.write_text(before + BEGIN + "\n" + "\n".join(lines) + "\n" + END + rest.split(END)[1], encoding="utf-8")


def main():
    arguments = soak.parser(__doc__)
    arguments.add_argument("--flights", type=int, default=20)
    arguments.add_argument("--write-doc", action="store_true", help="write the table into doc/robustness.md")
    options = arguments.parse_args()
    launch = ("sim.launch", f"scenario:={os.path.abspath(options.scenario)}", f"seed:={options.seed}", "next_seed_at_reset:=true")
    with OwnSystem(*launch) as system:
        rospy.init_node("node_memory", disable_signals=True)
        flights = Quiet(options)
        while flights.flights < options.flights:
            if system.has_ended():
                raise RuntimeError("the launch has ended: a required process is gone")
            flights.fly()
        rows = flights.rows()
    lines = table(rows, options.flights)
    print("\n".join(lines))
    if options.write_doc:
        write_document(lines)
    grown = [row for row in rows if row.end_mb - row.warm_mb > MAX_GROWTH_MB]
    for row in grown:
        print(f"NOT MET: {row.node} has grown by {row.end_mb - row.warm_mb:.1f} MB")
    return 1 if grown else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (RuntimeError, AssertionError, rospy.ROSException, rospy.ServiceException) as error:
        print(f"node_memory: {error}", file=sys.stderr)
        sys.exit(2)
