#!/usr/bin/env python3
"""Node of rehearse.launch: replaces vehicle and operator while somebody carries the camera. Commands nothing.

Computes `odom` and its tf from the single-image poses in `window_pose`, because a camera alone has no odometry (~odometry: false
if another node publishes it). Keeps a mission of the navigator running, and prints the setpoints of `cmd_vel` in words.
"""
import math
import os
import sys
import threading

import numpy
import rospy
from geometry_msgs.msg import TransformStamped, TwistStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger
from window_ingress.msg import ImagePose, IngressState, WindowPose

for folder in ("../tools", "."):  # in the sources; installed
    sys.path.insert(0, os.path.join(os.path.dirname(os.path.realpath(__file__)), folder))
from ingress_tools.hand_odometry import HandOdometry  # noqa: E402
from ingress_tools.transforms import quaternion_of, rotation_of, transforms_type  # noqa: E402

RATE_HZ = 50.0
PAUSE_S = 3.0      # between the end of a mission and the next start
SAY_EVERY_S = 1.0
ENDS = IngressState.PASSED, IngressState.ABORTED


def candidates_of(image):
    poses = [image.pose.pose] + ([image.alternative.pose] if image.has_alternative else [])
    return [(rotation_of(p.orientation), numpy.array([p.position.x, p.position.y, p.position.z])) for p in poses]


def in_words(setpoint, heading):
    """The setpoint (odom axes) in words, relative to the camera's heading."""
    linear = setpoint.twist.linear
    ahead = math.cos(heading) * linear.x + math.sin(heading) * linear.y
    left = math.cos(heading) * linear.y - math.sin(heading) * linear.x
    words = [f"{abs(value):.1f} m/s {positive if value > 0 else negative}"
             for value, positive, negative in ((ahead, "ahead", "back"), (left, "left", "right"), (linear.z, "up", "down"))
             if abs(value) >= 0.05]
    turn = math.degrees(setpoint.twist.angular.z)
    words += [f"turn {'left' if turn > 0 else 'right'} {abs(turn):.0f} deg/s"] if abs(turn) >= 3 else []
    return ", ".join(words) or "stay"


class Rehearsal:
    def __init__(self):
        self._lock, self._hand = threading.Lock(), HandOdometry()
        self._state, self._setpoint, self._ended_s, self._said_s = None, TwistStamped(), None, -1.0
        self._last_s, self._frame = rospy.get_time(), rospy.get_param("vehicle/odom_frame", "odom")
        kind = transforms_type()
        self._odom = rospy.Publisher("odom", Odometry, queue_size=1) if rospy.get_param("~odometry", True) else None
        self._tf = rospy.Publisher("/tf", kind, queue_size=10)
        self._transforms = kind
        self._subscribers = [rospy.Subscriber("window_pose", WindowPose, self._see, queue_size=1),
                             rospy.Subscriber("state", IngressState, self._hear, queue_size=1),
                             rospy.Subscriber("cmd_vel", TwistStamped, self._heed, queue_size=1)]
        self._timer = rospy.Timer(rospy.Duration(1.0 / RATE_HZ), lambda _: self._step())

    def _see(self, message):
        if message.image.reject == ImagePose.OK:
            with self._lock:
                self._hand.see(message.header.stamp.to_sec(), candidates_of(message.image), message.image.log_likelihood_ratio)

    def _hear(self, message):
        self._state = message

    def _heed(self, message):
        self._setpoint = message

    def _step(self):
        try:
            self._publish()
        except rospy.ROSException:  # at shutdown the topics close before the node knows
            self._timer.shutdown()

    def _publish(self):
        now = rospy.Time.now()
        with self._lock:
            dt, self._last_s = now.to_sec() - self._last_s, now.to_sec()
            if not self._hand.is_seen(now.to_sec()):
                linear = self._setpoint.twist.linear
                velocity = [linear.x, linear.y, linear.z] if self._flies_unseen() else numpy.zeros(3)
                self._hand.carry(velocity, max(0.0, min(dt, 0.1)))
            place, velocity, rotation = self._hand.at(now.to_sec())
        if self._odom is not None:
            self._tell(now, place, velocity, rotation)

    def _flies_unseen(self):
        return self._state is not None and self._state.state in (IngressState.COMMIT, IngressState.BACK_OFF)

    def _tell(self, now, place, velocity, rotation):
        message, transform = Odometry(child_frame_id="base_link"), TransformStamped(child_frame_id="base_link")
        for each in (message, transform):
            each.header.stamp, each.header.frame_id = now, self._frame
        position, orientation, linear = message.pose.pose.position, message.pose.pose.orientation, message.twist.twist.linear
        position.x, position.y = place[:2]
        position.z = place[2] + 1e-9 * (now.nsecs % 1000)  # real odometry never repeats exactly
        orientation.x, orientation.y, orientation.z, orientation.w = quaternion_of(rotation)
        linear.x, linear.y, linear.z = rotation.T @ velocity
        transform.transform.translation.x, transform.transform.translation.y, transform.transform.translation.z = place
        transform.transform.rotation = orientation
        self._odom.publish(message)
        self._tf.publish(self._transforms([transform]))

    def conduct(self):
        """Called regularly: restarts the mission when it has ended, and prints the setpoint."""
        state, now_s = self._state, rospy.get_time()
        if state is None:
            return
        if state.state in ENDS:
            self._ended_s = self._ended_s or now_s
            if now_s - self._ended_s > PAUSE_S:
                self._call("reset")
        elif state.state == IngressState.IDLE:
            self._call("start")
        else:
            self._ended_s = None
            self._say(state, now_s)

    def _say(self, state, now_s):
        if now_s - self._said_s >= SAY_EVERY_S:
            self._said_s = now_s
            with self._lock:
                heading = math.atan2(self._hand.rotation[1, 0], self._hand.rotation[0, 0])
            rospy.loginfo("%s: %s (%s)", state.state_name, in_words(self._setpoint, heading), state.reason)

    @staticmethod
    def _call(service):
        try:
            reply = rospy.ServiceProxy(f"ingress_navigator/{service}", Trigger)()
            rospy.loginfo_throttle(5.0, f"{service}: {reply.message}")
        except rospy.ServiceException as error:
            rospy.logwarn_throttle(5.0, f"{service}: {error}")


def main():
    rospy.init_node("rehearsal")
    rehearsal = Rehearsal()
    if not rospy.get_param("window_detector/reference/picture", ""):
        rospy.logwarn("no reference image: the target is whatever looks most like a window, and may change; "
                      "give reference:=IMAGE reference_corners:=X1,Y1,...")
    while not rospy.is_shutdown():
        rehearsal.conduct()
        rospy.rostime.wallsleep(0.5)


if __name__ == "__main__":
    try:
        main()
    except rospy.ROSInterruptException:
        pass
