"""What the actions of default_LGP_TAMP_Abstraction ask of a motion problem."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from ._core import FS, JT, OT
from .errors import ArgumentError
from .manipulation import KOMO_ManipulationHelper

if TYPE_CHECKING:
    from .lgp_abstraction import Action, default_LGP_TAMP_Abstraction

_MARGIN = 0.02  # m: how far inside of a box a gripper is


def _pick_frame(
    tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, hand: str, obj: str
) -> None:
    name = f"pickPose_{hand}_{obj}_{round(time)}"
    m.add_stable_frame(JT.free, hand, name)
    tamp.switch(m, time, name, obj)


def _pick_touch(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, _, hand = action
    _pick_frame(tamp, m, time, hand, obj)
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.eq, [1e2])


def _pick_box(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, _, hand = action
    _pick_frame(tamp, m, time, hand, obj)
    frames, inside = [hand, obj], 0.5 * np.array(tamp.C.getFrame(obj).getSize()[:3]) - _MARGIN
    rows = np.array([[1e1, 0, 0], [0, 0, 1e1]])
    m.komo.addObjective([time], FS.positionRel, frames, OT.eq, [0, 1e1, 0])
    m.komo.addObjective([time], FS.positionRel, frames, OT.ineq, rows, inside)
    m.komo.addObjective([time], FS.positionRel, frames, OT.ineq, -rows, -inside)
    for product in (FS.scalarProductXX, FS.scalarProductXZ):
        m.komo.addObjective([time - 0.2, time], product, frames, OT.eq, [1e0])
    m.komo.addObjective([time - 0.3, time], FS.distance, [_palm(hand), obj], OT.ineq, [1e1], [-0.001])
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.ineq, [-1e1])


def _palm(hand: str) -> str:
    return hand.removesuffix("gripper") + "palm"


def _place_straight_on(
    tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action
) -> None:
    _, obj, _, to = action
    name = f"placePose_{to}_{obj}_{round(time)}"
    m.add_place_frame(to, obj, name)
    tamp.switch(m, time, name, obj)


def _place_box(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, hand, to = action
    if not tamp.is_last(time):
        name = f"placePose_{to}_{obj}_{round(time)}"
        m.add_stable_frame(JT.free, to, name)
        tamp.switch(m, time, name, obj)
    m.place_box(time, obj, to, _palm(hand), "x")
    m.komo.addObjective([time], FS.distance, [obj, hand], OT.ineq, [-1e1])


def _pose_eq(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    m.komo.addObjective([time], FS.poseDiff, action[1:3], OT.eq, [1e1])


def _push(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    _, obj, floor, hand = action
    if not tamp.is_last(time):
        name = f"pushPose_{hand}_{obj}_{round(time)}"
        m.add_stable_frame(JT.free, hand, name, obj)
        tamp.switch(m, time, name, obj)
        if tamp.steps(m.komo) > 1:
            m.komo.addObjective([time], FS.poseDiff, [name, obj], OT.eq, [1e0])
    else:
        return  # it begins, and nothing says where to
    m.straight_push([time, time + 1], obj, hand, floor, 1.0, f"_straight_pushStart_{hand}_{obj}_{round(time)}")


def _end_push(tamp: default_LGP_TAMP_Abstraction, m: KOMO_ManipulationHelper, time: float, action: Action) -> None:
    if not tamp.is_last(time):
        raise ArgumentError("end_push is the last action of a plan; another one follows")
    _, _, obj, _, to = action
    m.place_box(time, obj, to, "", "z")


LGP_ACTIONS: dict[str, Callable[[default_LGP_TAMP_Abstraction, KOMO_ManipulationHelper, float, Action], None]] = {
    "pick_touch": _pick_touch,
    "pick_box": _pick_box,
    "handover": _pick_touch,
    "place_straightOn": _place_straight_on,
    "place_box": _place_box,
    "poseEq": _pose_eq,
    "gripper_push": _push,
    "end_push": _end_push,
    "pick": _pick_touch,  # as files of earlier years call them
    "place": _place_straight_on,
}
