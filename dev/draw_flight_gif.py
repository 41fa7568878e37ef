#!/usr/bin/env python3
"""Draws a simulated flight as a short animation: the image with the window that the detector found, and the path from above.

    scripts/run fly --scenario FILE.yaml --seeds 20 --keep-failures --output out/fly   # FILE.yaml: time limit too short, so it is recorded
    scripts/run replay_bag --bag out/fly/failures/flight_20.bag --output out/replay --window-size 1.2,1.0
    scripts/run draw_flight_gif.py out/fly/failures/flight_20.bag --replay out/replay --output doc/flight.gif

Needs ffmpeg.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

import cv2
import numpy as np
import rosbag

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tools"))
from ingress_tools.command_line import rows_of  # noqa: E402
from ingress_tools.flight_data import STATE_COLOURS, yaw_of  # noqa: E402

HEIGHT, IMAGE_WIDTH, PATH_WIDTH = 240, 320, 240  # [px]
METRE_PX, PLANE_X = 34.0, 195  # of the path: pixels per metre, and x of the window's plane
HALF_OPENING_M, SAME_STAMP_SEC = 0.6, 0.02
FONT = cv2.FONT_HERSHEY_SIMPLEX


def colour(state):
    text = STATE_COLOURS[state].lstrip("#")
    return tuple(int(text[i:i + 2], 16) for i in (4, 2, 0))


def read(bag_file):
    """(images, states, path in the window's axes), each with its time."""
    images, states, poses, window = [], [], [], None
    with rosbag.Bag(str(bag_file)) as bag:
        for topic, message, _ in bag.read_messages():
            stamp = message.header.stamp.to_sec() if hasattr(message, "header") else None
            if message._type == "sensor_msgs/CompressedImage":
                images.append((stamp, message.data))
            elif message._type == "window_ingress/IngressState":
                states.append((stamp, message.state_name))
            elif topic.endswith("ground_truth/odom"):
                poses.append((stamp, message.pose.pose.position))
            elif topic.endswith("ground_truth/window"):
                window = message.pose
    yaw, centre = yaw_of(window.orientation), window.position
    axes = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])
    return images, states, [(stamp, axes @ (p.x - centre.x, p.y - centre.y)) for stamp, p in poses]


def outlines(replay):
    """{stamp: corners of the detected window}"""
    return {float(row["stamp"]): np.array([[float(row[f"{axis}{i}"]) for axis in "xy"] for i in range(1, 5)])
            for row in rows_of(replay / "frames.csv") if row["detected"] == "1" and all(row[f"x{i}"] for i in range(1, 5))}


def image_panel(data, stamp, found):
    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR)
    nearest = min(found, key=lambda other: abs(other - stamp))
    if abs(nearest - stamp) < SAME_STAMP_SEC:
        cv2.polylines(image, [np.round(found[nearest]).astype(np.int32)], True, (0, 220, 0), 5, cv2.LINE_AA)
    return cv2.resize(image, (IMAGE_WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)


def path_panel(path, state, since_sec):
    panel = np.full((HEIGHT, PATH_WIDTH, 3), 255, np.uint8)
    half = int(HALF_OPENING_M * METRE_PX)
    for top, bottom in ((0, HEIGHT // 2 - half), (HEIGHT // 2 + half, HEIGHT)):
        cv2.rectangle(panel, (PLANE_X, top), (PLANE_X + 6, bottom), (150, 150, 150), cv2.FILLED)
    points = [(int(PLANE_X + METRE_PX * x), int(HEIGHT / 2 - METRE_PX * y)) for x, y in path]
    cv2.polylines(panel, [np.array(points, np.int32)], False, colour(state), 2, cv2.LINE_AA)
    cv2.circle(panel, points[-1], 6, colour(state), cv2.FILLED, cv2.LINE_AA)
    cv2.putText(panel, state, (10, HEIGHT - 10), FONT, 0.55, colour(state), 1, cv2.LINE_AA)
    cv2.putText(panel, f"{since_sec:.0f} s", (10, 22), FONT, 0.5, (90, 90, 90), 1, cv2.LINE_AA)
    return panel


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bag", type=pathlib.Path, help="bag of fly --keep-failures")
    parser.add_argument("--replay", required=True, type=pathlib.Path, help="folder that replay_bag wrote for this bag")
    parser.add_argument("--rate", type=float, default=5.0, help="images per second of the flight")
    parser.add_argument("--output", required=True, type=pathlib.Path)
    arguments = parser.parse_args()
    images, states, path = read(arguments.bag)
    found = outlines(arguments.replay)
    begin = images[0][0]
    with tempfile.TemporaryDirectory() as folder:
        times = np.arange(begin, states[-1][0], 1.0 / arguments.rate)
        for number, now in enumerate(times):
            stamp, data = min(images, key=lambda image: abs(image[0] - now))
            state = [name for at, name in states if at <= now][-1:] or ["IDLE"]
            so_far = [place for at, place in path if at <= now] or [path[0][1]]
            both = [image_panel(data, stamp, found), path_panel(so_far, state[0], now - begin)]
            cv2.imwrite(f"{folder}/{number:04d}.png", np.hstack(both))
        palette = ("scale=480:-1:flags=area,split[a][b];[a]palettegen=max_colors=96[p];"
                   "[b][p]paletteuse=dither=bayer:bayer_scale=3:diff_mode=rectangle")
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-framerate", str(arguments.rate), "-i", f"{folder}/%04d.png",
                        "-vf", palette, "-loop", "0", str(arguments.output)], check=True)
    print(f"{arguments.output}: {len(times)} images, {arguments.output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
