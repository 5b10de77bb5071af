"""Domain, LogicProblem, PlanSearch: what Python adds; the rest is tested in C++."""

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
