"""Part of doctor: calibration and mounting of the camera."""
import numpy

from ingress_tools.remedies import remedy

LOOKS_FORWARD = 0.7  # least component of an axis, about 45 degrees
BESIDE_BODY_M = 0.02


def view_deg(info):
    """Width of the field of view, without the lens's distortion [deg]."""
    half = 0.5 * info.width / info.K[0]
    return 2.0 * numpy.degrees(half if info.distortion_model in ("equidistant", "fisheye") else numpy.arctan(half))


def angles_deg(R_base_optical):
    """Yaw, pitch, roll of an optical frame as camera_pose:= takes them, in degrees: of x forward, y left, z up."""
    forward, left, up = R_base_optical[:, 2], -R_base_optical[:, 0], -R_base_optical[:, 1]
    angles = numpy.arctan2(forward[1], forward[0]), numpy.arcsin(numpy.clip(-forward[2], -1.0, 1.0)), numpy.arctan2(left[2], up[2])
    return numpy.round(numpy.degrees(angles), 1) + 0.0  # no -0.0


def check_calibration(system, report):
    topic = system.input("window_detector", "sensor_msgs/CameraInfo")
    image = system.input("window_detector", "sensor_msgs/Image")
    info = system.infos.get(topic)
    if not info:
        return
    size = system.samples[image].image_size() if image else None
    if not any(info.K):
        report.error(f"{topic}: not calibrated, K is all zero", remedy("uncalibrated"), [topic])
    elif size and size != (info.width, info.height):
        report.error(f"{topic}: for {info.width}x{info.height}, the image on {image} has {size[0]}x{size[1]}", remedy("sizes differ"), [topic])
    else:
        report.ok(f"{topic}: calibrated, fx {info.K[0]:.1f} px ({view_deg(info):.0f} deg wide), {info.width}x{info.height} as the image, "
                  f"frame {info.header.frame_id}")


def check_mounting(system, report):
    for frame, senders in system.transforms.contradictions().items():
        report.error(f"tf: {' and '.join(senders)} send different transforms of {frame}, and the latest counts",
                     "let only one of them send it: no camera_pose:= beside another source, one source of odometry in tf")
    info = system.infos.get(system.input("homography_pose", "sensor_msgs/CameraInfo"))
    base = system.parameter("vehicle", "base_frame", "base_link")
    if not info:
        return
    camera = info.header.frame_id
    T_base_camera = system.transforms.between(base, camera)
    if T_base_camera is None and system.knows_mounting():
        report.ok(f"tf: homography_pose knows {camera}; its transform was sent before doctor listened")
        return
    if T_base_camera is None:
        known = ", ".join(system.transforms.frames()) or "none"
        report.error(f"tf: no transform from {base} to {camera}; known frames: {known}", remedy("not in tf").replace("FRAME_OF_THE_IMAGES", camera),
                     [camera])
        return
    forward, down = T_base_camera[:3, 2], T_base_camera[:3, 1]
    at = ", ".join(f"{value:+.2f}" for value in T_base_camera[:3, 3])
    if forward[0] < LOOKS_FORWARD or down[2] > -LOOKS_FORWARD:
        report.error(f"tf: {camera} does not look forward: its z axis is ({forward[0]:+.2f}, {forward[1]:+.2f}, {forward[2]:+.2f}) in {base}; "
                     "an optical frame has z forward, x right, y down", "give the optical frame, or camera_pose:=x,y,z,yaw,pitch,roll", [camera])
        return
    half = [system.parameter("vehicle", f"half_{side}_m", 0.25) for side in ("length", "width", "height")]
    if any(abs(value) > reach + BESIDE_BODY_M for value, reach in zip(T_base_camera[:3, 3], half)):
        report.error(f"tf: {camera} at ({at}) m in {base} lies outside of the vehicle, which reaches {' x '.join(map(str, half))} m from its middle",
                     "measure both: camera_pose:=x,y,z,yaw,pitch,roll, and vehicle: {half_length_m, half_width_m, half_height_m} in your config", [camera])
    else:
        yaw, pitch, roll = angles_deg(T_base_camera[:3, :3])
        report.ok(f"tf: {camera} at ({at}) m in {base}, looks forward: yaw {yaw:+.1f}, pitch {pitch:+.1f} (positive: down), roll {roll:+.1f} deg")
