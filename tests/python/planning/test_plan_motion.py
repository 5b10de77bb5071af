"""planMotion: collision-free, time-parameterized motions to a goal."""

from __future__ import annotations

import itertools
from pathlib import Path

import numpy as np
import pytest

import kinegraph as ry
from kinegraph import call_errors

STUB = Path(ry.__file__).parent / "_core.pyi"

DOOR = """
world: {{}}
left(world): {{shape: box, size: [0.1, 3, 1], Q: [0, {far}, 0], contact: 1}}
right(world): {{shape: box, size: [0.1, 3, 1], Q: [0, -{far}, 0], contact: 1}}
base(world): {{joint: transXYPhi, limits: [-2, -2, -4, 2, 2, 4]}}
body(base): {{shape: ssBox, size: [0.5, 0.3, 0.2, 0.02], contact: 1}}
"""
START, GOAL = [-1.0, 1.2, 1.57], [1.0, 1.0, 1.57]


def room(door: float = 0.5) -> ry.Config:
    """A box on wheels, 0.5 m by 0.3 m, and two walls with a door of this width."""
    C = ry.Config()
    C.addText(DOOR.format(far=1.5 + door / 2))
    C.setJointState(START)
    return C


def leastDistance(C: ry.Config, Q: np.ndarray, step: float = 2e-3) -> float:
    """The least distance of all moving pairs at configurations every `step`, independently of edge checks."""
    rows = [
        a + np.linspace(0, 1, max(2, int(np.linalg.norm(b - a) / step)))[:, None] * (b - a)
        for a, b in itertools.pairwise(Q)
    ]
    return float(C.getDistances(np.concatenate(rows)).min())


def ends(C: ry.Config) -> tuple[np.ndarray, np.ndarray]:
    q = C.getJointState()
    start, goal = q.copy(), q.copy()
    start[0] -= 0.6
    goal[0] += 0.6
    return start, goal


def test_a_box_on_wheels_goes_through_a_door() -> None:
    C = room()
    plan = ry.planMotion(C, GOAL)
    assert plan.feasible and plan and plan.status == ry.PlanStatus.solved and plan.message == ""
    assert np.allclose(plan.path[0], START) and np.allclose(plan.path[-1], GOAL)
    assert leastDistance(C, plan.path) >= 0
    assert np.allclose(C.getJointState(), START)
    assert [stage["name"] for stage in plan.stages] == [
        "setup",
        "endpoints",
        "search",
        "shortcut",
        "rope_shortcut",
        "verify",
        "timing",
    ]
    assert plan.length == pytest.approx(np.linalg.norm(np.diff(plan.path, axis=0), axis=1).sum())
    assert "trees of" in plan.explain() and plan.clearance() >= 0


def parametersOf(call: object) -> list:
    signature, _, defaults = call.__nb_signature__[0]
    return [each for each in call_errors.parameters(signature, defaults or ()) if each.keyword_only]


def test_every_option_is_a_keyword_with_its_default() -> None:
    options = {each.name: each for each in parametersOf(ry.planMotion)}
    assert {"margin", "optimize", "velocity", "constraints", "obstacle_trajectories", "seed"} <= set(options)
    assert options["margin"].type == "float" and options["margin"].default == "0.0"
    defaults = {name: eval(each.default, {"inf": np.inf}) for name, each in options.items()}
    plan, same = ry.planMotion(room(), GOAL), ry.planMotion(room(), GOAL, **defaults)
    assert np.array_equal(plan.path, same.path) and plan.duration == same.duration
    assert [each.default for each in parametersOf(ry.MotionPlan.replan)] == ["None"] * (len(options) - 5)
    assert not {"start_velocity", "end_velocity", "obstacle_trajectories"} & {
        each.name for each in parametersOf(ry.planMotions)
    }
    unchanged = plan.replan(room(), 0.0, **dict.fromkeys(each.name for each in parametersOf(ry.MotionPlan.replan)))
    assert np.array_equal(unchanged.path[-1], plan.path[-1])


@pytest.mark.skipif(not STUB.exists(), reason="the stub is generated when the wheel is built")
def test_editors_see_the_options_in_the_stub() -> None:
    stub = STUB.read_text()
    for call in ("planMotion", "planMotions", "replan"):
        signature = stub[stub.index(f"def {call}(") :].split("\n", 1)[0]
        assert "*, margin: float" in signature and "**" not in signature


def test_a_verbose_call_logs_a_line(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level("INFO", "kinegraph")
    C = room()
    quiet, plan = ry.planMotion(C, GOAL), ry.planMotion(C, GOAL, verbose=1)
    assert len(caplog.messages) == 1 and caplog.messages[0].startswith("planMotion: solved: ")
    assert np.array_equal(quiet.path, plan.path)
    with pytest.raises(ry.ArgumentError, match="verbose is 'yes'; expected a number"):
        ry.planMotion(C, GOAL, verbose="yes")


def test_a_plan_is_a_trajectory() -> None:
    plan = ry.planMotion(room(), GOAL)
    assert isinstance(plan, ry.Trajectory)
    times = np.linspace(0, plan.duration, 5)
    for many, each in zip(plan.eval(times), zip(*map(plan.eval, times), strict=True), strict=True):
        assert np.array_equal(many, each)
    sampled, q, v, a = plan.sample(100.0)
    assert sampled[0] == 0 and sampled[-1] == plan.duration and q.shape == v.shape == a.shape == (len(sampled), 3)
    assert sum(search["samples"] for search in plan.searches) > 0


def test_what_moves_in_time_is_free_and_keeps_the_limits() -> None:
    C = room()
    plan = ry.planMotion(C, GOAL, velocity=[0.5, 0.5, 1.0], acceleration=2.0)
    times = np.linspace(0, plan.duration, 4000)
    q, v, a = (np.array(x) for x in zip(*(plan.eval(t) for t in times), strict=True))
    assert leastDistance(C, q) >= 0  # roundings of corners included
    assert (np.abs(v) <= np.array([0.5, 0.5, 1.0]) + 1e-9).all() and (np.abs(a) <= 2 + 1e-9).all()
    assert np.allclose(q[0], START) and np.allclose(q[-1], GOAL) and np.allclose(v[[0, -1]], 0)
    assert plan.times[0] == pytest.approx(0, abs=1e-12) and plan.times[-1] == pytest.approx(plan.duration)


def test_a_panda_goes_around_a_column_with_a_margin(column: ry.Config) -> None:
    start, goal = ends(column)
    plan = ry.planMotion(column, goal, start, margin=0.01, optimize="length")
    assert plan.feasible, plan.message
    assert leastDistance(column, plan.path) >= 0.01
    assert plan.clearance() >= 0.0099
    assert plan.length <= np.linalg.norm(np.diff(plan.raw_path, axis=0), axis=1).sum()


@pytest.mark.parametrize("seed", [0, 7])
def test_the_same_arguments_give_the_same_bits_at_any_number_of_threads(column: ry.Config, seed: int) -> None:
    start, goal = ends(column)
    plans = [ry.planMotion(column, goal, start, seed=seed, threads=threads) for threads in (1, 4)]
    assert plans[0].feasible and np.array_equal(plans[0].path, plans[1].path)
    assert np.array_equal(plans[0].times, plans[1].times)


def test_a_free_straight_motion_is_taken_as_it_is() -> None:
    plan = ry.planMotion(room(), [-1.0, -1.0, 1.0])
    assert plan.feasible and plan.path.shape == (2, 3) and "straight" in plan.explain()


def test_a_goal_may_be_targets_and_the_motion_reaches_them(column: ry.Config) -> None:
    start, _ = ends(column)
    target = [0.35, 0.3, 1.0]
    plan = ry.planMotion(column, {"l_gripper": target}, start)
    assert plan.feasible, plan.message
    column.setJointState(plan.path[-1])
    assert np.allclose(column.getFrame("l_gripper").getPosition(), target, atol=1e-5)
    assert leastDistance(column, plan.path) >= 0


def test_one_of_several_goals_is_reached_and_told() -> None:
    plan = ry.planMotion(room(), [[1.0, 1.0, 1.57], [0.0, 1.0, 1.57], [-1.0, -1.5, 1.0]])
    assert plan.feasible and plan.goal == 2  # the second one is inside of a wall


def test_a_goal_may_be_a_state_with_a_name() -> None:
    C = ry.Config()
    C.addText("world: {}  a(world): {joint: hingeX, limits: [-1, 1], joint_states: { folded: [0.5] }}")
    plan = ry.planMotion(C, "folded")
    assert plan.feasible and plan.path[-1].tolist() == [0.5]
    with pytest.raises(ry.NotFound, match="folded"):
        ry.planMotion(C, "foldet")


def test_a_constraint_holds_all_along(panda: ry.Config) -> None:
    panda.setJointState([0.0, -0.5, 0.0, -2.0, 0.0, 2.0, 0.0])
    upright = ry.MotionConstraint(ry.FS.vectorZ, ["l_gripper"], target=panda.eval(ry.FS.vectorZ, ["l_gripper"])[0])
    start = panda.getJointState()
    goal = ry.solveIk(
        panda, {"l_gripper": {"position": [0.3, 0.4, 1.1], "z": panda.eval(ry.FS.vectorZ, ["l_gripper"])[0]}}
    )
    assert goal.feasible
    plan = ry.planMotion(panda, goal.q, start, constraints=[upright])
    assert plan.feasible, plan.message
    z = panda.eval(ry.FS.vectorZ, ["l_gripper"])[0]
    worst = 0.0
    for t in np.linspace(0, plan.duration, 5000):
        panda.setJointState(plan.eval(t)[0])
        worst = max(worst, np.abs(panda.eval(ry.FS.vectorZ, ["l_gripper"])[0] - z).max())
    assert worst <= 1e-3
    assert plan.warnings == []
    assert leastDistance(panda, plan.path) >= 0


def test_a_constraint_that_is_looked_at_in_samples_alone_is_told() -> None:
    C = room()
    above = ry.MotionConstraint(ry.FS.distance, ["body", "left"], ry.OT.ineq)  # minus the distance
    plan = ry.planMotion(C, [1.0, 1.0, 1.57], constraints=[above])
    assert plan.feasible, plan.message
    assert any("distance" in note and "samples 0.02 apart" in note for note in plan.warnings)


def test_a_motion_is_planned_anew_without_a_jump_of_its_acceleration() -> None:
    C = room()
    limits = {"velocity": 1.0, "acceleration": 4.0, "jerk": 40.0}
    plan = ry.planMotion(C, [1.0, 1.0, 1.57], **limits)
    assert plan.feasible
    for share in (0.1, 0.35, 0.6, 0.9):
        at = share * plan.duration
        bend = plan.replan(C, at=at, goal=[-1.0, -1.2, 1.0])
        assert bend.feasible, bend.message
        for before, after in zip(plan.eval(at), bend.eval(0.0), strict=True):
            assert after == pytest.approx(before, abs=1e-6)
    with pytest.raises(ry.ArgumentError, match="start_acceleration needs jerk limits"):
        ry.planMotion(C, [1.0, 1.0, 1.57], start_velocity=[0.1, 0, 0], start_acceleration=[1.0, 0, 0])


def test_a_small_start_acceleration_costs_no_time() -> None:
    """Motions whose first ramp was shorter than the grid of the timing took minutes and hours."""
    C = ry.Config()
    C.addFile(ry.raiPath("scenarios/pandaSingle.g"))
    q, rng = C.getJointState(), np.random.default_rng(0)
    goal = q + np.array([0.3, 0.2, -0.2, 0.1, 0.2, 0.1, 0.3])
    limits = {"acceleration": 6.0, "jerk": 120.0}
    for _ in range(10):
        velocity = np.clip(rng.normal(size=7) * 10 ** rng.uniform(-2, 0), -1.5, 1.5)
        acceleration = np.clip(rng.normal(size=7) * 10 ** rng.uniform(-3, 0.5), -5.5, 5.5)
        ramped, plain = (
            ry.planMotion(C, goal, start=q, start_velocity=velocity, start_acceleration=a, **limits)
            for a in (acceleration, None)
        )
        assert ramped.duration < plain.duration + 0.3


@pytest.mark.parametrize("jerk", [None, 40.0])
def test_a_motion_ends_with_a_velocity(jerk: float | None) -> None:
    C = room()
    limits = {"velocity": 1.0, "acceleration": 4.0, "jerk": jerk}
    goal, velocity = np.array([1.0, 1.0, 1.57]), np.array([0.0, -0.4, 0.3])
    acceleration = np.array([0.3, 0.2, 0.0]) if jerk else None
    plan = ry.planMotion(C, goal, end_velocity=velocity, end_acceleration=acceleration, **limits)
    assert plan.feasible, plan.message
    assert not plan.warnings
    end = plan.eval(plan.duration)
    assert end[0] == pytest.approx(goal, abs=1e-9)
    assert end[1] == pytest.approx(velocity, abs=1e-9)
    if acceleration is not None:
        assert end[2] == pytest.approx(acceleration, abs=1e-9)
    h = 1e-3
    q = plan.eval(np.arange(0.0, plan.duration, h))[0]
    assert C.isValid(q).all()
    for order, limit in ((1, 1.0), (2, 4.0), (3, jerk)):
        assert limit is None or np.abs(np.diff(q, order, axis=0)).max() / h**order <= 1.001 * limit
    after = plan.replan(C, at=0.5 * plan.duration)
    assert after.feasible and after.eval(after.duration)[1] == pytest.approx(np.zeros(3), abs=1e-9)
    assert "ends at rest" in after.warnings[-1]


def test_an_end_velocity_that_cannot_be_says_why() -> None:
    C = room()
    fast = ry.planMotion(C, [1.0, 1.0, 1.57], velocity=1.0, end_velocity=[0.0, 2.0, 0.0])
    assert fast.status == ry.PlanStatus.invalid_goal and "the end velocity of" in fast.message
    for options, words in (
        ({"end_velocity": [0.1, 0.0]}, "end_velocity has 2 numbers; expected 3"),
        ({"end_velocity": [0.1, 0, 0], "start_velocity": [0.1, 0, 0]}, "needs a start at rest"),
        ({"end_acceleration": [0.1, 0, 0], "jerk": 1.0}, "needs an end_velocity"),
    ):
        with pytest.raises(ry.ArgumentError, match=words):
            ry.planMotion(C, [1.0, 1.0, 1.57], **options)
    with pytest.raises(ry.ArgumentError, match="goal of one configuration"):
        ry.planMotion(C, [[1.0, 1.0, 1.57], [1.0, 1.0, 0.0]], end_velocity=[0.1, 0, 0])


def test_a_path_without_times_is_the_same_path() -> None:
    C = room()
    timed = ry.planMotion(C, [1.0, 1.0, 1.57])
    plan = ry.planMotion(C, [1.0, 1.0, 1.57], timing=False)
    assert plan.feasible and np.array_equal(plan.path, timed.path)
    assert len(plan.times) == 0 and plan.duration == 0
    assert [stage["name"] for stage in plan.stages].count("timing") == 0
    with pytest.raises(ry.ArgumentError, match="has no times"):
        plan.eval(0.0)
    with pytest.raises(ry.ArgumentError, match="need timing"):
        ry.planMotion(C, [1.0, 1.0, 1.57], timing=False, start_velocity=[0.1, 0, 0])
    better = list(ry.planMotions(C, [1.0, 1.0, 1.57], timing=False, improvement_evaluations=2000))
    lengths = [one.length for one in better]
    assert lengths == sorted(lengths, reverse=True)
    assert plan.view(C, pause=False) is not None


def test_conditions_may_be_the_goal(column: ry.Config) -> None:
    start, _ = ends(column)
    high = ry.MotionConstraint(ry.FS.position, ["l_gripper"], scale=[[0, 0, 1]], target=[0, 0, 1.4])
    plan = ry.planMotion(column, high, start)
    assert plan.feasible, plan.message
    column.setJointState(plan.path[-1])
    assert column.getFrame("l_gripper").getPosition()[2] == pytest.approx(1.4, abs=1e-3)


def test_a_start_that_rests_on_something_is_left_and_said() -> None:
    C = ry.Config()
    C.addText("""
world: {}
table(world): {shape: box, size: [2, 2, 0.1], Q: [0, 0, -0.05], contact: 1}
cart(world): {joint: trans3, limits: [-1, -1, 0, 1, 1, 1]}
box(cart): {shape: box, size: [0.2, 0.2, 0.2], Q: [0, 0, 0.0998], contact: 1}
""")
    plan = ry.planMotion(C, [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0])  # both 0.2 mm inside of the table
    assert plan.feasible, plan.message
    assert (
        "the start is in contact: 'table' and 'box' overlap by 200 um; the motion begins with a retreat"
        in plan.warnings
    )
    assert (
        "the goal is in contact: 'table' and 'box' overlap by 200 um; the motion ends with a contact" in plan.warnings
    )
    assert leastDistance(C, plan.path) >= -0.0002 - 1e-6
    assert leastDistance(C, plan.path[1:-1]) >= 0


@pytest.mark.parametrize(
    ("goal", "status", "words"),
    [
        ([0.0, 1.0, 1.57], "invalid_goal", "the goal collides: 'left' and 'body' overlap by"),
        ([5.0, 1.0, 1.57], "invalid_goal", "the goal is outside the limits: base:0 is at 5, 3 beyond"),
        ({"body": [9.0, 0.0, 0.0]}, "goal_unreachable", "the goal is out of reach: .*body"),
    ],
)
def test_a_goal_that_cannot_be_is_told(goal: object, status: str, words: str) -> None:
    plan = ry.planMotion(room(), goal)
    assert not plan.feasible and plan.status.name == status and plan.path.size == 0
    assert __import__("re").search(words, plan.message), plan.message
    with pytest.raises(ry.ArgumentError, match="there is no motion"):
        plan.eval(0.0)


def test_a_start_that_collides_is_told() -> None:
    plan = ry.planMotion(room(), GOAL, [0.0, 1.0, 0.0])
    assert plan.status == ry.PlanStatus.invalid_start and "the start collides: 'left' and 'body'" in plan.message


def test_where_no_way_is_found_the_message_says_what_is_in_the_way() -> None:
    plan = ry.planMotion(room(0.31), GOAL, max_evaluations=3000)
    assert plan.status in (ry.PlanStatus.no_path_found, ry.PlanStatus.infeasible)
    assert "most edges collided with 'left'" in plan.message or "most edges collided with 'right'" in plan.message
    assert len(plan.trees) == 2 and plan.trees[0][0].shape[1] == 3


def test_a_picture_has_the_trees_and_the_path() -> None:
    C = room()
    plan = ry.planMotion(C, GOAL)
    picture = plan.picture(C)
    names = [frame.name for frame in picture.getFrames()]
    assert names[len(C.getFrames()) :] == ["start tree", "goal tree", "raw path", "path"]
    sampled = picture.getFrame("path").getMeshPoints()
    assert np.allclose(sampled[0, :2], START[:2]) and np.allclose(sampled[-1, :2], GOAL[:2])
    assert len(C.getFrames()) == 5 and plan.obstacles == []
    with pytest.raises(ry.FrameNotFound, match="bdy"):
        plan.picture(C, "bdy")
    with pytest.raises(ry.ArgumentError, match="the scene has 0 dofs; expected 3"):
        plan.picture(ry.Config())


def test_where_there_is_no_way_the_picture_shows_what_most_motions_ended_at() -> None:
    C = room(0.31)
    plan = ry.planMotion(C, GOAL, max_evaluations=3000)
    worst = plan.obstacles[0]
    assert worst["name"] in ("left", "right") and worst["by"] == ["body"] and 0.3 < worst["share"] <= 1
    assert sum(met["share"] for met in plan.obstacles) == pytest.approx(1)
    picture = plan.picture(C, ["body"])
    assert "path" not in [frame.name for frame in picture.getFrames()]
    assert picture.getFrame(worst["name"]).asDict()["color"] == [1.0, 0.0, 0.0]


def test_a_time_limit_ends_the_search() -> None:
    plan = ry.planMotion(room(0.31), GOAL, time_limit=0.05)
    assert plan.status == ry.PlanStatus.timeout and "time limit of 0.05 s" in plan.message


def test_clearance_is_asked_for_and_given() -> None:
    C = room(0.6)
    near = ry.planMotion(C, GOAL, optimize="length")
    far = ry.planMotion(C, GOAL, optimize="clearance")
    assert far.margin >= 0.05 and leastDistance(C, far.path) >= far.margin > leastDistance(C, near.path)


def test_shortcut_and_smooth_are_free_and_say_where_a_path_is_not() -> None:
    C = room()
    rough = ry.planMotion(C, GOAL).raw_path
    short = ry.shortcut(C, rough)
    length = lambda path: np.linalg.norm(np.diff(path, axis=0), axis=1).sum()  # noqa: E731
    assert length(short) < length(rough) and leastDistance(C, short) >= 0
    round_ = ry.smooth(C, short)
    turns = [np.diff(path, axis=0) / np.linalg.norm(np.diff(path, axis=0), axis=1)[:, None] for path in (short, round_)]
    sharpest = [min((a * b).sum() for a, b in itertools.pairwise(turn)) for turn in turns]
    assert sharpest[1] > sharpest[0] and leastDistance(C, round_) >= 0
    with pytest.raises(ry.ArgumentError, match="in collision between rows 0 and 1: '(left|right)' and 'body'"):
        ry.shortcut(C, [START, GOAL])


def test_what_makes_no_sense_is_an_error() -> None:
    C = room()
    with pytest.raises(ry.ArgumentError, match="the goal has 2 numbers; expected 3"):
        ry.planMotion(C, [0.0, 1.0])
    with pytest.raises(ry.ArgumentError, match="similar names: margin"):
        ry.planMotion(C, GOAL, margn=0.1)
    with pytest.raises(ry.ArgumentError, match="velocity has 2 numbers"):
        ry.planMotion(C, GOAL, velocity=[1.0, 2.0])
    with pytest.raises(ry.ArgumentError, match="optimize is 'speed'; expected one of time, length, clearance"):
        ry.planMotion(C, GOAL, optimize="speed")
    for goal in (3, None):
        for call in (ry.planMotion, ry.planMotions):
            with pytest.raises(ry.ArgumentError, match=f"the goal is {goal}; expected a joint vector or several"):
                call(C, goal)
    with pytest.raises(ry.ArgumentError, match="neither eq nor ineq"):
        ry.planMotion(C, GOAL, constraints=[ry.MotionConstraint(ry.FS.position, ["body"], ry.OT.sos)])
    with pytest.raises(ry.FrameNotFound, match="bdy"):
        ry.planMotion(C, GOAL, constraints=[ry.MotionConstraint(ry.FS.position, ["bdy"])])


def test_obstacles_that_touch_each_other_are_no_collision_of_the_start() -> None:
    C = room()
    C.addFrame("lintel").setShape(ry.ST.box, [0.2, 4.0, 0.2]).setPosition([0.0, 0.0, 0.55]).setContact(
        1
    )  # in both walls
    assert ry.planMotion(C, [-1.0, -1.0, 1.0]).feasible
    assert ry.RRT_PathFinder().setProblem(C).setStartGoal(START, [-1.0, -1.0, 1.0]).solve(0).feasible


def test_the_name_of_a_frame_as_goal_is_told_from_that_of_a_state(panda: ry.Config) -> None:
    with pytest.raises(ry.ArgumentError, match=r"'l_gripper' is a frame, not a joint state; pass .*\{'l_gripper': \[x"):
        ry.planMotion(panda, "l_gripper")
    with pytest.raises(ry.NotFound, match="no state 'l_griper'"):
        ry.planMotion(panda, "l_griper")


def test_joints_without_limits_are_named_for_goals_of_frames_too() -> None:
    C = ry.Config()
    C.addText("w: {}\nbase (w): { joint: free }\narm (base): { joint: hingeX, limits: [-1 1] }")
    with pytest.raises(ry.ArgumentError, match="no limits are known for base:0, base:1, base:2"):
        ry.planMotion(C, {"arm": [1, 1, 1]})


def test_joint_values_in_degrees_are_asked_about_if_they_are_no_round_numbers(panda: ry.Config) -> None:
    goal = np.degrees(panda.getJointState() + 0.01)
    assert "did you mean radians?" in ry.planMotion(panda, goal).message
    with pytest.raises(ry.ArgumentError, match=r"did you mean radians\?"):
        ry.BotOp(panda, False).moveTo(goal)


@pytest.mark.parametrize("pair", [("base", "a"), ("a", "c"), ("b", "wall"), ("a", "wall")])
def test_a_start_in_which_only_parts_of_the_robot_overlap_has_advice(pair: tuple[str, str]) -> None:
    def shape(frame: str) -> str:
        return "shape: sphere, size: [.06], contact: 1" if frame in pair else ""

    C = ry.Config()
    C.addText(
        f"base: {{ {shape('base')} }}\na (base): {{ joint: hingeZ, limits: [-1 1], {shape('a')} }}\n"
        f"b (a): {{ joint: hingeX, limits: [-1 1], {shape('b')} }}\nc (b): {{ joint: hingeX, limits: [-1 1], {shape('c')} }}\n"
        f"wall: {{ {shape('wall')} }}"
    )
    plan = ry.planMotion(C, [0.5, 0, 0])
    assert plan.status == ry.PlanStatus.invalid_start
    advice = "if these parts of the robot always touch, C.ignoreCollisionsNow() excludes them"
    assert (advice in plan.message) == ("wall" not in pair)
    C.ignoreCollisionsNow()
    assert ry.planMotion(C, [0.5, 0, 0]).feasible
