"""Part of doctor: each input has one publisher, the right type, a sufficient rate and current stamps."""
from ingress_tools.observed_system import ARGUMENTS, PIPELINE
from ingress_tools.remedies import AGAIN, another_topic, remedy

WANTED_HZ = {"sensor_msgs/Image": 15.0, "sensor_msgs/CompressedImage": 15.0, "nav_msgs/Odometry": 30.0, "sensor_msgs/Imu": 30.0}
ALMOST = 0.85  # of a wanted rate is accepted
DAY_S = 86400.0
LATE_S = 0.27  # close to the age at which the navigator no longer flies at a window


def is_of_world(system, topic):
    return any(node.rsplit("/", 1)[-1] == "world" for node in system.graph.publishers.get(topic, []))


def world_waits(system, report):
    """Whether the simulated world lacks its input: the odometry of a vehicle that another program simulates."""
    refuses = any(name.rsplit("/", 1)[-1].startswith("world: ") and status.level > 1 for name, status in system.said.items())
    return refuses or any(finding.level == "ERROR" for finding in report.findings)


def waits_for_estimator(topic):
    return ("wait until the autopilot's estimator runs, up to 90 s after power-on; ArduPilot then needs scripts/run rosservice call "
            f"{topic.split('/mavros/')[0]}/mavros/set_stream_rate 0 50 1")


def check_input(system, report, topic, kind, readers):
    publishers = system.graph.publishers.get(topic, [])
    sample = system.samples[topic]
    type_ = system.graph.types.get(topic, kind)
    place = {"symptom": "/clock" in report.named}
    if not sample.times and is_of_world(system, topic) and world_waits(system, report):
        place = {"symptom": True, "stage": len(PIPELINE)}
    if not publishers:
        report.error(f"{topic}: 0 publishers, read by {readers}", another_topic(system, topic, kind), [topic], **place)
    elif type_ not in (kind, "*"):
        report.error(f"{topic}: is a {type_}, {readers} reads {kind}", another_topic(system, topic, kind), [topic], **place)
    elif not sample.times:
        mend = (waits_for_estimator(topic) if "/mavros/" in topic else
                "if it plays a file, that is over; else read what it says on its console or in ~/.ros/log, and start it again")
        report.error(f"{topic}: {', '.join(publishers)} advertises it and sends nothing", mend,
                     [topic], **place)
    elif len(publishers) > 1:
        report.error(f"{topic}: {len(publishers)} publishers: {', '.join(publishers)}", f"stop one of them: scripts/run rosnode kill {publishers[-1]}",
                     [topic], **place)
    elif sample.rate_hz() < ALMOST * WANTED_HZ.get(kind, 0.0):
        report.warn(f"{topic}: {sample.rate_hz():.1f} Hz, should be {WANTED_HZ[kind]:.0f} Hz or more", f"raise the rate of {publishers[0]}; "
                    "MAVROS: doc/autopilots.md", [topic], **place)
    else:
        check_age(report, topic, kind, publishers[0], sample, **place)


def check_age(report, topic, kind, publisher, sample, **place):
    age = sample.age_s()
    text = f"{topic}: {sample.rate_hz():.1f} Hz from {publisher}"
    if abs(age) > DAY_S:
        when = "old" if age > 0.0 else "ahead of the clock"
        mend = remedy("recorded data" if age > 0.0 else "is use_sim_time set")
        report.error(f"{text}, stamps {abs(age) / DAY_S:.0f} days {when}", mend, [topic], **place)
    elif not -0.1 <= age <= 0.5:
        report.error(f"{text}, stamps {abs(age):.2f} s {'old' if age > 0.0 else 'ahead of the clock'}",
                     "synchronise the clocks (chrony); let the driver stamp at the exposure", [topic], **place)
    elif age > LATE_S:
        oldest = "max_vehicle_age_sec" if kind == "nav_msgs/Odometry" else "max_target_age_sec"
        report.warn(f"{text}, stamps {age:.2f} s old: the vehicle stops at ingress_navigator/navigator/input/{oldest}",
                    "a driver with less delay; synchronise the clocks (chrony, MAVROS's timesync)", [topic], **place)
    else:
        report.ok(f"{text}, {1e3 * age:.0f} ms old")


def check_mavros(system, report, topics):
    """Reports a missing MAVROS, or one without an autopilot, as one finding for all its topics. \return those topics"""
    topics = [topic for topic in topics if "/mavros/" in topic]
    missing = [topic for topic in topics if not system.graph.publishers.get(topic)]
    if not topics or (missing != topics and any(system.samples[topic].times for topic in topics)):
        return []
    engaged = system.input("ingress_navigator", "std_msgs/Bool")
    namespace = topics[0].split("/mavros/")[0] + "/mavros"
    listed = ", ".join(topics)
    if missing == topics:
        report.error(f"MAVROS is not running: 0 publishers of {listed}",
                     f"start MAVROS (roslaunch mavros px4.launch, or apm.launch), or {AGAIN} mavros:=ITS_NAMESPACE", [*topics, engaged, f"{namespace}/state"])
    else:
        report.error(f"MAVROS sends nothing on {listed}: has it an autopilot?",
                     f"scripts/run rostopic echo -n1 {namespace}/state says whether it is connected; if not, mend fcu_url:= of MAVROS; "
                     f"if it is: {waits_for_estimator(topics[0])}", [*topics, engaged, f"{namespace}/state"])
    return topics


def check_inputs(system, report):
    readers = {}
    for name, inputs in system.inputs.items():
        for topic, kind in inputs.items():
            if topic in system.samples and kind in ARGUMENTS:
                readers.setdefault((topic, kind), []).append(name)
    of_mavros = check_mavros(system, report, sorted(topic for topic, _ in readers))
    for (topic, kind), names in sorted(readers.items(), key=lambda reader: (is_of_world(system, reader[0][0]), reader)):
        if topic in of_mavros:
            continue
        optional = kind == "sensor_msgs/Imu" and names == ["window_detector"]
        if not optional:
            check_input(system, report, topic, kind, " and ".join(names))
