"""The PlotJuggler layout names existing topics and fields."""
import re
import xml.etree.ElementTree as ElementTree

from repository import ROOT

KINDS = {"/state": "IngressState", "/window_pose": "WindowPose"}
NUMBERS = {"bool", "uint8", "uint32", "float64"}
TWISTS = {"/cmd_vel", "/ingress_navigator/cmd_vel"}


def numbers_of(kind):
    """Numbers of the message and of those members that have message files of their own."""
    text = (ROOT / f"msg/{kind}.msg").read_text()
    fields = re.findall(r"^(\w+) (\w+)\s*(?:#.*)?$", text, re.M)
    nested = {f"{name}/{number}" for type_, name in fields if (ROOT / f"msg/{type_}.msg").exists() for number in numbers_of(type_)}
    return nested | {name for type_, name in fields if type_ in NUMBERS}


def test_every_curve_is_a_number_that_somebody_publishes():
    curves = [curve.get("name") for curve in ElementTree.parse(ROOT / "config/plotjuggler.xml").getroot().iter("curve")]
    assert len(curves) > 20 and len(set(curves)) == len(curves)
    for curve in curves:
        topic = next(topic for topic in (*KINDS, *TWISTS) if curve.startswith(topic + "/"))
        field = curve[len(topic) + 1:]
        if topic in TWISTS:
            assert re.fullmatch(r"twist/(linear|angular)/[xyz]", field), curve
        else:
            assert field in numbers_of(KINDS[topic]), curve


def test_each_tab_has_as_many_plots_as_it_says():
    for splitter in ElementTree.parse(ROOT / "config/plotjuggler.xml").getroot().iter("DockSplitter"):
        assert int(splitter.get("count")) == len(splitter.findall("DockArea")) == len(splitter.get("sizes").split(";"))
