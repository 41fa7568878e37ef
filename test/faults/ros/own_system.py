"""A separate ROS system: a master on a free port and one launch file, ended with the program."""
import os
import signal
import socket
import subprocess
import time

import rosgraph

PATIENCE_S = 60.0


def free_port():
    with socket.socket() as probe:
        probe.bind(("localhost", 0))
        return probe.getsockname()[1]


class OwnSystem:
    """`with OwnSystem("sim.launch", "seed:=3"):` - only this process hears it, over loopback."""

    def __init__(self, launch_file, *arguments, package="window_ingress", prefix=()):
        self._port = free_port()
        os.environ.update(ROS_MASTER_URI=f"http://localhost:{self._port}", ROS_HOSTNAME="localhost")
        file = [launch_file] if os.path.isabs(launch_file) else [package, launch_file]
        self._command = [*prefix, "roslaunch", "-p", str(self._port), *file, *arguments]

    def __enter__(self):
        self._process = subprocess.Popen(self._command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        end = time.monotonic() + PATIENCE_S
        while not rosgraph.is_master_online():
            if self._process.poll() is not None or time.monotonic() > end:
                self.__exit__()
                raise RuntimeError(f"does not start: {' '.join(self._command)}")
            time.sleep(0.1)
        return self

    def has_ended(self):
        return self._process.poll() is not None

    def __exit__(self, *_):
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
        try:
            self._process.wait(30.0)
        except subprocess.TimeoutExpired:
            os.killpg(self._process.pid, signal.SIGKILL)
            self._process.wait()
