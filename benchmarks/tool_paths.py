#!/usr/bin/env python3
"""Plans tool paths of seven families and judges them: deviation, limits, speed, places of failures, and processor time.

    python benchmarks/tool_paths.py [--seeds 0 1] [--families abcdefg] [--robots panda ur10] [--peers] [--orders]

Robots: a Panda with a pen and a UR10 with a rod. tool_path_problems/families.py draws the families by a seed; lines,
circles and rasters are dense rows of poses, .5 mm apart. The judge samples motions every ms. Its kinematics come from a
URDF file of the scene, its derivatives from differences. It goes forward along the rows, so that it notices pieces that
are left out. Collisions of samples are those of `Config.isValid`. Limits are the model's velocities, 6 rad/s^2 and 120
rad/s^3; along the path 2 m/s^2 and 40 m/s^3.

Columns: distance from the rows and rotation, with the bound that the plan states; velocities, accelerations and jerks
as shares of their limits; the largest speed of the tool as a share of the speed asked; the share of the way on which it
is within 1 % of it, and the share that `plan.slow` lists; processor time of the call.

--peers adds roboplan, MPlib and Descartes of tesseract-robotics (tool_path_problems/peers.py) on families a to d,
judged alike, without collisions. A motion counts as solved if it gets to the end with a deviation below 10 mm.

--flow path lets transfers flow into the seams of family f, --approach into approaches.

--orders compares instead the durations of seven seams in any order with the best of all orders, directions and branches
(tool_path_problems/orders.py), for a UR10e and an IRB 120. A plan is wrong if it takes more than 5 % longer.
"""

import argparse
import statistics
from time import process_time

import numpy as np
from tool_path_problems import families, judge, orders, peers

import kinegraph as ry

KINDS = {"out_of_reach": "reach", "in_collision": "collision", "no_branch": "limits"}
WORST = {"free": min, "inside": min, "done": min, "steady": min, "duration": lambda a, b: a + b}


def paths_of(problem):
    paths = []
    for rows in problem["paths"]:
        path = ry.ToolPath.along(rows)
        if problem["free"]:
            path.free("z").tilt(problem["tilt"])
        paths.append(path)
    return paths


def planned(problem, approach, flow):
    """The scene, the plan, and the processor time in ms."""
    C = families.scene(problem["robot"], problem["boxes"])
    C.setJointState(families.home(C, problem["robot"]))
    velocity, acceleration, jerk = families.limits(C)
    paths = paths_of(problem)
    begin = process_time()
    plan = ry.planToolPath(
        C,
        paths,
        speed=problem["speed"],
        order="free" if problem["order"] else "given",
        velocity=velocity,
        acceleration=acceleration,
        jerk=jerk,
        approach=approach,
        retract=approach,
        flow=flow,
    )
    return C, plan, 1e3 * (process_time() - begin)


def transfer_shares(C, q, limits):
    velocity, acceleration, jerk = limits
    v, a, j = (np.diff(q, k, axis=0) / 1e-3**k for k in (1, 2, 3))
    return {
        "v": np.max(np.abs(v) / velocity),
        "a": np.max(np.abs(a)) / acceleration,
        "j": np.max(np.abs(j)) / jerk,
        "free": bool(C.isValid(q).all()),
    }


def judged(C, problem, plan):
    """The worst numbers of all parts."""
    chain, limits = judge.chain(C), families.limits(C)
    worst = {}
    for kind, path, back, begin, end in plan.segments:
        t = np.arange(begin, end, 1e-3)
        q = plan.eval(t)[0]
        if kind == "path":
            rows = problem["paths"][path]
            part = judge.judge(
                C, rows, t, q, problem["free"], problem["tilt"], problem["speed"], *limits, back=back, links=chain
            )
        else:
            part = transfer_shares(C, q, limits)
        for name, value in part.items():
            worst[name] = WORST.get(name, max)(worst[name], value) if name in worst else value
    return worst


def line(problem, C, plan, ms):
    """A row of the table, and whether the result is right."""
    name = f"{problem['name']:22s}"
    if not plan:
        kind = KINDS.get(plan.status.name, plan.status.name)
        where = problem["where"]
        right = kind == problem["expect"] and (where is None or where[0] - 5e-3 <= plan.where[1] <= where[1] + 5e-3)
        return f"{name} {'right' if right else 'WRONG'} {ms:6.1f} ms  {plan.message}", right
    w = judged(C, problem, plan)
    right = (
        problem["expect"] == "motion"
        and w["mm"] <= 0.05
        and w["deg"] <= 0.005
        and max(w["v"], w["a"], w["j"], w["fast"]) <= 1.001
        and w["inside"]
        and w["free"]
        and w["done"] > 0.9999
    )
    way = sum(rows_length(rows) for rows in problem["paths"])
    slow = sum(end - begin for _, begin, end, *_ in plan.slow) / way
    return (
        f"{name} {'right' if right else 'WRONG'} {ms:6.1f} ms  {w['mm']:.4f} mm (bound {1e3 * plan.deviation[0]:.4f}) "
        f"{w['deg']:.4f} deg  v {w['v']:.3f} a {w['a']:.4f} j {w['j']:.4f}  speed {w['fast']:.4f} "
        f"steady {w['steady']:.3f} slow {slow:.3f}  {plan.duration:.2f} s"
    ), right


def peer_lines(problem, C, row):
    """Judges the motions of other packages; adds them to the rows of the table."""
    chain, (velocity, acceleration, jerk) = judge.chain(C), families.limits(C)
    for name, plan_with in peers.PEERS.items():
        motion, ms = plan_with(problem, C)
        if motion is None and ms == 0.0:
            continue
        result = {"ms": ms}
        if motion is not None:
            t, q = peers.resampled(*motion)
            result |= judge.judge(
                C, problem["paths"][0], t, q, None, 0.0, problem["speed"], velocity, acceleration, jerk, links=chain
            )
            if name in peers.UNTIMED:
                result |= dict.fromkeys(("v", "a", "j", "fast"), float("nan"))
        row(name, problem["family"], result)


def own_result(C, problem, plan, ms):
    return {"ms": ms} | (judged(C, problem, plan) if plan else {})


def peer_table(results):
    print("\n| family | package | solved | deviation, mm (median, worst) | a | j | speed | ms (median, worst) |")
    print("|---|---|---|---|---|---|---|---|")
    for (family, name), all_of in sorted(results.items()):
        done = [r for r in all_of if "mm" in r and r["done"] > 0.99 and r["mm"] < 10]
        ms = [r["ms"] for r in all_of]
        worst = {k: max((r[k] for r in done), default=float("nan")) for k in ("mm", "a", "j", "fast")}
        median = statistics.median(r["mm"] for r in done) if done else float("nan")
        print(
            f"| {family} | {name} | {len(done)} of {len(all_of)} | {median:.3f}, {worst['mm']:.3f} | {worst['a']:.2f} | "
            f"{worst['j']:.1f} | {worst['fast']:.3f} | {statistics.median(ms):.1f}, {max(ms):.1f} |"
        )


def rows_length(rows):
    return np.linalg.norm(np.diff(rows[:, :3], axis=0), axis=1).sum()


def order_table(seeds):
    """Compares orders of seams with the best ones; returns the names of those that take more than 5 % longer."""
    wrong = []
    for robot in orders.MODELS:
        for seed in seeds:
            duration, best, ways = orders.compare(robot, seed)
            print(
                f"{robot}-{seed}: {duration:.3f} s, best {best:.3f} s, ratio {duration / best:.4f}, {ways} ways",
                flush=True,
            )
            if duration > 1.05 * best:
                wrong.append(f"{robot}-{seed}")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1])
    parser.add_argument("--families", default="abcdefg", help="their letters")
    parser.add_argument("--robots", nargs="+", default=["panda", "ur10"], choices=["panda", "ur10"])
    parser.add_argument("--peers", action="store_true", help="a table with roboplan, MPlib and Descartes")
    parser.add_argument("--orders", action="store_true", help="orders of seven seams beside the best ones")
    parser.add_argument("--approach", type=float, default=0.0, help="length of approaches and retracts, m")
    parser.add_argument("--flow", default="approach", help="where transfers end with a velocity")
    options = parser.parse_args()
    if options.orders:
        wrong = order_table(options.seeds)
        print("wrong:", ", ".join(wrong) or "none")
        return 1 if wrong else 0
    times, wrong, results = {}, [], {}

    def row(name, family, result):
        results.setdefault((family, name), []).append(result)

    for problem in families.all_problems(options.seeds, options.families, options.robots):
        C, plan, ms = planned(problem, options.approach, options.flow)
        text, right = line(problem, C, plan, ms)
        print(text, flush=True)
        times.setdefault(problem["family"], []).append(ms)
        if not right:
            wrong.append(problem["name"])
        if options.peers and problem["family"] in "abcd":
            row("kinegraph", problem["family"], own_result(C, problem, plan, ms))
            peer_lines(problem, C, row)
    for family, all_ms in sorted(times.items()):
        print(
            f"{family}: {len(all_ms)} problems, median {statistics.median(all_ms):.1f} ms, worst {max(all_ms):.1f} ms"
        )
    if results:
        peer_table(results)
    print("wrong:", ", ".join(wrong) or "none")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
