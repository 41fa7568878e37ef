#!/usr/bin/env python3
"""Writes the seed inputs of the fuzzers: make_fuzz_seeds.py FOLDER. Small files of each kind, some from the package."""
import pathlib
import random
import re
import struct
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def write(folder, name, data):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())


def images(folder):
    """Raw images as test/fuzz/any_image.cpp reads them, and compressed images."""
    for encoding in range(24):
        write(folder / "image", f"raw{encoding}", struct.pack("<BHBBB", 1, encoding, 64, 32, 24) + bytes(range(256)) * 8)
    try:
        import cv2
        import numpy
        image = numpy.arange(48 * 64 * 3, dtype=numpy.uint32).reshape(48, 64, 3).astype(numpy.uint8)
        for extension in (".png", ".jpg"):
            write(folder / "image", "compressed" + extension, b"\0" + cv2.imencode(extension, image)[1].tobytes())
    except ImportError:
        print("make_fuzz_seeds: without compressed images (python3-opencv is not installed)", file=sys.stderr)


def random_bytes(folder, target, sizes, count):
    source = random.Random(target)
    for i in range(count):
        write(folder / target, f"random{i}", source.randbytes(source.choice(sizes)))


def detection(folder):
    """Inputs of test/fuzz/detection.cpp: two nested rectangles on a grey image."""
    for encoding in (0, 2, 8, 14):
        scene = struct.pack("<HHHB", encoding, 80, 60, 0)
        draw = b"\2" + struct.pack("<8b4B", 20, 15, 70, 50, 0, 0, 0, 0, 50, 140, 215, 1)
        draw += struct.pack("<8b4B", 26, 20, 64, 45, 0, 0, 0, 0, 50, 50, 60, 1)
        write(folder / "detection", f"window{encoding}", b"\1\2" + scene + draw + b"\x96" * 64)


def yaml(folder):
    for scenario in sorted((ROOT / "config" / "scenarios").glob("*.yaml"), key=lambda file: file.stat().st_size)[:25]:
        write(folder / "scenario", scenario.name, scenario.read_bytes())
    calibration = ("image_width: 640\nimage_height: 480\ncamera_matrix: {rows: 3, cols: 3, data: [554, 0, 319.5, 0, 553, "
                   "239.5, 0, 0, 1]}\ndistortion_model: plumb_bob\n"
                   "distortion_coefficients: {rows: 1, cols: 5, data: [-0.2, 0.05, 0.001, 0, 0]}\n")
    write(folder / "parameters", "calibration.yaml", calibration)
    for node, keys in {"window_detector": "detector: {max_candidates: 5, preprocess: {}, track: {}, min_score: 0.1}",
                       "homography_pose": "{pose: {opening_width_m: 1.5, scale_sigma: 0.3}, filter: {max_age_sec: 1.0}}",
                       "ingress_navigator": "navigator: {limits: {speed_mps: 0.5}}", "vehicle": "half_width_m: 0.3"}.items():
        write(folder / "parameters", node + ".yaml", f"{node}:\n  {keys}\n")
    for file in sorted((ROOT / "config").glob("*.yaml")):
        if file.stat().st_size < 20000:
            write(folder / "parameters", file.name, file.read_bytes())


def words(folder):
    """The keys and choices of all parameters, which mutation alone would never find."""
    sources = [*(ROOT / "include").rglob("*.hpp"), *(ROOT / "src" / "parameters").glob("*.cpp")]
    found = {word for file in sources for call in re.findall(r"field(?:\.\w+)?\(([^;]*)\);", file.read_text())
             for word in re.findall(r'"([\w/]+)"', call)}
    found |= {"image_width", "image_height", "camera_matrix", "distortion_model", "distortion_coefficients", "plumb_bob",
              "equidistant", "fisheye", "rows", "cols", "data", "one_of", "true", "false", ".nan", ".inf", "1e300", "-1", "[0, 1]"}
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "yaml.dict").write_text("".join(f'"{word}"\n"{word}: "\n' for word in sorted(found)))


def bag(folder):
    try:
        import rosbag
        import rospy
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import CameraInfo, Image
    except ImportError:
        print("make_fuzz_seeds: without bags (python3-rosbag is not installed)", file=sys.stderr)
        return
    for compression in ("none", "bz2"):
        file = folder / "bag" / f"small_{compression}.bag"
        file.parent.mkdir(parents=True, exist_ok=True)
        with rosbag.Bag(str(file), "w", compression=compression, chunk_threshold=2000) as output:
            for i in range(3):
                stamp = rospy.Time(100 + i)
                image = Image(height=8, width=12, encoding="mono8", step=12, data=bytes(range(96)))
                info = CameraInfo(width=12, height=8, K=[10, 0, 6, 0, 10, 4, 0, 0, 1])
                odometry = Odometry(child_frame_id="base_link")
                odometry.pose.pose.orientation.w = 1.0
                for topic, message in (("image_raw", image), ("camera_info", info), ("odom", odometry)):
                    message.header.stamp = stamp
                    message.header.frame_id = "odom" if topic == "odom" else "camera"
                    output.write(topic, message, stamp)


def main():
    folder = pathlib.Path(sys.argv[1])
    images(folder)
    detection(folder)
    random_bytes(folder, "camera_info", (200, 300, 400), 20)
    random_bytes(folder, "corners", (100, 300, 600, 1200), 30)
    yaml(folder)
    words(folder)
    bag(folder)


if __name__ == "__main__":
    main()
