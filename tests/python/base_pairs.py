"""Pairs that collide here, but not in the reference: it excludes one joint more than `contact: -k` says at a base
without a joint."""

import itertools

import kinegraph as ry


def jointed(frame: ry.Frame) -> bool:
    return frame.getJointType() != ry.JT.none


def isBase(frame: ry.Frame) -> bool:
    """Returns whether no joint is between a frame and its root."""
    return not jointed(frame) and (frame.getParent() is None or isBase(frame.getParent()))


def joints(frame: ry.Frame) -> int:
    parent = frame.getParent()
    return jointed(frame) + (joints(parent) if parent else 0)


def root(frame: ry.Frame) -> int:
    parent = frame.getParent()
    return root(parent) if parent else frame.ID


def pairsAtBases(C: ry.Config) -> list[tuple[str, str]]:
    colliding = [(frame, int(frame.asDict()["contact"])) for frame in C.getFrames() if frame.asDict().get("contact")]
    return [
        (a.name, b.name)
        for (a, flag), (b, _) in itertools.permutations(colliding, 2)
        if flag < 0 and isBase(b) and joints(a) == 1 - flag and root(a) == root(b)
    ]
