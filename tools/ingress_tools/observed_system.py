"""A live system as doctor observed it: its nodes, their inputs, the messages, the diagnostics."""
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from sensor_msgs.msg import CameraInfo
from window_ingress.msg import IngressState

from ingress_tools import live_system

NODES = {"window_detector": "detector.yaml", "homography_pose": "pose.yaml", "ingress_navigator": "navigator.yaml",
         "setpoint_guard": "guard.yaml"}
# From the camera to the autopilot: later nodes depend on the output of earlier ones.
PIPELINE = "world", "window_detector", "homography_pose", "engaged_from_mavros", "ingress_navigator", "setpoint_guard"
ARGUMENTS = {"sensor_msgs/Image": "image", "sensor_msgs/CompressedImage": "image_transport:=compressed image",
             "sensor_msgs/CameraInfo": "camera_info", "sensor_msgs/Imu": "imu", "nav_msgs/Odometry": "odom"}
WANTED = "window_detector", "homography_pose"  # in every launch
SETPOINTS = "geometry_msgs/TwistStamped"


def stage_of(node):
    return PIPELINE.index(node) if node in PIPELINE else 0


class System:
    """All that was observed while listening."""

    def __init__(self, master, seconds):
        self.graph = live_system.Graph(master)
        self.nodes = {name: node for node in self.graph.nodes() for name in NODES if node.rsplit("/", 1)[-1] == name}
        self.alive = {name: node for name, node in self.nodes.items() if self.graph.answers(node)}
        self.inputs = {name: self.graph.subscriptions(node) for name, node in self.alive.items()}
        guard = self.alive.get("setpoint_guard")
        outputs = self.graph.publications(guard) if guard else {}
        self.setpoints = next((topic for topic, kind in outputs.items() if kind == SETPOINTS), None)
        self.listen(seconds)

    def listen(self, seconds):
        topics = {topic: kind for inputs in self.inputs.values() for topic, kind in inputs.items() if kind in ARGUMENTS}
        samples = {topic: live_system.Sample(topic) for topic in topics}
        if self.setpoints:
            samples[self.setpoints] = live_system.Sample(self.setpoints)
        diagnostics = live_system.Collector("/diagnostics", DiagnosticArray)
        states = live_system.Collector(self.state_topic(), IngressState)
        self.clock = live_system.Sample("/clock", stamped=False)
        self.transforms = live_system.Transforms()
        time.sleep(seconds)
        for listener in (*samples.values(), self.clock, diagnostics, states):
            listener.stop()
        self.samples = samples
        self.infos = {topic: samples[topic].message(CameraInfo) for topic, kind in topics.items() if kind == "sensor_msgs/CameraInfo"}
        self.state = states.messages[-1] if states.messages else None
        self.said = {status.name: status for message in diagnostics.messages for status in message.status}

    def state_topic(self):
        node = self.alive.get("ingress_navigator")
        outputs = self.graph.publications(node) if node else {}
        return next((topic for topic, kind in outputs.items() if kind == "window_ingress/IngressState"), "/state")

    def knows_mounting(self):
        """Whether the pose node receives corners and has the camera's transform, which a bag sends only once."""
        said = {name.rsplit("/", 1)[-1]: status.level for name, status in self.said.items()}
        return said.get("homography_pose: camera mounting") == said.get("homography_pose: window") == 0

    def input(self, name, *kinds):
        return next((topic for topic, kind in self.inputs.get(name, {}).items() if kind in kinds), None)

    def namespace_of(self, name):
        """Namespace of a node's parameters; the vehicle's are beside the navigator's."""
        if name == "vehicle":
            return self.namespace_of("ingress_navigator").rsplit("/", 1)[0] + "/vehicle"
        return self.nodes.get(name, "/" + name)

    def is_launched(self, name):
        """Whether a launch file starts this node: ingress.launch loads the parameters of the nodes that it starts."""
        beside = next((node for other, node in self.alive.items() if other in WANTED), None)
        if name in WANTED or beside is None or "ingress_navigator" in self.alive:
            return True
        return rospy.has_param(f"{beside.rsplit('/', 1)[0]}/{name}")

    def parameter(self, name, path, default=None):
        return rospy.get_param(f"{self.namespace_of(name)}/{path}", default)
