"""Names of earlier years that Kinegraph lacks, and those that users of other libraries try first (`guessed`): access
raises an error that suggests a replacement."""

from __future__ import annotations

from typing import NoReturn

from .._core import KOMO, BotOp, Config, Frame, NLP_Solver, Simulation
from .guessed import GUESSED

_FORCES = (
    "KOMO.getForceInteractions() has those of a motion problem, Simulation.getContacts() those of a simulated world"
)
_SIMULATION = "ry.Simulation(C) simulates a scene"
_PICTURE = "C.viewer().getRgb() is a picture of what the viewer shows, getImageAndDepth() one of a camera"
_POSE = "getPosition(), getQuaternion() and getPose() of C.getFrame(name)"
_PATH = "komo.view(True) shows the path, komo.view_play() plays it"

ABSENT: dict[type, dict[str, str]] = {
    Config: {
        "getForces": _FORCES,
        "bullet": _SIMULATION,
        "physx": _SIMULATION,
        "simulation": _SIMULATION,
        "operate": "ry.BotOp(C, False) operates a robot",
        "lgp": "ry.LGP_Tool and ry.planTask plan tasks",
        "camera": "ry.CameraView(C) draws what a camera sees",
        "cameraView": "ry.CameraView(C) draws what a camera sees",
        "getFrameIDs": "C.getJointIDs() has those of joints, frame.ID that of a frame",
        "getPairDistance": "C.eval(ry.FS.negDistance, [a, b]) has minus the distance",
        "getDistance": "C.eval(ry.FS.negDistance, [a, b]) has minus the distance",
        "getTransform": _POSE,
        "kinematicsPos": "C.eval(ry.FS.position, [name]) has value and Jacobian",
        "inverseKinematics": "ry.solveIk(C, {name: target})",
        "setActiveJoints": "C.selectJoints(names)",
        "useJointGroup": "C.selectJoints(names), or C.selectJointsByTag(tags)",
        "stepKinematics": "C.setJointState(q) and C.view()",
        "detach": "frame.unLink(), or C.attach(other, frame)",
        "edit": "C.watchFile(file) shows a file while it is edited",
        "editConfiguration": "C.watchFile(file) shows a file while it is edited",
        "watch": "C.view(True)",
    },
    Frame: {
        "getLimits": "C.getJointLimits()",
        "getShape": "frame.getShapeType() and frame.getSize()",
        "getColor": "frame.asDict()['color']",
        "getJoint": "frame.getJointType() and frame.getJointState()",
        "setInertia": "frame.setMass(mass, inertiaMatrix)",
    },
    Simulation: {
        "getScreenshot": _PICTURE,
        "openGripper": "moveGripper(gripper, width)",
        "pushConfigurationToSimulator": "pushConfigToSim()",
        "getImageAndSegmentation": "getImageAndDepth(); ry.CameraView(C).computeSegmentationID() says which frame each pixel shows",
        "getGripperIsClose": "gripperIsDone(gripper), getGripperWidth(gripper)",
        "getGripperIsOpen": "gripperIsDone(gripper), getGripperWidth(gripper)",
    },
    BotOp: {
        "moveLeap": "moveTo(q)",
        "getCameraImage": "getImageAndDepth(sensorName)",
    },
    KOMO: {
        "displayPath": _PATH,
        "displayTrajectory": _PATH,
        "plotTrajectory": "komo.report(plotOverTime=True)",
        "checkGradients": "komo.nlp().checkJacobian(x, tolerance)",
        "setIKOpt": "ry.KOMO(C, 1, 1, 0, True)",
        "setPathOpt": "ry.KOMO(C, phases, slices, 2, True)",
        "setSequenceOpt": "ry.KOMO(C, phases, 1, 1, True)",
        "reset": "a new ry.KOMO",
    },
    NLP_Solver: {
        "setVerbose": "setOptions(verbose=...)",
    },
}


class Absent:
    """An absent attribute: access raises an error with advice, and `hasattr` is False."""

    def __init__(self, name: str, advice: str) -> None:
        self.message = f"{name}: not part of Kinegraph; instead: {advice}"

    def __get__(self, instance: object, owner: type) -> NoReturn:
        raise AttributeError(self.message)


def addAbsentNames() -> None:
    """Adds the absent names to the classes."""
    for owner, names in [*ABSENT.items(), *GUESSED.items()]:
        for name, advice in names.items():
            if not hasattr(owner, name):
                setattr(owner, name, Absent(f"{owner.__name__}.{name}", advice))
