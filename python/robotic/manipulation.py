"""Manipulation problems in a few calls, with feasibility by the reference's rule."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import kinegraph

from .path_finder import RRT_PathFinder
from .results import NLP_Solver, SolverReturn


class KOMO_ManipulationHelper(kinegraph.KOMO_ManipulationHelper):
    """Like kinegraph.KOMO_ManipulationHelper, but `ret.feasible` follows the reference's rule.

    Methods of its `komo` (addObjective, getPath ...) can be called on the helper, too, as in the reference's latest
    scripts. With the scene given to the constructor, as until 0.1.9, setups and play do not take it.
    """

    _solver = NLP_Solver
    _finder = RRT_PathFinder

    def __init__(self, *scene_and_info: Any, info: str = "", helpers: Any = ()) -> None:
        """Makes a helper whose `komo` is empty; a setup replaces it, or scripts set it up.

        Args:
            scene_and_info: The name of the problem in the output of solve; before it the scene, and behind it frames
                that need no preparation, as until 0.1.9.
            info: The name by keyword.
            helpers: Not used.
        """
        given = list(scene_and_info)
        scene = given.pop(0) if given and isinstance(given[0], kinegraph.Config) else None
        super().__init__(given[0] if given else info)
        self._scene = scene
        self.komo = kinegraph.KOMO()

    _begin = __init__

    def place_box(
        self,
        time: float,
        obj: Any,
        table: Any,
        palm: Any,
        place_direction: str = "z",
        margin: float = 0.02,
        on_table: bool = True,
    ) -> None:
        """Places a box, as kinegraph.KOMO_ManipulationHelper.place_box.

        Args:
            time, obj, table, palm, place_direction, margin: As in kinegraph.KOMO_ManipulationHelper.place_box.
            on_table: As until 0.1.9; False is not supported.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: on_table is False, or another argument is invalid.
        """
        if not on_table:
            raise kinegraph.ArgumentError(
                "place_box: on_table is False; expected True; to place a box elsewhere, add objectives to `komo`"
            )
        super().place_box(time, obj, table, palm, place_direction, margin)

    def no_collision(
        self, time_interval: Any, *frames_and_margin: Any, pairs: Any = None, margin: float | None = None
    ) -> None:
        """Keeps pairs of frames apart, like no_collisions.

        Args:
            time_interval: Start and end, in phases.
            frames_and_margin: A list of names, two per pair, or two names, as in the first versions; behind them,
                optionally, the margin.
            pairs: The list of names by keyword.
            margin: Least distance, m; None: 0.001.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: The names are not in pairs, or other arguments are given.
        """
        given = list(frames_and_margin if pairs is None else (pairs, *frames_and_margin))
        if len(given) > 1 and isinstance(given[0], str) and isinstance(given[1], str):
            given[:2] = [given[:2]]
        if len(given) == 2 and margin is None:
            margin = given.pop()
        if len(given) != 1 or isinstance(given[0], str):
            raise kinegraph.ArgumentError(
                "no_collision: expected times, then a list of names in pairs or two names, and optionally one margin"
            )
        self.no_collisions(time_interval, given[0], 0.001 if margin is None else margin)

    keep_distance = no_collision

    def keep_distances(self, time_interval: Any, objs: list[str], margin: float = 0.001) -> None:
        """Keeps each of some frames apart from each other one.

        Args:
            time_interval: Start and end, in phases.
            objs: Names of frames.
            margin: Least distance, m.
        Raises:
            FrameNotFound: There is no such frame.
            ArgumentError: There are fewer than two names.
        """
        if isinstance(objs, str) or len(objs) < 2:
            raise kinegraph.ArgumentError(f"keep_distances: objs is {objs!r}; expected a list of at least two names")
        pairs = [name for pair in itertools.combinations(objs, 2) for name in pair]
        self.no_collisions(time_interval, pairs, margin)

    if not TYPE_CHECKING:  # otherwise type checkers accept any name

        def __getattr__(self, name: str) -> Any:
            if not name.startswith("_") and self.komo is not None and hasattr(self.komo, name):
                return getattr(self.komo, name)
            hint = "" if self.komo is not None else "; there is no problem yet; call one of the setups first"
            raise AttributeError(f"KOMO_ManipulationHelper has no '{name}'{hint}")


class LGP_Tool(kinegraph.LGP_Tool):
    """Like kinegraph.LGP_Tool, but feasibility of waypoints follows the reference's rule."""

    def __init__(
        self, C: kinegraph.Config, tamp: kinegraph.LGP_TAMP_Abstraction, translator: object = None, *, threads: int = 1
    ) -> None:
        """Creates a tool without starting a search.

        Args:
            C: The scene.
            tamp: Provides plans, and the requirements of their actions.
            translator: Not used; accepted for older scripts, since `tamp` does its work.
            threads: Number of threads that solve in parallel.
        Raises:
            ArgumentError: threads is less than one.
        """
        super().__init__(C, tamp, translator, threads=threads, results=SolverReturn)


ManipulationModelling = KOMO_ManipulationHelper  # its name in older scripts


def _withScene(call: Callable[..., Any]) -> Callable[..., Any]:
    """Lets a method that takes a scene first be called without it, if the constructor got one."""

    @functools.wraps(call)
    def called(self: KOMO_ManipulationHelper, *args: Any, **kwargs: Any) -> Any:
        is_given = "C" in kwargs or (args and isinstance(args[0], kinegraph.Config))
        if self._scene is None or is_given:
            return call(self, *args, **kwargs)
        return call(self, self._scene, *args, **kwargs)

    if hasattr(call, "__nb_signature__"):
        called.__nb_signature__ = call.__nb_signature__  # type: ignore[attr-defined]
    return called


for _name in (
    "setup_inverse_kinematics",
    "setup_sequence",
    "setup_motion",
    "setup_pick_and_place_waypoints",
    "setup_point_to_point_motion",
    "play",
):
    setattr(KOMO_ManipulationHelper, _name, _withScene(getattr(KOMO_ManipulationHelper, _name)))
