"""Helpers of the ROS tests. Everything waits for a condition with a deadline in wall time; nothing relies on a fixed sleep."""
import pathlib
import sys
import threading
import time
import xmlrpc.client

import numpy
import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from genpy.dynamic import generate_dynamic
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_msgs.msg import Header
from std_srvs.srv import Trigger
from window_ingress.msg import FilteredPose, ImagePose, WindowPose

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "tools"))
from ingress_tools.transforms import transforms_type  # noqa: E402

DEADLINE_S = 20.0
POLL_S = 0.02


def wait_for(condition, what, deadline_s=DEADLINE_S):
    """The first true value of `condition`; fails by name when the deadline passes."""
    end = time.monotonic() + deadline_s
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(POLL_S)
    raise AssertionError(f"not within {deadline_s} s: {what}")


def pid_of(node):
    """Process of a node, as the node itself reports."""
    uri = rosgraph.Master("/test").lookupNode(node)
    code, message, pid = xmlrpc.client.ServerProxy(uri).getPid("/test")
    assert code == 1, message
    return pid


def call(service, deadline_s=DEADLINE_S):
    rospy.wait_for_service(service, deadline_s)
    return rospy.ServiceProxy(service, Trigger)()


def start_mission(within_s=DEADLINE_S):
    """Waits for the navigator and everything that it needs."""
    rospy.wait_for_service("ingress_navigator/start", within_s)
    wait_for(lambda: call("ingress_navigator/start").success, "a mission that starts", within_s)


def is_zero(setpoint):
    linear, angular = setpoint.twist.linear, setpoint.twist.angular
    return not any((linear.x, linear.y, linear.z, angular.x, angular.y, angular.z))


class Listener:
    """Messages of a topic with their wall time of arrival."""

    def __init__(self, topic, kind):
        self.kind = kind
        self._lock = threading.Lock()
        self._messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self._receive)

    def _receive(self, message):
        with self._lock:
            self._messages.append((time.monotonic(), message))

    def since(self, begin):
        with self._lock:
            return [message for at, message in self._messages if at >= begin]

    def times_since(self, begin):
        with self._lock:
            return [at for at, _ in self._messages if at >= begin]

    def forget_before(self, at):
        with self._lock:
            self._messages = [entry for entry in self._messages if entry[0] >= at]

    def wait(self, accept=lambda message: True, what="a message", deadline_s=DEADLINE_S, begin=None):
        begin = time.monotonic() if begin is None else begin
        return wait_for(lambda: next((m for m in self.since(begin) if accept(m)), None), what, deadline_s)

    def stop(self):
        self._subscriber.unregister()


def is_latched(message):
    return message._connection_header["latching"] == "1"


class Stream:
    """Publishes what `make(stamp)` gives at a rate of wall time until it is stopped.

    The topic stays advertised: a publisher that goes and comes back at once may be missed by its subscribers, because the
    master tells them from several threads, in any order.
    """

    _publishers = {}

    def __init__(self, topic, kind, make, rate_hz=30.0):
        if topic not in self._publishers:
            self._publishers[topic] = rospy.Publisher(topic, kind, queue_size=1)
        self._publisher = self._publishers[topic]
        self.make = make
        self._period_s = 1.0 / rate_hz
        self._paused = False
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def pause(self):
        self._paused = True

    def resume(self):
        self._paused = False

    def _run(self):
        while not self._stop.wait(self._period_s) and not rospy.is_shutdown():
            if self._paused:
                continue
            try:
                self._publisher.publish(self.make(rospy.Time.now()))
            except rospy.ROSException:  # the topic is closed: the node has shut down meanwhile
                return

    def stop(self):
        self._stop.set()
        self._thread.join()


class Diagnostics:
    """The latest status of each item that nodes report."""

    def __init__(self):
        self._status = {}
        self._subscriber = rospy.Subscriber("/diagnostics", DiagnosticArray, self._receive)

    def _receive(self, message):
        for status in message.status:
            self._status[status.name] = status

    def wait(self, name, *words, deadline_s=DEADLINE_S):
        """Waits until the status `name` contains all the words."""
        def found():
            status = self._status.get(name)
            return status if status and all(word in status.message for word in words) else None
        try:
            return wait_for(found, f"{name} says {words}", deadline_s)
        except AssertionError:
            status = self._status.get(name)
            raise AssertionError(f"{name} does not say {words} but: {status.message if status else 'nothing'}")


WIDTH, HEIGHT, FOCAL = 640, 480, 500.0
FRAME_PX = 16
CORNERS = ((220, 150), (420, 150), (420, 310), (220, 310))  # inner border: pixels 220..420 x 150..310


def window_image():
    """A plaster wall with an orange frame around a dark opening."""
    image = numpy.full((HEIGHT, WIDTH, 3), 190, numpy.uint8)
    (left, top), _, (right, bottom), _ = CORNERS
    image[top - FRAME_PX:bottom + FRAME_PX + 1, left - FRAME_PX:right + FRAME_PX + 1] = (20, 95, 225)
    image[top:bottom + 1, left:right + 1] = (60, 50, 45)
    noise = numpy.random.default_rng(1).normal(0.0, 2.0, image.shape)
    return numpy.clip(image + noise, 0, 255).astype(numpy.uint8)


def image_message(pixels, stamp, frame_id="camera_optical_frame"):
    message = Image(height=pixels.shape[0], width=pixels.shape[1], encoding="bgr8", step=3 * pixels.shape[1])
    message.header.stamp = stamp
    message.header.frame_id = frame_id
    message.data = pixels.tobytes()
    return message


class Camera:
    """Images that always differ, unless the camera is stuck."""

    def __init__(self, pixels=None):
        self.pixels = window_image() if pixels is None else pixels
        self.stuck = False

    def __call__(self, stamp):
        if not self.stuck:
            self.pixels[0, 0, 0] = (int(self.pixels[0, 0, 0]) + 1) % 256
        return image_message(self.pixels, stamp)


def camera_info(stamp, frame_id="camera_optical_frame", focal=FOCAL):
    message = CameraInfo(width=WIDTH, height=HEIGHT, distortion_model="plumb_bob", D=[0.0] * 5)
    message.header.stamp = stamp
    message.header.frame_id = frame_id
    cx, cy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
    message.K = [focal, 0, cx, 0, focal, cy, 0, 0, 1 if focal else 0]
    if not focal:
        message.K = [0.0] * 9
    message.R = [1, 0, 0, 0, 1, 0, 0, 0, 1]
    message.P = [focal, 0, cx, 0, 0, focal, cy, 0, 0, 0, 1, 0]
    return message


def odometry(stamp, x=0.0, speed=0.0):
    message = Odometry(child_frame_id="base_link")
    message.header.stamp = stamp
    message.header.frame_id = "odom"
    message.pose.pose.position.x = x
    message.pose.pose.position.z = 1.5 + 1e-15 * stamp.nsecs  # no two odometry samples are equal
    message.pose.pose.orientation.w = 1.0
    message.twist.twist.linear.x = speed
    return message


CAMERA_X = 0.1  # the camera is mounted this far ahead of the vehicle's centre


def imu(stamp):
    message = Imu()
    message.header.stamp = stamp
    message.header.frame_id = "base_link"
    message.orientation.w = 1.0
    return message


AUTOPILOT_STATE = f"""std_msgs/Header header
bool connected
bool armed
bool guided
bool manual_input
string mode
uint8 system_status
{80 * '='}
MSG: std_msgs/Header
{Header._full_text}"""
AutopilotState = generate_dynamic("mavros_msgs/State", AUTOPILOT_STATE)["mavros_msgs/State"]  # MAVROS may not be installed


def no_window(stamp):
    message = WindowPose(image=ImagePose(reject=ImagePose.NO_WINDOW, reason="nothing in view"),
                         filtered=FilteredPose(reject=FilteredPose.NO_WINDOW, reason="nothing in view"))
    message.header.stamp = stamp
    message.header.frame_id = "camera_optical_frame"
    return message


def changed(make, **what):
    """The same messages with these members set. 'header__frame_id' is a nested member; a function gets the message."""
    def altered(stamp):
        message = make(stamp)
        for path, value in what.items():
            *owners, name = path.split("__")
            owner = message
            for part in owners:
                owner = getattr(owner, part)
            setattr(owner, name, value(message) if callable(value) else value)
        return message
    return altered


def mounting():
    """The camera looks forward, a little ahead of the vehicle's centre."""
    message = TransformStamped(child_frame_id="camera_optical_frame")
    message.header.stamp = rospy.Time.now()
    message.header.frame_id = "base_link"
    message.transform.translation.x = CAMERA_X
    rotation = message.transform.rotation
    rotation.x, rotation.y, rotation.z, rotation.w = -0.5, 0.5, -0.5, 0.5
    return message


def publish_mounting():
    """As tf_static says it. \return the publisher: it must live as long as it is to be heard"""
    kind = transforms_type()
    publisher = rospy.Publisher("/tf_static", kind, queue_size=1, latch=True)
    publisher.publish(kind([mounting()]))
    return publisher
