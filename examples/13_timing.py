"""Timing of a path.

The fastest motion along a path, within limits of velocity, acceleration and jerk.

    python examples/13_timing.py [PICTURE.svg]

With a file name it draws velocity and acceleration of each joint relative to their limits, against time.
"""

import sys

import numpy as np

import kinegraph as ry

VELOCITY = np.array([2.175] * 4 + [2.61] * 3)
ACCELERATION = np.array([15, 7.5, 10, 12.5, 15, 20, 20])
COLORS = ["#1f77b4", "#ff7f0e", "#2ca02c", "#d62728", "#9467bd", "#8c564b", "#e377c2"]


def panda_path() -> np.ndarray:
    """Returns three configurations of a Panda."""
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    start = np.array(C.getJointState())[:7]
    over = start + np.array([0.8, -0.3, 0.2, 0.4, 0.0, 0.3, 0.1])
    goal = start + np.array([1.6, 0.5, -0.3, 0.1, 0.4, -0.2, 0.5])
    return np.array([start, over, goal])


def curve(x: np.ndarray, y: np.ndarray, left: float, top: float, width: float, height: float, peak: float) -> str:
    points = (f"{left + width * a:.1f},{top + height / 2 * (1 - b / peak):.1f}" for a, b in zip(x, y, strict=True))
    return " ".join(points)


def draw(motion: ry.TimedPath, file: str) -> None:
    """Draws velocity and acceleration relative to their limits, one curve per joint. The outer lines are the limits."""
    t, _, velocity, acceleration = motion.sample(600 / motion.duration)
    width, height, margin = 720, 160, 40
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width + 2 * margin}" height="{2 * height + 3 * margin}">'
    ]
    parts.append('<rect width="100%" height="100%" fill="white"/>')
    for row, (name, shares) in enumerate(
        (("velocity", velocity / VELOCITY), ("acceleration", acceleration / ACCELERATION))
    ):
        top = margin + row * (height + margin)
        for level in (-1, 0, 1):
            y = top + height / 2 * (1 - level / 1.1)
            parts.append(f'<line x1="{margin}" x2="{margin + width}" y1="{y}" y2="{y}" stroke="#999"/>')
        parts.append(f'<text x="{margin}" y="{top - 6}" font-family="sans-serif" font-size="13">{name} / limit</text>')
        for joint, color in enumerate(COLORS):
            points = curve(t / motion.duration, shares[:, joint], margin, top, width, height, 1.1)
            parts.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"/>')
    parts.append("</svg>")
    with open(file, "w") as out:
        out.write("\n".join(parts))


def main() -> None:
    path = panda_path()
    for corners in ("stop", "blend", "spline"):
        fast = ry.retime(path, VELOCITY, ACCELERATION, corners=corners, tolerance=0.1)
        smooth = ry.retime(path, VELOCITY, ACCELERATION, 20 * ACCELERATION, corners=corners, tolerance=0.1)
        print(f"{corners}: {fast.duration:.3f} s, with jerk limits {smooth.duration:.3f} s")
    print("the motion passes the middle point at", np.round(smooth.times[1], 3), "s")
    if len(sys.argv) > 1:
        draw(smooth, sys.argv[1])


if __name__ == "__main__":
    main()
