#!/usr/bin/env python3
"""The world as a test stand: external.launch and px4.launch, with a simulated autopilot behind /mavros."""
import math
import random
import sys
import threading
import time
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import PoseStamped, TwistStamped
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import Imu
from window_ingress.msg import FlightVerdict, IngressState

import support

STEP_S = 0.02
REAL_TIME_FACTOR = 0.5         # for machines that render slowly
MOST_AHEAD_S = 0.12            # lead of the world, which may be even slower
PATIENCE_S = 0.5               # waiting for a world that renders nothing
LAG_S, MOST_MPS2 = 0.3, 1.5    # of the response to setpoints
TWIST_BIAS_MPS, TWIST_NOISE_MPS = (0.03, -0.02), 0.03   # fixed in the body
LATE_S = 0.03                  # every tenth odometry is stamped too early by this time
START = 20.0, -7.0, 1.5, 1.9   # x, y, z, heading
READY_WITHIN_S, FLIGHT_WITHIN_S = 120.0, 300.0


class Autopilot:
    """An autopilot with simulator and MAVROS: follows velocity setpoints in `map` and reports odometry with poor stamps."""

    def __init__(self, simulates_time=True):
        self.x, self.y, self.z, self.yaw = START
        self._velocity, self._turning = [0.0, 0.0, 0.0], 0.0
        self._setpoint = TwistStamped().twist
        self._seen = 0.0
        self._simulates_time = simulates_time
        self._publishers = {kind: rospy.Publisher(topic, kind, queue_size=10) for topic, kind in (
            ("/clock", Clock), ("/mavros/local_position/odom", Odometry), ("/mavros/imu/data", Imu), ("/mavros/state", support.AutopilotState))
            if simulates_time or kind is not Clock}
        rospy.Subscriber("/mavros/setpoint_velocity/cmd_vel", TwistStamped, self._obey)
        rospy.Subscriber("/ground_truth/window_in_camera", PoseStamped, self._look)  # one with each image
        threading.Thread(target=self._run, daemon=True).start()

    def _obey(self, message):
        self._setpoint = message.twist

    def _look(self, message):
        self._seen = message.header.stamp.to_sec()

    def _run(self):
        begin, began = time.monotonic(), 1000.0 if self._simulates_time else time.time()
        factor, count = REAL_TIME_FACTOR if self._simulates_time else 1.0, 0
        while not rospy.is_shutdown():
            count += 1
            now = began + count * STEP_S
            while time.monotonic() < begin + count * STEP_S / factor:
                time.sleep(0.002)
            end = time.monotonic() + PATIENCE_S
            while self._simulates_time and 0.0 < self._seen < now - MOST_AHEAD_S and time.monotonic() < end:
                time.sleep(0.002)
            self._move()
            self._speak(rospy.Time.from_sec(now), count)

    def _move(self):
        linear = self._setpoint.linear
        for axis, wanted in enumerate((linear.x, linear.y, linear.z)):
            change = (wanted - self._velocity[axis]) * STEP_S / LAG_S
            self._velocity[axis] += max(-MOST_MPS2 * STEP_S, min(MOST_MPS2 * STEP_S, change))
        self._turning += (self._setpoint.angular.z - self._turning) * STEP_S / LAG_S
        self.x, self.y, self.z = (at + v * STEP_S for at, v in zip((self.x, self.y, self.z), self._velocity))
        self.yaw += self._turning * STEP_S

    def _speak(self, now, count):
        if self._simulates_time:
            self._publishers[Clock].publish(Clock(now))
        late = count > 10 and count % 10 == 0
        self._publishers[Odometry].publish(self._odometry(now - rospy.Duration(LATE_S) if late else now))
        self._publishers[Imu].publish(self._stamped(Imu(orientation=self._attitude()), now, "base_link"))
        if count % 25 == 0:
            state = support.AutopilotState(connected=True, armed=True, mode="OFFBOARD", system_status=4)
            self._publishers[support.AutopilotState].publish(self._stamped(state, now, ""))

    @staticmethod
    def _stamped(message, now, frame):
        message.header.stamp, message.header.frame_id = now, frame
        return message

    def _attitude(self):
        attitude = Odometry().pose.pose.orientation
        attitude.z, attitude.w = math.sin(0.5 * self.yaw), math.cos(0.5 * self.yaw)
        return attitude

    def _odometry(self, stamp):
        message = self._stamped(Odometry(child_frame_id="base_link"), stamp, "map")
        p, linear = message.pose.pose.position, message.twist.twist.linear
        p.x, p.y, p.z = self.x, self.y, self.z
        message.pose.pose.orientation = self._attitude()
        cos, sin, (vx, vy, vz) = math.cos(self.yaw), math.sin(self.yaw), self._velocity
        linear.x = cos * vx + sin * vy + TWIST_BIAS_MPS[0] + random.gauss(0.0, TWIST_NOISE_MPS)
        linear.y = cos * vy - sin * vx + TWIST_BIAS_MPS[1] + random.gauss(0.0, TWIST_NOISE_MPS)
        linear.z = vz + random.gauss(0.0, TWIST_NOISE_MPS)
        message.twist.twist.angular.z = self._turning
        return message


class ExternalFlightTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.windows = support.Listener("/ground_truth/window", PoseStamped)
        cls.verdicts = support.Listener("/referee", FlightVerdict)
        cls.states = support.Listener("/state", IngressState)
        cls.autopilot = Autopilot()

    def window_ahead(self):
        """The scenario's window, five metres ahead of the vehicle."""
        yaw = self.autopilot.yaw
        x, y = self.autopilot.x + 5.0 * math.cos(yaw), self.autopilot.y + 5.0 * math.sin(yaw)

        def is_it(message):
            p, q = message.pose.position, message.pose.orientation
            turn = 2.0 * math.atan2(q.z, q.w) - yaw
            return message.header.frame_id == "map" and math.dist((p.x, p.y, p.z), (x, y, 1.5)) < 0.05 and abs(math.sin(0.5 * turn)) < 0.01
        return self.windows.wait(is_it, f"the window at {x:.2f}, {y:.2f}", begin=0.0)

    def test_1_the_house_stands_before_the_vehicle_and_the_world_plays_no_vehicle(self):
        self.window_ahead()
        publishers, _, _ = rosgraph.Master("/test").getSystemState()
        of_the_world = {topic for topic, nodes in publishers if "/world" in nodes}
        self.assertLessEqual({"/camera/image_raw", "/camera/camera_info", "/tf_static", "/referee", "/ground_truth/odom"}, of_the_world)
        self.assertEqual({"/clock", "/odom", "/imu"} & of_the_world, set())

    def test_2_the_flight_is_judged_by_where_it_went(self):
        support.start_mission(READY_WITHIN_S)
        verdict = self.verdicts.wait(lambda v: v.outcome != FlightVerdict.RUNNING, "a verdict", FLIGHT_WITHIN_S)
        last = self.states.since(0.0)[-1]
        self.assertEqual(verdict.outcome_name, "PASSED", f"{verdict.reason}; {last.state_name}: {last.reason}")
        self.assertLess(math.hypot(verdict.offset_y, verdict.offset_z), 0.1)

    def test_3_a_reset_puts_the_house_before_the_vehicle_again(self):
        self.states.wait(lambda s: s.state_name in ("PASSED", "ABORTED"), "the end of the mission", begin=0.0)
        support.call("/ingress_navigator/reset")
        reply = support.call("/world/reset")
        self.assertTrue(reply.success)
        self.assertIn("/homography_pose/reset: the track and the memory of all windows are forgotten", reply.message)
        self.assertIn("/window_detector/reset: the track is forgotten", reply.message)
        self.window_ahead()


if __name__ == "__main__":
    rospy.init_node("external_flight_test")
    rostest.rosrun("window_ingress", "external_flight_test", ExternalFlightTest, sys.argv)
