"""The recorded flight in front of the kiosk: an open window, a poster, a pane of glass. Each is tracked in turn, and the others are
painted over at their true places."""
import cv2
import numpy as np
import pytest
import rosbag

from ingress_tools.transforms import rotation_of
from repository import ROOT, rows_of, run

DATA = ROOT / "../shared/data"
WALL_BGR = (145, 163, 172)
SHOWS_ALL = 104  # index of an image in which all three are whole
# Inner borders on the wall in the target's axes [m]: left, right, top, bottom. Then the areas that are painted over.
BORDERS_M = {"target": (0.65, -0.65, 0.55, -0.55), "poster": (2.853, 1.962, 0.590, -0.195), "glass": (-1.806, -2.602, 0.494, -0.304)}
FRAME_M = 0.16

pytestmark = pytest.mark.skipif(not (DATA / "kiosk.bag").is_file(), reason="the shared data are not here")


def corners_on_wall(name, grown_m=0.0):
    left, right, top, bottom = BORDERS_M[name]
    left, right, top, bottom = left + grown_m, right - grown_m, top + grown_m, bottom - grown_m
    return np.array([(0, left, top), (0, right, top), (0, right, bottom), (0, left, bottom)], float)


class Kiosk:
    """The recording with two of the three painted over."""

    def __init__(self):
        self.bag = rosbag.Bag(str(DATA / "kiosk.bag"))
        read = self.bag.read_messages
        self.K = np.array(next(m for _, m, _ in read(topics=["/camera/camera_info"])).K).reshape(3, 3)
        self.poses = {m.header.stamp: m.pose for _, m, _ in read(topics=["/ground_truth/window_in_camera"])}

    def pixels(self, stamp, points):
        """Nothing if one of the points is behind the camera."""
        pose = self.poses[stamp]
        place = np.array([pose.position.x, pose.position.y, pose.position.z])
        in_camera = points @ rotation_of(pose.orientation).T + place
        if in_camera[:, 2].min() < 0.1:
            return None
        projected = in_camera @ self.K.T
        return np.clip(projected[:, :2] / projected[:, 2:], -20000, 20000)

    def only(self, name, folder):
        """Returns the bag, an image that shows this one, and its corners there."""
        seen = 0
        with rosbag.Bag(str(folder / "flight.bag"), "w") as out:
            for topic, message, time in self.bag.read_messages():
                if topic == "/camera/image_raw/compressed":
                    image = cv2.imdecode(np.frombuffer(message.data, np.uint8), cv2.IMREAD_COLOR)
                    for other in set(BORDERS_M) - {name}:
                        around = self.pixels(message.header.stamp, corners_on_wall(other, FRAME_M))
                        if around is not None:
                            cv2.fillConvexPoly(image, around.round().astype(np.int32), WALL_BGR)
                    message.data = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, 92])[1].tobytes()
                    if seen == SHOWS_ALL:
                        cv2.imwrite(str(folder / "reference.png"), image)
                        corners = self.pixels(message.header.stamp, corners_on_wall(name))
                    seen += 1
                out.write(topic, message, time)
        return folder / "flight.bag", folder / "reference.png", corners


def verdicts(name, folder):
    bag, reference, corners = Kiosk().only(name, folder)
    left, right, top, bottom = BORDERS_M[name]
    done = run("replay_bag", "--bag", bag, "--output", folder / "out", "--reference", reference,
               "--reference-corners", ",".join(f"{c:.2f}" for c in corners.ravel()),
               "--window-size", f"{left - right:.3f},{top - bottom:.3f}")
    assert done.returncode == 0, done.stderr
    frames = rows_of(folder / "out/frames.csv")
    assert sum(row["detected"] == "1" for row in frames) > 80
    return [row["openness"] for row in frames]


def test_the_open_window_is_called_open(tmp_path):
    said = verdicts("target", tmp_path)
    assert said[-1] == "OPEN" and "CLOSED" not in said and said.count("OPEN") > 30


def test_the_poster_is_called_closed(tmp_path):
    said = verdicts("poster", tmp_path)
    assert said[-1] == "CLOSED" and "OPEN" not in said


def test_the_pane_that_mirrors_is_never_called_open(tmp_path):
    assert "OPEN" not in verdicts("glass", tmp_path)
