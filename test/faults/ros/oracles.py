"""The nine oracles that judge every fault row, as functions over a recording, without ROS.

O1 no process dies  O2 numbers finite, stamps never back  O3 speed, yaw rate and acceleration within limits
O4 zero setpoint 0.3 s after pose or odometry is lost, stream never below 10 Hz while enabled
O5 the cause is named in the diagnostics within 2 s  O6 recovers when the fault ends, moves only after its dwell or ~start
O7 memory flat, threads and time of an image bounded  O8 the same input twice gives the same output
O9 no motion when not enabled, or when the autopilot does not follow

Times are seconds of the machine's steady clock; those named stamp come from the messages.
"""
import bisect
import collections
import dataclasses
import math
import pathlib
import typing

import yaml

Setpoint = collections.namedtuple("Setpoint", "at stamp source velocity turning")  # m/s (x, y, z), rad/s about z
State = collections.namedtuple("State", "at name enabled")
Engaged = collections.namedtuple("Engaged", "at engaged")
Said = collections.namedtuple("Said", "at name level text")
Death = collections.namedtuple("Death", "at node")
BadNumber = collections.namedtuple("BadNumber", "at topic path value")
StampBack = collections.namedtuple("StampBack", "at topic before after")
Process = collections.namedtuple("Process", "at node megabytes threads")
Frame = collections.namedtuple("Frame", "at milliseconds age_sec")  # of an image: time spent, stamp to arrival
Restart = collections.namedtuple("Restart", "at")                   # of the clock: stamps may go back here
Blind = collections.namedtuple("Blind", "at seconds")                 # the observer itself was not awake, until `at`
Violation = collections.namedtuple("Violation", "oracle at text")

OK = 0
CONTEXT_S = 1.5
TOUCHED = ("COLLISION", "FALSE_INGRESS")  # verdicts of the simulated world's referee
DISOBEYS = ("cmd_vel garbage", "cmd_vel wrong", "cmd_vel stuck")  # between the guard and the vehicle


CONFIG = pathlib.Path(__file__).resolve().parents[3] / "config"
SHIPPED = yaml.safe_load((CONFIG / "navigator.yaml").read_text())["navigator"]["limits"]
GUARD_SHIPPED = yaml.safe_load((CONFIG / "guard.yaml").read_text())


@dataclasses.dataclass
class Limits:
    """Limits of the oracles. Those of motion are the shipped parameters."""
    speed_mps: float = SHIPPED["speed_mps"]
    guard_speed_mps: float = GUARD_SHIPPED["max_speed_mps"]
    yaw_rate_radps: float = SHIPPED["yaw_rate_radps"]
    guard_yaw_rate_radps: float = GUARD_SHIPPED["max_yaw_rate_radps"]
    acceleration_mps2: float = SHIPPED["acceleration_mps2"]
    yaw_acceleration_radps2: float = SHIPPED["yaw_acceleration_radps2"]
    stop_within_s: float = 0.3
    least_rate_hz: float = 10.0
    rate_window_s: float = 1.0
    named_within_s: float = 2.0
    memory_growth_mb: float = 25.0
    threads_growth: int = 8
    frame_ms: float = 2000.0
    machine_s: float = 0.1   # a machine that is busy: messages of two topics are heard so far apart


@dataclasses.dataclass
class Recording:
    """Everything recorded, each list in order of time."""
    setpoints: typing.List[Setpoint] = dataclasses.field(default_factory=list)
    states: typing.List[State] = dataclasses.field(default_factory=list)
    engaged: typing.List[Engaged] = dataclasses.field(default_factory=list)
    said: typing.List[Said] = dataclasses.field(default_factory=list)
    deaths: typing.List[Death] = dataclasses.field(default_factory=list)
    bad_numbers: typing.List[BadNumber] = dataclasses.field(default_factory=list)
    stamps_back: typing.List[StampBack] = dataclasses.field(default_factory=list)
    processes: typing.List[Process] = dataclasses.field(default_factory=list)
    frames: typing.List[Frame] = dataclasses.field(default_factory=list)
    restarts: typing.List[Restart] = dataclasses.field(default_factory=list)
    blind: typing.List[Blind] = dataclasses.field(default_factory=list)

    def between(self, begin, end):
        """Recording of this time span. Permissions given before it still hold, and are kept."""
        before = {"states": CONTEXT_S, "engaged": CONTEXT_S}
        parts = {field.name: slice_of(getattr(self, field.name), begin - before.get(field.name, 0.0), end)
                 for field in dataclasses.fields(self)}
        return Recording(**parts)

    def forget_before(self, at):
        for field in dataclasses.fields(self):
            entries = getattr(self, field.name)
            del entries[:bisect.bisect_left([entry.at for entry in entries], at)]


def slice_of(entries, begin, end):
    times = [entry.at for entry in entries]
    return entries[bisect.bisect_left(times, begin):bisect.bisect_right(times, end)]


def is_still(setpoint):
    return not any(setpoint.velocity) and setpoint.turning == 0.0


def norm(vector):
    return math.sqrt(sum(x * x for x in vector))


def O1(recording, expected=()):
    """Parameter `expected`: nodes that the test itself ends."""
    return [Violation("O1", d.at, f"process of {d.node} is gone") for d in recording.deaths if d.node not in expected]


def O2(recording):
    numbers = [Violation("O2", b.at, f"{b.topic}: {b.path} is {b.value}") for b in recording.bad_numbers]
    jumps = [Violation("O2", s.at, f"{s.topic}: stamp {s.after:.3f} after {s.before:.3f}") for s in recording.stamps_back]
    return numbers + jumps


def O3(recording, limits, guard):
    """\\param guard source of setpoints that are those of the guard: resampled, so that their steps are not the limiter's"""
    found = []
    for setpoint in recording.setpoints:
        is_guards = setpoint.source == guard
        speed = limits.guard_speed_mps if is_guards else limits.speed_mps
        rate = limits.guard_yaw_rate_radps if is_guards else limits.yaw_rate_radps
        if not norm(setpoint.velocity) <= speed + 1e-6:
            found.append(Violation("O3", setpoint.at, f"{setpoint.source}: {norm(setpoint.velocity):.3f} m/s, limit {speed}"))
        if not abs(setpoint.turning) <= rate + 1e-6:
            found.append(Violation("O3", setpoint.at, f"{setpoint.source}: {setpoint.turning:.3f} rad/s, limit {rate}"))
    for source in {s.source for s in recording.setpoints} - {guard}:
        found += too_sudden([s for s in recording.setpoints if s.source == source], limits)
    return found


def too_sudden(setpoints, limits):
    """Increase of the velocity beyond the permitted acceleration, in its direction. Decreases may be sudden."""
    found = []
    for one, two in zip(setpoints, setpoints[1:]):
        passed = min(0.2, max(0.0, two.stamp - one.stamp))
        gained = sum((b - a) * b for a, b in zip(one.velocity, two.velocity)) / max(1e-9, norm(two.velocity))
        if gained > limits.acceleration_mps2 * passed + 1e-3:
            found.append(Violation("O3", two.at, f"{two.source}: {gained:.3f} m/s faster within {passed:.3f} s"))
        turn = abs(two.turning) - abs(one.turning)
        if turn > limits.yaw_acceleration_radps2 * passed + 1e-3:
            found.append(Violation("O3", two.at, f"{two.source}: {turn:.3f} rad/s more within {passed:.3f} s"))
    return found


def O4_stop(recording, limits, lost_at, until):
    """Only zeros, and at least some, from `stop_within_s` after the loss on."""
    begin = lost_at + limits.stop_within_s + limits.machine_s
    after = slice_of(recording.setpoints, begin, until)
    moving = [s for s in after if not is_still(s) and not was_blind(recording, s.at, limits)]
    if moving:
        text = f"{moving[-1].source} still moves {moving[-1].at - lost_at:.2f} s after the loss, {norm(moving[-1].velocity):.2f} m/s"
        return [Violation("O4", moving[-1].at, text)]
    return [] if after else [Violation("O4", until, f"no setpoints at all after the loss, for {until - begin:.2f} s")]


def stop_time(recording, lost_at, until):
    """Time from the loss to the last setpoint that moves; None if none moved."""
    moving = [s.at for s in slice_of(recording.setpoints, lost_at, until) if not is_still(s)]
    return moving[-1] - lost_at if moving else None


def O4_stream(recording, limits, source, begin, end):
    """At least `least_rate_hz` within any window of [begin, end]."""
    rate, at = stream_rate(recording, limits, source, begin, end)
    if rate >= limits.least_rate_hz:
        return []
    return [Violation("O4", at, f"{source}: {rate:.1f} setpoints a second, {limits.least_rate_hz:.0f} wanted")]


def stream_rate(recording, limits, source, begin, end):
    """\\return (lowest rate within any window, where it begins); windows in which the observer was blind do not count"""
    times = [s.at for s in slice_of(recording.setpoints, begin, end) if s.source == source]
    return least_rate(times, begin, end, limits.rate_window_s, [(b.at - b.seconds, b.at + limits.machine_s) for b in recording.blind])


def least_rate(times, begin, end, window_s, blind=()):
    """\\return lowest number a second within any window, and where it begins; infinite if there is no such window"""
    worst = (math.inf, begin)
    starts = [begin] + [t + 1e-9 for t in times]
    for start in starts:
        if start + window_s <= end and not any(a < start + window_s and b > start for a, b in blind):
            count = bisect.bisect_right(times, start + window_s) - bisect.bisect_left(times, start)
            worst = min(worst, (count / window_s, start))
    return worst


def enabled_spans(states, end, begin=-math.inf):
    """[(begin, end)] in which the navigator says that it streams, from `begin` on."""
    return [(max(one, begin), two) for one, two in spans_of(states, end) if two > begin]


def spans_of(states, end):
    spans, begin = [], None
    for state in states:
        if state.enabled and begin is None:
            begin = state.at
        if not state.enabled and begin is not None:
            spans.append((begin, state.at))
            begin = None
    return spans + ([(begin, end)] if begin is not None else [])


def was_blind(recording, at, limits):
    """True if messages received then may be older."""
    return any(b.at - b.seconds <= at <= b.at + limits.machine_s for b in recording.blind)


def O5(recording, limits, caused_at, name, words):
    """The status `name` contains all the words, and is not OK, within the time."""
    said = [s for s in recording.said if s.at >= caused_at and s.name == name]
    fitting = [s for s in said if s.level != OK and all(word in s.text for word in words)]
    if fitting and fitting[0].at - caused_at <= limits.named_within_s + limits.machine_s:
        return []
    instead = f"after {fitting[0].at - caused_at:.2f} s" if fitting else f"it says '{said[-1].text}'" if said else "it says nothing"
    return [Violation("O5", caused_at, f"{name} does not say {words} within {limits.named_within_s} s: {instead}")]


def O6(recording, limits, ended_at, name):
    """The status is OK again within the time after the end of the fault."""
    if any(s.at >= ended_at and s.name == name and s.level == OK and
           s.at - ended_at <= limits.named_within_s + limits.machine_s for s in recording.said):
        return []
    said = [s.text for s in recording.said if s.at >= ended_at and s.name == name]
    return [Violation("O6", ended_at, f"{name} is not at ease again: {said[-1] if said else 'it says nothing'}")]


def O7(recording, limits):
    found = []
    for node in {p.node for p in recording.processes}:
        samples = [p for p in recording.processes if p.node == node]
        first, last = samples[:max(1, len(samples) // 10)], samples[-max(1, len(samples) // 10):]
        grown = median(p.megabytes for p in last) - median(p.megabytes for p in first)
        if grown > limits.memory_growth_mb:
            found.append(Violation("O7", last[-1].at, f"{node} has grown by {grown:.1f} MB, {limits.memory_growth_mb} allowed"))
        threads = median(p.threads for p in last) - median(p.threads for p in first)
        if threads > limits.threads_growth:
            found.append(Violation("O7", last[-1].at, f"{node} has {threads:.0f} threads more"))
    slow = [f for f in recording.frames if f.milliseconds > limits.frame_ms]
    return found + [Violation("O7", f.at, f"an image took {f.milliseconds:.0f} ms") for f in slow[:1]]


def median(values):
    ordered = sorted(values)
    return ordered[len(ordered) // 2]


def O8(one, other):
    """Two mappings must be equal to the bit."""
    differing = sorted(key for key in set(one) | set(other) if one.get(key) != other.get(key))
    return [Violation("O8", 0.0, f"{len(differing)} differ, first at {differing[0]}")] if differing else []


def O9(recording, limits):
    """Setpoints that move the vehicle while the navigator says that it does not stream, or nobody follows them."""
    found = []
    states, engaged = [s.at for s in recording.states], [e.at for e in recording.engaged]
    for setpoint in recording.setpoints:
        if is_still(setpoint) or was_blind(recording, setpoint.at, limits):
            continue
        if recording.states and not was(recording.states, states, setpoint.at, limits, lambda s: s.enabled):
            found.append(Violation("O9", setpoint.at, f"{setpoint.source} moves while the navigator is not enabled"))
        if recording.engaged and not was(recording.engaged, engaged, setpoint.at, limits, lambda e: e.engaged):
            found.append(Violation("O9", setpoint.at, f"{setpoint.source} moves while the autopilot does not follow"))
    return found


def disobeyed(faults):
    """True if the vehicle did not follow its setpoints: then no node can prevent a contact."""
    return any(fault.startswith(DISOBEYS) for fault in faults)


def contact(at, outcome, faults):
    """At the end of a flight: nothing was touched, whatever the faults."""
    if outcome not in TOUCHED or disobeyed(faults):
        return []
    return [Violation("contact", at, outcome)]


def was(entries, times, at, limits, accept):
    """Whether any entry that held at `at`, a little before or a little after, is accepted; before the first: yes."""
    first = bisect.bisect_right(times, at - limits.stop_within_s) - 1
    last = bisect.bisect_right(times, at + 2 * limits.machine_s)
    held = entries[max(0, first):last]
    return not held or any(accept(entry) for entry in held)


def always(recording, limits, navigator, guard, end, expected_deaths=(), begin=-math.inf):
    """The oracles that need no word of the test: O1, O2, O3, O4 (stream), O7, O9; of what was recorded within [begin, end]."""
    found = O1(recording, expected_deaths) + O2(recording) + O3(recording, limits, guard)
    for span in enabled_spans(recording.states, end, begin):
        for source in (navigator, guard):
            if source and source not in expected_deaths:
                found += O4_stream(recording, limits, source, *span)
    return found + O7(recording, limits) + O9(recording, limits)
