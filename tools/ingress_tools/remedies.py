"""Remedies for messages in /diagnostics and for missing topics. Remedies for a check's own findings are in the check."""
import re

from ingress_tools.observed_system import ARGUMENTS, NODES

LAUNCH = "scripts/run roslaunch window_ingress ingress.launch"
AGAIN = "end ingress.launch and start it as before, but with"  # a second launch beside it is refused
WRONG_SIZE = (f"measure the opening's inner width and height, {AGAIN} window_size:=W,H, or homography_pose/pose/opening_*_m in your config; "
              "if it is another window that is seen: doc/window.md, 'Make a reference image'")
WRONG_SIZE_OR_FOCUS = (WRONG_SIZE + ". If the tape agrees with the configuration, the calibration is wrong by the factor between the two sizes: calibrate "
                       "again (doc/window.md), never enter a size that was not measured")
LOOK = "is the image upside down or mirrored? Look at it: scripts/run roslaunch window_ingress view.launch"  # a camera's roll, or its driver's flip
IMAGES = {"sensor_msgs/Image": ("image_transport:=raw ", ""), "sensor_msgs/CompressedImage": ("image_transport:=compressed ", "/compressed")}
# (words of a message, what to do about it); the first match counts.
REMEDIES = (
    ("use_sim_time is set but nothing", "scripts/run rosparam set use_sim_time false, and start the nodes again (a bag: rosbag play --clock)"),
    ("is use_sim_time set", "scripts/run rosparam set use_sim_time false, and start the nodes again"),
    ("recorded data", "scripts/run roslaunch window_ingress replay.launch bag:=$PWD/FILE.bag"),
    ("uncalibrated", "calibrate the camera: doc/window.md"),
    ("sizes differ", "set the camera to the size it was calibrated for, or calibrate again: doc/window.md"),
    ("frames differ", "give image and camera_info of one camera, under one frame_id"),
    ("stamps of image and", "give image and camera_info of one camera; let one clock stamp both"),
    ("the IMU's header.frame_id is", "let the IMU's driver stamp base_link (MAVROS: imu/frame_id), or the frame that vehicle/base_frame names"),
    ("child_frame_id is", "in the file of config:= vehicle: {base_frame: ITS_FRAME}, if that is the body's frame"),
    ("odometry stuck", "restart the estimator or its driver: its messages arrive, but the pose in them never changes; then "
                       "scripts/run rosservice call /ingress_navigator/reset"),
    ("no odometry near the exposure", "odometry and images must be stamped by one clock (MAVROS's timesync, chrony), and odometry may come "
                                      "later than the images by homography_pose/odom_wait_sec; in a replay rosbag decompress, or rate:=0.3"),
    ("holds the vehicle", "a larger limits/fence_radius_m, or start nearer to the window"),
    ("twist is zero", "let the odometry's driver fill in twist.twist.linear, in the axes of child_frame_id; a motion-capture bridge that has no "
                          "velocity: the estimator's odometry instead (EKF2 of PX4, EKF3 of ArduPilot, by MAVROS)"),
    ("position and velocity disagree", "scripts/run rostopic echo -n1 the odometry in flight: twist must be the velocity, in the axes of child_frame_id; "
                                       "propellers off: scripts/ingress check-frames --by-hand --odom ITS_TOPIC"),
    ("setpoints and odometry differ in axes", "take over; odometry must be ENU, z up, and setpoints in its axes: propellers off, scripts/ingress check-frames "
                                              "--by-hand --odom ITS_TOPIC. No start before it agrees"),
    ("unknown to the ROS master", "take over by the pilot's switch, end all launches and MAVROS, and start again"),
    ("attitudes of imu and odometry differ", "one of them has other axes: both must be ENU and forward-left-up, as MAVROS sends them (not PX4's or the driver's own "
                                             "NED); propellers off: scripts/ingress check-frames --by-hand --odom ITS_TOPIC"),
    ("twist looks like", "let the odometry's driver give the velocity in the axes of child_frame_id: forward, left, up"),
    ("quaternion has length", "let the publisher normalise orientation; a driver that does not fill it in sends zeros"),
    ("contradict the estimated window", WRONG_SIZE_OR_FOCUS),
    ("normalised innovation squared", WRONG_SIZE_OR_FOCUS),
    ("relative to odometry", f"correct the driver's stamps, synchronise the clocks (chrony, MAVROS's timesync); {LOOK}"),
    ("none is the reference's", f"if it is the target that is in view: {LOOK}; are red and blue exchanged, or is the image grey (encoding)? Then a new "
                                "reference: scripts/run rosservice call /window_detector/capture_reference"),
    ("header.frame_id is", f"{AGAIN} odom_frame:=ITS_FRAME"),
    ("not in tf", f"{AGAIN} camera_pose:=x,y,z,yaw,pitch,roll camera_frame:=FRAME_OF_THE_IMAGES, "
                  "or scripts/run rosrun tf2_ros static_transform_publisher"),
    ("draws too slowly", "real_time_factor:=0.5 of sim.launch (external.launch: let the vehicle's simulator run slower), or fewer or smaller images: camera: {rate_hz: 15, width_px: 320, height_px: 240} "
                         "in the scenario"),
    ("the budget is", "let the camera send smaller images, or fewer a second; most goes into 'reference' where other rectangles "
                      "than the target are in view: doc/detection.md, 'What it costs'"),
    ("ABORTED: ", "scripts/run rosservice call /ingress_navigator/reset, then start"),
    ("opening guessed", "scripts/ingress reference IMAGE, and give reference_corners:="),
    ("times as wide as it is high", WRONG_SIZE),
    ("opening looks like", WRONG_SIZE_OR_FOCUS),
    ("cannot be excluded yet", f"wait until the vehicle has moved sideways before the window; if this comes again, measure the camera's angles, {AGAIN} "
                               "camera_pose:=x,y,z,yaw,pitch,roll"),
    ("camera mounting turned by", f"{LOOK}; if it is as it should be, add these angles, in radians, to those of the camera, {AGAIN} camera_pose:=x,y,z,yaw,pitch,roll"),
    ("gated out: ", f"measure the opening (window_size:=W,H) and the camera's angles; where these are wrong, {AGAIN} "
                    "camera_pose:=x,y,z,yaw,pitch,roll"),
    ("s old, limit", "a source with less delay, a lighter load on this computer; synchronise the clocks (chrony, MAVROS's timesync)"),
    ("does not change any more", "restart the camera's driver"),
    ("it is advertised, but nothing is sent", "see what its publisher says, scripts/run rosnode info names its log; if it "
                                              "died: scripts/run rosnode cleanup, and start it again"),
    ("(0 publishers)", "start what publishes it, or check the remapping: scripts/run rosnode info"),
    ("nobody subscribes to", "scripts/run rosnode info the one that should listen; check its remapping"),
    ("more than one source on", "scripts/run rostopic info names them; end the one that should not be there"),
    ("must be mavros_msgs/State", "scripts/run rostopic info the topic names its publishers; end the one that is not MAVROS, or give mavros:=ITS_NAMESPACE"),
    ("in a failsafe", "read in the ground station what the autopilot says: battery, link, sensors"),
    ("not connected, ", "mend fcu_url:= of MAVROS: it does not reach its autopilot"),
    ("(it follows in", "px4.launch is for PX4 (OFFBOARD), ardupilot.launch for ArduPilot (GUIDED); in the right one switch to that mode"),
    ("/state has fallen silent", "see what MAVROS says, and scripts/run rostopic hz its state"),
    ("has fallen silent", "let its publisher repeat it, once a second or more often"),
    ("/state so far", f"start MAVROS (roslaunch mavros px4.launch, or apm.launch), or {AGAIN} mavros:=ITS_NAMESPACE"),
    ("engaged", "arm, and switch to OFFBOARD or GUIDED: doc/autopilots.md"),
)


def remedy(text):
    mend = next((mend for words, mend in REMEDIES if words in text), "doc/troubleshooting.md")
    came = re.search("frame_id is '(.+?)'", text)
    return mend.replace("ITS_FRAME", came[1]) if came else mend


def another_topic(system, topic, kind):
    """How to give a node another topic of this type that is not one of ours."""
    def topics_of_type(wanted):
        return [name for name in system.graph.topics_of_type(wanted)
                if any(node.split("/")[-1] not in NODES for node in system.graph.publishers[name]) and not name.startswith("/ground_truth/")]

    if kind in IMAGES:
        others = [f"{transport}image:={other[:len(other) - len(end)]}" for wanted, (transport, end) in IMAGES.items()
                  for other in topics_of_type(wanted) if other != topic and other.endswith(end)]
    else:
        others = [f"{ARGUMENTS[kind]}:={other}" for other in topics_of_type(kind) if other != topic]
    who = f"MAVROS (roslaunch mavros px4.launch, or apm.launch), which publishes {topic}" if "/mavros/" in topic else f"what publishes {topic}"
    return f"{AGAIN} {' or '.join(others)}" if others else f"start {who}, or give {ARGUMENTS[kind]}:=ITS_TOPIC"
