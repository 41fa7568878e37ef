"""Writes a bag of a made-up flight: usage write_flight_bag.py FILE.bag truth|no_truth|no_state|no_odom|no_pose|two_odoms

1 m/s along the window's axis, 0.1 m left and 0.05 m above it, through the plane 5 s after the start. The window stands at
(10, 2, 1.5), turned by 0.3 rad.
"""
import math
import sys

import rosbag
import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Odometry
from window_ingress.msg import (ApparentOpening, FilteredPose, FlightVerdict, ImagePose, IngressState, RelativeYaw, WindowPose,
                                WindowSize)

START_S, YAW = 100.0, 0.3
CENTRE = (10.0, 2.0, 1.5)


def place(pose, x, y, z, yaw):
    pose.position.x = CENTRE[0] + x * math.cos(YAW) - y * math.sin(YAW)
    pose.position.y = CENTRE[1] + x * math.sin(YAW) + y * math.cos(YAW)
    pose.position.z = CENTRE[2] + z
    pose.orientation.z, pose.orientation.w = math.sin(yaw / 2), math.cos(yaw / 2)


def odometry(x):
    message = Odometry(child_frame_id="base_link")
    place(message.pose.pose, x, 0.1, 0.05, YAW)
    message.twist.twist.linear.x = 1.0
    return message


def window():
    message = PoseStamped()
    place(message.pose, 0, 0, 0, YAW)
    return message


def state(t):
    name = "IDLE" if t < 0 else "SEARCH" if t < 1 else "APPROACH" if t < 4 else "COMMIT" if t < 6 else "PASSED"
    return IngressState(state_name=name, reason="as the test says", predicted_miss=0.12 if t >= 4 else 0.0)


def window_pose():
    image = ImagePose(relative_yaw=RelativeYaw(sign_trusted=True),
                      apparent=ApparentOpening(width=1.2, height=1.0, left_side=80, right_side=80))
    message = WindowPose(image=image, filtered=FilteredPose(valid=True, sign_trusted=True), size=WindowSize(width=1.2, height=1.0))
    place(message.filtered.pose.pose, 0, 0, 0, YAW)
    return message


def main():
    file, what = sys.argv[1:]
    odom = [] if what == "no_odom" else ["/mavros/local_position/odom"]
    odom += ["/mavros/odometry/in"] if what == "two_odoms" else []
    with rosbag.Bag(file, "w") as bag:
        if what != "no_state":  # from before /clock ran
            bag.write("/state", IngressState(state_name="IDLE"), rospy.Time.from_sec(START_S - 2.0))
        for i in range(-10, 70):
            t = 0.1 * i
            messages = [(topic, odometry(t - 5.0)) for topic in odom]
            messages += [("/ground_truth/odom", odometry(t - 5.0)), ("/ground_truth/window", window())] * (what == "truth")
            unheard = what == "truth" and t < 0.25  # not recorded: the recorder came late
            messages += [("/state", state(t))] * (what != "no_state" and not unheard)
            messages += [("/window_pose", window_pose())] * (what != "no_pose" and i % 2 == 0)
            if what == "truth":
                outcome = ("PASSED", FlightVerdict.PASSED) if t > 6 else ("RUNNING", FlightVerdict.RUNNING)
                messages.append(("/referee", FlightVerdict(outcome_name=outcome[0], outcome=outcome[1], reason="went through",
                                                           time=min(max(t, 0.0), 5.0), crossed=t >= 5.0)))
            for topic, message in messages:
                message.header.stamp = rospy.Time.from_sec(START_S + t)
                bag.write(topic, message, message.header.stamp)


if __name__ == "__main__":
    main()
