"""A vehicle and its window without a renderer. The velocity follows cmd_vel, and the test decides whether the window is seen."""
import threading

import rospy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from std_msgs.msg import UInt32
from window_ingress.msg import Facade, FilteredPose, ImagePose, KnownWindow, Openness, SystemChecks, WindowPose

import support

WINDOW_X, HEIGHT, SIZE = 4.0, 1.5, (1.2, 1.0)
ODOM_HZ, POSE_HZ = 50.0, 30.0
RESPONSE_S = 0.2
COMMITTED_FROM_M = 0.6  # nearer than this the border is outside the image


class Plant:
    def __init__(self):
        self.shows_window, self.sign_trusted, self.has_odometry, self.obeys_choice = False, True, True, True
        self._lock = threading.Lock()
        self._target, self._chosen = 1, False
        self._told = [0.0, 0.0, 0.0]
        self._facade = rospy.Publisher("facade", Facade, queue_size=1, latch=True)
        self.restart()
        self._subscribers = [rospy.Subscriber("cmd_vel", TwistStamped, self._receive, queue_size=1),
                             rospy.Subscriber("chosen_window", UInt32, self._choose)]
        self._streams = [support.Stream("odom", Odometry, self._odometry, ODOM_HZ),
                         support.Stream("window_pose", WindowPose, self._pose, POSE_HZ)]

    def stop(self):
        for stream in self._streams:
            stream.stop()
        for subscriber in self._subscribers:
            subscriber.unregister()

    def pause_odometry(self):
        self._streams[0].pause()

    def resume_odometry(self):
        self._streams[0].resume()

    def restart(self):
        """Back to the start, at rest, with the window out of sight."""
        with self._lock:
            self.place, self.velocity, self.updates = [0.0, 0.0, HEIGHT], [0.0, 0.0, 0.0], 0
            self.shows_window, self.sign_trusted, self.obeys_choice = False, True, True
            self._target, self._chosen = 1, False
        self._publish_facade()

    def _choose(self, message):
        if self.obeys_choice:
            self._target, self._chosen = message.data, True
            self._publish_facade()

    def _publish_facade(self):
        self._facade.publish(windows=[KnownWindow(id=1), KnownWindow(id=2)], target_id=self._target, target_chosen=self._chosen)

    def _receive(self, message):
        linear = message.twist.linear
        self._told = [linear.x, linear.y, linear.z]

    def _odometry(self, stamp):
        with self._lock:
            for i, told in enumerate(self._told):
                self.velocity[i] += (told - self.velocity[i]) / (RESPONSE_S * ODOM_HZ)
                self.place[i] += self.velocity[i] / ODOM_HZ
            message = support.odometry(stamp)
            position, linear = message.pose.pose.position, message.twist.twist.linear
            position.x, position.y = self.place[:2]
            position.z = self.place[2] + 1e-15 * stamp.nsecs  # no two odometry samples are equal
            linear.x, linear.y, linear.z = self.velocity
        return message

    def _pose(self, stamp):
        message = support.no_window(stamp)
        message.size.width, message.size.height = SIZE
        if self.shows_window and WINDOW_X - self.place[0] > COMMITTED_FROM_M:
            self.updates += 1
            self._show(message, stamp)
        return message

    def _show(self, message, stamp):
        message.image.reject, message.image.reason = ImagePose.OK, ""
        filtered = message.filtered = FilteredPose(valid=True, sign_trusted=self.sign_trusted, weight=1.0, updates=self.updates)
        filtered.header.frame_id, filtered.header.stamp = "odom", stamp
        pose = filtered.pose.pose
        pose.position.x, pose.position.z, pose.orientation.w = WINDOW_X, HEIGHT, 1.0
        covariance = [0.0] * 36
        for i in range(6):
            covariance[7 * i] = 1e-4
        filtered.pose.covariance = covariance
        message.checks.fit, message.target.window_id = SystemChecks.FIT_GO, self._target
        message.openness = Openness(verdict=Openness.OPEN, open_share=1.0, log_odds=20.0)
