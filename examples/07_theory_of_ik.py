"""Part 7: inverse kinematics from scratch, ten damped Newton steps.

Near q, the position of the end effector is y + J dq. A short step that brings it to the target,

    minimize  |y_target - y - J dq|^2 + w |dq|^2,   is   dq = (J^T J + w I)^-1 J^T (y_target - y).

The damping w keeps the inverse finite if J loses rank, as for a stretched arm.
"""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from robotic import ry

K = ry.Config()
K.addFile(str(Path(__file__).with_name("two_link_arm.g")))
W = 1e-4 * np.identity(K.getJointDimension())
position = K.feature(ry.FS.position, ["endeffector"])


def newton(q: NDArray[np.float64], y_target: NDArray[np.float64], steps: int = 10) -> NDArray[np.float64]:
    print(f"\ntarget {y_target}")
    for step in range(steps):
        y, J = position.eval(K)
        print(f"  step {step}: end effector {y.round(4)}, {np.linalg.norm(y_target - y):.6f} m off")
        q = q + np.linalg.inv(J.T @ J + W) @ J.T @ (y_target - y)
        K.setJointState(q)  # sets the angles and moves all frames
        K.view(True, f"after step {step}")
    y, _ = position.eval(K)
    print(f"  done:   end effector {y.round(4)}, {np.linalg.norm(y_target - y):.6f} m off, q = {q.round(3)}")
    return q


K.setJointState([0.0, 0.0, 0.0])
K.view(True, "stretched upwards")

# .5 m to the side and .2 m up: the arm bends and reaches it.
K.setJointState([0.3, 0.4, 0.0])
newton(K.getJointState(), np.array([0.0, 0.5, 0.2]))
assert np.allclose(position.eval(K)[0], [0, 0.5, 0.2], atol=1e-3)

# .7 m to the side: the arm is only .68 m long, so the nearest it comes is .02 m.
K.setJointState([0.3, 0.4, 0.0])
newton(K.getJointState(), np.array([0.0, 0.7, 0.0]))
