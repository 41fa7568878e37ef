"""The Foxglove layout: every panel is placed once, and names existing topics and fields."""
import json
import re

from repository import ROOT

LAYOUT = json.loads((ROOT / "config/foxglove.json").read_text())
TOPICS = {"/markers", "/window_polygon", "/odom", "/debug_image", "/diagnostics", "/clicked_point"}


def placed(node):
    if isinstance(node, str):
        return [node]
    assert node["direction"] in ("row", "column") and 0 < node["splitPercentage"] < 100
    return placed(node["first"]) + placed(node["second"])


def test_every_panel_is_placed_once():
    assert sorted(placed(LAYOUT["layout"])) == sorted(LAYOUT["configById"]) and len(LAYOUT["configById"]) == 7


def test_every_path_is_a_field_that_somebody_publishes():
    state = re.findall(r"^\w+ (\w+)\s*(?:#.*)?$", (ROOT / "msg/IngressState.msg").read_text(), re.M)
    paths = [path["value"] for panel in LAYOUT["configById"].values() for path in panel.get("paths", [])]
    assert len(paths) > 8
    for path in paths:
        topic, _, field = path.partition(".")
        if topic == "/state":
            assert field in state, path
        else:
            assert topic == "/cmd_vel" and re.fullmatch(r"twist\.(linear|angular)\.[xyz]", field), path


def test_every_topic_is_documented():
    panels = LAYOUT["configById"]
    topics = set(panels["3D!flight"]["topics"]) | {panels["Image!detector"]["imageMode"]["imageTopic"],
                                                   panels["DiagnosticSummary!health"]["topicToRender"],
                                                   panels["3D!flight"]["publish"]["pointTopic"]}
    assert topics == TOPICS
    page = (ROOT / "doc/ros_api.md").read_text(encoding="utf-8")
    assert all(re.search(rf"`/?{topic[1:]}`", page) for topic in TOPICS)
