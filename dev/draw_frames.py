#!/usr/bin/env python3
"""Draws doc/frames.png, the figure of all frames. Usage: draw_frames.py OUT.png"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Rectangle

RED, GREEN, BLUE, GREY = "#c0392b", "#1e8449", "#1f4e9c", "#777777"


def axis(ax, origin, direction, label, colour, length=0.9):
    direction = np.asarray(direction, float)
    tip = np.asarray(origin) + length * direction
    ax.annotate("", xy=tip, xytext=origin, arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 2})
    ax.text(*(np.asarray(origin) + (length + 0.14 + 0.045 * len(label)) * direction), label, color=colour, ha="center", va="center",
            fontsize=11, weight="bold")


def out_of_page(ax, origin, label, colour, dx=0.0, dy=-0.22):
    ax.plot(*origin, "o", ms=11, mfc="white", mec=colour, mew=1.8)
    ax.plot(*origin, ".", ms=5, color=colour)
    ax.text(origin[0] + dx, origin[1] + dy, label, color=colour, ha="center", va="center", fontsize=10, weight="bold")


def into_page(ax, origin, label, colour, dx=0.0, dy=-0.22):
    ax.plot(*origin, "o", ms=11, mfc="white", mec=colour, mew=1.8)
    ax.plot(*origin, "x", ms=7, color=colour, mew=1.8)
    ax.text(origin[0] + dx, origin[1] + dy, label, color=colour, ha="center", va="center", fontsize=10, weight="bold")


def title(ax, origin, text):
    ax.text(*origin, text, ha="center", va="center", fontsize=11, color="black",
            bbox={"boxstyle": "round", "fc": "#f4f4f4", "ec": GREY})


def rotation(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


def from_above(ax):
    ax.set_title("seen from above: the window turned by +25° against the vehicle (yaw_rad > 0)")
    window, yaw = np.array([5.6, 0.9]), np.radians(25)
    along, side = rotation(yaw) @ [1, 0], rotation(yaw) @ [0, 1]
    for low, high in ((0.6, 1.8), (-1.8, -0.6)):
        a, b = window + low * side, window + high * side
        corners = np.array([a, b, b + 0.25 * along, a + 0.25 * along])
        ax.fill(*corners.T, color="#c9b79c", ec=GREY)
    axis(ax, window, along, "x", RED)
    axis(ax, window, side, "y", GREEN)
    out_of_page(ax, window, "z", BLUE, dx=-0.22, dy=-0.12)
    title(ax, window + [0.55, -2.55], "window\norigin: centre of the opening's front plane\nx into the opening")
    ax.plot([window[0] - 2.4, window[0] + 1.1], [window[1]] * 2, ":", color=GREY)
    arc = np.linspace(0, yaw, 30)
    ax.plot(window[0] + 1.15 * np.cos(arc), window[1] + 1.15 * np.sin(arc), color="black")
    ax.text(window[0] + 1.4, window[1] + 0.3, "yaw", fontsize=11)

    base = np.array([1.6, 0.4])
    ax.add_patch(Rectangle(base - [0.25, 0.25], 0.5, 0.5, fc="#dddddd", ec=GREY))
    axis(ax, base, [1, 0], "x", RED)
    axis(ax, base, [0, 1], "y", GREEN)
    out_of_page(ax, base, "z", BLUE, dx=-0.2, dy=-0.05)
    title(ax, base + [-0.15, -0.75], "base_link\nforward, left, up")

    camera = np.array([3.0, -1.6])
    axis(ax, camera, [1, 0], "z", BLUE)
    axis(ax, camera, [0, -1], "x", RED, 0.6)
    into_page(ax, camera, "y", GREEN, dx=-0.2, dy=0.1)
    title(ax, camera + [-1.35, -0.2], "camera_optical_frame\nright, down, forward")

    odom = np.array([-1.0, -1.7])
    axis(ax, odom, [1, 0], "x east", RED, 0.7)
    axis(ax, odom, [0, 1], "y north", GREEN, 0.7)
    out_of_page(ax, odom, "z up", BLUE, dy=-0.25)
    title(ax, odom + [0.2, -0.75], "odom")
    ax.set_xlim(-2.0, 8.3)
    ax.set_ylim(-2.9, 3.0)


def as_seen(ax):
    ax.set_title("as the vehicle sees it: order of the corners and sides")
    ax.add_patch(Rectangle((-2.2, -1.6), 4.4, 3.2, fc="#c9b79c", ec=GREY))
    ax.add_patch(Rectangle((-1.15, -0.95), 2.3, 1.9, fc="#a0522d"))
    ax.add_patch(Rectangle((-1, -0.8), 2, 1.6, fc="#e8edf2", ec="#2ecc71", lw=3))
    for (x, y), label in zip(((-1, 0.8), (1, 0.8), (1, -0.8), (-1, -0.8)), "0123"):
        ax.plot(x, y, "o", color="#2ecc71", ms=8)
        ax.text(x * 0.82, y * 0.8, label, color="black", ha="center", va="center", fontsize=12, weight="bold")
    for x, y, label in ((0, 0.68, "side 0: top"), (0.76, 0, "1: right"), (0, -0.68, "2: bottom"), (-0.78, 0, "3: left")):
        ax.text(x, y, label, color="black", ha="center", va="center", fontsize=9)
    axis(ax, (0, 0), [-1, 0], "y", GREEN, 0.32)
    axis(ax, (0, 0), [0, 1], "z", BLUE, 0.32)
    into_page(ax, (0, 0), "x", RED, dx=0.17, dy=-0.15)
    ax.text(0, -1.28, "the inner border of the frame is the opening", ha="center", fontsize=10)
    axis(ax, (-2.55, 1.75), [1, 0], "u", RED, 0.6)
    axis(ax, (-2.55, 1.75), [0, -1], "v", GREEN, 0.6)
    ax.text(-2.5, 1.98, "pixel (0, 0): centre of the first pixel", fontsize=9, ha="left", color=GREY)
    ax.set_xlim(-3.0, 2.7)
    ax.set_ylim(-1.8, 2.2)


def main():
    figure, (left, right) = plt.subplots(1, 2, figsize=(15, 6), gridspec_kw={"width_ratios": [1.5, 1]})
    from_above(left)
    as_seen(right)
    for ax in (left, right):
        ax.set_aspect("equal")
        ax.axis("off")
    figure.tight_layout()
    figure.savefig(sys.argv[1], dpi=80)


if __name__ == "__main__":
    main()
