#!/usr/bin/env python3
"""Kills each node in each state of a simulated mission, under an autopilot that flies the last velocity on for 3.2 s; nothing
may be touched. Prints a table; exit code 0 if every cell is met."""
import argparse
import math
import os
import pathlib
import signal
import sys
import time

import fault_paths  # noqa: F401
import rospy
from fault_notes import note
from nav_msgs.msg import Odometry
from window_ingress.msg import FlightVerdict, IngressState
from window_ingress.srv import Inject

import monitor as monitors
import oracles
import support
from own_system import OwnSystem

SCENARIO = pathlib.Path(__file__).resolve().parents[1] / "world" / "kill.yaml"
NODES = monitors.NODES
STATES = ("SEARCH", "ALIGN", "APPROACH", "COMMIT", "HOLD", "BACK_OFF")
RESPAWN_S = 5              # of all nodes but the guard, which is restarted at once
WATCH_S = 4.5              # after the kill: longer than the autopilot flies the last velocity on
INTO_STATE_S, BACK_S = 180.0, 60.0
NEAR_M = 2.0
FAST_MPS = {"APPROACH": 0.5, "ALIGN": 0.2, "BACK_OFF": 0.2}


def call(name):
    return support.call(name, 3 * support.DEADLINE_S)


def speed_of(truth):
    linear = truth.twist.twist.linear
    return math.sqrt(linear.x ** 2 + linear.y ** 2 + linear.z ** 2)


def place_of(truth):
    point = truth.pose.pose.position
    return point.x, point.y, point.z


class KillMatrix:
    def __init__(self):
        self.monitor = monitors.Monitor((*NODES, "world"), {"steered": "/ingress_navigator/cmd_vel"})
        self.truth = support.Listener("ground_truth/odom", Odometry)
        self.states = support.Listener("state", IngressState)
        self.verdicts = support.Listener("referee", FlightVerdict)
        rospy.wait_for_service("world/inject", support.DEADLINE_S)
        self.inject = rospy.ServiceProxy("world/inject", Inject)

    # --- into a state

    def take_off(self):
        call("ingress_navigator/abort")
        call("world/reset")
        support.wait_for(lambda: call("ingress_navigator/reset").success, "a reset")
        support.wait_for(lambda: call("ingress_navigator/start").success, "a start", 30.0)

    def lead_into(self, state):
        """Leads the mission into the state, at the speed that it has there."""
        self.take_off()
        begin = time.monotonic()
        if state in ("HOLD", "BACK_OFF"):
            # Further off there is nothing to go back from.
            self.wait_in("APPROACH", begin, 0.3, NEAR_M if state == "BACK_OFF" else math.inf)
            self.inject("image", "off", 60.0)
        self.wait_in(state, begin, FAST_MPS.get(state, 0.0))

    def wait_in(self, state, begin, fast_mps, nearer_m=math.inf):
        def there():
            states = self.states.since(max(begin, time.monotonic() - 0.25))
            last = states[-1] if states else None
            return last and last.state_name == state and last.distance <= nearer_m and \
                speed_of(self.truth.since(time.monotonic() - 1.0)[-1]) >= fast_mps
        support.wait_for(there, state, INTO_STATE_S)

    # --- one cell

    def kill(self, node, state):
        """\\return (problems, what was seen)"""
        self.lead_into(state)
        pid, name = self.monitor.pid(node), "/" + node
        before = self.truth.since(time.monotonic() - 1.0)[-1]
        self.monitor.expected_deaths = {name}
        killed = time.monotonic()
        os.kill(pid, signal.SIGKILL)
        support.wait_for(lambda: time.monotonic() > killed + WATCH_S, "the time of the measurement")
        problems, seen = self.judge(node, state, before, killed)
        self.bring_back(node, pid)
        if node == "ingress_navigator":
            problems += self.is_safe_again()
        for listener in (self.truth, self.states, self.verdicts):
            listener.forget_before(time.monotonic() - 2.0)
        self.monitor.forget_before(time.monotonic() - 2.0)
        return problems, seen

    def judge(self, node, state, before, killed):
        way = self.truth.since(killed)
        furthest = max(math.dist(place_of(before), place_of(t)) for t in way)
        verdict = self.verdicts.since(0.0)[-1]
        touched = verdict.outcome_name in oracles.TOUCHED
        problems = [f"{verdict.outcome_name}: {verdict.reason}"] if touched else []
        if node == "ingress_navigator":
            end = killed + WATCH_S
            problems += [v.text for v in oracles.O4_stop(self.monitor.part(killed, end), self.monitor.limits, killed, end)
                         if "no setpoints" not in v.text]
        problems += [v.text for v in self.monitor.violations(killed) if v.oracle in ("O1", "O2", "O3", "O9")]
        last = self.states.since(0.0)[-1].state_name
        ends = "passed" if verdict.outcome_name == "PASSED" else f"{furthest:.2f} m"
        silence = f", no setpoint for {self.silence(killed):.1f} s" if node == "setpoint_guard" else ""
        return problems, f"{ends}, {speed_of(before):.2f} to {speed_of(way[-1]):.2f} m/s, {last}{silence}"

    def silence(self, killed):
        """The longest time without a setpoint."""
        times = [s.at for s in self.monitor.part(killed - 0.5).setpoints if s.source == self.monitor.guard]
        return max((after - before for before, after in zip(times, times[1:])), default=math.inf)

    def bring_back(self, node, pid):
        def is_back():
            new = monitors.running(node)
            return new if new and new != pid else None
        support.wait_for(is_back, f"{node} is back", BACK_S)
        self.monitor.recording.deaths.clear()
        self.monitor.watch([node])

    def is_safe_again(self):
        """A restarted navigator moves nothing until it is asked to."""
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() > begin + 1.0, "a second")
        states = self.states.since(begin)
        moving = [s for s in self.monitor.part(begin).setpoints if not oracles.is_still(s)]
        problems = ["moves without ~start"] if moving else []
        return problems + ([] if states and states[-1].state_name == "IDLE" else ["is not IDLE when it is back"])


def arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--nodes", nargs="+", default=list(NODES), choices=NODES)
    parser.add_argument("--states", nargs="+", default=list(STATES), choices=STATES)
    parser.add_argument("--scenario", default=str(SCENARIO))
    return parser.parse_args()


def main():
    options = arguments()
    bad = 0
    with OwnSystem("sim.launch", f"scenario:={os.path.abspath(options.scenario)}", "respawn:=true", f"respawn_delay:={RESPAWN_S}"):
        rospy.init_node("kill_matrix", disable_signals=True)
        matrix = KillMatrix()
        print("| killed | in | goes on for, from and to speed, state | |\n|---|---|---|---|", flush=True)
        for node in options.nodes:
            for state in options.states:
                try:
                    problems, seen = matrix.kill(node, state)
                except AssertionError as error:
                    problems, seen = [str(error)], ""
                bad += bool(problems)
                print(f"| {node} | {state} | {seen} | {'NOT MET: ' + '; '.join(problems[:2]) if problems else 'met'} |", flush=True)
    cells = len(options.nodes) * len(options.states)
    note("M74", f"{cells - bad} of {cells} kills without contact")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
