#!/usr/bin/env python3
"""Missions in the simulated world beside a stranger who publishes garbage or lies, on any topic but those that steer;
exit code 0 if nothing was touched and no oracle violated."""
import collections
import copy
import math
import random
import sys
import threading
import time

import fault_paths  # noqa: F401
import rospy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from own_system import OwnSystem
from sensor_msgs.msg import CameraInfo, Image, Imu
from window_ingress.msg import IngressState, WindowDetection, WindowPose

import oracles
import soak

SENSING = {"odom": Odometry, "imu": Imu, "camera/camera_info": CameraInfo, "camera/image_raw": Image, "window": WindowDetection,
           "window_pose": WindowPose, "state": IngressState}
STEERING = {"ingress_navigator/cmd_vel": TwistStamped, "cmd_vel": TwistStamped}
RATE_HZ = {"camera/image_raw": 20.0, "camera/camera_info": 20.0}
USUAL_HZ = 60.0


def numbers_of(message):
    """[(owner, name)] of all floating-point members, and (list, index) of those in lists."""
    found = []
    for name, kind in zip(message.__slots__, message._slot_types):
        part = getattr(message, name)
        if kind in ("float32", "float64"):
            found.append((message, name))
        elif kind.split("[")[0] in ("float32", "float64"):
            setattr(message, name, list(part))
            found += [(getattr(message, name), i) for i in range(len(part))]
        elif hasattr(part, "_slot_types"):
            found += numbers_of(part)
        elif kind.endswith("]") and part and hasattr(part[0], "_slot_types"):
            found += [place for item in part for place in numbers_of(item)]
    return found


def spoil(message, generator):
    """Garbage: replaces some of its numbers by arbitrary ones."""
    places = numbers_of(message)
    for owner, name in generator.sample(places, min(len(places), generator.randint(1, 4))):
        value = generator.choice((math.nan, math.inf, -1e30, 1e6, 0.0, generator.uniform(-10, 10)))
        if isinstance(owner, list):
            owner[name] = value
        else:
            setattr(owner, name, value)
    if isinstance(message, Image):
        message.data = generator.randbytes(len(message.data))


def lie(message, topic, stranger):
    """A valid but wrong message: everything is moved half a metre aside or further, always by the same amount."""
    aside = stranger.aside_m
    if topic == "odom":
        message.pose.pose.position.y += aside
    elif topic == "window_pose":
        message.filtered.pose.pose.position.y += aside
        message.image.pose.pose.position.x += aside
    elif topic == "window":
        for corner in message.corners:
            corner.x += 100.0 * aside
    elif topic == "camera/camera_info":
        message.K = [1.3 * message.K[0], *message.K[1:4], 1.3 * message.K[4], *message.K[5:]]
    elif topic == "imu":
        message.orientation.x, message.orientation.w = 0.15, 0.9887
    elif isinstance(message, TwistStamped):
        message.twist.linear.x, message.twist.linear.y = 1.0, aside


class Stranger:
    """Publishes changed copies of the latest true message on one topic for a while."""

    def __init__(self, steering):
        self.kinds = {**SENSING, **(STEERING if steering else {})}
        self.generator, self.aside_m = random.Random(1), 0.5
        self.last, self.sent = {}, collections.Counter()
        self.publishers = {topic: rospy.Publisher(topic, kind, queue_size=5) for topic, kind in self.kinds.items()}
        self.listeners = [rospy.Subscriber(topic, kind, self._hear, topic) for topic, kind in self.kinds.items()]

    def _hear(self, message, topic):
        if message._connection_header["callerid"] != rospy.get_name():
            self.last[topic] = message

    def say(self, topic, kind, duration):
        threading.Thread(target=self._run, args=(topic, kind, time.monotonic() + duration), daemon=True).start()

    def _run(self, topic, kind, until):
        self.aside_m = self.generator.choice((-2.0, -0.5, 0.5, 2.0))
        while time.monotonic() < until:
            message = copy.deepcopy(self.last.get(topic) or self.kinds[topic]())
            message.header.stamp = rospy.Time.now()
            spoil(message, self.generator) if kind == "garbage" else lie(message, topic, self)
            try:
                self.publishers[topic].publish(message)
                self.sent[f"{topic} {kind}"] += 1
            except rospy.ROSException:
                pass  # a number that its type cannot hold
            time.sleep(1.0 / RATE_HZ.get(topic, USUAL_HZ))


class HostileFlights(soak.Soak):
    def __init__(self, options):
        super().__init__(options)
        self.stranger = Stranger(options.steering)
        self.touched = []

    def plan(self):
        topic = self.random.choice(sorted(self.stranger.kinds))
        return [(self.random.uniform(1.0, 7.0), topic, self.random.choice(("garbage", "lie")), self.random.uniform(1.0, 8.0))]

    def hurt(self, unit, kind, duration):
        self.stranger.say(unit, kind, duration)
        self.faults[f"{unit} {kind}"] += 1
        return f"{unit} {kind} {duration:.1f} s"

    def judge(self, began, started, done):
        before = self.contacts()
        super().judge(began, started, done)
        if self.contacts() > before:
            self.touched += done

    def contacts(self):
        return sum(self.outcomes[outcome] for outcome in oracles.TOUCHED)


def main():
    parser = soak.parser(__doc__)
    parser.add_argument("--flights", type=int, default=100)
    parser.add_argument("--steering", action="store_true", help="the topics that steer, too: those can make it touch the wall")
    options = parser.parse_args()
    with OwnSystem("sim.launch", f"scenario:={options.scenario}", f"seed:={options.seed}", "next_seed_at_reset:=true"):
        rospy.init_node("stranger", disable_signals=True)
        flights = HostileFlights(options)
        while flights.flights < options.flights:
            flights.fly()
        code = flights.report()
    soak.say(f"messages of the stranger: {sum(flights.stranger.sent.values())}; touched something in {len(flights.touched)} of "
             f"{flights.flights} flights: {', '.join(flights.touched) or 'none'}")
    return 1 if code or flights.touched else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (RuntimeError, AssertionError, rospy.ROSException, rospy.ServiceException) as error:
        soak.say(f"hostile: {error}")
        sys.exit(2)
