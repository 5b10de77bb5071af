"""Domain, LogicProblem, PlanSearch: what Python adds; the rest is tested in C++."""

import signal
import types
from collections import deque

import pytest

import kinegraph as ry

FOL = """
is_gripper is_object is_place on busy
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To,
  { (is_gripper Hand) (is_object Obj) (on Hand Obj) (is_place To) }
  { (busy Hand)! (on Hand Obj)! (on To Obj) } }
"""
START = "(is_gripper hand) (is_place table) (is_place tray) (is_object cup) (on table cup)"


def search(goal: str) -> ry.PlanSearch:
    return ry.PlanSearch(ry.LogicProblem(ry.Domain.fromFolText(FOL), START, goal))


def test_a_plan_is_a_list_of_words_and_its_states_say_what_holds() -> None:
    plans = search("(on tray cup)")
    plan = plans.next()
    assert plan == [["pick", "cup", "table", "hand"], ["place", "cup", "hand", "tray"]]
    states = plans.states(plan)
    assert "(on table cup)" in states[0] and "(on hand cup)" in states[1] and "(on tray cup)" in states[2]
    assert plans.status == ry.PlanSearchStatus.found and plans.expansions > 0
    assert plans.next() is None and plans.status == ry.PlanSearchStatus.exhausted


def test_an_action_is_added_from_python_and_written_as_pddl(tmp_path) -> None:
    domain = ry.Domain.fromFolText(FOL)
    domain.addAction(
        "scoop", ["Obj", "From"], "(is_object Obj) (on From Obj) (is_place From)", "(on From Obj)! (on tray Obj)"
    )
    assert domain.actions == ["pick", "place", "scoop"]
    plans = ry.PlanSearch(ry.LogicProblem(domain, START, "(on tray cup)"))
    assert plans.next() == [["scoop", "cup", "table"]]
    file, problem = tmp_path / "d.pddl", tmp_path / "p.pddl"
    file.write_text(domain.toPddl())
    problem.write_text(ry.LogicProblem(domain, START, "(on tray cup)").toPddl())
    again = ry.Domain.fromPddl(file)
    assert ry.PlanSearch(ry.LogicProblem.fromPddl(again, problem)).next() == [["scoop", "cup", "table"]]
    with pytest.raises(ry.ParseError, match="has the variable 'To'"):
        domain.addAction("wrong", ["To"], "(is_object cup)", "(on To cup)")


def test_what_is_forbidden_is_named_by_words() -> None:
    plans = search("(on tray cup)")
    with pytest.raises(
        ry.ArgumentError, match=r"no action \(pick cup tabel hand\); similar names: pick cup table hand"
    ):
        plans.forbid(["pick", "cup", "tabel", "hand"])
    with pytest.raises(ry.ArgumentError, match="never changes, or can never hold"):
        plans.forbid(["pick", "cup", "table", "hand"], "(is_place table)")
    plans.forbid(["pick", "cup", "table", "hand"])
    assert plans.next() is None and plans.status == ry.PlanSearchStatus.exhausted


def test_errors_have_places_and_near_names(tmp_path) -> None:
    file = tmp_path / "d.fol"
    file.write_text("on\nDecisionRule a { X { (onn X) } { (on X) } }")
    with pytest.raises(ry.ParseError, match=r"d.fol:2:22: unknown predicate 'onn'.*similar names: on"):
        ry.Domain.fromFol(file)
    with pytest.raises(ry.ParseError, match="unknown symbol 'trey' in the goal.*similar names: tray"):
        search("(on trey cup)")
    with pytest.raises(ry.FileError, match="nowhere.fol"):
        ry.Domain.fromFol("nowhere.fol")


def test_the_goal_that_nothing_makes_true_is_told_before_the_search() -> None:
    plans = search("(on cup tray)")
    assert plans.unreachable == ["(on cup tray)"]
    assert plans.diagnostics[-1] == "nothing can make (on cup tray) of the goal true"


def test_a_scene_says_what_is_on_what() -> None:
    C = ry.Config()
    C.addFrame("table").setShape(ry.ST.ssBox, [1, 1, 0.1, 0.01]).setAttributes({"logical": {"is_place": True}})
    C.addFrame("cup", "table").setJoint(ry.JT.rigid).setShape(ry.ST.sphere, [0.05])
    assert ry.sceneFacts(C) == ["(is_place table)", "(is_object cup)", "(is_sphere cup)", "(on table cup)"]


def test_a_fact_that_two_preconditions_deny_counts_once() -> None:
    fol = """is_a is_b holds done
    DecisionRule go { X, Y, { (is_a X) (is_b Y) (holds ANY Y)! (holds X ANY)! } { (holds X Y) } }
    DecisionRule end { X, Y, { (holds X Y) } { (holds X Y)! (done Y) } }"""
    goal = "(done p) (done q)"
    problem = ry.LogicProblem(ry.Domain.fromFolText(fol), "(is_a a) (is_b p) (is_b q)", goal)
    assert [action[0] for action in ry.PlanSearch(problem).next()] == ["go", "end"] * 2


SLIDE = """(define (domain slide) (:predicates (at ?tile ?cell) (blank ?cell) (near ?one ?other))
  (:action move :parameters (?tile ?from ?to)
   :precondition (and (at ?tile ?from) (blank ?to) (near ?from ?to))
   :effect (and (not (at ?tile ?from)) (not (blank ?to)) (at ?tile ?to) (blank ?from))))"""


def near(cell: int) -> list[int]:
    """The neighbors of a cell of a grid of 3 x 3."""
    return [other for other in range(9) if (abs(other % 3 - cell % 3), abs(other // 3 - cell // 3)) in ((0, 1), (1, 0))]


def moves(tiles: str) -> int:
    """Fewest moves to " 12345678", by breadth-first search."""
    seen, queue = {tiles}, deque([(tiles, 0)])
    while queue:
        state, count = queue.popleft()
        if state == " 12345678":
            return count
        blank = state.index(" ")
        for cell in near(blank):
            now = list(state)
            now[blank], now[cell] = now[cell], " "
            if (text := "".join(now)) not in seen:
                seen.add(text)
                queue.append((text, count + 1))
    raise AssertionError


def sliding(tiles: str, tmp_path, most: int = 100000) -> ry.PlanSearch:
    facts = [f"(at t{tile} c{cell})" if tile != " " else f"(blank c{cell})" for cell, tile in enumerate(tiles)]
    facts += [f"(near c{one} c{other})" for one in range(9) for other in near(one)]
    goal = " ".join(f"(at t{tile} c{tile})" for tile in range(1, 9))
    objects = " ".join([*(f"t{i}" for i in range(1, 9)), *(f"c{i}" for i in range(9))])
    file = tmp_path / "p.pddl"
    file.write_text(
        f"(define (problem p) (:domain slide) (:objects {objects}) (:init {' '.join(facts)}) (:goal (and {goal})))"
    )
    return ry.PlanSearch(ry.LogicProblem.fromPddl(ry.Domain.fromPddlText(SLIDE), file), most)


def test_a_search_through_many_states_ends_with_a_shortest_plan(tmp_path) -> None:
    for tiles in ("312 45678", "1423 5678", "341625 78", "3 1465782"):
        plans = sliding(tiles, tmp_path)
        plan = plans.next()
        assert plan is not None and len(plan) == moves(tiles), tiles
    assert plans.expansions > 64  # signals are asked for meanwhile


def test_a_limit_that_suffices_for_a_shortest_plan_gives_it(tmp_path) -> None:
    plans = sliding("3 1465782", tmp_path)
    length = len(plans.next() or ())
    enough = next(most for most in range(1, 200) if sliding("3 1465782", tmp_path, most).next() is not None)
    assert enough < plans.expansions  # the rest orders plans of one cost
    plan = sliding("3 1465782", tmp_path, enough).next()
    assert plan is not None and len(plan) == length == moves("3 1465782")


def test_what_a_signal_handler_raises_ends_a_search_and_the_next_call_goes_on(tmp_path) -> None:
    class Enough(Exception):
        pass

    def enough(number: int, frame: types.FrameType | None) -> None:
        raise Enough

    tiles = "8672543 1"
    plans = sliding(tiles, tmp_path)
    before = signal.signal(signal.SIGALRM, enough)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(Enough):
            plans.next()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    plan = plans.next()
    assert plan is not None and len(plan) == moves(tiles)
