"""Compares the scene of an MJCF file with MuJoCo's model."""

import itertools

import mujoco
import numpy as np

import kinegraph as ry

WIDTH = {int(mujoco.mjtJoint.mjJNT_FREE): 7, int(mujoco.mjtJoint.mjJNT_BALL): 4}


class Comparison:
    """A scene and MuJoCo's model of a file."""

    def __init__(self, file: str, config: ry.Config, seed: int) -> None:
        self.config, self.random = config, np.random.default_rng(seed)
        self.model = mujoco.MjModel.from_xml_path(file)
        self.data = mujoco.MjData(self.model)
        self.frame_index = {name: i for i, name in reversed(list(enumerate(config.getFrameNames())))}
        model = self.model
        self.equalities = [
            (model.eq_obj1id[e], model.eq_obj2id[e], model.eq_data[e])
            for e in range(model.neq)
            if model.eq_type[e] == mujoco.mjtEq.mjEQ_JOINT and model.eq_active0[e] and not any(model.eq_data[e][2:5])
        ]

    def joint(self, j: int) -> slice:
        """The place of a joint in qpos."""
        start = self.model.jnt_qposadr[j]
        return slice(start, start + WIDTH.get(int(self.model.jnt_type[j]), 1))

    def drawState(self) -> None:
        """Draws a state that fulfils the equalities, and sets it in both."""
        model, q = self.model, self.data.qpos
        for j in range(model.njnt):
            place = self.joint(j)
            limited = model.jnt_limited[j] and place.stop - place.start == 1
            q[place] = self.random.uniform(*(model.jnt_range[j] if limited else (-2, 2)), place.stop - place.start)
            if place.stop - place.start > 1:
                q[place.stop - 4 : place.stop] /= np.linalg.norm(q[place.stop - 4 : place.stop])
        for _ in self.equalities:  # chains
            for first, second, c in self.equalities:
                a, b = model.jnt_qposadr[[first, second]]
                x = q[b] - model.qpos0[b] if second >= 0 else 0.0
                q[a] = model.qpos0[a] + c[0] + c[1] * x
        followers = {first for first, _, _ in self.equalities}
        own = [q[self.joint(j)] for j in range(model.njnt) if j not in followers]
        self.config.setJointState(np.concatenate(own) if own else [])

    def difference(self) -> float:
        """Sets a random state in both; the largest difference of a body's or a site's pose, in m or rad."""
        self.drawState()
        mujoco.mj_kinematics(self.model, self.data)
        poses = self.config.getFrameState()
        worst = 0.0
        for kind, positions, rotations in [
            (mujoco.mjtObj.mjOBJ_BODY, self.data.xpos, self.data.xmat),
            (mujoco.mjtObj.mjOBJ_SITE, self.data.site_xpos, self.data.site_xmat),
        ]:
            for i in range(len(positions)):
                name = mujoco.mj_id2name(self.model, kind, i)
                suffixed = f"{name}_site" if kind == mujoco.mjtObj.mjOBJ_SITE else None
                frame = self.frame_index.get(suffixed, self.frame_index.get(name))
                if frame is None:
                    continue
                rotation = np.empty(9)
                mujoco.mju_quat2Mat(rotation, poses[frame, 3:])
                worst = max(worst, np.abs(poses[frame, :3] - positions[i]).max(), np.abs(rotation - rotations[i]).max())
        return worst


def largestDifference(file: str, config: ry.Config, seed: int, samples: int) -> float:
    """The largest difference of the poses of bodies and sites at random states, in m or rad."""
    comparison = Comparison(file, config, seed)
    return max(comparison.difference() for _ in range(samples))


def collidingBodies(model: mujoco.MjModel) -> set[frozenset[str]]:
    """The pairs of bodies that MuJoCo's rules let collide: bits, welded bodies, parents, exclusions, listed pairs."""
    weld, excluded = model.body_weldid, set(model.exclude_signature.tolist())
    filters_parents = not model.opt.disableflags & int(mujoco.mjtDisableBit.mjDSBL_FILTERPARENT)

    def geoms(body: int) -> range:
        return range(model.body_geomadr[body], model.body_geomadr[body] + model.body_geomnum[body])

    def touch(a: int, b: int) -> bool:
        wa, wb = weld[a], weld[b]
        parents = weld[model.body_parentid[wa]], weld[model.body_parentid[wb]]
        related = filters_parents and wa and wb and (wa == parents[1] or wb == parents[0])
        if wa == wb or related or (a << 16) + b in excluded:
            return False
        types, affinities = model.geom_contype, model.geom_conaffinity
        return any(types[x] & affinities[y] or types[y] & affinities[x] for x in geoms(a) for y in geoms(b))

    bodies = itertools.combinations(range(model.nbody), 2)
    listed = [
        (model.geom_bodyid[model.pair_geom1[k]], model.geom_bodyid[model.pair_geom2[k]]) for k in range(model.npair)
    ]
    pairs = [pair for pair in bodies if touch(*pair)] + listed
    return {frozenset(model.body(int(body)).name for body in pair) for pair in pairs}


def assertSameNumbers(file: str, config: ry.Config) -> None:
    """The total mass, the limits of joints, and the pairs of bodies that collide are MuJoCo's."""
    model = mujoco.MjModel.from_xml_path(file)
    mass = float(model.body_mass.sum())
    assert abs(sum(frame.getMass() for frame in config) - mass) <= 1e-5 * max(1, mass)
    names, limits = set(config.getFrameNames()), config.getJointLimits()
    for j in range(model.njnt):
        name = model.joint(j).name
        if model.jnt_type[j] < int(mujoco.mjtJoint.mjJNT_SLIDE) or name not in names:
            continue
        given = model.jnt_range[j] if model.jnt_limited[j] else (-np.inf, np.inf)
        np.testing.assert_allclose(limits[:, config.getFrame(name).getJointQIndex()], given, atol=1e-6)
    bodies = {model.body(b).name for b in range(1, model.nbody)}

    def bodyOf(name: str) -> str:
        frame = config.getFrame(name)
        while frame is not None and frame.name not in bodies:
            frame = frame.getParent()
        return frame.name if frame is not None else "world"

    pairs = {frozenset(map(bodyOf, pair)) for pair in zip(*[iter(config.getCollidablePairs())] * 2, strict=True)}
    assert pairs == collidingBodies(model)
