#!/usr/bin/env python3
"""Writes report.html from the output folder of replay_bag. Usage: report_replay.py FOLDER

The page opens from disk, without network or scripts. Charts are inside it, the images beside it in pictures/.
"""
import json
import math
import os
import sys
from html import escape

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from ingress_tools.command_line import rows_of  # noqa: E402
from ingress_tools.svg_chart import Chart  # noqa: E402

STYLE = """
body { font: 15px/1.45 sans-serif; color: #222; margin: 2em auto; max-width: 1080px; padding: 0 1em; }
h1 { font-size: 1.5em; margin-bottom: 0; } h2 { font-size: 1.15em; margin: 1.8em 0 .4em; }
.cards { display: flex; flex-wrap: wrap; gap: .7em; margin: 1em 0; }
.card { border: 1px solid #ddd; border-radius: 6px; padding: .5em .9em; min-width: 8em; }
.card b { display: block; font-size: 1.35em; } .bad b { color: #c0261c; } .card span, figcaption, .note { color: #666; font-size: .87em; }
.strip { display: flex; flex-wrap: wrap; gap: 6px; } figure { margin: 0; width: 170px; } figure img { width: 170px; display: block; }
figure.lost img { outline: 3px solid #d0312d; } figure.found img { outline: 3px solid #2ecc40; }
table { border-collapse: collapse; } td, th { text-align: left; padding: .15em .9em .15em 0; vertical-align: top; }
td.number { text-align: right; } .bar { background: #d0312d; height: .85em; display: inline-block; }
code { background: #f3f3f3; padding: .1em .3em; overflow-wrap: anywhere; } svg { width: 100%; height: auto; }
"""
NAN = math.nan
MEANING = {  # of the reasons, as in doc/detection.md
    "bad_image": "the image is empty, of another type, or too small",
    "no_candidate": "nothing with four sides in the image",
    "corners": "an outline without four corners",
    "area_small": "smaller than the farthest window",
    "area_large": "larger than the nearest window",
    "aspect": "too wide or too narrow",
    "solidity": "an outline much smaller than its convex hull",
    "angle": "a corner too far from a right angle",
    "border": "cut by the border of the image: a corner is not seen",
    "line_support": "a side without straight edges under it",
    "contrast": "an edge too weak to be told from noise",
    "refinement": "an edge that could not be fitted in the full image",
    "outer_border": "the outer border of a frame whose inner border was found",
    "duplicate": "the same loop as a better candidate",
    "pane": "a part of a larger window: pane between mullions, border behind the opening",
    "appearance": "its frame does not look like the reference",
    "other_aspect": "of another aspect than the reference",
    "other_frame": "its frame is wider or narrower than the reference's",
    "unlike": "its surroundings do not match the reference's",
    "score": "score below the limit",
    "outscored": "a plausible window, but another one has the higher score once its size in the image is weighed",
    "budget": "not looked at: too many candidates in one image",
    "pose_bad_camera": "the calibration cannot be used",
    "pose_bad_corners": "the corners are no window seen from the front",
    "pose_not_in_front": "the window would lie behind the camera",
    "pose_reprojection": "no pose of this window fits the corners",
    "pose_range": "nearer or further than a window may be",
    "pose_tilt": "the window would be tilted against gravity",
    "pose_not_finite": "the pose is not finite",
}


def number(text):
    return float(text) if text else NAN


def column(rows, name, factor=1.0):
    return [factor * number(row[name]) for row in rows]


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.1f} %)" if whole else "0"


def quantile(values, part):
    known = sorted(value for value in values if math.isfinite(value))
    return known[min(len(known) - 1, int(part * len(known)))] if known else NAN


class Replay:
    """The tables of one replay; times in seconds since the first image."""

    def __init__(self, folder):
        self.frames, self.details, self.latency, self.strip = (
            rows_of(os.path.join(folder, f"{table}.csv")) for table in ("frames", "details", "latency", "strip"))
        with open(os.path.join(folder, "replay.json"), encoding="utf-8") as file:
            self.facts = json.load(file)
        if not self.frames:
            sys.exit(f"report_replay: {folder}/frames.csv: no frames in it")
        self.begin = number(self.frames[0]["stamp"])
        self.time = self.since([row["stamp"] for row in self.frames])
        self.milliseconds = [d + p for d, p in zip(column(self.latency, "detector_ms"), column(self.latency, "pose_ms"))]

    def since(self, stamps):
        return [number(stamp) - self.begin for stamp in stamps]


def filtered_yaw(rows):
    """Heading of the window's axis about odom's z [deg]."""
    quaternions = [[number(row[f"filtered_q{c}"]) for c in "xyzw"] for row in rows]
    return [math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))) for x, y, z, w in quaternions]


def cards(replay):
    counts, images = replay.facts["counts"], len(replay.frames)
    found = sum(row["detected"] == "1" for row in replay.frames)
    posed = sum(bool(row["qx"]) for row in replay.frames)
    trusted = sum(row["filtered_sign_trusted"] == "1" for row in replay.details)
    size = replay.facts.get("window_size_m")
    all_cards = [("window found", share(found, images), found == 0),
                 ("pose from one image", share(posed, images) if size else "no size given", not posed),
                 ("filtered, sign known", share(trusted, images) if size else "no size given", not trusted),
                 ("time per image", f"{quantile(replay.milliseconds, 0.5):.2f} ms, 95 %: {quantile(replay.milliseconds, 0.95):.2f} ms", False),
                 ("without calibration", counts["without_calibration"], counts["without_calibration"]),
                 ("without odometry", counts["without_odometry"], counts["without_odometry"]),
                 ("without attitude", counts["without_attitude"], counts["without_attitude"]),
                 ("jumps back in time", counts["jumps_back_in_time"], counts["jumps_back_in_time"]),
                 ("messages refused", counts["messages_refused"], counts["messages_refused"])]
    return "".join(f'<div class="card{" bad" if bad else ""}"><span>{name}</span><b>{value}</b></div>'
                   for name, value, bad in all_cards)


def strip(replay):
    figures = []
    for row, time in zip(replay.strip, replay.since([row["stamp"] for row in replay.strip])):
        caption = f"{time:.2f} s: {escape(row['caption'])}"
        figures.append(f'<figure class="{row["shown"]}"><a href="{row["file"]}"><img src="{row["file"]}" alt="{caption}" '
                       f'loading="lazy"></a><figcaption>{caption}</figcaption></figure>')
    return f'<div class="strip">{"".join(figures)}</div>'


def columns_chart(title, table, *columns, factor=1.0):
    """A chart of columns of one table, each with its name and colour."""
    def draw(replay):
        chart = Chart(replay.time, title)
        for name, key, colour in columns:
            chart.points(name, column(getattr(replay, table), key, factor), colour)
        return chart.svg()
    return draw


angles_chart = columns_chart("the paper's angles [deg]", "details", ("theta", "theta_rad", "#1f5fa8"), ("phi", "phi_rad", "#e67e22"),
                             ("psi", "psi_rad", "#2e9e4f"), factor=180 / math.pi)
width_chart = columns_chart("apparent width and height of the opening [m]", "details", ("width", "opening_width_m", "#1f5fa8"),
                            ("height", "opening_height_m", "#e67e22"))
sides_chart = columns_chart("length of the borders [px]", "details", ("left", "left_side_px", "#8c6d31"),
                            ("right", "right_side_px", "#5b7c99"))
latency_chart = columns_chart("milliseconds an image", "latency", ("detector", "detector_ms", "#1f5fa8"),
                              ("pose and filter", "pose_ms", "#e0218a"))


def detection_chart(replay):
    chart = Chart(replay.time, "score, distance to the reference")
    chart.points("score", column(replay.frames, "score"), "#2e9e4f")
    chart.points("distance to the reference", column(replay.frames, "bhattacharyya"), "#8c6d31")
    chart.marks("no window", [time for time, row in zip(replay.time, replay.frames) if row["detected"] == "0"], "#d0312d")
    return chart.svg()


def yaw_chart(replay):
    chart = Chart(replay.time, "yaw of the window against the camera [deg]")
    yaw, sigma = (column(replay.details, name, 180 / math.pi) for name in ("yaw_rad", "sigma_u_rad"))
    sure = [row["sign_trusted"] == "1" for row in replay.details]
    chart.band([y - 3 * s if s < 30 else NAN for y, s in zip(yaw, sigma)], [y + 3 * s for y, s in zip(yaw, sigma)], "#1f5fa8")
    chart.points("sign known", [y if s else NAN for y, s in zip(yaw, sure)], "#1f5fa8")
    chart.points("sign unknown", [NAN if s else y for y, s in zip(yaw, sure)], "#ffa500")
    if "truth_yaw_rad" in replay.frames[0]:
        chart.line("truth", column(replay.frames, "truth_yaw_rad", 180 / math.pi), "#000000")
    return chart.svg()


def filtered_chart(replay):
    chart = Chart(replay.time, "filtered heading of the window in odom [deg]")
    yaw, sigma = filtered_yaw(replay.frames), column(replay.frames, "filtered_sigma_yaw", 180 / math.pi)
    chart.band([y - 3 * s for y, s in zip(yaw, sigma)], [y + 3 * s for y, s in zip(yaw, sigma)], "#e0218a")
    chart.line("heading, with three standard deviations", yaw, "#e0218a")
    return chart.svg()


def openness_chart(replay):
    chart = Chart(replay.time, "the opening is open: log odds")
    for verdict, colour in (("OPEN", "#2e9e4f"), ("CLOSED", "#d0312d"), ("UNKNOWN", "#8a8a8a")):
        chart.points(verdict.lower(), [number(row["openness_log_odds"]) if row["openness"] == verdict else NAN
                                       for row in replay.frames], colour)
    return chart.svg()


def distance_chart(replay):
    chart = Chart(replay.time, "distance of the camera [m]")
    chart.points("image", [math.sqrt(sum(number(row[f"t{c}"]) ** 2 for c in "xyz")) for row in replay.frames], "#1f5fa8")
    if "truth_distance_m" in replay.frames[0]:
        chart.line("truth", column(replay.frames, "truth_distance_m"), "#000000")
    return chart.svg()


def bars(counts):
    if not counts:
        return "<p>None.</p>"
    most = max(counts.values())
    rows = "".join(f'<tr><td><code>{escape(name)}</code> <span class="note">{escape(MEANING.get(name, ""))}</span></td>'
                   f'<td class="number">{count}</td><td style="width:45%"><span class="bar" style="width:{100 * count / most:.1f}%"></span></td></tr>'
                   for name, count in sorted(counts.items(), key=lambda item: (-item[1], item[0])))
    return f'<table style="width:100%">{rows}</table>'


def counted(values):
    return {value: values.count(value) for value in set(values) if value}


def topics(facts):
    rows = "".join(f"<tr><td><code>{escape(t['topic'])}</code></td><td>{escape(t['type'])}</td>"
                   f"<td class=\"number\">{t['messages']}</td><td>{escape(t['used_as'])}</td></tr>" for t in facts["topics"])
    return f"<table><tr><th>topic</th><th>type</th><th>messages</th><th>used as</th></tr>{rows}</table>"


def section(title, *parts):
    return f"<h2>{title}</h2>" + "".join(parts)


def page(replay):
    bag = replay.facts["bag"]
    name = escape(os.path.basename(bag["file"]))
    with_pose = "window_size_m" in replay.facts
    charts = [("Detection", [detection_chart])]
    if with_pose:
        charts += [("Angles", [yaw_chart, filtered_chart, angles_chart]), ("Widths and distance", [width_chart, sides_chart, distance_chart]),
                   ("Open or not", [openness_chart])]
    parts = [f"<h1>{name}</h1><p class=\"note\">{bag['bytes'] / 1e6:.1f} MB, {bag['seconds']:.1f} s from {bag['begin']}, "
             f"{len(replay.frames)} images</p>", f'<div class="cards">{cards(replay)}</div>',
             section("What was seen", '<p class="note">Evenly over time; red: lost here, green: found here. Click for the whole image.</p>',
                     strip(replay))]
    parts += [section(title, *(chart(replay) for chart in some)) for title, some in charts]
    parts.append(section("Images without a window or a pose, and why", 
                         '<p class="note">The reason of the candidate that came furthest.</p>',
                         bars(counted([row["reject_reason"] for row in replay.frames]))))
    if with_pose:
        parts.append(section("Images that did not contribute to the filtered pose, and why",
                             bars(counted([row["why_not_filtered"] for row in replay.details]))))
    parts.append(section("Messages refused, and why", bars(replay.facts["counts"]["refused_because"])))
    parts.append(section("Latency", latency_chart(replay)))
    parts.append(section("Topics of the bag", topics(replay.facts)))
    parts.append(section("How this was made", f"<p><code>{escape(replay.facts['command'])}</code></p>", "<p>All numbers: <a "
                         "href=\"frames.csv\">frames.csv</a>, <a href=\"details.csv\">details.csv</a>, <a href=\"latency.csv\">"
                         "latency.csv</a>, <a href=\"replay.json\">replay.json</a>.</p>"))
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{name}</title><style>{STYLE}</style></head>\n'
            f'<body>{"".join(parts)}</body></html>\n')


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    try:
        text = page(Replay(sys.argv[1]))
    except (OSError, ValueError, KeyError) as error:
        sys.exit(f"report_replay: {sys.argv[1]}: not what replay_bag writes: {error}")
    with open(os.path.join(sys.argv[1], "report.html"), "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
