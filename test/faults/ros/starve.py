#!/usr/bin/env python3
"""Images of 3840 x 2880 at up to 200 Hz, while all nodes share one core with a program that wants all of it; exit code 0 if
images are dropped and not queued, and setpoints go on."""
import argparse
import os
import pathlib
import subprocess
import sys
import time

import fault_paths
import cv2
import rospy
from fault_notes import note
from own_system import OwnSystem
from sensor_msgs.msg import Image
from window_ingress.msg import WindowDetection

import chain
import monitor as monitors
import oracles
import support

SCALE, RATE_HZ = 6, 200.0
LAUNCH = str(fault_paths.HERE / "starve.launch.xml")
GROWTH_MB = 120.0   # an image takes 11 MB, and a few are held at once
SETTLE_S = 5.0


def images():
    """This process publishes as fast as possible and counts the images."""
    rospy.init_node("flood")
    pixels = cv2.resize(cv2.cvtColor(chain.window_image(), cv2.COLOR_BGR2GRAY), None, fx=SCALE, fy=SCALE)
    message = Image(height=pixels.shape[0], width=pixels.shape[1], encoding="mono8", step=pixels.shape[1], data=pixels.tobytes())
    message.header.frame_id = "camera_optical_frame"
    publisher = rospy.Publisher("image_raw", Image, queue_size=1)
    rate, sent = rospy.Rate(RATE_HZ), 0
    try:
        while not rospy.is_shutdown():
            message.header.stamp = rospy.Time.now()
            publisher.publish(message)
            sent += 1
            rate.sleep()
    except rospy.ROSInterruptException:
        pass
    pathlib.Path(sys.argv[2]).write_text(str(sent))


def calibration(stamp):
    info = support.camera_info(stamp, focal=SCALE * support.FOCAL)
    info.width, info.height = SCALE * support.WIDTH, SCALE * support.HEIGHT
    for matrix in (info.K, info.P):
        matrix[2] = (info.width - 1) / 2
        matrix[5 if matrix is info.K else 6] = (info.height - 1) / 2
    return info


class Starvation:
    def __init__(self, options, file):
        self.options, self.file = options, file
        self.monitor = monitors.Monitor(topics={"steered": "/ingress_navigator/cmd_vel"})
        self.monitor.limits.memory_growth_mb = GROWTH_MB
        self.windows = support.Listener("window", WindowDetection)
        self.chain = chain.Chain()
        self.chain.streams["image_raw"].pause()
        self.chain.streams["camera_info"].make = calibration
        self.helpers = []

    def starve(self):
        if not self.options.flood:
            for pid in [self.monitor.pid(node) for node in monitors.NODES]:
                subprocess.run(["taskset", "-a", "-p", "-c", "0", str(pid)], stdout=subprocess.DEVNULL, check=True)
            self.helpers.append(subprocess.Popen(["taskset", "-c", "0", sys.executable, "-c", "while True: pass"]))
        self.helpers.append(subprocess.Popen([sys.executable, __file__, "--publish", self.file]))

    def run(self):
        self.starve()
        try:
            self.chain.fly(self.monitor)  # streams setpoints, on its way or in IDLE
        except AssertionError:
            print("not on its way: the images come too late to fly by", file=sys.stderr)
        support.wait_for(lambda: time.monotonic() > self.begun + SETTLE_S, "everything to have settled")
        begin = time.monotonic()
        support.wait_for(lambda: time.monotonic() > begin + self.options.seconds, "the time of the measurement", self.options.seconds + 10)
        return begin, time.monotonic()

    def __enter__(self):
        self.begun = time.monotonic()
        return self

    def __exit__(self, *_):
        for helper in reversed(self.helpers):
            helper.terminate()
            helper.wait(20)
        self.chain.stop()

    def judge(self, begin, end):
        part = self.monitor.part(begin, end)
        ages = sorted(f.age_sec for f in part.frames)
        periods = [b.at - a.at for a, b in zip(part.frames, part.frames[1:])]
        period = sum(periods) / max(1, len(periods))
        least = min(oracles.stream_rate(part, self.monitor.limits, source, begin, end)[0] for source in (self.monitor.navigator, self.monitor.guard))
        memory = {node: [p.megabytes for p in part.processes if p.node == node] for node in self.monitor.sources()}
        problems = [f"{v.oracle}: {v.text}" for v in self.monitor.violations(begin, end)]
        late = ages[int(0.95 * len(ages))] if ages else float("inf")
        if late > 0.15 + 3.0 * period:
            problems.append(f"images are queued: seen {late:.2f} s after their stamp, {period:.2f} s apart")
        if not least >= self.monitor.limits.least_rate_hz:
            problems.append(f"{least:.0f} setpoints a second")
        detector = memory["/window_detector"]
        seen = (f"{len(part.frames) / (end - begin):.1f} images a second seen, median {1e3 * ages[len(ages) // 2]:.0f} ms and 95 % within "
                f"{1e3 * late:.0f} ms after their stamp; at least {least:.0f} setpoints a second; detector {detector[0]:.0f} to "
                f"{max(detector):.0f} MB; blind {sum(b.seconds for b in part.blind):.1f} s") if ages else "nothing seen"
        return problems, seen


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--flood", action="store_true", help="the images alone, on all cores")
    parser.add_argument("--seconds", type=float, default=20.0)
    options = parser.parse_args()
    file = os.path.join(os.environ.get("ROS_HOME", "/tmp"), "sent")
    with OwnSystem(LAUNCH):
        rospy.init_node("starve", disable_signals=True)
        with Starvation(options, file) as starvation:
            span = starvation.run()
            problems, seen = starvation.judge(*span)
            running = time.monotonic() - starvation.begun
        sent = int(pathlib.Path(file).read_text()) / running if os.path.exists(file) else float("nan")
    seen = f"about {sent:.0f} images of 11 MB a second sent, {seen}"
    print(seen)
    for problem in problems[:10]:
        print(f"NOT MET: {problem}")
    note("M20" if options.flood else "M91", seen)
    return 1 if problems else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--publish"]:
        images()
    else:
        sys.exit(main())
