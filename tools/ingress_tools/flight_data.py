"""One flight as arrays, from a log of `fly --log` or from a bag; used by plot_flight.

Positions are those of the vehicle in the window's frame: x into the opening, y left, z up, the wall at x = 0.
"""
import math
import os

import numpy as np

from .campaign_data import DataError, need_columns, table_of

STATE_COLOURS = {
    "IDLE": "#aaaaaa", "SEARCH": "#9b59b6", "ALIGN": "#1f5fa8", "APPROACH": "#56c1e8", "COMMIT": "#e67e22",
    "PASSED": "#2e9e4f", "BACK_OFF": "#d0312d", "HOLD": "#f1c40f", "ABORTED": "#000000",
}
LOG_COLUMNS = ("time_s", "x_m", "y_m", "z_m", "heading_rad", "vx_mps", "vy_mps", "vz_mps", "image_s", "image_yaw_rad",
               "image_trusted", "image_width_m", "image_height_m", "image_left_px", "image_right_px", "error_yaw_rad",
               "predicted_miss_m")
MAY_BE_EMPTY = LOG_COLUMNS[8:]


def yaw_of(q):
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


class Images:
    """Estimates from each single image: time, yaw [rad], trusted, width [m], height [m], left and right [px]."""

    NAMES = ("time", "yaw", "trusted", "width", "height", "left", "right")

    def __init__(self, rows):
        table = np.array(rows, float).reshape(-1, len(self.NAMES))
        for name, column in zip(self.NAMES, table.T):
            setattr(self, name, column)
        self.trusted = self.trusted > 0.5

    def __len__(self):
        return len(self.time)


class Flight:
    """Times are seconds since the start of the mission.

    file. is_truth: positions are the truth, else odometry relative to the last trusted pose of the window.
    time, x, y, z, heading, speed: of the vehicle, arrays; heading against the window's axis [rad].
    states: (time, name) of each step. images: see Images. filtered: (times, relative angle by the filter [rad]).
    predicted_miss: three sigma at the last commit [m], or None. window_size: (width, height) [m], or None.
    reason: of the last state. verdict: of the simulated world's referee, or empty. is_part: begin or end was cut off.
    """

    def __init__(self, file, motion, states, images, filtered=((), ())):
        self.file, self.is_truth, self.images = file, True, images
        order = np.unique(motion[:, 0], return_index=True)[1]
        self.time, self.x, self.y, self.z, heading, self.speed = motion[order].T
        self.heading = np.unwrap(heading)
        self.states = states
        self.filtered = tuple(np.array(column, float) for column in filtered)
        self.predicted_miss, self.window_size = None, None
        self.reason, self.verdict, self.is_part = "", "", False

    def at(self, times, values):
        return np.interp(times, self.time, values)

    def knows(self, times, slack=0.05):
        """Whether positions are recorded for these times."""
        return (times >= self.time[0] - slack) & (times <= self.time[-1] + slack)

    def spans(self):
        """(name, begin, end) of each stay in a state."""
        spans = []
        for time, name in self.states:
            if spans and spans[-1][0] == name:
                spans[-1][2] = time
                continue
            if spans:
                spans[-1][2] = time
            spans.append([name, time, time])
        spans[-1][2] = max(spans[-1][2], self.time[-1])
        return spans

    def crossing(self):
        """(time, y, z) where the plane of the window was crossed for the first time, from outside; None if never."""
        into = np.nonzero((self.x[:-1] < 0) & (self.x[1:] >= 0))[0]
        if len(into) == 0:
            return None
        i = into[0]
        share = -self.x[i] / (self.x[i + 1] - self.x[i])
        return tuple(column[i] + share * (column[i + 1] - column[i]) for column in (self.time, self.y, self.z))

    def cut(self, begin, end):
        """Keeps only what lies between two times [s]."""
        keep = (self.time >= begin) & (self.time <= end)
        if keep.sum() < 2:
            raise DataError(f"{self.file}: fewer than two positions between {begin:g} and {end:g} s; it holds "
                              f"{self.time[0]:.1f} to {self.time[-1]:.1f} s")
        for name in ("time", "x", "y", "z", "heading", "speed"):
            setattr(self, name, getattr(self, name)[keep])
        self.is_part = True
        if end < self.states[-1][0]:
            self.reason = self.verdict = ""
        inside = [(time, name) for time, name in self.states if begin <= time <= end]
        before = [name for time, name in self.states if time < begin]
        self.states = [(self.time[0], before[-1])] + inside if before else inside or self.states[:1]
        if not any(name == "COMMIT" for _, name in self.states):
            self.predicted_miss = None
        seen = (self.images.time >= begin) & (self.images.time <= end)
        for name in Images.NAMES:
            setattr(self.images, name, getattr(self.images, name)[seen])


def read_flight(file, topics=None):
    """Reads a bag or, with another ending, a log. Raises DataError."""
    if os.path.isdir(file):
        raise DataError(f"{file}: is a folder; give one flight_N.csv or one bag in it")
    if not os.path.isfile(file):
        raise DataError(f"{file}: no such file; record a bag, or write a log with 'fly --log DIR'")
    if file.endswith(".bag"):
        try:
            from .flight_bag import read_bag  # pylint: disable=import-outside-toplevel  (logs are drawn without ROS)
        except ImportError as error:
            raise DataError(f"{file}: bags need ROS: {error}; run it with scripts/run") from error
        return read_bag(file, topics or {})
    return read_log(file)


def read_log(file):
    rows, columns = table_of(file, "give a log of 'fly --log DIR' or a .bag")
    if "outcome" in columns:
        raise DataError(f"{file}: is the table of a campaign; plot_miss draws it, plot_flight one log of 'fly --log DIR'")
    need_columns(file, ("state", "reason", *LOG_COLUMNS), columns, "write the log with 'fly --log DIR' of this version")
    if len(rows) < 2:
        raise DataError(f"{file}: {len(rows)} rows, a flight needs two; did the flight start?")
    return flight_of_log(file, rows)


def flight_of_log(file, rows):
    table = {name: [number(file, i + 2, row, name) for i, row in enumerate(rows)] for name in LOG_COLUMNS}
    table = {name: np.array(values) for name, values in table.items()}
    speed = np.sqrt(table["vx_mps"] ** 2 + table["vy_mps"] ** 2 + table["vz_mps"] ** 2)
    motion = np.column_stack([table[name] for name in LOG_COLUMNS[:5]] + [speed])
    seen = np.column_stack([table[name] for name in LOG_COLUMNS[8:15]])
    first = np.isfinite(seen[:, 0]) & np.append(True, seen[1:, 0] != seen[:-1, 0])
    known = np.isfinite(table["error_yaw_rad"])
    filtered = (table["time_s"][known], (table["error_yaw_rad"] - table["heading_rad"])[known])
    flight = Flight(file, motion, list(zip(table["time_s"], (row["state"] for row in rows))), Images(seen[first]), filtered)
    predictions = table["predicted_miss_m"][np.isfinite(table["predicted_miss_m"])]
    flight.predicted_miss = predictions[-1] if len(predictions) else None
    flight.reason = rows[-1]["reason"] or ""
    return flight


def number(file, line, row, name):
    text = row[name]
    if not text and name in MAY_BE_EMPTY:
        return math.nan
    try:
        value = float(text)
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise DataError(f"{file}:{line}: '{text}' in column {name} is no number; was the log cut off?")
    return value
