"""Charts of the report: round ticks, gaps for missing values, nothing outside the frame."""
import math
import re
import xml.etree.ElementTree as ElementTree

import pytest

from ingress_tools import svg_chart

NAN = math.nan


@pytest.mark.parametrize("low, high", [(0.0, 1.0), (-83.0, 12.0), (1e-4, 2e-4), (1000.0, 1012.0), (-0.5, 0.5)])
def test_ticks_are_round_few_and_inside(low, high):
    values = svg_chart.ticks(low, high)
    assert 2 <= len(values) <= 11
    assert all(low - 1e-9 <= value <= high + 1e-9 for value in values)
    steps = {round(b - a, 9) for a, b in zip(values, values[1:])}
    assert len(steps) == 1 and f"{steps.pop():e}"[0] in "125"


def test_spread_is_never_empty_and_leaves_single_outliers_out():
    assert svg_chart.spread([]) == svg_chart.spread([NAN]) == (0.0, 1.0)
    low, high = svg_chart.spread([3.0, 3.0])
    assert low < 3.0 < high
    assert svg_chart.spread([1.0] * 200 + [2.0] * 200 + [1e6])[1] < 3.0


def test_lines_break_where_nothing_is_known():
    assert list(svg_chart.runs([1, NAN, 2, 3, NAN], [0, 0, 0, 0, 0])) == [[0], [2, 3]]
    chart = svg_chart.Chart([0.0, 1.0, 2.0, 3.0], "a chart")
    chart.line("line", [1.0, 2.0, NAN, 4.0], "#123456")
    assert chart.svg().count('stroke="#123456"') == 2


def test_everything_lies_within_the_picture_and_is_xml():
    chart = svg_chart.Chart([0.1 * i for i in range(300)], "angle & <width>")
    wild = [math.sin(0.1 * i) if i % 7 else NAN for i in range(299)] + [1e9]
    chart.band([v - 0.1 for v in wild], [v + 0.1 for v in wild], "#0000ff")
    chart.points("points", wild, "#ff0000")
    chart.marks("lost", [0.0, 29.9], "#00ff00")
    root = ElementTree.fromstring(chart.svg())
    for circle in root.iter("circle"):
        assert 0 <= float(circle.get("cx")) <= svg_chart.WIDTH and 0 <= float(circle.get("cy")) <= svg_chart.HEIGHT
    for path in root.iter("path"):
        assert all(-1 <= float(n) <= svg_chart.WIDTH for n in re.findall(r"[ML](\d+\.?\d*)", path.get("d")))
    assert "nan" not in chart.svg()


def test_a_column_without_a_number_is_left_out():
    chart = svg_chart.Chart([0.0], "nothing")
    chart.points("none", [NAN], "#ff0000")
    assert "none" not in chart.svg() and "nan" not in chart.svg()
