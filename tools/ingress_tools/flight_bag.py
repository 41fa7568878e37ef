"""Reads a flight from a bag: a simulated one with its truth, or a real one without. See flight_data.py."""
import math

import numpy as np
import rosbag

from . import package_paths
from .campaign_data import DataError
from .flight_data import Flight, Images, yaw_of

KINDS = {"state": "window_ingress/IngressState", "pose": "window_ingress/WindowPose", "odom": "nav_msgs/Odometry",
         "truth": "nav_msgs/Odometry", "window": "geometry_msgs/PoseStamped", "verdict": "window_ingress/FlightVerdict"}
RULES = package_paths.share() / "msg/migration/nested_messages.bmr"


def read_bag(file, topics):
    try:
        with rosbag.Bag(file) as bag:
            chosen = choose(file, bag.get_type_and_topic_info().topics, topics)
            messages = {name: [] for name in KINDS}
            for topic, message, _ in bag.read_messages(topics=[topic for topic in chosen.values() if topic]):
                messages[next(name for name, own in chosen.items() if own == topic)].append(message)
            if bag.get_message_count() == 0:
                raise DataError(f"{file}: holds no message; rosbag records none where less than 1 GB of the disk is free")
    except (OSError, rosbag.ROSBagException) as error:
        raise DataError(f"{file}: {error or type(error).__name__}; if it was not closed, mend it with 'rosbag reindex'") \
            from error
    return flight_of(file, messages, chosen)


def choose(file, info, asked):
    """{kind: topic} for each of KINDS; None where the bag holds none."""
    chosen = {}
    for name, kind in KINDS.items():
        own = asked.get(name)
        if own and own not in info:
            raise DataError(f"{file}: no topic {own}; it holds {', '.join(sorted(info)) or 'nothing'}")
        if own and info[own].msg_type != kind:
            raise DataError(f"{file}: {own} is {info[own].msg_type}, not {kind}")
        chosen[name] = own or only_one(file, name, [t for t in sorted(info) if info[t].msg_type == kind])
    return chosen


def only_one(file, name, topics):
    ends = {"truth": "ground_truth/odom", "window": "ground_truth/window"}
    if name in ends:
        topics = [topic for topic in topics if topic.endswith(ends[name])]
    elif name == "odom":
        topics = [topic for topic in topics if not topic.endswith(ends["truth"])]
        topics = [topic for topic in topics if topic == "/odom"] or topics
    if len(topics) > 1:
        raise DataError(f"{file}: several topics for --{name}: {', '.join(topics)}; say which")
    return topics[0] if topics else None


def flight_of(file, messages, chosen):
    messages["state"] = [m for m in messages["state"] if stamp(m) > 0]  # messages before /clock runs have no time
    if not messages["state"]:
        raise DataError(f"{file}: no {KINDS['state']} in it; was the navigator running, and /state recorded?")
    if messages["pose"] and not hasattr(messages["pose"][0], "image"):
        raise DataError(f"{file}: recorded by an earlier version; convert it: rosbag fix -n {file} NEW.bag {RULES}")
    is_truth = bool(messages["truth"] and messages["window"])
    vehicle = messages["truth" if is_truth else "odom"]
    if len(vehicle) < 2:
        raise DataError(f"{file}: no nav_msgs/Odometry with two messages; record the topic, or name it with --odom")
    window = messages["window"][-1].pose if is_truth else trusted_window(file, messages["pose"])
    begin = start_of(messages["state"], messages["verdict"])
    flight = Flight(file, motion_in(window, vehicle, begin), [(stamp(m) - begin, m.state_name) for m in messages["state"]],
                    Images([image_row(m, begin) for m in messages["pose"] if m.image.reject == 0]),
                    filtered_angle(messages["pose"], messages["odom"] or vehicle, begin))
    flight.is_truth = is_truth
    flight.predicted_miss = next((m.predicted_miss for m in reversed(messages["state"]) if m.predicted_miss > 0), None)
    flight.reason = messages["state"][-1].reason
    flight.verdict = next((f"{m.outcome_name}: {m.reason}" for m in reversed(messages["verdict"]) if m.outcome != m.RUNNING), "")
    sizes = [(m.size.width, m.size.height) for m in messages["pose"] if m.size.width > 0]
    flight.window_size = sizes[-1] if sizes else None
    return flight


def trusted_window(file, poses):
    """The window's pose by the last trusted estimate."""
    good = [m for m in poses if m.filtered.valid and m.filtered.sign_trusted]
    if not good:
        raise DataError(f"{file}: neither ground_truth/odom and ground_truth/window nor a trusted pose of the window; "
                          "record window_pose, or see its filtered.reason")
    return good[-1].filtered.pose.pose


def stamp(message):
    return message.header.stamp.to_sec()


def start_of(states, verdicts):
    """The referee's start, if there is one: a late recorder misses the first states."""
    told = next((stamp(m) - m.time for m in verdicts if m.time > 0 and not m.crossed), None)
    return told or next((stamp(m) for m in states if m.state_name != "IDLE"), stamp(states[0]))


def motion_in(window, vehicle, begin):
    yaw, centre = yaw_of(window.orientation), window.position
    into, left = (math.cos(yaw), math.sin(yaw)), (-math.sin(yaw), math.cos(yaw))
    rows = []
    for message in vehicle:
        place, speed = message.pose.pose.position, message.twist.twist.linear
        dx, dy = place.x - centre.x, place.y - centre.y
        rows.append((stamp(message) - begin, dx * into[0] + dy * into[1], dx * left[0] + dy * left[1], place.z - centre.z,
                     yaw_of(message.pose.pose.orientation) - yaw, math.sqrt(speed.x ** 2 + speed.y ** 2 + speed.z ** 2)))
    return np.array(rows)


def image_row(message, begin):
    yaw, apparent = message.image.relative_yaw, message.image.apparent
    return (stamp(message) - begin, yaw.angle, yaw.sign_trusted, apparent.width, apparent.height, apparent.left_side,
            apparent.right_side)


def filtered_angle(poses, odometry, begin):
    """(times, filtered angle of the window's axis against the vehicle's heading), where the filter has a pose."""
    known = [m for m in poses if m.filtered.valid]
    times = np.array([stamp(m) for m in known])
    if len(times) == 0:
        return (), ()
    order = sorted(odometry, key=stamp)
    heading = np.unwrap([yaw_of(m.pose.pose.orientation) for m in order])
    own = np.interp(times, [stamp(m) for m in order], heading)
    angle = np.array([yaw_of(m.filtered.pose.pose.orientation) for m in known]) - own
    return times - begin, (angle + math.pi) % (2 * math.pi) - math.pi
