"""Bags recorded before messages were nested: 'rosbag fix' converts each of their numbers into the present messages."""
import inspect
import sys

import pytest

rosbag = pytest.importorskip("rosbag")
import genpy
from genpy.dynamic import generate_dynamic
from rosbag.migration import MessageMigrator, MessageUpdateRule

from repository import ROOT, run

RULES = ROOT / "msg/migration/nested_messages.bmr"
OLD = {"window_ingress/WindowPose": "4f0b002e9675a17f975f5e82c2c6ee5f", "window_ingress/WindowDetection": "34bf1e107acff7827cfb7582932d1ff0",
       "window_ingress/ReferencePicture": "5f9da380cb2e8862cb6e0c0349d5023b"}


def old_types():
    """{type: class} by the former definitions."""
    if not (ROOT / "build/ros/devel/lib/python3/dist-packages/window_ingress").is_dir():
        pytest.skip("the messages are not built")
    sys.path.insert(0, str(ROOT / "build/ros/devel/lib/python3/dist-packages"))
    from window_ingress import msg
    assert not hasattr(msg, "ReferencePicture"), "messages of before in the build tree: delete build/ros/devel, build anew"
    known = {"MessageUpdateRule": MessageUpdateRule}
    exec(RULES.read_text(encoding="utf-8"), known)  # pylint: disable=exec-used
    rules = [rule for rule in known.values() if isinstance(rule, type) and issubclass(rule, MessageUpdateRule) and rule.old_type]
    types = {}
    for rule in rules:
        types.update({rule.old_type: generate_dynamic(rule.old_type, rule.old_full_text)})
    return types


class Filler:
    """Numbers and texts that are all different, as far as their types allow."""

    def __init__(self):
        self.count = 100

    def leaf(self, kind):
        self.count += 1
        if kind in ("float32", "float64"):
            return self.count + 0.25
        if kind == "time":
            return genpy.Time(self.count, 0)
        return {"string": f"text {self.count}", "bool": True, "uint8": self.count % 251}.get(kind, self.count)

    def fill(self, message, types):
        for name, kind in zip(message.__slots__, message._slot_types):
            base, _, length = kind.partition("[")
            if hasattr(getattr(message, name), "_slot_types"):
                self.fill(getattr(message, name), types)
            elif base not in types and length:
                size = int(length[:-1] or 5)
                values = [self.leaf(base) for _ in range(size)]
                setattr(message, name, bytes(values) if base == "uint8" and "bool" not in kind else values)
            elif length:
                setattr(message, name, [self.fill(types[base](), types) for _ in range(2)])
            else:
                setattr(message, name, self.leaf(kind))
        return message


def leaves(message):
    """All numbers and texts in the message, in its own order."""
    if hasattr(message, "__slots__") and hasattr(message, "_slot_types"):
        return [leaf for name in message.__slots__ for leaf in leaves(getattr(message, name))]
    if isinstance(message, (list, tuple)):
        return [leaf for part in message for leaf in leaves(part)]
    return [message.to_sec() if hasattr(message, "to_sec") else message]


@pytest.fixture(name="bags", scope="module")
def fixture_bags(tmp_path_factory):
    """{old type: (old message, migrated message)}, converted through a bag."""
    if sys.version_info >= (3, 13) and "return locals()[name]" in inspect.getsource(MessageMigrator.make_update_rule):
        pytest.skip("'rosbag fix' of this system does not work with its Python")
    folder, types, old = tmp_path_factory.mktemp("bags"), old_types(), {}
    with rosbag.Bag(str(folder / "old.bag"), "w") as bag:
        for kind, own in types.items():
            old[kind] = Filler().fill(own[kind](), own)
            bag.write("/" + kind, old[kind], genpy.Time(7))
    done = run("rosbag", "fix", "-n", folder / "old.bag", folder / "new.bag", RULES)
    assert done.returncode == 0 and not done.stderr, done.stdout + done.stderr
    with rosbag.Bag(str(folder / "new.bag")) as bag:
        new = {topic[1:]: message for topic, message, _ in bag.read_messages()}
    return {kind: (old[kind], new[kind]) for kind in old}


def test_the_old_definitions_are_those_of_the_bags():
    assert {kind: own[kind]._md5sum for kind, own in old_types().items()} == OLD


@pytest.mark.parametrize("kind", OLD)
def test_nothing_is_lost_and_little_is_added(bags, kind):
    from window_ingress import msg
    old, new = bags[kind]
    name = {"ReferencePicture": "ReferenceImage"}.get(kind.split("/")[1], kind.split("/")[1])
    assert (new._type, new._md5sum) == (f"window_ingress/{name}", getattr(msg, name)._md5sum)
    missing = list(leaves(old))
    added = []
    for leaf in leaves(new):
        if leaf in missing:
            missing.remove(leaf)
        else:
            added.append(leaf)
    assert not missing
    known = {"WindowPose": [0, 0, 1, ""], "WindowDetection": [0] + 4 * [True]}.get(name, [])  # fields of header, reject and visible
    assert len(added) <= len(known), added


def test_a_pose_stands_where_it_is_read_now(bags):
    old, new = bags["window_ingress/WindowPose"]
    assert new.header.stamp == old.header.stamp and new.image.reject == old.reject and new.image.reason == old.reject_reason
    assert list(new.image.pose.covariance) == list(old.pose.covariance) and new.image.relative_yaw.angle == old.yaw
    assert (new.image.euler.roll, new.image.euler.pitch, new.image.euler.yaw) == (old.theta, old.phi, old.psi)
    assert new.image.apparent.width == old.opening_width and new.image.relative_yaw.sigma_unknown_size == old.sigma_u
    assert new.filtered.header.stamp == old.filtered_stamp and new.filtered.header.frame_id == old.filtered_frame_id
    assert new.filtered.pose.pose.position.x == old.filtered.pose.position.x and new.filtered.updates == old.filtered_updates
    assert new.filtered.reject == new.filtered.REFUSED and new.filtered.motion.velocity.y == old.filtered_velocity.y
    assert new.size.height_sigma == old.window_height_sigma and new.measured_size.width == old.measured_width
    assert new.checks.nis == old.nis and new.checks.approach_forbidden == old.approach_forbidden
    assert new.openness.verdict == old.openness and new.openness.depth_behind == old.depth_behind
    assert new.camera.forward == old.camera.forward and new.target.position.z == old.remembered.z
    assert list(new.target.expected_y) == list(old.expected_y)


def test_a_detection_stands_where_it_is_read_now(bags):
    old, new = bags["window_ingress/WindowDetection"]
    assert [corner.y for corner in new.corners] == list(old.corner_y) and new.corners[2].covariance[3] == old.corner_covariance[11]
    assert [edge.b_x for edge in new.edges] == list(old.edge_b_x) and new.edges[3].sigma_rad == old.edge_sigma_rad[3]
    assert new.appearance.runner_up == old.runner_up and new.reason == old.reject_reason and new.reject == new.OK
    assert list(new.interior.beside) == list(old.interior_beside) and new.interior.key_stamp == old.interior_key_stamp
    assert new.interior.key_corners[1].x == old.interior_key_corner_x[1] and new.interior.key_corners[0].visible
    assert [list(window.corner_x) for window in new.windows] == [list(window.corner_x) for window in old.windows]


def test_a_reference_has_its_new_name(bags):
    old, new = bags["window_ingress/ReferencePicture"]
    assert new.image.data == old.picture.data and list(new.corner_x) == list(old.corner_x)


def test_a_tool_says_how_an_old_bag_is_converted(tmp_path):
    own = old_types()["window_ingress/WindowPose"]
    written = run("python3", ROOT / "test/tools/write_flight_bag.py", tmp_path / "flight.bag", "no_pose")
    assert written.returncode == 0, written.stderr
    with rosbag.Bag(str(tmp_path / "flight.bag"), "a") as bag:
        bag.write("/window_pose", own["window_ingress/WindowPose"](), genpy.Time(101))
    done = run("plot_flight", tmp_path / "flight.bag")
    assert done.returncode == 2 and len(done.stderr.splitlines()) == 1
    assert f"rosbag fix -n {tmp_path / 'flight.bag'} NEW.bag {RULES}" in done.stderr
