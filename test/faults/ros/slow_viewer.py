#!/usr/bin/env python3
"""Node: a viewer that subscribes to everything and is too slow, like rviz on a weak computer. Each message takes a second."""
import time

import rospy
from sensor_msgs.msg import Image
from visualization_msgs.msg import MarkerArray

SECONDS_A_MESSAGE = 1.0


def look(_):
    time.sleep(SECONDS_A_MESSAGE)


if __name__ == "__main__":
    rospy.init_node("slow_viewer")
    views = [rospy.Subscriber(topic, kind, look, buff_size=1 << 16)
             for topic, kind in (("debug_image", Image), ("/camera/image_raw", Image), ("markers", MarkerArray))]
    rospy.spin()
