#!/usr/bin/env python3
"""A terminal stopped by Ctrl-S, an unread pipe, a full disk, in flight: the brake and ~abort still work."""
import contextlib
import fcntl
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import sys
import tempfile
import termios
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from std_srvs.srv import Trigger
from window_ingress.msg import IngressState

import support

UP_WITHIN_S = 120.0
WATCH_S = 2.0
SETPOINTS_HZ = 28.0
ZERO_WITHIN_S = 0.25
ANSWER_WITHIN_S = 0.2
LINES = 200        # of about a hundred bytes: more than a small pipe holds
MANY_LINES = 1000  # more than the queue holds: further lines are lost
SMALL_PIPE = 4096
F_SETPIPE_SZ = 1031
CTRL_S, CTRL_Q = b"\x13", b"\x11"
FULL_DISK_KB = 256


class Terminal:
    """A real terminal, read until somebody presses Ctrl-S."""

    def __init__(self):
        self._master, self.end = pty.openpty()
        threading.Thread(target=self._look, daemon=True).start()

    def _look(self):
        with contextlib.suppress(OSError):
            while os.read(self._master, 4096):
                pass

    def take_over(self):
        """In the started process: makes this its terminal."""
        fcntl.ioctl(self.end, termios.TIOCSCTTY, 0)

    def stop(self):
        os.write(self._master, CTRL_S)

    def go_on(self):
        os.write(self._master, CTRL_Q)

    def close(self):
        os.close(self._master)


class Pipe:
    """A pipe to a reader that stops reading."""

    def __init__(self):
        self._reader = subprocess.Popen(["cat"], stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
        self.end = self._reader.stdin
        fcntl.fcntl(self.end, F_SETPIPE_SZ, SMALL_PIPE)

    def stop(self):
        self._reader.send_signal(signal.SIGSTOP)

    def go_on(self):
        self._reader.send_signal(signal.SIGCONT)

    def close(self):
        self._reader.kill()
        self._reader.wait()


class Disk:
    """A small disk for logs, home and all output."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={FULL_DISK_KB}k", "none", self.folder], capture_output=True, check=False)
        if mounted.returncode:
            shutil.rmtree(self.folder)
            raise unittest.SkipTest("may not mount a small disk")
        self.end = open(self.folder / "output.txt", "wb")

    def stop(self):
        with contextlib.suppress(OSError), open(self.folder / "rest", "wb", buffering=0) as rest:
            while True:
                rest.write(bytes(1024))

    def go_on(self):
        (self.folder / "rest").unlink()

    def close(self):
        self.end.close()
        subprocess.run(["umount", "-l", self.folder], check=False)
        self.folder.rmdir()


class BlockedOutputTest(unittest.TestCase):
    def setUp(self):
        self.setpoints = support.Listener("/cmd_vel", TwistStamped)
        self.states = support.Listener("/state", IngressState)
        self.flight = None

    def tearDown(self):
        if self.flight:
            self.output.go_on()  # roslaunch itself waits for its output
            self.flight.send_signal(signal.SIGINT)
            self.flight.wait(60.0)
            self.output.close()
        self.setpoints.stop()
        self.states.stop()

    def fly(self, output, lines=LINES, **environment):
        """Flies until the vehicle approaches. Then blocks the output and has this many lines written."""
        self.output = output
        command = ["roslaunch", "window_ingress", "sim.launch"]
        self.flight = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=output.end, stderr=output.end, start_new_session=True,
                                       preexec_fn=getattr(output, "take_over", None), env={**os.environ, **environment})
        rospy.wait_for_service("/ingress_navigator/start", UP_WITHIN_S)
        start, self.abort, confirm = (rospy.ServiceProxy(f"/ingress_navigator/{name}", Trigger, persistent=True)
                                      for name in ("start", "abort", "confirm_opening"))
        support.wait_for(lambda: start().success, "a mission that starts", UP_WITHIN_S)
        self.states.wait(lambda s: s.state_name == "APPROACH", "APPROACH", UP_WITHIN_S, begin=0.0)
        output.stop()
        # Both are refused for another reason than the call before, so each is reported.
        asking = threading.Thread(target=lambda: [call() for call in (confirm, start) * (lines // 2)], daemon=True)
        asking.start()
        asking.join(5.0)
        self.assertFalse(asking.is_alive(), "the navigator waits for its output")
        self.setpoints.wait(lambda m: not support.is_zero(m), "a vehicle on its way", 5.0)

    def assert_streams(self):
        begin = time.monotonic()
        time.sleep(WATCH_S)
        rate_hz = len(self.setpoints.since(begin)) / WATCH_S
        print(f"{rate_hz:.1f} setpoints a second")
        self.assertGreaterEqual(rate_hz, SETPOINTS_HZ)

    def first_zero_after(self, begin):
        self.setpoints.wait(support.is_zero, "zero", 5.0, begin)
        at = next(at for at, m in zip(self.setpoints.times_since(begin), self.setpoints.since(begin)) if support.is_zero(m))
        return at - begin

    def assert_abort_acts(self):
        begin = time.monotonic()
        answer = self.abort()
        answered_s = time.monotonic() - begin
        zero_s = self.first_zero_after(begin)
        print(f"~abort answered after {answered_s:.3f} s, zero after {zero_s:.3f} s")
        self.assertTrue(answer.success, answer.message)
        self.assertLess(answered_s, ANSWER_WITHIN_S)
        self.assertLess(zero_s, ZERO_WITHIN_S)

    def assert_the_guard_brakes(self):
        pid = support.pid_of("/ingress_navigator")
        begin = time.monotonic()
        os.kill(pid, signal.SIGSTOP)
        zero_s = self.first_zero_after(begin)
        os.kill(pid, signal.SIGKILL)
        print(f"navigator silent: zero after {zero_s:.3f} s")
        self.assertLess(zero_s, ZERO_WITHIN_S)

    def test_a_terminal_that_is_stopped(self):
        self.fly(Terminal(), MANY_LINES)
        support.Diagnostics().wait("ingress_navigator: console", "is blocked")
        self.assert_streams()
        self.assert_abort_acts()

    def test_a_pipe_that_nobody_reads(self):
        self.fly(Pipe())
        self.assert_the_guard_brakes()
        self.assert_streams()

    def test_a_disk_that_is_full(self):
        disk = Disk()
        folders = {name: str(disk.folder / name.lower()) for name in ("HOME", "ROS_HOME", "ROS_LOG_DIR")}
        self.fly(disk, **folders)
        self.assert_abort_acts()
        self.assert_streams()


if __name__ == "__main__":
    rospy.init_node("blocked_output_test")
    rostest.rosrun("window_ingress", "blocked_output_test", BlockedOutputTest, sys.argv)
