"""Describes a scene as a tree of its moving parts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from ._core import JT, Config, Frame

_NAMES_SHOWN = 4
_TARGETS = ("joint", "tendon", "site", "body")


def describeScene(config: Config) -> str:
    """Describes the parts of a scene as a tree: one line per root and joint, with the rigidly attached shapes.

    A joint's line has its type, its index in q, its value, `in [lower, upper]` (rad or m), the motor's velocity and
    effort limits if known (rad/s or m/s, Nm or N), and the names of shapes; those in `*` collide.
    """
    return "\n".join(_Overview(config).lines())


def describeActuators(config: Config) -> str:
    """Describes the actuators of MJCF files, one line each: type, target, and the gear, ranges and gains as written."""
    lines = []
    for frame in config.getFrames():
        for name, actuator in frame.asDict().get("actuators", {}).items():
            kind = actuator["type"]
            target = next((f" of {part} {actuator[part]}" for part in _TARGETS if part in actuator), "")
            numbers = [f"{key} {_shown(value)}" for key, value in actuator.items() if key not in ("type", *_TARGETS)]
            lines.append(f"  {name}: {kind}{target}" + (f" ({', '.join(numbers)})" if numbers else ""))
    return "\n".join([f"actuators ({len(lines)}):", *lines]) if lines else ""


def _shown(value: float | list[float]) -> str:
    return " ".join(f"{x:.4g}" for x in value) if isinstance(value, list) else f"{value:.4g}"


def _moves(frame: Frame) -> bool:
    return frame.getParent() is None or frame.getJointType() not in (JT.none, JT.rigid)


class _Overview:
    def __init__(self, config: Config) -> None:
        self.config = config
        self.members: dict[int, list[Frame]] = {}  # by the id of the part's first frame
        self.below: dict[int, list[Frame]] = {}
        part_of: dict[int, int] = {}

        def partOf(frame: Frame) -> int:
            if frame.ID not in part_of:
                part_of[frame.ID] = frame.ID if _moves(frame) else partOf(frame.getParent())
            return part_of[frame.ID]

        for frame in config.getFrames():
            self.members.setdefault(partOf(frame), []).append(frame)
            if _moves(frame) and frame.getParent():
                self.below.setdefault(partOf(frame.getParent()), []).append(frame)
        self.dofs: dict[str, list[int]] = {}  # indices in q, by the joint's name
        self.q, self.limits = config.getJointState(), config.getJointLimits()
        for i, name in enumerate(config.getJointNames()[: len(self.q)]):
            self.dofs.setdefault(name if name in self.dofs else name.rsplit(":", 1)[0], []).append(i)

    def lines(self) -> Iterator[str]:
        for frame in self.config.getFrames():
            if frame.getParent() is None:
                yield from self._branch(frame, "", "")

    def _branch(self, part: Frame, first: str, others: str) -> Iterator[str]:
        yield f"{first}{part.name or '(no name)'}{self._joint(part)}{self._shapes(part)}"
        below = self.below.get(part.ID, [])
        for child in below:
            last = child is below[-1]
            yield from self._branch(child, others + ("└── " if last else "├── "), others + ("    " if last else "│   "))

    def _joint(self, frame: Frame) -> str:
        if frame.getParent() is None:
            return ""
        kind = str(frame.getJointType()).rsplit(".")[-1]
        attributes = frame.asDict()
        if "mimic" in attributes:
            return f"  {kind}, follows {attributes['mimic']}"
        places = self.dofs.get(frame.name)
        if places is None:
            return f"  {kind}, not in q"
        where = f"q[{places[0]}]" if len(places) == 1 else f"q[{places[0]}:{places[-1] + 1}]"
        return f"  {kind}  {where} = {', '.join(self._dof(i) for i in places)}{self._motor(attributes)}"

    def _dof(self, i: int) -> str:
        lower, upper = self.limits[:, i]
        return f"{self.q[i]:.4g}" + (f" in [{lower:.4g}, {upper:.4g}]" if math.isfinite(upper - lower) else "")

    @staticmethod
    def _motor(attributes: Mapping[str, list[float]]) -> str:
        velocity, effort, *_ = [*attributes.get("ctrl_limits", []), 0, 0]
        return (f" at {velocity:.4g}/s" if velocity > 0 else "") + (f" with {effort:.4g}" if effort > 0 else "")

    def _shapes(self, part: Frame) -> str:
        names = []
        for frame in self.members[part.ID]:
            attributes = frame.asDict()
            if attributes.get("shape", "marker") != "marker":
                names.append(f"*{frame.name}*" if attributes.get("contact") else frame.name)
        if len(names) > _NAMES_SHOWN:
            names[_NAMES_SHOWN:] = [f"and {len(names) - _NAMES_SHOWN} more"]
        return f"  ({', '.join(names)})" if names else ""
