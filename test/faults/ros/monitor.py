"""The oracles beside running nodes: records what nodes publish, watches their processes, and judges by oracles.py."""
import math
import threading
import time

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PolygonStamped, PoseWithCovarianceStamped, TwistStamped
from std_msgs.msg import Bool
from visualization_msgs.msg import MarkerArray
from window_ingress.msg import IngressState, WindowDetection, WindowPose

import oracles
import support

NODES = ("window_detector", "homography_pose", "ingress_navigator", "setpoint_guard")
AWAKE_S = 0.02
MARKERS_S = 0.5  # between two checks of the numbers in markers, which are thousands
LOOK_S = 0.25  # between two checks of the processes
MEGABYTE = 1024.0
FLOATS = {"float32", "float64"}


def numbers(message, path=""):
    """(path, value) of every floating-point number in a message, at any depth."""
    for name, kind in zip(message.__slots__, message._slot_types):
        value, here = getattr(message, name), f"{path}{name}"
        if kind in FLOATS:
            yield here, value
        elif kind.split("[")[0] in FLOATS:
            yield from ((f"{here}[{i}]", number) for i, number in enumerate(value))
        elif hasattr(value, "_slot_types"):
            yield from numbers(value, here + ".")
        elif kind.endswith("]") and value and hasattr(value[0], "_slot_types"):
            for i, item in enumerate(value):
                yield from numbers(item, f"{here}[{i}].")


def first_bad(message):
    return next(((path, value) for path, value in numbers(message) if not math.isfinite(value)), None)


def memory_and_threads(pid):
    """(MB, threads) of a process, or None if it is gone or a zombie."""
    try:
        with open(f"/proc/{pid}/status") as file:
            status = dict(line.rstrip().split(":", 1) for line in file if ":" in line)
    except OSError:
        return None
    if "VmRSS" not in status or status["State"].split()[0] in "ZX":
        return None
    return int(status["VmRSS"].split()[0]) / MEGABYTE, int(status["Threads"])


class Monitor:
    """Records from its creation on. Topics can be renamed: {"cmd_vel": "guarded"}."""

    def __init__(self, nodes=NODES, topics=None, limits=None, heavy=True):
        self.limits = limits or oracles.Limits()
        self.recording = oracles.Recording()
        self.expected_deaths = set()
        self.messages, self._markers_at = 0, 0.0
        self._lock = threading.RLock()
        self._stamps, self._pids, self._over = {}, {}, threading.Event()
        topics = topics or {}
        kinds = {"steered": TwistStamped, "cmd_vel": TwistStamped, "state": IngressState, "window": WindowDetection,
                 "window_pose": WindowPose, "window_pose_cov": PoseWithCovarianceStamped, "window_polygon": PolygonStamped}
        kinds.update({"markers": MarkerArray} if heavy else {})
        self.navigator, self.guard = "/ingress_navigator", "/setpoint_guard"
        self._subscribers = [rospy.Subscriber(topics.get(name, name), kind, self._receive, name, queue_size=200, tcp_nodelay=True)
                             for name, kind in kinds.items()]
        self._subscribers += [rospy.Subscriber("/diagnostics", DiagnosticArray, self._hear, queue_size=200),
                              rospy.Subscriber(topics.get("engaged", "engaged"), Bool, self._engage, queue_size=10)]
        self.watch(nodes)
        for work in (self._look, self._stay_awake):
            threading.Thread(target=work, daemon=True).start()

    # --- messages that arrive

    def _receive(self, message, name):
        at = time.monotonic()
        source = message._connection_header["callerid"]
        topic = message._connection_header["topic"]
        if source not in self.sources():
            return  # the test's own messages, and those of strangers
        bad = first_bad(message) if name != "markers" or at - self._markers_at > MARKERS_S else None
        with self._lock:
            self._markers_at = at if name == "markers" else self._markers_at
            self.messages += 1
            if bad:
                self.recording.bad_numbers.append(oracles.BadNumber(at, topic, *bad))
            if hasattr(message, "header"):
                self._compare(at, topic, source, message.header.stamp.to_sec())
            self._note(at, name, source, message)

    def _compare(self, at, topic, source, stamp):
        before = self._stamps.get((topic, source), -math.inf)
        restarted = self.recording.restarts and at - self.recording.restarts[-1].at < 5.0
        if stamp < before and not restarted and source not in self.expected_deaths:  # a restarted node knows no /clock yet
            self.recording.stamps_back.append(oracles.StampBack(at, topic, before, stamp))
        self._stamps[topic, source] = stamp

    def _note(self, at, name, source, message):
        if isinstance(message, TwistStamped):
            linear, stamp = message.twist.linear, message.header.stamp.to_sec()
            self.recording.setpoints.append(oracles.Setpoint(at, stamp, source, (linear.x, linear.y, linear.z), message.twist.angular.z))
        elif isinstance(message, IngressState):
            self.recording.states.append(oracles.State(at, message.state_name, message.enabled))
        elif isinstance(message, WindowDetection):
            age = rospy.Time.now().to_sec() - message.header.stamp.to_sec()
            self.recording.frames.append(oracles.Frame(at, message.milliseconds, age))

    def _hear(self, message):
        at = time.monotonic()
        with self._lock:
            self.recording.said += [oracles.Said(at, s.name, s.level, s.message) for s in message.status]

    def _engage(self, message):
        with self._lock:
            self.recording.engaged.append(oracles.Engaged(time.monotonic(), message.data))

    # --- processes

    def watch(self, nodes):
        """From now on these processes must live."""
        for node in nodes:
            self._pids["/" + node.lstrip("/")] = support.wait_for(lambda: running(node), f"{node} runs", 30.0)

    def sources(self):
        return self._pids.keys()

    def pid(self, node):
        return self._pids["/" + node.lstrip("/")]

    def _look(self):
        while not self._over.wait(LOOK_S):
            for node, pid in list(self._pids.items()):
                self._look_at(node, pid)

    def _stay_awake(self):
        """Notes when this process itself did not run: it receives the messages of that time late."""
        before = time.monotonic()
        while not self._over.wait(AWAKE_S):
            now = time.monotonic()
            if now - before > AWAKE_S + self.limits.machine_s:
                with self._lock:
                    self.recording.blind.append(oracles.Blind(now, now - before))
            before = now

    def _look_at(self, node, pid):
        found = memory_and_threads(pid)
        at = time.monotonic()
        with self._lock:
            if found:
                self.recording.processes.append(oracles.Process(at, node, *found))
            elif self._pids.get(node) == pid and node not in [d.node for d in self.recording.deaths]:
                self.recording.deaths.append(oracles.Death(at, node))

    # --- verdicts

    def clock_restarts(self):
        """Stamps may go back from now on, for five seconds."""
        with self._lock:
            self.recording.restarts.append(oracles.Restart(time.monotonic()))

    def part(self, begin, end=None):
        with self._lock:
            return self.recording.between(begin, time.monotonic() if end is None else end)

    def states_since(self, begin):
        with self._lock:
            return oracles.slice_of(self.recording.states, begin, math.inf)

    def violations(self, begin, end=None):
        end = time.monotonic() if end is None else end
        return oracles.always(self.part(begin, end), self.limits, self.navigator, self.guard, end, self.expected_deaths, begin)

    def forget_before(self, at):
        with self._lock:
            self.recording.forget_before(at)

    def names(self, begin, name, *words):
        """Waits for the status that names the cause. Returns violations of O5."""
        return self._settled(lambda: oracles.O5(self.part(begin), self.limits, begin, name, words), begin)

    def recovers(self, begin, name):
        """Waits for the status to be OK again. Returns violations of O6."""
        return self._settled(lambda: oracles.O6(self.part(begin), self.limits, begin, name), begin)

    def _settled(self, judge, begin):
        end = begin + self.limits.named_within_s + 2 * self.limits.machine_s
        while judge() and time.monotonic() < end:
            time.sleep(support.POLL_S)
        return judge()

    def stops(self, begin, watch_s=1.0):
        """Waits, then judges whether all setpoints are zero from 0.3 s after `begin` on. Returns violations of O4."""
        end = begin + self.limits.stop_within_s + watch_s
        support.wait_for(lambda: time.monotonic() > end, "the time of the measurement")
        return oracles.O4_stop(self.part(begin, end), self.limits, begin, end)

    def stop(self):
        self._over.set()
        for subscriber in self._subscribers:
            subscriber.unregister()


def running(node):
    """Process id of a node that answers, or None."""
    try:
        return support.pid_of("/" + node.lstrip("/"))
    except (rosgraph.MasterException, OSError, AssertionError):
        return None
