"""What LGP_Tool asks of a domain: plans in logic, and what their actions ask of bodies."""

from __future__ import annotations

import os
from typing import Any

from ._core import FS, KOMO, OT, Config, Domain, LogicProblem, PlanSearch, parseText, sceneFacts
from .errors import ArgumentError, FileError, ParseError
from .lgp_actions import LGP_ACTIONS
from .manipulation import KOMO_ManipulationHelper

Action = list[str]

STEPS = 30  # slices per action


class LGP_TAMP_Abstraction:
    """What LGP_Tool asks of a domain. Subclass it, or default_LGP_TAMP_Abstraction, for actions of your own."""

    def __init__(self, C: Config) -> None:
        """Makes an abstraction of a scene, without actions.

        Args:
            C: The scene.
        """
        self.C = C
        self.explicitCollisions: list[str] = []

    def getNewActionSequence(self) -> list[Action] | None:
        """The next plan in logic.

        Returns:
            A list of actions, each a list of words; None if there is no further one.
        """
        return None

    def forbidBeginning(self, plan: list[Action]) -> None:
        """No further plan shall begin like that: it was found infeasible. An abstraction may ignore it.

        Args:
            plan: The first actions.
        """

    def _begin(self, count: int) -> None:
        """A problem of that many actions is set up."""

    def setup_sequence(self, C: Config, K: int) -> KOMO:
        """The waypoint problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with a slice per action.
        """
        self._begin(K)
        komo = KOMO(C, K, 1, 1, False)
        komo.addControlObjective([], 1, 1e-2)
        komo.addQuaternionNorms()
        return komo

    def setup_motion(self, C: Config, K: int) -> KOMO:
        """The motion problem of a plan, without what the actions ask.

        Args:
            C: The scene.
            K: The number of actions.
        Returns:
            A KOMO with 30 slices per action, free of collisions, that ends at rest.
        """
        self._begin(K)
        helper = KOMO_ManipulationHelper()
        helper.setup_motion(C, K, STEPS)
        return helper.komo

    def add_action_constraints(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the waypoints.

        Args:
            komo: The problem.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action.
        Raises:
            ArgumentError: The action is not known.
        """
        raise ArgumentError(f"no constraints are known for action {action}; override add_action_constraints")

    def add_action_constraints_motion(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the motion; by default what it asks of the waypoints.

        Args:
            komo: The problem.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action.
        Raises:
            ArgumentError: The action is not known.
        """
        self.add_action_constraints(komo, time, prev_action, action)

    def add_all(self, komo: KOMO, plan: list[Action], motion: bool) -> None:
        """Adds what the actions of a plan ask, then that the explicit pairs do not collide.

        Args:
            komo: The problem.
            plan: The actions.
            motion: Of the motion; else of the waypoints.
        Raises:
            ArgumentError: An action is not known.
        """
        add = self.add_action_constraints_motion if motion else self.add_action_constraints
        for i, action in enumerate(plan):
            add(komo, float(i + 1), plan[i - 1] if i else [], action)
        for i in range(0, len(self.explicitCollisions), 2):
            komo.addObjective([], FS.distance, self.explicitCollisions[i : i + 2], OT.ineq, [1e1])


class default_LGP_TAMP_Abstraction(LGP_TAMP_Abstraction):
    """Actions from a .lgp file and the .fol file that it names: pick_touch, pick_box, handover, place_straightOn,
    place_box, poseEq, gripper_push, end_push; pick and place, as files of earlier years call the first and the fourth. Actions
    of other names need a subclass."""

    def __init__(self, C: Config, lgp_file: str) -> None:
        """Reads the files, and what the scene says in logic.

        Args:
            C: The scene.
            lgp_file: Name of the .lgp file: `fol: <file>`, `terminal: "(on tray cup)"`, `coll: [a b]`.
        Raises:
            FileError: A file cannot be read.
            ParseError: A file is wrong, or the goal has an unknown word.
        """
        super().__init__(C)
        try:
            with open(lgp_file, encoding="utf-8") as file:
                text = file.read()
        except OSError as error:
            raise FileError(f"default_LGP_TAMP_Abstraction: cannot read '{lgp_file}': {error.strerror}") from None
        entries = parseText(text, os.fspath(lgp_file))
        for key in ("fol", "terminal"):
            if not isinstance(entries.get(key), str):
                raise ParseError(
                    f'{lgp_file}:1:1: there is no `{key}:`; expected fol: <file> and terminal: "(on tray cup)"'
                )
        folder = os.path.dirname(os.path.abspath(lgp_file))
        self.domain = Domain.fromFol(os.path.join(folder, entries["fol"].strip("<>")))
        self.explicitCollisions = _pairs(C, entries.get("coll", []), lgp_file)
        self.search = PlanSearch(LogicProblem(self.domain, " ".join(sceneFacts(C)), entries["terminal"]))
        if self.search.unreachable:
            odd = "; ".join(self.search.oddities)
            raise ParseError(f"{lgp_file}: the goal cannot be reached: {odd}")

    def getNewActionSequence(self) -> list[Action] | None:
        """The next plan in logic, the shortest first.

        Returns:
            A list of actions, each a list of words; None if there is no further one.
        """
        return self.search.next()

    def forbidBeginning(self, plan: list[Action]) -> None:
        """No further plan begins like that.

        Args:
            plan: The first actions.
        """
        self.search.forbidBeginning(plan)

    def _begin(self, count: int) -> None:
        self._held: dict[str, str] = {}
        self._count = count

    def add_action_constraints(self, komo: KOMO, time: float, prev_action: Action, action: Action) -> None:
        """Adds what an action asks of the waypoints.

        Args:
            komo: The problem, of setup_sequence.
            time: When the action is done, in phases.
            prev_action: The action before it, [] if there is none.
            action: The action: its name, and its arguments as in the .fol file.
        Raises:
            ArgumentError: The action is not known.
        """
        helper = KOMO_ManipulationHelper()
        helper.komo = komo
        rule = LGP_ACTIONS.get(action[0])
        if rule is None:
            known = ", ".join(LGP_ACTIONS)
            raise ArgumentError(f"unknown action '{action[0]}'; known are {known}; others need a subclass")
        rule(self, helper, time, action)

    def switch(self, m: KOMO_ManipulationHelper, time: float, frame: str, obj: str) -> None:
        """From a time on an object sits at a frame; it does not jump there.

        Args:
            m: A helper on the problem.
            time: In phases.
            frame: Name of the frame.
            obj: Name of the object.
        Raises:
            FrameNotFound: A name that is not in the scene.
        """
        held = self._held.get(obj)
        m.komo.addRigidSwitch(time, [frame, obj], False)
        frames, feature = ([obj, held], FS.poseRel) if held else ([obj], FS.pose)
        m.komo.addObjective([time], feature, frames, OT.eq, [1e1], [], 1)
        steps = self.steps(m.komo)
        if steps > 1 and time < self._count:  # accelerations tell of two velocities
            after = time + 1 / steps
            m.komo.addObjective([after], FS.linangVel, [obj], OT.eq, [1e0], [], 2)
        self._held[obj] = frame

    def steps(self, komo: KOMO) -> int:
        """Slices per action.

        Args:
            komo: The problem that was set up last.
        Returns:
            1 for waypoints.
        """
        return int(komo.getT()) // self._count

    def is_last(self, time: float) -> bool:
        """Whether the plan ends at a time.

        Args:
            time: In phases.
        Returns:
            True at the end of the problem that was set up last.
        """
        return round(time) >= self._count


def _pairs(C: Config, names: Any, where: str) -> list[str]:
    known = C.getFrameNames()
    for name in names:
        if name not in known:
            C.getFrame(name)  # raises, with names that are near
    if len(names) % 2:
        raise ParseError(f"{where}: coll has {len(names)} names; expected pairs")
    return list(names)


default_TAMP_Provider = default_LGP_TAMP_Abstraction  # as scripts of earlier years call it


class default_Logic2KOMO_Translator:
    """Of older scripts: what an action asks is said by default_LGP_TAMP_Abstraction."""
