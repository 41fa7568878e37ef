#!/usr/bin/env python3
"""Flight after flight through the real nodes, with faults at random times and a viewer that is too slow.

One line a flight, then a table; exit code 0 if no oracle was violated and nothing touched, 1 if one was, 2 if nothing could be
flown. What is touched while the vehicle itself does not do as it is told (`oracles.DISOBEYS`) nobody aboard could have prevented: it
is counted apart.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "ros")]
import rospy  # noqa: E402
from window_ingress.msg import FlightVerdict, IngressState  # noqa: E402
from window_ingress.srv import Inject  # noqa: E402

import monitor as monitors  # noqa: E402
import oracles  # noqa: E402
import support  # noqa: E402
from own_system import OwnSystem  # noqa: E402

KINDS = {"image": ("off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"),
         "camera_info": ("off", "garbage", "wrong", "slow", "delayed", "intermittent"),
         "odom": ("off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"),
         "imu": ("off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"),
         "tf": ("off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent"),
         "clock": ("off", "stuck", "wrong", "slow", "delayed", "intermittent"),
         "cmd_vel": ("off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent")}
TOPICS = {"steered": "/ingress_navigator/cmd_vel"}
MISSION_S, START_S = 200.0, 60.0 # wall time of a mission, and until it may start
LAST_WORD_S = 5.0                # the referee's verdict comes once a second of simulated time
WARM_FLIGHTS = 3                 # memory is measured after these: caches and pools are full
GROWTH_MB = 20.0                 # per process, from then to the end


def parser(description):
    options = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--seed", type=int, default=1, help="of the faults and of the first flight")
    options.add_argument("--scenario", default=str(HERE.parents[2] / "config/scenarios/nominal.yaml"))
    options.add_argument("--quiet-share", type=float, default=0.1, help="part of the flights without any fault")
    options.add_argument("--json", help="file for the figures")
    return options


def say(text):
    print(f"{time.strftime('%H:%M:%S')} {text}", flush=True)


class Soak:
    def __init__(self, options):
        self.options, self.random = options, random.Random(options.seed)
        self.monitor = monitors.Monitor((*monitors.NODES, "world"), TOPICS)
        self.verdicts = support.Listener("referee", FlightVerdict)
        self.states = support.Listener("state", IngressState)
        rospy.wait_for_service("world/inject", support.DEADLINE_S)
        self.inject = rospy.ServiceProxy("world/inject", Inject)
        self.outcomes, self.faults = collections.Counter(), collections.Counter()
        self.violations, self.memory, self.touched_disobeying = [], [], 0
        self.flights = self.images = 0
        self.least_hz, self.worst_frame_ms, self.blind_s = float("inf"), 0.0, 0.0
        self.began = time.monotonic()

    def prepare(self):
        """Restores the state before the first flight; the world's reset ends injected faults."""
        support.call("ingress_navigator/abort")
        support.call("world/reset")
        support.wait_for(lambda: support.call("ingress_navigator/reset").success, "the navigator can be reset")
        support.wait_for(self.starts, "a mission that starts", START_S)

    def starts(self):
        reply = support.call("ingress_navigator/start")
        if not reply.success:
            time.sleep(0.3)
        return reply.success

    def plan(self):
        """[(seconds after the start, unit, kind, duration)]"""
        if self.random.random() < self.options.quiet_share:
            return []
        faults = []
        for _ in range(self.random.choice((1, 1, 2, 3))):
            unit = self.random.choice(sorted(KINDS))
            faults.append((self.random.uniform(0.3, 9.0), unit, self.random.choice(KINDS[unit]), self.random.uniform(0.2, 5.0)))
        return sorted(faults)

    def fly(self):
        plan = self.plan()
        began = time.monotonic()
        self.prepare()
        started, done = time.monotonic(), []
        while time.monotonic() - started < MISSION_S and not self.is_over(started):
            while plan and time.monotonic() - started > plan[0][0]:
                done.append(self.hurt(*plan.pop(0)[1:]))
            time.sleep(0.05)
        self.judge(began, started, done)

    def hurt(self, unit, kind, duration):
        if unit == "clock":
            self.monitor.clock_restarts()
        reply = self.inject(unit, kind, duration)
        assert reply.success, reply.message
        self.faults[f"{unit} {kind}"] += 1
        return f"{unit} {kind} {duration:.1f} s"

    def is_decided(self, started):
        verdicts = self.verdicts.since(started + 0.5)
        return verdicts and verdicts[-1].outcome != FlightVerdict.RUNNING

    def is_over(self, started):
        states = self.monitor.states_since(started + 0.5)
        has_ended = states and states[-1].name in ("ABORTED", "PASSED")
        return has_ended or self.is_decided(started)

    def judge(self, began, started, done):
        last_word = time.monotonic() + LAST_WORD_S
        while time.monotonic() < last_word and not self.is_decided(started):
            time.sleep(0.05)
        end = time.monotonic()
        self.flights += 1
        verdicts = self.verdicts.since(started + 0.5)
        outcome = verdicts[-1].outcome_name if verdicts else "NO VERDICT"
        self.outcomes[outcome] += 1
        self.touched_disobeying += outcome in oracles.TOUCHED and oracles.disobeyed(done)
        found = self.monitor.violations(began, end) + oracles.contact(end, outcome, done)
        self.violations += found
        part = self.monitor.part(began, end)
        self.images += len(part.frames)
        self.worst_frame_ms = max([self.worst_frame_ms] + [f.milliseconds for f in part.frames])
        self.note_rate(part, began, end)
        self.memory.append({p.node: (p.megabytes, p.threads) for p in part.processes})
        say(f"flight {self.flights}: {outcome} after {end - started:.0f} s; {', '.join(done) or 'no fault'}"
            + ("" if outcome == "PASSED" else f"; {self.why(verdicts, started)}"))
        for violation in found:
            say(f"  VIOLATION {violation.oracle}, {violation.at - started:.1f} s after the start: {violation.text}")
        self.monitor.forget_before(end - 1.0)
        for listener in (self.verdicts, self.states):
            listener.forget_before(end - 1.0)

    def why(self, verdicts, started):
        states = self.states.since(started + 0.5)
        said = [s.reason for s in states if s.state_name == "ABORTED"] or [s.state_name for s in states[-1:]]
        return "; ".join(said[:1] + [v.reason for v in verdicts[-1:]])

    def note_rate(self, part, began, end):
        self.blind_s += sum(b.seconds for b in part.blind)
        for span in oracles.enabled_spans(part.states, end, began):
            self.least_hz = min(self.least_hz, oracles.stream_rate(part, self.monitor.limits, self.monitor.guard, *span)[0])

    def grown(self):
        if len(self.memory) <= WARM_FLIGHTS:
            return {}
        return {node: self.memory[-1][node][0] - self.memory[WARM_FLIGHTS][node][0] for node in self.memory[-1]
                if node in self.memory[WARM_FLIGHTS]}

    def figures(self):
        first = self.memory[min(WARM_FLIGHTS, len(self.memory) - 1)]
        return {"minutes": round((time.monotonic() - self.began) / 60.0, 1), "flights": self.flights, "outcomes": dict(self.outcomes),
                "faults": sum(self.faults.values()), "kinds_of_fault": len(self.faults),
                "touched_while_the_vehicle_did_not_obey": self.touched_disobeying, "messages": self.monitor.messages,
                "pictures": self.images, "longest_picture_ms": round(self.worst_frame_ms, 1),
                "least_setpoints_a_second": self.least_hz, "observer_kept_from_looking_s": round(self.blind_s, 1),
                "memory_mb": {node: [round(first[node][0], 1), round(last[0], 1)] for node, last in self.memory[-1].items() if node in first},
                "threads": {node: [first[node][1], last[1]] for node, last in self.memory[-1].items() if node in first},
                "violations": len(self.violations)}

    def report(self):
        for node, megabytes in self.grown().items():
            if megabytes > GROWTH_MB:
                self.violations.append(oracles.Violation("O7", time.monotonic(), f"{node} has grown by {megabytes:.1f} MB"))
                say(f"VIOLATION O7: {self.violations[-1].text}")
        figures = self.figures()
        for name, value in figures.items():
            say(f"{name}: {value}")
        if self.options.json:
            pathlib.Path(self.options.json).write_text(json.dumps(figures, indent=1) + "\n")
        return 1 if self.violations else 0


def main():
    arguments = parser(__doc__)
    arguments.add_argument("--minutes", type=float, default=60.0)
    options = arguments.parse_args()
    launch = ("sim.launch", f"scenario:={os.path.abspath(options.scenario)}", f"seed:={options.seed}", "next_seed_at_reset:=true")
    with OwnSystem(*launch) as system:
        rospy.init_node("soak", disable_signals=True)
        viewer = subprocess.Popen([sys.executable, str(HERE / "slow_viewer.py")], stdout=subprocess.DEVNULL)
        try:
            soak = Soak(options)
            while time.monotonic() - soak.began < 60.0 * options.minutes:
                if system.has_ended():
                    raise RuntimeError("the launch has ended: a required process is gone")
                soak.fly()
            return soak.report()
        finally:
            viewer.kill()
            viewer.wait()


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (RuntimeError, AssertionError, rospy.ROSException, rospy.ServiceException) as error:
        say(f"soak: {error}")
        sys.exit(2)
