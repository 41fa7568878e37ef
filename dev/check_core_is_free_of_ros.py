#!/usr/bin/env python3
"""Fails if any file of the ROS-free libraries includes a ROS header, even indirectly.

On Debian the ROS headers are in the system include path, so a build does not show this. The script reads
the compiler's dependency lists (-M, with system headers). Usage: check_core_is_free_of_ros.py
COMPILE_COMMANDS.json
"""
import json
import re
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

ROS_HEADER = re.compile(
    r"/(ros|rosbag|roscpp|rosgraph_msgs|std_msgs|sensor_msgs|geometry_msgs|nav_msgs|visualization_msgs|std_srvs|"
    r"tf2|tf2_ros|tf2_eigen|tf2_geometry_msgs|cv_bridge|image_transport|image_geometry|camera_info_manager|nodelet|"
    r"pluginlib|dynamic_reconfigure|diagnostic_updater|diagnostic_msgs|message_filters)/[^ ]+\.h(pp)?$")
ROS_FREE = re.compile(r"/src/(?!adapters/|mains/|tools/)\w+/.*\.cpp$")


def sources(entry):
    """The files that one command compiles: a single file, or those of a unity batch."""
    with open(entry["file"]) as file:
        return re.findall(r'^#include "(/.*\.cpp)"$', file.read(), re.M) or [entry["file"]]


def ros_headers(entry, source):
    command = shlex.split(entry["command"])
    output = command.index("-o")
    command = command[:output] + command[output + 2:]
    command = [source if word == entry["file"] else word for word in command
               if word != "-c" and not word.endswith("ccache")] + ["-M"]
    listing = subprocess.run(command, cwd=entry["directory"], check=True, capture_output=True, text=True).stdout
    return [word for word in listing.replace("\\\n", " ").split() if ROS_HEADER.search(word)]


def main():
    with open(sys.argv[1]) as file:
        files = [(entry, source) for entry in json.load(file) for source in sources(entry) if ROS_FREE.search(source)]
    if not files:
        sys.exit(f"{sys.argv[1]}: no file of the ROS-free libraries in it; was it configured?")
    bad = 0
    with ThreadPoolExecutor(2) as pool:
        for (_, source), headers in zip(files, pool.map(lambda pair: ros_headers(*pair), files)):
            for header in headers:
                bad += 1
                print(f"{source}: includes ROS header {header}")
    print(f"{len(files)} files checked, {bad} ROS headers found")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
