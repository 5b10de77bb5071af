"""Writes tests/data/dynamics_pinocchio.json, with which test_dynamics.py compares: `python
tests/python/record_dynamics.py` with the package pin (Pinocchio).

The scene, a floating base with a leg and a slider, is made by hand here and there. Pinocchio's model has a joint for
translations before the spherical one of the base. Its velocities are thus those of a free joint here.
"""

import json
from pathlib import Path

import numpy as np
import pinocchio as pin

# joint, parent, placement, axis or kind, mass, center of mass, inertia xx xy xz yy yz zz
LINKS = [
    ("base", None, [0, 0, 0], "free", 5.0, [0.05, 0.02, -0.01], [0.2, 0.01, -0.02, 0.3, 0.03, 0.25]),
    ("hip", "base", [0.1, 0.12, -0.1], "quatBall", 2.0, [0.01, 0.0, -0.2], [0.04, 0.001, 0.002, 0.05, 0.003, 0.01]),
    ("knee", "hip", [0.0, 0.0, -0.4], "hingeY", 1.0, [0.02, 0.01, -0.15], [0.02, 0.0, 0.001, 0.03, 0.002, 0.01]),
    ("slider", "base", [-0.2, 0.0, 0.1], "transX", 0.7, [0.0, 0.1, 0.05], [0.01, 0.002, 0.001, 0.02, 0.003, 0.03]),
]


def scene():
    lines = ["world: {}"]
    for name, parent, at, joint, mass, com, inertia in LINKS:
        lines.append(f"{name} ({parent or 'world'}): {{ pre: [{' '.join(map(str, at))}], joint: {joint} }}")
        numbers = " ".join(map(str, inertia))
        lines.append(f"{name}_mass ({name}): {{ Q: [{' '.join(map(str, com))}], mass: {mass}, inertia: [{numbers}] }}")
    return "\n".join(lines)


def model():
    model, ids = pin.Model(), {None: 0}
    for name, parent, at, joint, mass, com, (xx, xy, xz, yy, yz, zz) in LINKS:
        place = pin.SE3(np.eye(3), np.array(at, dtype=float))
        if joint == "free":
            ids[parent] = model.addJoint(0, pin.JointModelTranslation(), place, name + "_translation")
            place = pin.SE3.Identity()
        kind = {"free": pin.JointModelSpherical, "quatBall": pin.JointModelSpherical}.get(joint)
        kind = kind or {"hingeY": pin.JointModelRY, "transX": pin.JointModelPX}[joint]
        ids[name] = model.addJoint(ids[parent], kind(), place, name)
        matrix = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        model.appendBodyToJoint(ids[name], pin.Inertia(mass, np.array(com), matrix), pin.SE3.Identity())
    return model


def main():
    rng, robot, samples = np.random.default_rng(7), model(), []
    data = robot.createData()
    for _ in range(5):
        base, hip = rng.normal(size=4), rng.normal(size=4)
        base, hip = base / np.linalg.norm(base), hip / np.linalg.norm(hip)  # w x y z
        position, rest = rng.normal(size=3), rng.normal(size=2)
        v = rng.normal(size=robot.nv)
        q = np.concatenate([position, np.roll(base, -1), np.roll(hip, -1), rest])
        pin.computeAllTerms(robot, data, q, v)
        M = np.triu(pin.crba(robot, data, q))
        samples.append(
            {
                "q": np.concatenate([position, base, hip, rest]).tolist(),
                "v": v.tolist(),
                "M": (M + np.triu(M, 1).T).tolist(),
                "C": pin.computeCoriolisMatrix(robot, data, q, v).tolist(),
                "g": pin.computeGeneralizedGravity(robot, data, q).tolist(),
                "A": pin.computeCentroidalMap(robot, data, q).tolist(),
            }
        )
    file = Path(__file__).parent.parent / "data/dynamics_pinocchio.json"
    source = f"Pinocchio {pin.__version__}, tests/python/record_dynamics.py"
    file.write_text(json.dumps({"source": source, "scene": scene(), "samples": samples}) + "\n")


if __name__ == "__main__":
    main()
