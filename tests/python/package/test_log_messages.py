"""Messages go to the logger "kinegraph" if the program configures logging, and are printed otherwise."""

import subprocess
import sys

import kinegraph as ry

SOLVE = """
import logging, sys
import kinegraph as ry
if len(sys.argv) > 1:
    logging.basicConfig(level=sys.argv[1], format="%(name)s %(levelname)s %(message)s", stream=sys.stdout)
C = ry.Config()
C.addFile(ry.raiPath("panda/panda.g"))
komo = ry.KOMO(C, 1, 1, 0, False)
komo.addObjective([], ry.FS.position, ["gripper"], ry.OT.eq, [10.0], [0.4, 0.2, 0.9])
ry.NLP_Solver(komo.nlp(), verbose=3).solve()
"""


def printed(*arguments: str) -> list[str]:
    run = subprocess.run([sys.executable, "-c", SOLVE, *arguments], capture_output=True, text=True, check=True)
    assert run.stderr == ""
    return run.stdout.splitlines()


def test_verbose_calls_print_until_logging_is_configured():
    assert "==nlp==" in printed()[-1]
    assert printed("WARNING") == []
    lines = printed("INFO")
    assert len(lines) > 1 and all(line.startswith("kinegraph INFO") for line in lines)
    assert "==nlp==" in lines[-1]


def test_messages_reach_the_handlers_of_the_program(caplog):
    caplog.set_level("INFO", "kinegraph")
    C = ry.Config()
    C.addFile(ry.raiPath("panda/panda.g"))
    komo = ry.KOMO(C, 1, 1, 0, False)
    komo.addObjective([], ry.FS.position, ["gripper"], ry.OT.eq, [10.0], [0.4, 0.2, 0.9])
    assert ry.NLP_Solver(komo.nlp(), verbose=1).solve().feasible
    assert "==nlp==" in caplog.messages[-1]
