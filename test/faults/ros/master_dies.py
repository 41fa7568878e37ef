#!/usr/bin/env python3
"""Kills the ROS master in flight and starts another one in its place: existing connections must go on. The other master knows no
node, so a second set could be started and ~abort would not arrive: the navigator must stop the vehicle by itself."""
import os
import subprocess
import sys
import time

import fault_paths  # noqa: F401
import rosgraph
import rospy
from own_system import free_port
from roslib.packages import find_node

import chain
import monitor as monitors
import oracles
import support

GONE_S, BACK_S = 3.0, 5.0
NOTICED_S = 4.0  # it asks once a second, and believes what it hears twice


def start_master(port):
    return subprocess.Popen(["rosmaster", "--core", "-p", str(port)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def flight(monitor, begin, seconds):
    """\\return fraction of the guard's setpoints that move the vehicle"""
    support.wait_for(lambda: time.monotonic() > begin + seconds, "the time of the measurement")
    setpoints = [s for s in monitor.part(begin).setpoints if s.source == monitor.guard]
    return len(setpoints) / seconds, sum(not oracles.is_still(s) for s in setpoints) / max(1, len(setpoints))


def main():
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{port}", ROS_HOSTNAME="localhost")
    master = start_master(port)
    support.wait_for(rosgraph.is_master_online, "a master")
    rospy.init_node("master_dies", disable_signals=True)
    steered = {"ingress_navigator": ["cmd_vel:=steered"], "setpoint_guard": ["cmd_vel_in:=steered"]}
    nodes = [subprocess.Popen([find_node("window_ingress", node)[0], *steered.get(node, [])], stderr=subprocess.DEVNULL)
             for node in monitors.NODES]
    vehicle = None
    try:
        monitor = monitors.Monitor()
        vehicle = chain.Chain()
        vehicle.fly(monitor)
        begin = time.monotonic()
        master.kill()
        master.wait()
        without = flight(monitor, begin, GONE_S)
        again = time.monotonic()
        master = start_master(port)
        after = flight(monitor, again, BACK_S)
        problems = [v.text for v in monitor.violations(begin)]
        problems += [] if without[1] > 0.95 else ["the vehicle did not go on without a master"]
        stopped = [s.at for s in monitor.part(again).setpoints if s.source == monitor.guard and oracles.is_still(s)]
        noticed = stopped[0] - again if stopped else float("inf")
        problems += [] if noticed < NOTICED_S and after[0] > 20.0 else [f"zero {noticed:.1f} s after another master came, {after[0]:.0f} setpoints a second"]
        said = any("unknown to the ROS master" in s.text for s in monitor.part(again).said)
        problems += [] if said else ["no diagnostics say why"]
        problems += [f"{node.args[0]} has ended" for node in nodes if node.poll() is not None]
        print("; ".join(problems[:5]) if problems else
              f"without a master {without[0]:.0f} setpoints a second, all on its way; zero {noticed:.1f} s after another one has come; no node ended")
        return 1 if problems else 0
    finally:
        for node in nodes:
            node.kill()
        master.kill()
        if vehicle:
            vehicle.stop()


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # rospy would wait for a master that does not know this node
