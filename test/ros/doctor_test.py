#!/usr/bin/env python3
"""doctor finds nothing in a healthy simulation. In each broken one it finds the fault and the command that repairs it."""
import os
import subprocess
import sys
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import TwistStamped
from roslib.packages import find_node
from sensor_msgs.msg import CameraInfo
from std_srvs.srv import SetBool

import support

DOCTOR = find_node("window_ingress", "doctor")[0]  # in the source or the install space
READY_S = 40.0


def doctor(*arguments, **environment):
    done = subprocess.run([DOCTOR, "--seconds", "2.5", *arguments], capture_output=True, text=True, timeout=60, check=False,
                          env={**os.environ, "WINDOW_INGRESS_RUN": "", **environment})
    return done.returncode, done.stdout + done.stderr


class DoctorTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        end = time.monotonic() + READY_S
        code, said = doctor()
        while code and time.monotonic() < end:  # the simulation may still be starting
            code, said = doctor()
        cls.healthy = code, said

    def expect(self, *words, code=1):
        """Tries several times: nodes discover each other one by one."""
        for _ in range(3):
            found, said = doctor()
            if found == code and all(word in said for word in words):
                return said
        self.assertEqual(found, code, said)
        for word in words:
            self.assertIn(word, said)
        return said

    def test_0_a_healthy_simulation_has_nothing_to_mend(self):
        code, said = self.healthy
        self.assertEqual(code, 0, said)
        for word in ("OK     /window_detector is running", "OK     time is that of /clock, from /world", "/camera/image_raw: ",
                     "calibrated, fx", "looks forward", "from setpoint_guard to /world", "opening 1.20 x 1.00 m, vehicle 0.40 x 0.14 m", "nothing is wrong"):
            self.assertIn(word, said)

    def test_no_master(self):
        code, said = doctor(ROS_MASTER_URI="http://localhost:1")
        self.assertEqual(code, 2)
        self.assertIn("no master at ROS_MASTER_URI=http://localhost:1", said)
        self.assertIn("mend: start a launch file", said)
        self.assertIn("take over by the switch", said)

    def test_package_not_sourced(self):
        code, said = doctor(PYTHONPATH="/usr/lib/python3/dist-packages")
        self.assertEqual(code, 2)
        self.assertIn("not built, or its workspace is not sourced", said)

    def test_a_navigator_that_is_disabled(self):
        enable = rospy.ServiceProxy("/ingress_navigator/enable", SetBool)
        enable(False)
        try:
            said = self.expect("navigator: IDLE: disabled (~enable)", "mend: rosservice call /ingress_navigator/enable true")
        finally:
            enable(True)
        self.assertNotIn("setpoint_guard: cmd_vel_in", said)

    def test_two_sources_of_setpoints(self):
        other = rospy.Publisher("/cmd_vel", TwistStamped, queue_size=1)
        support.wait_for(lambda: other.get_num_connections() > 0, "the world hears the second source")
        try:
            said = self.expect("/cmd_vel: 2 publishers", "only setpoint_guard may steer", "mend: rosnode kill /doctor_test")
        finally:
            other.unregister()
        self.assertNotIn("mend: rosnode kill /setpoint_guard", said)

    def test_unknown_parameters_and_what_does_not_fit(self):
        rospy.set_param("/window_detector/detector/edges/flor", 3.0)
        wide, speed = "/vehicle/half_width_m", "/setpoint_guard/max_speed_mps"
        before = rospy.get_param(wide), rospy.get_param(speed)
        rospy.set_param(wide, 0.6)
        rospy.set_param(speed, 0.5)
        try:
            self.expect("window_detector does not know the parameters detector/edges/flor",
                        "mend: rosparam delete /window_detector/detector/edges/flor", "0.00 m to spare at each side",
                        "setpoint_guard refuses more than 0.5 m/s")
        finally:
            rospy.delete_param("/window_detector/detector/edges/flor")
            rospy.set_param(wide, before[0])
            rospy.set_param(speed, before[1])

    def test_a_second_camera_that_is_not_calibrated(self):
        stream = support.Stream("/camera/camera_info", CameraInfo, lambda stamp: support.camera_info(stamp, focal=0.0), 200.0)
        try:
            self.expect("/camera/camera_info: 2 publishers")
        finally:
            stream.stop()
            support.Stream._publishers.pop("/camera/camera_info").unregister()
        self.expect("nothing is wrong", code=0)

    def test_z_a_node_that_died_and_what_hangs_on_it(self):
        subprocess.run(["rosnode", "kill", "/homography_pose"], stdout=subprocess.DEVNULL, check=True, timeout=30)
        self.expect("homography_pose is not running", "mend: end the launch of the others, and start it again;",
                    "ingress_navigator: window_pose: no more window_pose on /window_pose (0 publishers)")
        subprocess.run(["rosnode", "kill", "/window_detector"], stdout=subprocess.DEVNULL, check=True, timeout=30)
        self.expect("window_detector is not running")


if __name__ == "__main__":
    rospy.init_node("doctor_test")
    rostest.rosrun("window_ingress", "doctor_test", DoctorTest, sys.argv)
