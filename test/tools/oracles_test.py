"""Each oracle of the fault rows accepts a good recording and finds the fault in a bad one."""
import math
import os
import sys

import pytest

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "faults", "ros"))

import oracles
from oracles import BadNumber, Death, Engaged, Frame, Limits, Process, Recording, Said, Setpoint, StampBack, State

NAVIGATOR, GUARD = "/ingress_navigator", "/setpoint_guard"
LIMITS = Limits()


def setpoints(speed_of, begin=0.0, end=10.0, rate_hz=30.0, source=NAVIGATOR):
    count = int((end - begin) * rate_hz)
    times = [begin + i / rate_hz for i in range(count)]
    return [Setpoint(t, 100.0 + t, source, (speed_of(t), 0.0, 0.0), 0.0) for t in times]


def ramp(t):
    """Up to 0.8 m/s within the permitted acceleration, and at once down to zero at 5 s."""
    return min(0.8, 1.4 * max(0.0, t - 1.0)) if t < 5.0 else 0.0


def good():
    return Recording(setpoints=sorted(setpoints(ramp) + setpoints(ramp, source=GUARD), key=lambda s: s.at),
                     states=[State(0.1 * i, "ALIGN", True) for i in range(100)],
                     engaged=[Engaged(0.2 * i, True) for i in range(50)],
                     said=[Said(float(i), "node: odom", 2 if 5 <= i < 8 else 0, "no more odom on /odom") for i in range(10)],
                     processes=[Process(float(i), NAVIGATOR, 40.0 + 0.1 * i, 9) for i in range(10)],
                     frames=[Frame(float(i), 12.0, 0.05) for i in range(10)])


def always(recording, **more):
    return oracles.always(recording, LIMITS, NAVIGATOR, GUARD, 10.0, **more)


def names(violations):
    return sorted({violation.oracle for violation in violations})


def test_a_good_recording_passes_all():
    recording = good()
    assert always(recording) == []
    assert oracles.O4_stop(recording, LIMITS, 4.9, 9.0) == []
    assert oracles.O5(recording, LIMITS, 4.5, "node: odom", ["no more odom", "/odom"]) == []
    assert oracles.O6(recording, LIMITS, 7.5, "node: odom") == []
    assert oracles.O8({1: "a"}, {1: "a"}) == []


def test_O1_a_process_that_dies_unless_it_was_killed():
    recording = good()
    recording.deaths.append(Death(3.0, NAVIGATOR))
    assert names(always(recording)) == ["O1"]
    assert names(always(recording, expected_deaths=(NAVIGATOR,))) == []


def test_O2_numbers_and_stamps():
    recording = good()
    recording.bad_numbers.append(BadNumber(3.0, "/window_pose", "pose.pose.position.x", math.nan))
    assert "position.x" in always(recording)[0].text
    recording = good()
    recording.stamps_back.append(StampBack(3.0, "/state", 10.0, 9.0))
    assert names(always(recording)) == ["O2"]


@pytest.mark.parametrize("velocity, turning", [((1.1, 0.0, 0.0), 0.0), ((0.7, 0.7, 0.5), 0.0), ((0.0, 0.0, 0.0), -0.6),
                                               ((math.nan, 0.0, 0.0), 0.0), ((0.0, 0.0, 0.0), math.inf)])
def test_O3_speed_and_yaw_rate(velocity, turning):
    recording = Recording(setpoints=[Setpoint(1.0, 1.0, NAVIGATOR, velocity, turning)])
    assert names(oracles.O3(recording, LIMITS, GUARD)) == ["O3"]


def test_O3_acceleration_counts_where_speed_is_added_not_where_it_is_taken_away():
    assert oracles.O3(Recording(setpoints=setpoints(lambda t: 0.0 if t > 5.0 else 0.8)), LIMITS, GUARD) == []
    assert names(oracles.O3(Recording(setpoints=setpoints(lambda t: 0.8 if t > 5.0 else 0.0)), LIMITS, GUARD)) == ["O3"]
    reversed_ = Recording(setpoints=setpoints(lambda t: -0.8 if t > 5.0 else 0.8))
    assert names(oracles.O3(reversed_, LIMITS, GUARD)) == ["O3"], "as fast, but back"
    cut_aside = [Setpoint(0.0, 0.0, NAVIGATOR, (0.5, 0.3, 0.0), 0.0), Setpoint(0.03, 0.03, NAVIGATOR, (0.54, 0.0, 0.0), 0.0)]
    assert oracles.O3(Recording(setpoints=cut_aside), LIMITS, GUARD) == []
    turning = [Setpoint(0.03 * i, 0.03 * i, NAVIGATOR, (0.0, 0.0, 0.0), 0.4 * (i > 5)) for i in range(10)]
    assert names(oracles.O3(Recording(setpoints=turning), LIMITS, GUARD)) == ["O3"]


def test_O3_the_guard_has_limits_of_its_own():
    fast = [Setpoint(1.0, 1.0, GUARD, (1.15, 0.0, 0.0), 0.9)]
    assert oracles.O3(Recording(setpoints=fast), LIMITS, GUARD) == []
    faster = [Setpoint(1.0, 1.0, GUARD, (1.25, 0.0, 0.0), 0.0)]
    assert names(oracles.O3(Recording(setpoints=faster), LIMITS, GUARD)) == ["O3"]


def test_O4_a_vehicle_that_flies_on_after_the_loss():
    recording = good()
    assert names(oracles.O4_stop(recording, LIMITS, 4.0, 9.0)) == ["O4"]
    assert abs(oracles.stop_time(recording, 4.0, 9.0) - 1.0) < 0.05
    assert oracles.stop_time(recording, 6.0, 9.0) is None


def test_O4_silence_is_no_stop():
    recording = Recording(setpoints=setpoints(ramp, end=5.0))
    assert names(oracles.O4_stop(recording, LIMITS, 4.9, 9.0)) == ["O4"]


def test_O4_a_stream_that_falters_while_enabled():
    recording = good()
    recording.setpoints = [s for s in recording.setpoints if not (6.0 < s.at < 6.9 and s.source == GUARD)]
    assert [v.text.split(":")[0] for v in always(recording)] == [GUARD]
    recording.states = [State(s.at, s.name, s.at < 5.5) for s in recording.states]
    assert always(recording) == []


def test_O4_the_least_rate_sees_gaps_at_both_ends():
    times = [5.0 + 0.05 * i for i in range(20)]
    assert oracles.least_rate(times, 5.0, 6.0, 1.0)[0] == 20
    assert oracles.least_rate(times, 4.0, 6.0, 1.0)[0] < 10
    assert oracles.least_rate(times, 5.0, 7.0, 1.0)[0] < 10
    assert oracles.least_rate([], 5.0, 7.0, 1.0)[0] == 0


def test_O4_what_a_blind_observer_missed_is_not_held_against_the_stream():
    recording = good()
    recording.setpoints = [s for s in recording.setpoints if not 6.0 < s.at < 6.95]
    assert names(always(recording)) == ["O4"]
    recording.blind = [oracles.Blind(6.95, 0.95)]
    assert always(recording) == []
    recording.setpoints = [s for s in recording.setpoints if not 8.0 < s.at < 8.95]
    assert names(always(recording)) == ["O4"], "another gap counts"
    moving = Recording(setpoints=setpoints(lambda t: 0.0 if t > 6.0 else 0.5))
    assert names(oracles.O4_stop(moving, LIMITS, 5.2, 9.0)) == ["O4"]
    moving.blind = [oracles.Blind(6.0, 0.5)]
    assert oracles.O4_stop(moving, LIMITS, 5.2, 9.0) == []


def test_O5_a_cause_that_is_named_late_or_not_or_calmly():
    recording = good()
    assert names(oracles.O5(recording, LIMITS, 1.0, "node: odom", ["no more odom"])) == ["O5"]
    assert names(oracles.O5(recording, LIMITS, 4.5, "node: odom", ["another cause"])) == ["O5"]
    assert names(oracles.O5(recording, LIMITS, 4.5, "node: imu", ["odom"])) == ["O5"]
    assert names(oracles.O5(recording, LIMITS, 8.5, "node: odom", ["no more odom"])) == ["O5"]


def test_O6_what_does_not_recover():
    recording = good()
    assert names(oracles.O6(recording, LIMITS, 5.0, "node: odom")) == ["O6"]
    assert names(oracles.O6(recording, LIMITS, 9.5, "node: odom")) == ["O6"]


def test_O7_memory_threads_and_time_of_an_image():
    recording = good()
    recording.processes = [Process(float(i), NAVIGATOR, 40.0 + 4.0 * i, 9) for i in range(10)]
    assert names(always(recording)) == ["O7"]
    recording.processes = [Process(float(i), NAVIGATOR, 40.0, 9 + 2 * i) for i in range(10)]
    assert names(always(recording)) == ["O7"]
    recording = good()
    recording.frames.append(Frame(9.5, 5000.0, 0.05))
    assert names(always(recording)) == ["O7"]


def test_O8_two_runs_that_differ():
    assert names(oracles.O8({1: "a", 2: "b"}, {1: "a", 2: "c"})) == ["O8"]
    assert names(oracles.O8({1: "a"}, {})) == ["O8"]


def test_O9_motion_without_permission():
    recording = good()
    recording.states = [State(s.at, "IDLE", s.at < 3.0) for s in recording.states]
    assert names(oracles.O9(recording, LIMITS)) == ["O9"]
    recording = good()
    recording.engaged = [Engaged(e.at, e.at < 3.0) for e in recording.engaged]
    assert names(oracles.O9(recording, LIMITS)) == ["O9"]


@pytest.mark.parametrize("outcome, faults, violations", [
    ("COLLISION", ["odom garbage 2.0 s"], ["contact"]),
    ("FALSE_INGRESS", [], ["contact"]),
    ("COLLISION", ["image off 1.0 s", "cmd_vel garbage 2.0 s"], []),  # behind the guard
    ("COLLISION", ["cmd_vel delayed 2.0 s"], ["contact"]),
    ("PASSED", [], []),
    ("ABORTED", ["image off 1.0 s"], []),
])
def test_nothing_is_touched_while_the_vehicle_obeys(outcome, faults, violations):
    assert names(oracles.contact(5.0, outcome, faults)) == violations


def test_a_permission_given_before_the_part_that_is_judged_holds_on():
    recording = good()
    recording.engaged = [Engaged(2.9, True), Engaged(3.3, False), Engaged(3.5, False)]
    recording.setpoints = [s for s in recording.setpoints if s.at < 3.4]
    assert oracles.O9(recording.between(3.2, 4.0), LIMITS) == []
    assert oracles.enabled_spans(recording.between(3.2, 4.0).states, 4.0, 3.2) == [(3.2, 4.0)]


def test_what_was_judged_can_be_forgotten_and_a_part_be_taken():
    recording = good()
    part = recording.between(2.0, 3.0)
    assert {type(x) for x in part.setpoints} == {Setpoint} and all(2.0 <= s.at <= 3.0 for s in part.setpoints)
    recording.forget_before(5.0)
    assert recording.setpoints[0].at >= 5.0 and recording.states[0].at >= 5.0
