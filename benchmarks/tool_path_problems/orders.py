"""Seven seams in any order, beside the best order of all: every branch, direction and order, with planned transfers."""

import itertools

import numpy as np

import kinegraph as ry

SEAMS = 7
MODELS = {"ur10e": ("ur10e/ur10e.g", 0.55, 0.9), "irb120": ("irb120/irb120.g", 0.25, 0.45)}  # nearest and farthest x, m
MOST_EVALUATIONS = 20000  # of a transfer; most take fewer than 1000
LIMITS = {"acceleration": 6.0, "jerk": 120.0}


def draw(robot, seed, many=SEAMS):
    """A scene and straight seams with the rotation of the tool given, so that there are finitely many branches."""
    file, near, far = MODELS[robot]
    rng = np.random.default_rng([seed, 7, sorted(MODELS).index(robot)])
    C = ry.Config()
    C.addFile(ry.raiPath(file))
    C.addFrame("tool", "tool0").setRelativePosition([0, 0, 0.1])
    seams = []
    while len(seams) < many:
        a = rng.uniform([near, -0.35, 0.1], [far, 0.35, 0.35])
        b = a + rng.uniform(-0.1, 0.1, 3) * [1, 1, 0.2]
        lean, turn = rng.uniform(0, 0.4), rng.uniform(0, 2 * np.pi)
        q = np.r_[np.sin(lean / 2), np.cos(lean / 2) * np.r_[np.cos(turn), np.sin(turn)], 0.0]  # z down, leaning
        start = np.r_[a, q]
        seam = ry.ToolPath("tool").start(start).line(b)
        if branches(C, seam, start):
            seams.append((seam, start))
    return C, seams


def branches(C, seam, start):
    """First and last configurations and durations of all motions along a seam, one for each inverse solution."""
    found = []
    for solution in ry.solveIk(C, {"tool": start}, all=True):
        plan = ry.planToolPath(C, seam, start=solution.q, **LIMITS)
        if plan:
            ends = plan.eval(np.array([0.0, plan.duration]))[0]
            found.append((ends[0], ends[1], plan.duration))
    return found


def best_duration(C, seams, home):
    """The least duration of all orders, directions and branches, transfers by planMotion: exact, over subsets."""

    def transfer(a, b):
        plan = ry.planMotion(C, b, start=a, max_evaluations=MOST_EVALUATIONS, **LIMITS)
        return plan.duration if plan.feasible else np.inf

    variants = []  # (seam, first, last, duration); a branch that home does not lead to is in no order
    for number, (seam, start) in enumerate(seams):
        for first, last, duration in branches(C, seam, start):
            if np.isfinite(transfer(home, first)):
                variants += [(number, first, last, duration), (number, last, first, duration)]
    count = len(variants)
    cost = np.full((count, count), np.inf)
    for i, j in itertools.product(range(count), repeat=2):
        if variants[i][0] != variants[j][0]:
            cost[i, j] = transfer(variants[i][2], variants[j][1])
    least = {(1 << v[0], k): transfer(home, v[1]) + v[3] for k, v in enumerate(variants)}
    for _ in range(len(seams) - 1):
        longer = {}
        for (done, i), so_far in least.items():
            for j, (number, _, _, duration) in enumerate(variants):
                if not done >> number & 1:
                    key = done | 1 << number, j
                    longer[key] = min(longer.get(key, np.inf), so_far + cost[i, j] + duration)
        least = longer
    return min(least.values()), count


def compare(robot, seed, many=SEAMS):
    """(duration of the plan, least duration, number of ways to do a seam)."""
    C, seams = draw(robot, seed, many)
    home = C.getJointState()
    plan = ry.planToolPath(C, [seam for seam, _ in seams], order="free", transfer_from=home, **LIMITS)
    assert plan, plan.message
    return plan.duration, *best_duration(C, seams, home)
