"""What planTask knows in logic: its own actions, and what a scene says of who can do what."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ._core import JT, ST, Config, Domain

PICKS = ("pick", "lift")  # a hand takes an object from where it stands
PLACES = ("place", "lay")  # a hand puts an object down
FACES = ("zNeg", "x", "xNeg", "y", "yNeg")  # axes that can point up beside z, which `place` does

DEFAULT_FOL = """
is_gripper is_object is_place is_face is_pose is_carrier is_pushable on busy up fresh posed pushes z
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)!
    (pushes ANY Obj)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule lift { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (is_carrier Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (on Obj To)! (pushes Obj ANY)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (fresh Obj)! (up ANY Obj)! (up z Obj) } }
DecisionRule lay { Obj, Hand, To, Face,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) (is_face Face) (on Obj To)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (fresh Obj)! (up ANY Obj)! (up Face Obj) } }
DecisionRule handover { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_gripper To) (busy To)! }
  { (busy Hand)! (on Hand Obj)! (on To Obj) (busy To) } }
DecisionRule push_start { Obj, From, Hand,
  { (is_gripper Hand) (is_pushable Obj) (on From Obj) (is_place From) (busy Hand)! (on Obj ANY)! (pushes ANY Obj)! }
  { (busy Hand) (pushes Hand Obj) } }
DecisionRule push_end { Obj, Hand, To,
  { (is_gripper Hand) (pushes Hand Obj) (is_place To) (on Obj To)! }
  { (pushes Hand Obj)! (busy Hand)! (on ANY Obj)! (on To Obj) (fresh Obj)! } }
DecisionRule pose { Obj, Hand, Goal,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_pose Goal) }
  { (posed Obj Goal) } }
"""


def defaultDomain() -> Domain:
    """The domain of planTask where none is given: pick (Obj From Hand) for what nothing
    stands on, lift (Obj From Hand) for what is called is_carrier, with all that stands on it, place (Obj Hand To), handover
    (Obj Hand To), lay (Obj Hand To Face) where the goal says which face is up, pose (Obj Hand Goal) for frames that are
    called is_pose, push_start (Obj From Hand) and push_end (Obj Hand To) for what is called is_pushable.

    Returns:
        A domain, to which actions can be added.
    """
    return Domain.fromFolText(DEFAULT_FOL, "default domain")


def sceneWords(C: Config, facts: list[str], goal: str = "") -> list[str]:
    """What holds at the start: the words of the scene and, where they name no gripper, no object or no place, what shapes
    and names suggest.

    Args:
        C: The scene.
        facts: Of sceneFacts.
        goal: Literals; where they say which face of something is up, there are faces.
    Returns:
        Literals.
    """
    said = list(facts)
    have = {fact[1:].split()[0] for fact in facts}
    frames = C.getFrames()
    boxes = (ST.box, ST.ssBox)
    if "is_gripper" not in have:
        said += [f"(is_gripper {f.name})" for f in frames if f.name.endswith("gripper")]
    grippers, objects = set(wordsOf(said, "is_gripper")), set(wordsOf(said, "is_object"))
    if "is_place" not in have:
        flat = [f for f in frames if f.getShapeType() in boxes and f.name not in grippers and _is_place(f, objects)]
        said += [f"(is_place {f.name})" for f in flat]
    on = {fact[1:-1].split()[2] for fact in said if fact.startswith("(on ")}
    for name in sorted(objects - on):  # it hangs below a frame of which nothing was said
        parent = C.getFrame(name).getParent()
        if parent is not None and f"(is_place {parent.name})" in said:
            said.append(f"(on {parent.name} {name})")
        elif hand := holderOf(C, name, sorted(grippers)):
            said.append(f"(on {hand} {name})")
    said += [f"(busy {hand})" for hand in sorted(grippers) if any(f.startswith(f"(on {hand} ") for f in said)]
    said += [f"(up {upOf(C, name)} {name})" for name in sorted(objects) if upOf(C, name)]
    said += [f"(fresh {name})" for name in wordsOf(said, "is_carrier") + wordsOf(said, "is_pushable")]
    if "(up " in goal:
        said += [f"(is_face {face})" for face in FACES]
    return list(dict.fromkeys(said))


def carriedBy(C: Config, hands: list[str], objects: list[str]) -> list[str]:
    """Objects that stand on something that a hand holds."""
    return [obj for obj in objects if holderOf(C, obj, hands) and holderOf(C, obj, objects)]


def upOf(C: Config, name: str) -> str:
    """The axis of a frame that points up, to 25 degrees; '' if none does."""
    heights = C.getFrame(name).getRotationMatrix()[2]
    axis = int(abs(heights).argmax())
    return "xyz"[axis] + ("Neg" if heights[axis] < 0 else "") if abs(heights[axis]) > 0.9 else ""


def planText(plan: Sequence[Sequence[str]]) -> str:
    """Actions as they are written in logic: "(pick cup table hand) (place cup hand tray)"."""
    return " ".join(f"({' '.join(action)})" for action in plan)


def wordsOf(facts: list[str], predicate: str) -> list[str]:
    """What a predicate of one argument holds of."""
    return [fact[1:-1].split()[1] for fact in facts if fact.startswith(f"({predicate} ")]


def holderOf(C: Config, obj: str, hands: list[str]) -> str:
    """The hand that an object hangs below without a joint of q in between; '' if there is none."""
    moving = {name.split(":")[0] for name in C.getJointNames()}
    frame: Any = C.getFrame(obj)
    while frame is not None and frame.name not in moving:
        frame = frame.getParent()
        if frame is not None and frame.name in hands:
            return str(frame.name)
    return ""


def _is_place(frame: Any, objects: set[str]) -> bool:
    """Large enough to carry something, level, and not a part of what moves."""
    if frame.name in objects:
        return True
    level = abs(frame.getRotationMatrix()[2, 2]) > 0.999
    up: Any = frame
    while up is not None:
        if up.getJointType() not in (JT.none, JT.rigid):
            return False
        up = up.getParent()
    return level and min(frame.getSize()[:2]) >= 0.05
