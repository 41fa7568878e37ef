#!/usr/bin/env python3
"""Moves the simulated camera in front of the chessboard of config/scenarios/chessboard.yaml, as for a calibration: near, far and
tilted views, with the board in all corners of the image, in a loop. For launch/board.launch."""
import itertools
import math

import rospy
from nav_msgs.msg import Odometry

BOARD = (5.0, 0.0, 1.5)  # its centre in odom
RATE_HZ, LEG_S = 50.0, 0.8
# A view: bearing and elevation from the board's normal [rad], distance [m], direction of the board in the image, right and
# down [rad], and roll [rad].
FAR = [(0.0, 0.0, 2.4, right, down, 0.0) for down in (-0.3, 0.0, 0.3) for right in (-0.4, 0.0, 0.4)]
TILTED = [(bearing, elevation, 1.5, 0.3 * bearing, 0.3 * elevation, roll)
          for bearing in (-0.7, 0.0, 0.7) for elevation, roll in ((-0.4, 0.3), (0.1, 0.0), (0.6, -0.3))]
NEAR = [(bearing, 0.0, 0.9, right, down, 0.0) for bearing, right, down in ((-0.3, -0.15, 0.1), (0.3, 0.15, -0.1), (0.0, 0.0, 0.0))]


def quaternion(roll, pitch, yaw):
    """x, y, z, w of yaw, then pitch, then roll (REP 103)."""
    (sr, cr), (sp, cp), (sy, cy) = [(math.sin(0.5 * angle), math.cos(0.5 * angle)) for angle in (roll, pitch, yaw)]
    return sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy, cr * cp * cy + sr * sp * sy


def pose(bearing, elevation, distance, right, down, roll):
    """(position, (roll, pitch, yaw))"""
    level = distance * math.cos(elevation)
    place = (BOARD[0] - level * math.cos(bearing), BOARD[1] + level * math.sin(bearing), BOARD[2] + distance * math.sin(elevation))
    return place, (roll, elevation - down, right - bearing)


def between(a, b, part):
    """Smooth interpolation between two views."""
    part = 0.5 - 0.5 * math.cos(math.pi * part)
    return [(1.0 - part) * x + part * y for x, y in zip(a, b)]


def message(view, stamp):
    place, angles = pose(*view)
    result = Odometry(child_frame_id="base_link")
    result.header.stamp, result.header.frame_id = stamp, "odom"
    p, q = result.pose.pose.position, result.pose.pose.orientation
    p.x, p.y, p.z = place
    q.x, q.y, q.z, q.w = quaternion(*angles)
    return result


def main():
    rospy.init_node("look_at_board")
    publisher = rospy.Publisher("vehicle_odom", Odometry, queue_size=10)
    views, steps = FAR + TILTED + NEAR, int(LEG_S * RATE_HZ)
    rate = rospy.Rate(RATE_HZ)
    for leg in itertools.count():
        here, there = views[leg % len(views)], views[(leg + 1) % len(views)]
        for step in range(steps):
            if rospy.is_shutdown():
                return
            publisher.publish(message(between(here, there, step / steps), rospy.Time.now()))
            rate.sleep()


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
