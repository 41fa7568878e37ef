#!/usr/bin/env python3
"""Draws the results of replay_bag. Usage: plot_replay.py FRAMES.csv IMAGE.png"""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.realpath(__file__)))
from ingress_tools.command_line import rows_of  # noqa: E402
from ingress_tools.plotting import plt  # noqa: E402

NAN = float("nan")
WORDS = ("reject_reason", "openness")
VERDICTS = {"UNKNOWN": "0.5", "OPEN": "C2", "CLOSED": "C3"}


def number(text):
    return float(text) if text else NAN


def read(path):
    """{name: column}; empty fields become NaN."""
    rows = rows_of(path)
    if not rows:
        sys.exit(f"{path}: no frames in it")
    return {name: [row[name] if name in WORDS else number(row[name]) for row in rows] for name in rows[0]}


def yaw_of(x, y, z, w):
    """Heading of the window's x axis about odom's z [deg]."""
    return math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))


def camera_yaw(x, y, z, w):
    """Heading of the window's axis against the camera's, positive to the left [deg]: x axis in the optical frame."""
    right, forward = 1 - 2 * (y * y + z * z), 2 * (x * z - w * y)
    return math.degrees(math.atan2(-right, forward))


def band(axis, time, centre, sigma, colour):
    low = [c - s for c, s in zip(centre, sigma)]
    high = [c + s for c, s in zip(centre, sigma)]
    axis.fill_between(time, low, high, color=colour, alpha=0.25, linewidth=0)


def draw_openness(axis, time, data):
    axis.plot(time, data["openness_log_odds"], "k", linewidth=0.8, drawstyle="steps-post", label="log odds, open over closed")
    for verdict, colour in VERDICTS.items():
        here = [odds if said == verdict else NAN for said, odds in zip(data["openness"], data["openness_log_odds"])]
        axis.plot(time, here, ".", color=colour, label=verdict)
    axis.set_ylabel("open?")


def draw(data, path):
    time = [stamp - data["stamp"][0] for stamp in data["stamp"]]
    figure, (found, distance, place, heading, openness) = plt.subplots(5, 1, sharex=True, figsize=(9, 12))
    found.plot(time, data["score"], ".", label="score")
    found.plot(time, data["bhattacharyya"], ".", label="Bhattacharyya distance")
    found.plot(time, [0.0 if not d else NAN for d in data["detected"]], "rx", label="no window")
    found.set_ylabel("detection")

    metres = [math.sqrt(x * x + y * y + z * z) for x, y, z in zip(data["tx"], data["ty"], data["tz"])]
    distance.plot(time, metres, ".", label="image")
    if "truth_distance_m" in data:
        distance.plot(time, data["truth_distance_m"], "k", linewidth=0.8, label="truth")
    distance.set_ylabel("distance [m]")

    for axis, colour in zip("xyz", ("C0", "C1", "C2")):
        place.plot(time, data[f"filtered_t{axis}"], colour, label=axis)
        band(place, time, data[f"filtered_t{axis}"], data[f"filtered_sigma_{axis}"], colour)
    place.set_ylabel("window in odom [m]")

    single = [camera_yaw(*q) for q in zip(data["qx"], data["qy"], data["qz"], data["qw"])]
    sigmas = [math.degrees(s) for s in data["yaw_sigma_rad"]]
    if any(map(math.isfinite, sigmas)):  # matplotlib needs at least one
        heading.errorbar(time, single, sigmas, fmt=".", label="image, to camera")
    if "truth_yaw_rad" in data:
        heading.plot(time, [math.degrees(y) for y in data["truth_yaw_rad"]], "k", linewidth=0.8, label="truth")
    filtered = [yaw_of(*q) for q in zip(*(data[f"filtered_q{c}"] for c in "xyzw"))]
    heading.plot(time, filtered, "C3", label="filtered, in odom")
    heading.set_ylabel("yaw [deg]")
    draw_openness(openness, time, data)
    openness.set_xlabel("time since the first image [s]")

    for axis in (found, distance, place, heading, openness):
        axis.grid(alpha=0.3)
        axis.legend(loc="best", fontsize="small")
    figure.tight_layout()
    figure.savefig(path, dpi=110, metadata={"Software": None})


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    draw(read(sys.argv[1]), sys.argv[2])
