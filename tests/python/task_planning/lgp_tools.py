"""LGP_Tool on recorded problems, and the objectives of its parts."""

from pathlib import Path

import kinegraph as ry

DATA = Path(__file__).parent.parent.parent / "data"


def tool(scene, problem=None):
    C = ry.Config()
    C.addFile(str(DATA / "lgp" / f"{scene}.g"))
    tamp = ry.default_LGP_TAMP_Abstraction(C, str(DATA / "lgp" / f"{problem or scene}.lgp"))
    return C, tamp, ry.LGP_Tool(C, tamp)


def objectives(komo):
    """Frames, order, type, times and slices of each, but for the number that a recording gives for all frames."""
    listed = [o for o in komo.report(False, True, False, False).values() if isinstance(o, dict) and "name" in o]
    return [
        [_named(o["frames"], komo), int(o["order"]), o["type"], list(o["times"]), list(map(int, o["slices"]))]
        for o in listed
    ]


def _named(frames, komo):
    joints = {"hand", "base"}  # the recording names the joint of a scene with one
    return [] if not frames or frames[0].startswith("#") or set(frames) == joints else frames
