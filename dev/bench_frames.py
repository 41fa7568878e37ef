#!/usr/bin/env python3
"""Adds recorded images to the images that scripts/bench measures on. Prints what it leaves out, and why.

Usage: bench_frames.py FOLDER DATA. DATA is the folder with kiosk.bag and photos/.
Each sequence is a few successive images, written losslessly, and an entry in FOLDER/frames.json, see
test/benchmark/frame_set.hpp.
"""
import csv
import json
import os
import sys

import cv2
import numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "tools"))
from evaluate_photos import corners_in_reference

IMAGES = 8
BAG_START_SEC = 4.0  # from here on the target is in view

# name: (file in photos/images, scene of its reference)
PHOTOGRAPHS = {
    "photo_bricks": ("lmf_05june05_static_street_porter_p1010933.jpg", None),
    "photo_gate": ("arena__20160913_172511.jpg", "phone_red"),
    "photo_drone": ("tudc_00283.jpg", "tud_cyberzoo"),
}


class FrameSet:
    def __init__(self, folder):
        self._folder = folder
        self._index_file = os.path.join(folder, "frames.json")
        with open(self._index_file) as file:
            self._index = json.load(file)

    def write(self, name, image):
        file = name + ".png"
        if not cv2.imwrite(os.path.join(self._folder, file), image):
            raise OSError(f"{self._folder}/{file}: cannot be written")
        return file

    def add(self, name, kind, period_sec, images, camera=None, reference=None):
        """`reference`: (image, eight coordinates of the opening's corners)."""
        entry = {"name": name, "kind": kind, "period_sec": period_sec, "camera": camera, "reference": None,
                 "images": [self.write(f"{name}_{i}", image) for i, image in enumerate(images)]}
        if reference is not None:
            entry["reference"] = {"picture": self.write(name + "_reference", reference[0]), "corners": reference[1]}
        self._index.append(entry)

    def save(self):
        with open(self._index_file, "w") as file:
            json.dump(self._index, file, indent=1)


def leave_out(name, why):
    print(f"bench: without {name}: {why}")


def photographed_reference(photos, scene):
    path = os.path.join(photos, "refs", scene + "_m.png")
    return cv2.imread(path), [float(value) for value in corners_in_reference(path).split(",")]


def add_photographs(frames, photos):
    for name, (file, scene) in PHOTOGRAPHS.items():
        path = os.path.join(photos, "images", file)
        if not os.path.exists(path):
            leave_out(name, f"{path} is not there")
            continue
        image = cv2.imread(path)
        frames.add(name, "photograph", 1.0 / 30.0, [image],
                   reference=photographed_reference(photos, scene) if scene else None)


def add_video(frames, photos):
    files = [os.path.join(photos, "sequences", "postcard", "frames", f"{i:04d}.jpg") for i in range(IMAGES)]
    if not all(map(os.path.exists, files)):
        return leave_out("video", f"{files[0]} is not there")
    return frames.add("video", "recording", 2.0 / 30.0, [cv2.imread(file) for file in files])


def camera_of(message):
    k = message.K
    return {"width": message.width, "height": message.height, "fx": k[0], "fy": k[4], "cx": k[2], "cy": k[5],
            "distortion": (list(message.D) + [0.0] * 5)[:5]}


def reference_of_flight(data):
    with open(os.path.join(data, "kiosk_reference.csv"), newline="") as file:
        row = next(csv.DictReader(file))
    corners = [float(row[f"{axis}{i}"]) for i in range(1, 5) for axis in "xy"]
    return cv2.imread(os.path.join(data, "kiosk_reference.jpg")), corners


def add_flight(frames, data):
    path = os.path.join(data, "kiosk.bag")
    if not os.path.exists(path):
        return leave_out("flight", f"{path} is not there")
    try:
        import rosbag
    except ImportError:
        return leave_out("flight", "no rosbag for Python (ROS is not installed)")
    images, stamps, camera = [], [], None
    with rosbag.Bag(path) as bag:
        for topic, message, stamp in bag.read_messages(["/camera/image_raw/compressed", "/camera/camera_info"]):
            if topic.endswith("camera_info"):
                camera = camera_of(message)
            elif stamp.to_sec() - bag.get_start_time() >= BAG_START_SEC and len(images) < IMAGES:
                images.append(cv2.imdecode(numpy.frombuffer(message.data, numpy.uint8), cv2.IMREAD_COLOR))
                stamps.append(message.header.stamp.to_sec())
    period_sec = (stamps[-1] - stamps[0]) / (len(stamps) - 1)
    return frames.add("flight", "recording", period_sec, images, camera, reference_of_flight(data))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder, data = sys.argv[1:]
    frames = FrameSet(folder)
    photos = os.path.join(data, "photos")
    if os.path.isdir(photos):
        add_photographs(frames, photos)
        add_video(frames, photos)
    else:
        leave_out("photographs", f"{photos} is not there")
    add_flight(frames, data)
    frames.save()


if __name__ == "__main__":
    main()
