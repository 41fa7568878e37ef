"""What the tests of launch files share: arguments that a launch file needs, what it starts, how it refuses."""
import cv2
import numpy
import rosgraph.names
import roslaunch.config
import roslaunch.xmlloader

from repository import ROOT, run

LAUNCH_FILES = sorted((ROOT / "launch").glob("*.launch"))
NEEDED = {"replay": ["bag:=/tmp/none.bag"], "record": ["name:=/tmp/none"], "mavros": ["modes:=[OFFBOARD]"]}  # arguments without a default
VEHICLE = ROOT / "test/ros/vehicle.yaml"
SIZE = ["window_size:=1.2,1.0", f"config:={VEHICLE}"]
GIVEN = {**NEEDED, "px4": SIZE, "ardupilot": SIZE, "mavros": [*NEEDED["mavros"], *SIZE]}  # without these nothing is flown
CHAIN = {"window_detector", "homography_pose", "ingress_navigator", "setpoint_guard"}


def dump(name, *arguments):
    """What a launch file starts: {"nodes": {name: {"type": "pkg/type", "remaps": {from: to}, ..}}, "params": {name: value}}."""
    named = {text.split(":=")[0] for text in arguments}
    given = [text for text in GIVEN.get(name, []) if text.split(":=")[0] not in named]
    config = roslaunch.config.ROSLaunchConfig()
    roslaunch.xmlloader.XmlLoader(resolve_anon=False).load(str(ROOT / f"launch/{name}.launch"), config, argv=[*given, *arguments], verbose=False)
    assert config.config_errors == []
    nodes = {}
    for node in config.nodes:
        own = {source: rosgraph.names.resolve_name(target, "/") for source, target in node.remap_args}
        nodes[rosgraph.names.ns_join(node.namespace, node.name)] = {
            "type": f"{node.package}/{node.type}", "remaps": own, "args": node.args, "required": node.required, "respawn": node.respawn,
            "prefix": node.launch_prefix}
    return {"nodes": nodes, "params": {name: param.value for name, param in config.params.items()}}


def photograph(file):
    """A frame on a wall. \return the file's name"""
    image = numpy.full((240, 320, 3), 190, numpy.uint8)
    cv2.rectangle(image, (50, 40), (270, 200), (20, 95, 225), -1)
    cv2.rectangle(image, (60, 50), (260, 190), (60, 50, 45), -1)
    cv2.imwrite(str(file), image)
    return str(file)


def remaps(launch, node):
    return launch["nodes"][f"/{node}"]["remaps"]


def refusal(*launch):
    """The refusal that roslaunch prints before it starts anything."""
    done = run("roslaunch", "--nodes", *launch)
    assert done.returncode == 1 and not done.stdout, done.stdout
    return done.stderr
