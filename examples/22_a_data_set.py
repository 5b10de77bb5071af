"""Part 22: a data set.

A data set of inverse kinematics and motions, computed by all processors, and read back.

`ry.map` applies a function to many items. Results are the same to the bit on threads, processes and clusters. A run
that is interrupted by Ctrl-C or a failure of the machine continues when the script is started again.
"""

import os
import tempfile

import numpy as np
import pyarrow as pa  # type: ignore[import-untyped]
import pyarrow.dataset  # type: ignore[import-untyped]

import kinegraph as ry

targets_in_all = int(os.environ.get("TARGETS", 100_000))
folder = tempfile.mkdtemp()  # a permanent folder allows a later continuation

C = ry.Config()
C.addFile(ry.raiPath("scenarios/pandaSingle.g"))


def reach(count: int, seed: int) -> pa.Table:
    """Solves inverse kinematics for random targets, one row each."""
    targets = np.random.default_rng(seed).uniform([-0.6, -0.2, 0.7], [0.6, 0.8, 1.4], (count, 3))
    found = ry.solveIk(C, {"l_gripper": targets})
    return pa.table({"feasible": found.feasible, "q": list(found.q), "target": list(targets)})


items = [1000] * (targets_in_all // 1000)
result = ry.map(reach, items, seed=1, out=f"{folder}/reaches")
print(result)

table = pa.dataset.dataset(f"{folder}/reaches").to_table()
feasible = table["feasible"].to_numpy()
print(f"{table.num_rows} targets, {100 * feasible.mean():.1f} % of them within reach")
assert table.num_rows == sum(items) and 0.2 < feasible.mean() < 1

# Motions to some of the configurations that were found. A function may return a dict: one row.
configurations = np.stack(table.filter(table["feasible"])["q"].to_numpy())[:20]


def move(goal: np.ndarray, seed: int) -> dict[str, object]:
    motion = ry.planMotion(C, goal, seed=seed % 1000)
    return {"goal": goal, "feasible": motion.feasible, "duration": motion.duration, "message": motion.message}


print(ry.map(move, configurations, engine="processes", seed=2, out=f"{folder}/motions"))
motions = list(ry.readResults(f"{folder}/motions"))
durations = [motion["duration"] for motion in motions if motion["feasible"]]
print(f"{len(durations)} of {len(motions)} motions found; they take {np.median(durations):.2f} s (median)")
assert len(motions) == len(configurations) and len(durations) > 15
