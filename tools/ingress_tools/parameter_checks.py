"""Part of doctor: parameters on the server are known to their nodes, are numbers, and fit together."""
import pathlib

import rospkg
import rospy
import yaml

from ingress_tools.observed_system import NODES


def keys(tree, prefix=""):
    for key, value in tree.items():
        if isinstance(value, dict):
            yield from keys(value, f"{prefix}{key}/")
        else:
            yield prefix + key


def config_folder():
    return pathlib.Path(rospkg.RosPack().get_path("window_ingress")) / "config"


def number(system, report, name, path):
    """A parameter; None if it is not set, or not a number, which is reported."""
    value = system.parameter(name, path)
    if value is None or (isinstance(value, (int, float)) and not isinstance(value, bool)):
        return value
    report.error(f"{name}: {path} is '{value}', not a number", f"scripts/run rosparam set {system.namespace_of(name)}/{path} NUMBER", [name])
    return None


def check_parameters(system, report):
    for name, file in {**NODES, "vehicle": "vehicle.yaml"}.items():
        known = set(keys(yaml.safe_load((config_folder() / file).read_text())))
        node = system.namespace_of(name)
        given = rospy.get_param(node, {})
        if not isinstance(given, dict):
            report.error(f"the parameter {node} is '{given}', but {name} has its parameters below that name",
                         f"scripts/run rosparam delete {node}", [name])
            continue
        strange = sorted(key for key in keys(given) if key not in known and not key.startswith("tuning/"))
        if strange:
            report.error(f"{name} does not know the parameters {', '.join(strange)}, and refuses to start with them",
                         f"scripts/run rosparam delete {node}/{strange[0]}; {config_folder() / file} lists what there is", [name])
    speed = number(system, report, "ingress_navigator", "navigator/limits/speed_mps")
    fastest = number(system, report, "setpoint_guard", "max_speed_mps")
    if speed and fastest and speed > fastest:
        report.error(f"setpoint_guard refuses more than {fastest} m/s, ingress_navigator flies up to {speed} m/s: the guard sends zero",
                     f"raise setpoint_guard/max_speed_mps above {speed} in your config, or lower navigator/limits/speed_mps")
    check_sizes(system, report)


def check_sizes(system, report):
    window = [number(system, report, "homography_pose", f"pose/opening_{side}_m") for side in ("width", "height")]
    vehicle = [number(system, report, "vehicle", f"half_{side}_m") for side in ("width", "height")]
    if None in window or None in vehicle:
        return
    spare = [opening / 2.0 - half for opening, half in zip(window, vehicle)]
    text = (f"opening {window[0]:.2f} x {window[1]:.2f} m, vehicle {2 * vehicle[0]:.2f} x {2 * vehicle[1]:.2f} m: "
            f"{spare[0]:.2f} m to spare at each side, {spare[1]:.2f} m above and below")
    if min(spare) <= 0.05:
        report.error(text, "measure both again: homography_pose/pose/opening_*_m, vehicle/half_*_m")
    else:
        report.ok(text)
