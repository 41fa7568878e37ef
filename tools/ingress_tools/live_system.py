"""What doctor reads from a running ROS system: master, nodes, topics and messages. Nothing here waits for ROS time."""
import os
import socket
import struct
import threading
import time
import xmlrpc.client

import numpy
import rosgraph
import rospy

from .transforms import rotation_of, transforms_type

CALLER = "/doctor"
PATIENCE_S = 3.0  # for an answer of the master or of a node


def master():
    """The master, or None if it does not answer."""
    socket.setdefaulttimeout(PATIENCE_S)
    found = rosgraph.Master(CALLER)
    try:
        found.getPid()
        return found
    except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
        return None


class Patience(xmlrpc.client.Transport):
    """Waits at most PATIENCE_S for an answer: rospy.init_node sets the sockets' default to a minute."""

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = PATIENCE_S
        return connection


class Graph:
    """The registered nodes with their topics and services."""

    def __init__(self, master_):
        publishers, subscribers, services = master_.getSystemState()
        self.publishers, self.subscribers, self.services = dict(publishers), dict(subscribers), dict(services)
        self.types = dict(master_.getTopicTypes())
        self._master = master_
        self._silent = set()  # nodes that did not answer, not asked again: each would take as long

    def nodes(self):
        return sorted({node for table in (self.publishers, self.subscribers, self.services) for nodes in table.values()
                       for node in nodes})

    def answers(self, node):
        return self._ask(node, "getPid") is not None

    def subscriptions(self, node):
        """{topic: type} as the node itself reports; the master knows only one type per topic. Of a nodelet: those of its manager."""
        return dict(self._ask(self._worker(node), "getSubscriptions") or [])

    def publications(self, node):
        return dict(self._ask(self._worker(node), "getPublications") or [])

    def _worker(self, node):
        """The manager, if the node is the loader of a nodelet: its only bond is the manager's."""
        bonds = [topic for topic, kind in self._ask(node, "getSubscriptions") or [] if kind == "bond/Status"]
        manager = bonds[0].rsplit("/", 1)[0] if len(bonds) == 1 else None
        return manager if manager and self.answers(manager) else node

    def topics_of_type(self, kind):
        return sorted(topic for topic, type_ in self.types.items() if type_ == kind and self.publishers.get(topic))

    def _ask(self, node, question):
        if node in self._silent:
            return None
        try:
            api = xmlrpc.client.ServerProxy(self._master.lookupNode(node), transport=Patience())
            code, _, answer = getattr(api, question)(CALLER)
            return answer if code == 1 else None
        except (OSError, rosgraph.MasterException, xmlrpc.client.Error):
            self._silent.add(node)
            return None


class Sample:
    """Messages of any type on a topic; stamps are read from the bytes of those that begin with a header."""

    def __init__(self, topic, stamped=True):
        self.times, self.stamps, self.ages, self.last, self.type = [], [], [], None, None
        self._stamped = stamped
        self._subscriber = rospy.Subscriber(topic, rospy.AnyMsg, self._receive, queue_size=100)

    def _receive(self, message):
        self.times.append(time.monotonic())
        self.last, self.type = message._buff, message._connection_header.get("type")
        if self._stamped and len(self.last) >= 12:
            _, sec, nsec = struct.unpack_from("<III", self.last)
            self.stamps.append(sec + 1e-9 * nsec)
            self.ages.append(rospy.Time.now().to_sec() - self.stamps[-1])

    def stop(self):
        self._subscriber.unregister()

    def rate_hz(self):
        """Rate by the stamps, so that simulated time may run at any speed; by arrival if the stamps do not advance."""
        moments = self.stamps if len(self.stamps) > 1 and self.stamps[-1] > self.stamps[0] else self.times
        return self._rate(moments)

    def arrival_hz(self):
        """Rate by wall time."""
        return self._rate(self.times)

    @staticmethod
    def _rate(moments):
        return (len(moments) - 1) / max(1e-6, moments[-1] - moments[0]) if len(moments) > 1 else 0.0

    def message(self, kind):
        """The last message; None if there is none, or of another type. rospy gives all subscribers of a topic the form that the
        first one asked for: bytes."""
        if self.type != kind._type:
            return None
        message = kind()
        message.deserialize(self.last)
        return message

    def age_s(self):
        """Median age [s]; None without messages."""
        return sorted(self.ages)[len(self.ages) // 2] if self.ages else None

    def image_size(self):
        """(width, height) of a sensor_msgs/Image, or None."""
        if self.type != "sensor_msgs/Image":
            return None
        length = struct.unpack_from("<I", self.last, 12)[0]
        height, width = struct.unpack_from("<II", self.last, 16 + length)
        return width, height


class Collector:
    """Messages of one topic, as they come."""

    def __init__(self, topic, kind):
        self.messages = []
        self._subscriber = rospy.Subscriber(topic, kind, self.messages.append, queue_size=100)

    def stop(self):
        self._subscriber.unregister()


class Transforms:
    """/tf and /tf_static as they come."""

    def __init__(self):
        self._lock = threading.Lock()
        self._parent = {}  # child -> (parent, 4x4)
        self._said = {}  # child -> {node that sent it: (parent, 4x4)}
        kind = transforms_type()
        self._subscribers = [rospy.Subscriber(topic, kind, self._receive, queue_size=100) for topic in ("/tf", "/tf_static")]

    def _receive(self, message):
        sender = message._connection_header.get("callerid")
        for item in message.transforms:
            T = numpy.eye(4)
            move = item.transform.translation
            T[:3, 3] = move.x, move.y, move.z
            if any((item.transform.rotation.x, item.transform.rotation.y, item.transform.rotation.z, item.transform.rotation.w)):
                T[:3, :3] = rotation_of(item.transform.rotation)
            with self._lock:
                child, said = item.child_frame_id.lstrip("/"), (item.header.frame_id.lstrip("/"), T)
                self._parent[child] = said
                self._said.setdefault(child, {})[sender] = said

    def _to_root(self, frame):
        chain, T = {frame: numpy.eye(4)}, numpy.eye(4)
        while frame in self._parent and len(chain) < 1000:
            parent, T_parent_frame = self._parent[frame]
            T, frame = T_parent_frame @ T, parent
            if frame in chain:
                break
            chain[frame] = T
        return chain  # ancestor -> T_ancestor_frame

    def contradictions(self):
        """{frame: its senders} of frames that are sent with different transforms or parents."""
        def differ(said):
            (parent, T), *others = said.values()
            return any(other != parent or not numpy.allclose(T, T_other, atol=1e-3) for other, T_other in others)

        with self._lock:
            return {child: sorted(said) for child, said in self._said.items() if differ(said)}

    def frames(self):
        with self._lock:
            return sorted(set(self._parent) | {parent for parent, _ in self._parent.values()})

    def between(self, a, b):
        """T_a_b, or None if they are not connected."""
        with self._lock:
            of_a, of_b = self._to_root(a), self._to_root(b)
        for ancestor, T_ancestor_a in of_a.items():
            if ancestor in of_b:
                return numpy.linalg.inv(T_ancestor_a) @ of_b[ancestor]
        return None


def free_gigabytes(folder):
    while folder and not os.path.isdir(folder):
        folder = os.path.dirname(folder)
    state = os.statvfs(folder or "/")
    return state.f_bavail * state.f_frsize / 1e9
