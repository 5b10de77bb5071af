"""Tries an installed wheel: scenes, inverse kinematics, planning, simulation, a page. Needs numpy and nothing else."""

import os
import tempfile
from pathlib import Path

os.environ["KINEGRAPH_HEADLESS"] = "1"

import numpy as np

import kinegraph as kg


def main() -> None:
    C = kg.Config()
    C.addFile(kg.raiPath("scenarios/pandaSingle.g"))
    target = C.addFrame("target").setPosition([0.3, 0.3, 1.0]).setQuaternion([0, 1, 0, 0])
    found = kg.solveIk(C, {"l_gripper": target})
    assert found, found
    plan = kg.planMotion(C, found.q)
    assert plan.feasible, plan
    start, end = plan.eval(0.0)[0], plan.eval(plan.duration)[0]
    np.testing.assert_allclose([start, end], [C.getJointState(), found.q], atol=1e-9)

    simulation = kg.Simulation(C, kg.SimulationEngine.physx, 0)
    for _ in range(20):
        simulation.step([], 0.01)
    try:
        C.addFile("no_such_file.g")
        raise SystemExit("a missing file is no error")
    except kg.FileError as error:
        assert "no_such_file.g" in str(error)
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "corner.stl"
        mesh.write_text(
            "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n"
        )
        C.addFrame("corner").setMeshFile(str(mesh))  # loads assimp
        page = Path(folder) / "scene.html"
        C.viewer().saveHtml(str(page))
        assert page.stat().st_size > 100_000
    print(f"kinegraph {kg.__version__} works")


if __name__ == "__main__":
    main()
