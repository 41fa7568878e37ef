"""Advice of doctor on made-up findings. test/ros/doctor*.test cover live systems."""
import math
import os
import pathlib
import re
import socket
import time
import types

import pytest
from geometry_msgs.msg import TransformStamped

from ingress_tools import camera_checks, findings, hand_odometry, live_system, observed_system, remedies, topic_checks, transforms
from repository import ROOT, call, load, run

RAW, COMPRESSED = "sensor_msgs/Image", "sensor_msgs/CompressedImage"


@pytest.fixture(name="doctor", scope="module")
def fixture_doctor():
    return load("tools/doctor")


@pytest.mark.parametrize("axis, index", [((0, 0, 1), 0), ((0, 1, 0), 1), ((1, 0, 0), 2)], ids=["yaw", "pitch down", "roll"])
def test_the_mounting_is_told_in_the_angles_that_camera_pose_takes(axis, index):
    turned = transforms.matrix_of([*(math.sin(math.radians(7.5)) * value for value in axis), math.cos(math.radians(7.5))])
    wanted = [15.0 if i == index else 0.0 for i in range(3)]
    assert list(camera_checks.angles_deg(turned @ hand_odometry.R_BODY_CAMERA)) == pytest.approx(wanted)


def seen(topics=(), said=()):
    """A system with topics {name: type} of one camera, and statuses {status: level} of the nodes."""
    system = object.__new__(observed_system.System)
    topics = dict(topics)
    system.graph = types.SimpleNamespace(publishers={topic: ["/camera"] for topic in topics},
                                         topics_of_type=lambda kind: sorted(t for t, k in topics.items() if k == kind))
    system.said = {name: types.SimpleNamespace(level=level, message="") for name, level in dict(said).items()}
    system.graph.answers = lambda node: node not in system.dead
    system.dead, system.nodes, system.alive, system.inputs = [], {}, {}, {}
    return system


@pytest.mark.parametrize("wanted, kind, there, arguments", [
    ("/eye/image_raw", RAW, {"/camera/image_raw": RAW}, " image_transport:=raw image:=/camera/image_raw"),
    ("/eye/image_raw", RAW, {"/camera/image_raw/compressed": COMPRESSED}, " image_transport:=compressed image:=/camera/image_raw"),
    ("/eye/image_raw/compressed", COMPRESSED, {"/camera/image_raw/compressed": COMPRESSED},
     " image_transport:=compressed image:=/camera/image_raw"),
    ("/camera/image_raw/compressed", COMPRESSED, {"/camera/image_raw": RAW}, " image_transport:=raw image:=/camera/image_raw"),
    ("/odom", "nav_msgs/Odometry", {"/mavros/local_position/odom": "nav_msgs/Odometry", "/ground_truth/odom": "nav_msgs/Odometry"},
     " odom:=/mavros/local_position/odom")])
def test_another_topic_is_given_as_launch_files_want_it(wanted, kind, there, arguments):
    assert remedies.another_topic(seen(there), wanted, kind) == remedies.AGAIN + arguments


def test_without_another_topic_the_argument_is_named():
    assert remedies.another_topic(seen(), "/imu", "sensor_msgs/Imu") == "start what publishes /imu, or give imu:=ITS_TOPIC"


def test_of_a_topic_of_mavros_it_is_mavros_that_is_started():
    mend = remedies.another_topic(seen(), "/mavros/imu/data", "sensor_msgs/Imu")
    assert mend.startswith("start MAVROS (roslaunch mavros px4.launch") and mend.endswith("or give imu:=ITS_TOPIC")


@pytest.mark.parametrize("publishers, arrived, words", [
    ([], (), "ERROR  MAVROS is not running: 0 publishers of /mavros/imu/data, /mavros/local_position/odom"),
    (["/mavros"], (), "ERROR  MAVROS sends nothing on /mavros/imu/data, /mavros/local_position/odom: has it an autopilot?"),
    (["/mavros"], ("/mavros/imu/data",), "ERROR  /mavros/local_position/odom: /mavros advertises it and sends nothing")])
def test_mavros_that_is_away_is_one_finding(doctor, capsys, publishers, arrived, words):
    kinds = {"/mavros/imu/data": "sensor_msgs/Imu", "/mavros/local_position/odom": "nav_msgs/Odometry"}
    system = seen(said={"ingress_navigator: engaged": 2, "homography_pose: imu": 2})
    for status in system.said.values():
        status.message = "nothing on /engaged yet" if status is system.said["ingress_navigator: engaged"] else "no imu on /mavros/imu/data"
    system.nodes = system.alive = {name: f"/{name}" for name in (*doctor.WANTED, "ingress_navigator", "setpoint_guard")}
    system.inputs = {"homography_pose": kinds, "ingress_navigator": {"/engaged": "std_msgs/Bool"}}
    system.graph.publishers = {topic: publishers for topic in kinds}
    system.graph.subscribers, system.graph.types = {}, kinds
    system.setpoints = "/mavros/setpoint_velocity/cmd_vel"
    system.samples = {topic: types.SimpleNamespace(times=[0.0] * (topic in arrived), rate_hz=lambda: 50.0, age_s=lambda: 0.0)
                      for topic in (*kinds, system.setpoints)}
    report = findings.Report()
    for check in (topic_checks.check_inputs, doctor.check_setpoints, doctor.check_what_nodes_say):
        check(system, report)
    report.say()
    said = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("OK")]
    assert said[0].startswith(words), said
    assert not publishers or "set_stream_rate 0 50 1" in said[1], said
    if not arrived:
        assert said[2:] == ["       follows: /mavros/setpoint_velocity/cmd_vel: nobody takes setpoints", "1 finding(s) to mend, 1 follow from them"]


@pytest.mark.parametrize("required, setpoints, publishers, words", [
    (True, "/cmd_vel", [], "ERROR  /engaged: 0 publishers"), (False, "/cmd_vel", [], "nothing is wrong"),
    (False, "/mavros/setpoint_velocity/cmd_vel", [], "WARN   setpoints go to MAVROS, but nothing on /engaged says"),
    (True, "/mavros/setpoint_velocity/cmd_vel", ["/engaged_from_mavros"], "nothing is wrong")])
def test_a_relay_of_mavros_that_has_died_is_named_not_the_pilot(doctor, monkeypatch, capsys, required, setpoints, publishers, words):
    monkeypatch.setattr(doctor.rospy, "get_param", lambda name, default=None: required if name.endswith("engagement/required") else default)
    system = seen(said={} if publishers else {"ingress_navigator: engaged": 2})
    for status in system.said.values():
        status.message = "nothing on /engaged yet, but engagement/required is set: no mission can start"
    system.nodes = system.alive = {name: f"/{name}" for name in (*doctor.WANTED, "ingress_navigator")}
    system.inputs = {"ingress_navigator": {"/engaged": "std_msgs/Bool"}}
    system.setpoints = setpoints
    system.graph.publishers["/engaged"] = publishers
    report = findings.Report()
    doctor.check_engaged(system, report)
    if system.said and required:
        doctor.check_what_nodes_say(system, report)
    report.say()
    said = capsys.readouterr().out
    assert said.startswith(words) and "arm, and switch" not in said


@pytest.mark.parametrize("publishers, dead, words", [
    (["/engaged_from_mavros"], ["/engaged_from_mavros"], "ERROR  /engaged_from_mavros is registered but does not answer"),
    (["/engaged_from_mavros", "/stranger"], [], "ERROR  /engaged: 2 publishers: /engaged_from_mavros, /stranger")])
def test_what_engages_is_named_where_it_hangs_or_is_not_alone(doctor, capsys, publishers, dead, words):
    system = seen(said={"ingress_navigator: engaged": 2})
    system.said["ingress_navigator: engaged"].message = "/engaged has fallen silent: assumed to be out of control"
    system.nodes = system.alive = {name: f"/{name}" for name in (*doctor.WANTED, "ingress_navigator")}
    system.inputs = {"ingress_navigator": {"/engaged": "std_msgs/Bool"}}
    system.graph.publishers["/engaged"], system.dead = publishers, dead
    report = findings.Report()
    doctor.check_engaged(system, report)
    doctor.check_what_nodes_say(system, report)
    assert report.say() == 1
    said = capsys.readouterr().out
    assert said.startswith(words)
    assert dead or "rosnode kill /stranger\n" in said


# The texts of the nodes, whole.
@pytest.mark.parametrize("text, mend", [
    ("ABORTED: odometry sinks where the vehicle is told to climb, or climbs where told to sink: setpoints and odometry differ in axes, here z, which "
     "must point up", "take over; odometry must be ENU"),
    ("ABORTED: aborted: unknown to the ROS master, which was restarted: take over", "take over by the pilot's switch, end all launches"),
    ("/odom (1 publisher): twist is zero while the position moves", "let the odometry's driver fill in"),
    ("APPROACH: odometry: position and velocity disagree by 0.40 m/s", "twist must be the velocity"),
    ("more than one source on /engaged: follows setpoints", "scripts/run rostopic info names them"),
    ("the autopilot does not follow setpoints: armed, mode OFFBOARD (it follows in GUIDED)", "px4.launch is for PX4"),
    ("the autopilot does not follow setpoints: armed, mode RTL (it follows in GUIDED), in a failsafe", "read in the ground station"),
    ("/mavros/state is std_msgs/Bool, without connected, armed, mode; it must be mavros_msgs/State; the autopilot follows setpoints: armed, mode OFFBOARD",
     "scripts/run rostopic info"),
    ("camera mounting turned by about 22 deg in yaw; no approach", "is the image upside down or mirrored?"),
    ("images are stamped 0.75 +- 0.03 s late relative to odometry: correct the driver's stamps", "upside down or mirrored"),
    ("110 images show a window, but none is the reference's: correlation with the reference's surroundings 0.101 < 0.88", "red and blue exchanged"),
    ("attitudes of imu and odometry differ by 30 deg: different axes?", "one of them has other axes"),
    ("twist looks like world frame, not body frame", "axes of child_frame_id"),
    ("/odom (1 publisher) refused, 9 so far: quaternion has length 2.000000 instead of 1", "normalise"),
    ("30 of 50 images contradict the estimated window and were not used; of the others: normalised innovation squared 0.13", "measure the opening")])
def test_a_text_of_a_node_has_its_remedy(text, mend):
    assert mend in remedies.remedy(text)


@pytest.mark.parametrize("world_says, words", [("odometry", "ERROR  /odom: /drone advertises it and sends nothing"),
                                               ("refused", "ERROR  homography_pose: odom: /odom (1 publisher) refused")])
def test_a_world_without_the_odometry_that_it_draws_by_is_no_cause(doctor, capsys, world_says, words):
    kinds = {"/camera/image_raw": RAW, "/odom": "nav_msgs/Odometry"}
    is_refused = world_says == "refused"
    system = seen(said={"homography_pose: odom": 2, "world: vehicle_odom": 2} if is_refused else {})
    for status in system.said.values():
        status.message = "/odom (1 publisher) refused, 9 so far: header.frame_id is 'odom', expected 'map'"
    system.alive = {name: f"/{name}" for name in doctor.WANTED}
    system.inputs = {"window_detector": {"/camera/image_raw": RAW}, "homography_pose": {"/odom": "nav_msgs/Odometry"}}
    system.graph.publishers, system.graph.types = {"/camera/image_raw": ["/world"], "/odom": ["/drone"]}, kinds
    system.samples = {topic: types.SimpleNamespace(times=[0.0] * (is_refused and topic == "/odom"), rate_hz=lambda: 50.0, age_s=lambda: 0.0)
                      for topic in kinds}
    report = findings.Report()
    topic_checks.check_inputs(system, report)
    if is_refused:
        doctor.check_what_nodes_say(system, report)
    assert report.say() == 1
    said = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("OK")]
    assert said[0].startswith(words) and "       follows: /camera/image_raw: /world advertises it and sends nothing" in said, said


@pytest.mark.parametrize("why, mend", [
    ("/mavros/state has fallen silent", "see what MAVROS says, "), ("/mavros/state so far", "start MAVROS "),
    ("the autopilot does not follow setpoints: not connected, armed, mode OFFBOARD", "mend fcu_url:="),
    ("the autopilot does not follow setpoints: armed, mode OFFBOARD, in a failsafe", "read in the ground station")])
def test_an_autopilot_that_does_not_follow_is_one_finding_with_its_reason(doctor, capsys, why, mend):
    system = seen(said={"engaged_from_mavros: autopilot": 2, "ingress_navigator: engaged": 2})
    for status, text in zip(system.said.values(), (why, "/engaged has fallen silent: assumed to be out of control")):
        status.message = text
    system.alive = {name: f"/{name}" for name in (*doctor.WANTED, "ingress_navigator")}
    system.inputs = {"ingress_navigator": {"/engaged": "std_msgs/Bool"}}
    report = findings.Report()
    doctor.check_what_nodes_say(system, report)
    assert report.say() == 1
    said = capsys.readouterr().out
    assert said.startswith(f"ERROR  engaged_from_mavros: autopilot: {why}\n       mend: {mend}"), said


@pytest.mark.parametrize("parameters, alive, words", [
    (["/uav1/setpoint_guard"], ["window_detector"], "WARN   setpoint_guard is not running"),
    ([], ["window_detector"], "OK     setpoint_guard is not part of this launch (fly:=false)"),
    ([], ["window_detector", "ingress_navigator"], "ERROR  setpoint_guard is not running"),
    ([], [], "WARN   setpoint_guard is not running")])
def test_a_node_that_the_launch_leaves_out_is_not_missed(doctor, monkeypatch, capsys, parameters, alive, words):
    monkeypatch.setattr(observed_system.rospy, "has_param", lambda name: name in parameters)
    system = seen()
    system.nodes = system.alive = {name: f"/uav1/{name}" for name in alive}
    system.graph.nodes = lambda: list(system.nodes.values())
    report = findings.Report()
    doctor.check_nodes(system, report)
    report.say()
    assert words in capsys.readouterr().out


@pytest.mark.parametrize("mounting, window, known", [(0, 0, True), (2, 0, False), (0, 2, False), (None, None, False)])
def test_a_transform_that_the_pose_node_has_is_not_missed(mounting, window, known):
    levels = {"/homography_pose: camera mounting": mounting, "/homography_pose: window": window}
    assert seen(said={name: level for name, level in levels.items() if level is not None}).knows_mounting() == known


def test_each_remedy_is_reached():
    for number, (words, mend) in enumerate(remedies.REMEDIES):
        assert remedies.remedy(f"so {words} it is") == mend, number


@pytest.mark.parametrize("age_s, levels", [(0.12, []), (0.31, ["WARN"]), (0.7, ["ERROR"]), (-0.2, ["ERROR"])])
def test_messages_that_come_late_are_told(age_s, levels):
    report = findings.Report()
    topic_checks.check_age(report, "/odom", "nav_msgs/Odometry", "/driver", types.SimpleNamespace(age_s=lambda: age_s, rate_hz=lambda: 50.0))
    assert [finding.level for finding in report.findings] == levels


@pytest.mark.parametrize("kind, rate_hz, levels", [("nav_msgs/Odometry", 16.7, ["WARN"]), ("nav_msgs/Odometry", 29.0, []),
                                                   (RAW, 10.0, ["WARN"]), (RAW, 14.5, []), ("std_msgs/Bool", 1.0, [])])
def test_a_rate_below_what_the_pages_ask_for_is_told(kind, rate_hz, levels):
    report, system = findings.Report(), seen({"/topic": kind})
    system.graph.types = {"/topic": kind}
    system.samples = {"/topic": types.SimpleNamespace(times=[1.0], rate_hz=lambda: rate_hz, age_s=lambda: 0.02)}
    topic_checks.check_input(system, report, "/topic", kind, "homography_pose")
    assert [finding.level for finding in report.findings] == levels


@pytest.mark.parametrize("fault", ["opening looks like 1.4 x 1.2 m, configured as 1.2 x 1.0 m", "camera mounting turned by about 6 deg"])
def test_no_remedy_of_a_simulation_gives_an_argument_that_it_lacks(fault):
    mend = findings.as_run(remedies.remedy(fault), "sim.launch")
    given = re.findall(r"(\w+):=", mend)
    assert "sim.launch" in mend and set(given) <= set(re.findall(r'<arg name="(\w+)"', (ROOT / "launch/sim.launch").read_text())), mend


def test_the_frame_that_came_is_the_one_to_be_given():
    assert remedies.remedy("/odom (1 publisher) refused, 9 so far: header.frame_id is 'map', expected 'odom'") == f"{remedies.AGAIN} odom_frame:=map"
    body = remedies.remedy("/odom (1 publisher) refused, 361 so far: child_frame_id is 'base_footprint', expected 'base_link'")
    assert "vehicle: {base_frame: base_footprint}" in body
    imu = remedies.remedy("/imu (1 publisher) refused, 9 so far: the IMU's header.frame_id is 'imu_link', expected 'base_link'")
    assert "odom_frame" not in imu and "base_link" in imu


def test_what_two_nodes_refuse_alike_is_mended_once(doctor, capsys):
    text = "/odom (1 publisher) refused, 9 so far: header.frame_id is 'map', expected 'odom'"
    said_by(doctor, homography_pose__odom=(2, text), ingress_navigator__odom=(2, text.replace("9", "11")))
    assert "1 finding(s) to mend, 1 follow from them" in capsys.readouterr().out
    report = findings.Report()
    report.error("/odom: 50.0 Hz from /driver, stamps 3.00 s old", "synchronise the clocks", ["/odom"])
    doctor.check_what_nodes_say(types.SimpleNamespace(alive={name: name for name in doctor.WANTED}, said={
        "homography_pose: odom": types.SimpleNamespace(level=2, message="/odom (1 publisher) refused, 9 so far: stamp is 3.01 s old")}), report)
    assert report.say() == 1


@pytest.mark.parametrize("sender, yaw_rad, frames", [("/mounting", 0.0, {}), ("/mounting", 0.5, {"camera": ["/driver", "/mounting"]}),
                                                     ("/driver", 0.5, {})])
def test_a_transform_that_two_nodes_say_differently_is_named(monkeypatch, sender, yaw_rad, frames):
    monkeypatch.setattr(live_system.rospy, "Subscriber", lambda *_, **__: None)
    transforms = live_system.Transforms()
    for node, angle in (("/driver", 0.0), (sender, yaw_rad)):
        item = TransformStamped(child_frame_id="camera")
        item.header.frame_id = "base_link"
        item.transform.rotation.z, item.transform.rotation.w = math.sin(angle / 2.0), math.cos(angle / 2.0)
        transforms._receive(types.SimpleNamespace(transforms=[item], _connection_header={"callerid": node}))
    assert transforms.contradictions() == frames


def test_the_programs_that_are_advised_are_installed():
    advised = {match for _, mend in remedies.REMEDIES for match in re.findall(r"rosrun (\w+) (\w+)", mend)}
    assert ("tf2_ros", "static_transform_publisher") in advised
    for package, program in advised:
        folders = [pathlib.Path(root) / "lib" / package for root in ("/usr", "/opt/ros/noetic")]
        assert any((folder / program).is_file() for folder in folders), f"{package} {program}: scripts/setup does not install it"


@pytest.mark.parametrize("file, without", [("ingress.launch", {"mavros"}), ("px4.launch", set()), ("ardupilot.launch", set()),
                                           ("rehearse.launch", {"mavros", "cmd_vel"})])
def test_the_launch_files_have_the_arguments_that_are_advised(file, without):
    sources = [ROOT / "tools/doctor", *(ROOT / "tools/ingress_tools").glob("*.py")]
    lines = [line for source in sources for line in source.read_text(encoding="utf-8").splitlines() if "{AGAIN} " in line]
    advised = {*observed_system.ARGUMENTS.values(), "image_transport", *re.findall(r"(\w+):=", "".join(lines))} - {"image_transport:=compressed image"}
    assert "cmd_vel" in advised and "camera_frame" in advised
    there = set(re.findall(r'<arg name="(\w+)" default', (ROOT / "launch" / file).read_text(encoding="utf-8")))
    assert advised - there == without


def test_who_rehearses_is_told_the_arguments_of_the_rehearsal(doctor):
    assert doctor.launch_file(types.SimpleNamespace(graph=types.SimpleNamespace(nodes=lambda: ["/rosout", "/rehearsal"]))) == "rehearse.launch"


@pytest.mark.parametrize("simulated, clocks, heard, said", [
    (True, ["/world"], 3, "OK     time is that of /clock, from /world"),
    (True, ["/world"], 0, "ERROR  use_sim_time is set, but nothing comes on /clock from /world: time stands still\n       mend: /world hangs"),
    (True, [], 0, "ERROR  use_sim_time is set, but nobody publishes /clock"),
    (False, ["/world"], 0, "OK     time is that of this computer"),
    (False, ["/world"], 3, "WARN   time is that of this computer; use_sim_time is not set, nodes ignore /clock from /world"),
    (False, [], 0, "OK     time is that of this computer")])
def test_time_is_that_of_a_clock_which_runs_and_is_heeded(doctor, monkeypatch, capsys, simulated, clocks, heard, said):
    monkeypatch.setattr(doctor.rospy, "get_param", lambda name, default: simulated if name == "/use_sim_time" else default)
    system = object.__new__(observed_system.System)
    system.graph = types.SimpleNamespace(publishers={"/clock": clocks} if clocks else {})
    system.clock, system.said = types.SimpleNamespace(times=[0.0] * heard), {}
    report = findings.Report()
    doctor.check_clock(system, report)
    report.say()
    assert capsys.readouterr().out.startswith(said)


def test_a_world_that_waits_for_the_detector_is_not_mended_by_another_clock(doctor, monkeypatch, capsys):
    monkeypatch.setattr(doctor.rospy, "get_param", lambda name, default: True)
    system = seen({"/clock": "rosgraph_msgs/Clock"}, {"world: speed": 1})
    system.said["world: speed"].message = "waiting for subscribers of image_raw and odom"
    system.clock = types.SimpleNamespace(times=[])
    report = findings.Report()
    doctor.check_clock(system, report)
    report.say()
    said = capsys.readouterr().out
    assert "from /camera, waiting for subscribers of image_raw and odom: time stands still" in said
    assert "image_transport: raw" in said and "use_sim_time false" not in said


def said_by(doctor, *, alive=("window_detector", "homography_pose", "ingress_navigator", "setpoint_guard"), simulated_without_clock=False, **said):
    """Output of doctor for a system with these nodes and statuses {item: (level, message)}, as `node__item`."""
    system = object.__new__(observed_system.System)
    system.nodes = system.alive = {name: f"/{name}" for name in alive}
    system.graph = types.SimpleNamespace(publishers={}, nodes=lambda: [f"/{name}" for name in alive])
    system.said = {name.replace("__", ": "): types.SimpleNamespace(level=level, message=message) for name, (level, message) in said.items()}
    report = findings.Report()
    doctor.check_nodes(system, report)
    if simulated_without_clock:
        report.error("time stands still", "a clock", ["/clock"])
    doctor.check_what_nodes_say(system, report)
    report.say()


def test_a_cause_comes_first_and_what_follows_from_it_stands_below_it(doctor, capsys):
    said_by(doctor, homography_pose__window=(2, "no more window on /window"), homography_pose__detection=(0, "ok"),
            ingress_navigator__window_pose=(2, "no more window_pose on /window_pose"), ingress_navigator__mission=(1, "HOLD: no window seen"),
            setpoint_guard__cmd_vel_in=(2, "/cmd_vel_in is silent"), window_detector__image=(2, "the image does not change any more"))
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("OK")]
    assert lines[0] == "ERROR  window_detector: image: the image does not change any more"
    assert lines[1] == "       mend: restart the camera's driver"
    assert [line.split(": ", 1)[1] for line in lines[2:-1]] == [
        "homography_pose: window: no more window on /window", "ingress_navigator: window_pose: no more window_pose on /window_pose",
        "setpoint_guard: cmd_vel_in: /cmd_vel_in is silent", "ingress_navigator: mission: HOLD: no window seen"]
    assert all(line.startswith("       follows: ") for line in lines[2:-1])
    assert lines[-1] == "1 finding(s) to mend, 4 follow from them"


def test_after_the_end_of_a_mission_the_silence_is_no_finding(doctor, capsys):
    said_by(doctor, setpoint_guard__cmd_vel_in=(2, "/cmd_vel_in is silent"), ingress_navigator__mission=(1, "ABORTED: the goal was cancelled"))
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("OK")]
    assert lines[0] == "WARN   ingress_navigator: mission: ABORTED: the goal was cancelled"
    assert "/ingress_navigator/reset" in lines[1] and len(lines) == 3


def test_a_symptom_with_nothing_wrong_before_it_is_a_finding(doctor, capsys):
    said_by(doctor, setpoint_guard__cmd_vel_in=(2, "/cmd_vel_in is silent"))
    assert "ERROR  setpoint_guard: cmd_vel_in: /cmd_vel_in is silent\n       mend: " in capsys.readouterr().out


def test_two_causes_are_two_findings_the_nearest_takes_what_follows(doctor, capsys):
    said_by(doctor, window_detector__image=(2, "refused, 7 so far"), homography_pose__imu=(2, "no more imu on /imu"),
            ingress_navigator__window_pose=(2, "no more window_pose"), window_detector__time=(1, "the budget is 0.0 ms"))
    lines = [line.strip() for line in capsys.readouterr().out.splitlines() if not line.startswith("OK") and "mend: " not in line]
    assert lines == ["ERROR  window_detector: image: refused, 7 so far", "ERROR  homography_pose: imu: no more imu on /imu",
                     "follows: ingress_navigator: window_pose: no more window_pose", "WARN   window_detector: time: the budget is 0.0 ms",
                     "3 finding(s) to mend, 1 follow from them"]


def test_where_time_stands_still_everything_follows_from_that(doctor, capsys):
    said_by(doctor, simulated_without_clock=True, window_detector__image=(2, "no image"), homography_pose__imu=(2, "no imu"))
    out = capsys.readouterr().out
    assert out.count("mend: ") == 1 and "1 finding(s) to mend, 2 follow from them" in out


def test_who_is_not_heard_by_a_node_that_died_has_nothing_to_mend(doctor, capsys):
    said_by(doctor, alive=("window_detector", "ingress_navigator", "setpoint_guard"), window_detector__window=(1, "nobody subscribes to /window"))
    out = capsys.readouterr().out
    assert "ERROR  homography_pose is not running" in out and "follows: window_detector: window: nobody" in out and out.count("mend: ") == 1


def test_a_guard_that_died_is_the_cause_of_what_is_not_passed_on(doctor, capsys):
    said_by(doctor, alive=("window_detector", "homography_pose", "ingress_navigator"),
            ingress_navigator__passed_on=(2, "nothing on /setpoint_guard/passed_on from setpoint_guard"))
    out = capsys.readouterr().out
    assert "ERROR  setpoint_guard is not running" in out and out.count("mend: ") == 1


def test_the_zeros_past_a_dead_guard_are_no_second_source_to_be_ended(doctor, capsys):
    said_by(doctor, alive=("window_detector", "homography_pose", "ingress_navigator"), world__cmd_vel=(1, "more than one source on /cmd_vel"))
    out = capsys.readouterr().out
    assert "ERROR  setpoint_guard" in out and "follows: world: cmd_vel: more than one source" in out and out.count("mend: ") == 1


def test_an_opening_of_another_shape_than_said_is_the_cause_of_a_window_not_found(doctor, capsys):
    said_by(doctor, ingress_navigator__mission=(1, "ABORTED: window not found in 3 turns"), homography_pose__target=(
        2, "a window is seen in 186 images, but used in none: it is 1.20 times as wide as it is high, but the configured opening, 1.00 x 1.20 m, is 0.83 times"))
    lines = [line for line in capsys.readouterr().out.splitlines() if not line.startswith("OK")]
    assert lines[0].startswith("ERROR  homography_pose: target: a window is seen in 186 images") and lines[1].startswith("       mend: measure the opening's")
    assert lines[2] == "       follows: ingress_navigator: mission: ABORTED: window not found in 3 turns" and lines[3].startswith("1 finding(s) to mend")


@pytest.mark.parametrize("called, launch, wanted", [
    ("./scripts/run", None, "./scripts/run roslaunch window_ingress ingress.launch; ./scripts/ingress reference IMAGE"),
    ("", "px4.launch", "roslaunch window_ingress px4.launch; ingress reference IMAGE")])
def test_mends_are_commands_as_the_user_runs_them(monkeypatch, called, launch, wanted):
    monkeypatch.setenv("WINDOW_INGRESS_RUN", called)
    assert findings.as_run(f"{remedies.LAUNCH}; scripts/ingress reference IMAGE", launch) == wanted


@pytest.mark.parametrize("host, warned", [("localhost", False), (socket.gethostname(), False), ("drone", True)])
def test_only_a_master_elsewhere_asks_for_this_machines_address(doctor, monkeypatch, capsys, host, warned):
    for name in ("ROS_IP", "ROS_HOSTNAME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("ROS_MASTER_URI", f"http://{host}:11311")
    report = findings.Report()
    doctor.check_network(types.SimpleNamespace(graph=types.SimpleNamespace(nodes=lambda: [])), report)
    report.say()
    assert ("neither ROS_IP nor ROS_HOSTNAME" in capsys.readouterr().out) == warned


@pytest.mark.parametrize("words", [["--seconds", "abc"], ["--seconds", "-1"], ["--seconds", "nan"], ["--nope"]])
def test_wrong_usage(words):
    done = run("doctor", *words, env={**os.environ, "ROS_MASTER_URI": "http://localhost:1"})
    assert done.returncode == 2 and "Traceback" not in done.stderr and words[0] in done.stderr, done.stderr


def test_helps_before_the_package_is_built():
    env = {"PATH": "/usr/bin:/bin"}  # without the built tools
    done = call(ROOT / "tools/doctor", "--help", env=env)
    assert done.returncode == 0 and "the command that mends it" in done.stdout, done
    assert call(ROOT / "tools/doctor", env=env).returncode == 2


def test_a_node_that_hangs_is_waited_for_once_and_shortly(monkeypatch):
    """Whatever rospy sets as the default time-out of sockets."""
    monkeypatch.setattr(live_system, "PATIENCE_S", 0.3)
    with socket.create_server(("localhost", 0)) as hangs:  # takes connections, answers nothing
        master = types.SimpleNamespace(getSystemState=lambda: ([], [], []), getTopicTypes=list,
                                       lookupNode=lambda _: f"http://localhost:{hangs.getsockname()[1]}")
        graph = live_system.Graph(master)
        before = socket.getdefaulttimeout()
        socket.setdefaulttimeout(60.0)
        try:
            begin = time.monotonic()
            assert not graph.answers("/hangs") and time.monotonic() - begin < 3.0
            begin = time.monotonic()
            assert graph.subscriptions("/hangs") == {} and time.monotonic() - begin < 0.1
        finally:
            socket.setdefaulttimeout(before)
