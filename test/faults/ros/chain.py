"""Camera and autopilot of a vehicle that stands in front of a window, for nodes that believe to fly."""
import time

import numpy
import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu
from std_msgs.msg import Bool

import oracles
import support

LEFT, TOP, RIGHT, BOTTOM = 200, 140, 440, 340  # inner border of 1.2 m x 1.0 m, 2.5 m away, at a focal length of 500 px
CAMERA_HZ, VEHICLE_HZ, AUTOPILOT_HZ = 15.0, 50.0, 10.0
MOVES_WITHIN_S = 20.0


def window_image(shift_px=0):
    """A plaster wall with an orange frame around a dark opening."""
    image = numpy.full((support.HEIGHT, support.WIDTH, 3), 190, numpy.uint8)
    frame = support.FRAME_PX
    image[TOP - frame:BOTTOM + frame, LEFT - frame + shift_px:RIGHT + frame + shift_px] = (20, 95, 225)
    image[TOP:BOTTOM, LEFT + shift_px:RIGHT + shift_px] = (60, 50, 45)
    noise = numpy.random.default_rng(1).normal(0.0, 2.0, image.shape)
    return numpy.clip(image + noise, 0, 255).astype(numpy.uint8)


def later(seconds):
    """For `changed(..., header__stamp=later(-5.0))`."""
    return lambda message: message.header.stamp + rospy.Duration(seconds)


class Chain:
    """Streams every input of the nodes; `streams[topic].make` can be replaced."""

    def __init__(self):
        self.camera = support.Camera(window_image())
        self.mounting = support.publish_mounting()
        self.engaged = True
        self.streams = {topic: support.Stream(topic, kind, make, rate) for topic, kind, make, rate in (
            ("image_raw", Image, self.camera, CAMERA_HZ), ("camera_info", CameraInfo, support.camera_info, CAMERA_HZ),
            ("imu", Imu, support.imu, VEHICLE_HZ), ("odom", Odometry, support.odometry, VEHICLE_HZ),
            ("engaged", Bool, lambda _: Bool(self.engaged), AUTOPILOT_HZ))}
        self.usual = {topic: stream.make for topic, stream in self.streams.items()}

    def restore(self):
        for topic, stream in self.streams.items():
            stream.make = self.usual[topic]
            stream.resume()

    @staticmethod
    def call(service):
        return support.call(f"ingress_navigator/{service}")

    def fly(self, monitor):
        """Waits until the vehicle is commanded to move, from any state."""
        def moves():
            states = monitor.states_since(time.monotonic() - 1.5)
            if not states or not states[-1].enabled:
                self.call("reset")
                self.call("start")
                time.sleep(0.1)
            recent = monitor.part(time.monotonic() - 0.15).setpoints
            return states and states[-1].name == "APPROACH" and any(
                oracles.norm(s.velocity) > 0.1 for s in recent if s.source == monitor.guard)
        support.wait_for(moves, "a vehicle on its way", MOVES_WITHIN_S)

    def stop(self):
        for stream in self.streams.values():
            stream.stop()
