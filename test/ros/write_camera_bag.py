"""Writes a bag of a camera on a standing vehicle: usage write_camera_bag.py FILE.bag [WORD...]

raw|compressed (compressed), seconds=3, image=/camera/image_raw, no_info, rear_info (of another frame), not_rectified (P is zero), no_odom, map (the frame of the odometry), reference (another window than the one seen), twice (a looped replay, recorded), no_clock (the recorder did not use the simulated clock), outputs (a
window_pose and setpoints of the flight, which must not count as new ones).
"""
import pathlib
import sys

import cv2
import rosbag
import rospy
from geometry_msgs.msg import TwistStamped
from sensor_msgs.msg import CompressedImage
from window_ingress.msg import FilteredPose, ReferenceImage, WindowPose

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import support  # noqa: E402

COMMANDS = ("/cmd_vel", "/uav1/mavros/setpoint_velocity/cmd_vel", "/mavros/setpoint_position/local", "/ingress_navigator/cmd_vel")
START_S, RATE_HZ, RECORDED_S = 1000.0, 20, 5000.0


def message_of(pixels, stamp, is_raw):
    if is_raw:
        return support.image_message(pixels, stamp)
    message = CompressedImage(format="bgr8; jpeg compressed bgr8", data=cv2.imencode(".jpg", pixels)[1].tobytes())
    message.header.stamp, message.header.frame_id = stamp, "camera_optical_frame"
    return message


def recorded_outputs(stamp):
    pose = WindowPose(filtered=FilteredPose(reason="from the recording"))
    command = TwistStamped()
    pose.header.stamp = command.header.stamp = stamp
    command.twist.linear.x = 0.77
    return [("/window_pose", pose), *((topic, command) for topic in COMMANDS)]


def messages(stamp, pixels, words, image):
    is_raw = "raw" in words
    yield image if is_raw else image + "/compressed", message_of(pixels, stamp, is_raw)
    if "no_info" not in words:
        info = support.camera_info(stamp, "rear" if "rear_info" in words else "camera_optical_frame")
        info.P = [0.0] * 12 if "not_rectified" in words else info.P
        yield image.rsplit("/", 1)[0] + "/camera_info", info
    if "no_odom" not in words:
        yield "/odom", support.changed(support.odometry, header__frame_id="map" if "map" in words else "odom")(stamp)
    yield "/imu", support.imu(stamp)
    if "outputs" in words:
        yield from recorded_outputs(stamp)


def main():
    file, *words = sys.argv[1:]
    named = dict(word.split("=") for word in words if "=" in word)
    image, count = named.get("image", "/camera/image_raw"), int(RATE_HZ * float(named.get("seconds", "3")))
    pixels, received = support.window_image(), 0
    rospy.rostime.set_rostime_initialized(True)
    with rosbag.Bag(file, "w") as bag:
        transforms = support.transforms_type()([support.mounting()])
        bag.write("/tf_static", transforms, rospy.Time.from_sec(RECORDED_S if "twice" in words else START_S))
        if "reference" in words:
            x, y = zip(*support.CORNERS)
            target = support.image_message(pixels[:, :, ::-1].copy(), rospy.Time())  # the frame of this window is blue
            bag.write("/reference", ReferenceImage(image=target, corner_x=x, corner_y=y), rospy.Time.from_sec(START_S))
        for _ in range(2 if "twice" in words else 1):
            for i in range(count):
                stamp = rospy.Time.from_sec(START_S + i / RATE_HZ)
                at = rospy.Time.from_sec(RECORDED_S + received / RATE_HZ) if "twice" in words else stamp
                at += rospy.Duration(20000 * 86400) if "no_clock" in words else rospy.Duration()
                received += 1
                for topic, message in messages(stamp, pixels, words, image):
                    bag.write(topic, message, at - rospy.Duration(0.001) if topic == "/imu" else at)


if __name__ == "__main__":
    main()
