#!/usr/bin/env python3
"""Node: publishes whether the autopilot follows setpoints, as std_msgs/Bool on `engaged`, from the state of MAVROS.

Subscribes `autopilot_state` (mavros_msgs/State: connected, armed, mode). Each message gives one on `engaged`, so a silent
autopilot makes a silent topic. A message is decoded by the definition sent with it; mavros_msgs need not be installed.
Parameter ~modes: modes in which the autopilot follows velocity setpoints, default [OFFBOARD, GUIDED]. ~heed_failsafe,
default true: an autopilot in a failsafe (MAV_STATE critical or worse: low battery, lost link) counts as not engaged.

Reports on /diagnostics why the autopilot does not follow: silent, not connected, in a failsafe, in a mode of another autopilot; warns
of a second source and of messages that are no state.

Publishes `companion_status` (mavros_msgs/CompanionProcessStatus) once a second, from the navigator's `state`, if mavros_msgs is
installed and knows the component USER1. The ground station then shows this computer as stand-by, active or, if the navigator falls
silent, critical.
"""
import contextlib
import functools
import queue
import sys
import threading
import time

import genpy.dynamic
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from std_msgs.msg import Bool

from window_ingress.msg import IngressState

try:
    from mavros_msgs.msg import CompanionProcessStatus
except ImportError:
    CompanionProcessStatus = None

FIELDS = ("connected", "armed", "mode")
SETPOINT_MODES = "OFFBOARD", "GUIDED"  # of PX4, of ArduPilot
LONGEST = 300  # characters of a text
KINDS = 5  # of messages are remembered
LINES = 100  # at most this many wait to be written
MAV_STATE_CRITICAL = 5  # higher values: emergency, power off, termination
MAX_SILENCE_S = 2.0  # of the navigator, or the autopilot
REFUSED_S = 5.0  # a refused message is remembered this long
AT_REST = IngressState.IDLE, IngressState.PASSED, IngressState.ABORTED


class Relay:
    def __init__(self, modes, heeds_failsafe):
        self._modes, self._heeds_failsafe, self._said = modes, heeds_failsafe, None
        self._classes = {}  # by definition: a stranger may send another type
        self._refused, self._refused_at = None, 0.0
        self._level, self._heard = DiagnosticStatus.OK, None
        self._lines = queue.Queue(LINES)
        threading.Thread(target=self._speak, daemon=True).start()
        self._publisher = rospy.Publisher("engaged", Bool, queue_size=1, latch=False)
        self._diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=1)
        self._subscriber = rospy.Subscriber("autopilot_state", rospy.AnyMsg, self._receive, queue_size=1)
        threading.Thread(target=self._repeat, daemon=True).start()

    def _receive(self, message):
        state = self._decode(message)
        if state is None:
            return
        fails = self._heeds_failsafe and getattr(state, "system_status", 0) >= MAV_STATE_CRITICAL
        engaged = bool(state.connected and state.armed and state.mode in self._modes and not fails)
        self._publisher.publish(engaged)
        modes = "" if state.mode in self._modes else f" (it follows in {' or '.join(self._modes)})"
        said = f"{'follows' if engaged else 'does not follow'} setpoints: " \
               f"{'' if state.connected else 'not connected, '}{'armed' if state.armed else 'disarmed'}, mode {state.mode}{modes}" \
               f"{', in a failsafe' if fails else ''}"
        if said != self._said:
            self._say(rospy.loginfo, "the autopilot " + said)
            self._said = said
        of_another = state.mode in SETPOINT_MODES and modes
        self._level = DiagnosticStatus.ERROR if fails or not state.connected else DiagnosticStatus.WARN if of_another else DiagnosticStatus.OK
        self._heard = time.monotonic()

    def _health(self):
        if self._heard is None:
            return DiagnosticStatus.ERROR, f"nothing on {self._subscriber.resolved_name} so far"
        if time.monotonic() - self._heard > MAX_SILENCE_S:
            return DiagnosticStatus.ERROR, f"{self._subscriber.resolved_name} has fallen silent"
        if self._level == DiagnosticStatus.OK:
            if self._refused and time.monotonic() - self._refused_at < REFUSED_S:
                return DiagnosticStatus.WARN, f"{self._refused}; the autopilot {self._said}"
            if self._subscriber.get_num_connections() > 1:
                return DiagnosticStatus.WARN, f"more than one source on {self._subscriber.resolved_name}: the autopilot {self._said}"
        return self._level, f"the autopilot {self._said}"

    def _repeat(self):
        name = f"{rospy.get_name().lstrip('/')}: autopilot"
        while not rospy.is_shutdown():
            time.sleep(1.0)
            level, text = self._health()
            message = DiagnosticArray(status=[DiagnosticStatus(level=level, name=name, message=text, hardware_id=rospy.get_name())])
            message.header.stamp = rospy.Time.now()
            self._diagnostics.publish(message)

    def _say(self, log, text):
        """Never waits for a terminal or a disk: a thread writes the lines. They are lost while it is blocked."""
        with contextlib.suppress(queue.Full):
            self._lines.put_nowait((log, text))

    def _speak(self):
        while True:
            log, text = self._lines.get()
            log(text)

    def _decode(self, message):
        header = message._connection_header
        try:
            kind = self._class_of(header["type"], header["message_definition"])
            missing = [name for name in FIELDS if name not in kind.__slots__]
            why = f"without {', '.join(missing)}; it must be mavros_msgs/State" if missing else None
            if not missing:
                return kind().deserialize(message._buff)
        except Exception as error:  # whatever a stranger sends: no exception leaves a callback
            why = f"not readable: {error}"
        self._refused, self._refused_at = f"{self._subscriber.resolved_name} is {header.get('type')}, {why}"[:LONGEST], time.monotonic()
        self._say(functools.partial(rospy.logerr_throttle, 5.0), self._refused)
        return None

    def _class_of(self, kind, definition):
        if (kind, definition) not in self._classes:
            if len(self._classes) >= KINDS:
                self._classes.clear()
            self._classes[kind, definition] = genpy.dynamic.generate_dynamic(kind, definition)[kind]
        return self._classes[kind, definition]


class Companion:
    """Tells MAVROS the state of this computer."""
    def __init__(self):
        self._state, self._heard = IngressState.IDLE, None
        self._publisher = rospy.Publisher("companion_status", CompanionProcessStatus, queue_size=1)
        self._subscriber = rospy.Subscriber("state", IngressState, self._receive, queue_size=1)
        threading.Thread(target=self._repeat, daemon=True).start()

    def _receive(self, message):
        self._state, self._heard = message.state, time.monotonic()

    def _repeat(self):
        while not rospy.is_shutdown():
            status = CompanionProcessStatus(state=self._mav_state(), component=CompanionProcessStatus.MAV_COMP_ID_USER1)
            status.header.stamp = rospy.Time.now()
            self._publisher.publish(status)
            time.sleep(1.0)

    def _mav_state(self):
        if self._heard is None:
            return CompanionProcessStatus.MAV_STATE_BOOT
        if time.monotonic() - self._heard > MAX_SILENCE_S:
            return CompanionProcessStatus.MAV_STATE_CRITICAL
        return CompanionProcessStatus.MAV_STATE_STANDBY if self._state in AT_REST else CompanionProcessStatus.MAV_STATE_ACTIVE


def main():
    rospy.init_node("engaged_from_mavros")
    modes = rospy.get_param("~modes", ["OFFBOARD", "GUIDED"])  # px4.launch and ardupilot.launch set their own
    if not isinstance(modes, list) or not modes or not all(isinstance(mode, str) for mode in modes):
        print(f"engaged_from_mavros: ~modes is {modes!r}; give a list of mode names, e.g. [OFFBOARD]", file=sys.stderr)
        sys.exit(2)
    relay = Relay(modes, bool(rospy.get_param("~heed_failsafe", True)))  # noqa: F841  (kept alive while the node spins)
    companion = Companion() if hasattr(CompanionProcessStatus, "MAV_COMP_ID_USER1") else None  # noqa: F841
    rospy.spin()


if __name__ == "__main__":
    main()
