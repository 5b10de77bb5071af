"""Names that users of other libraries try first, and what has this purpose here."""

from __future__ import annotations

from .._core import BotOp, Config, ConfigurationViewer, Frame, IkResult, MotionPlan, Simulation, TaskPlan, TimedPath

_Q = "C.getJointState()"
_IK = "ry.solveIk(C, {name: target})"
_PLAN = "ry.planMotion(C, goal)"
_LOAD = "C.addFile(file) reads .g, .urdf, .xacro and .xml (MJCF)"
_POSE = "C.getFrame(name).getPose()"
_SHAPE = "C.addFrame(name).setShape(ry.ST.box, [x, y, z])"
_FREE = "C.isValid(q), C.getCollisions()"
_SIMULATE = "S = ry.Simulation(C, ry.SimulationEngine.physx), then S.step(q, seconds, ry.ControlMode.position)"
_TRAJECTORY = "this is a trajectory itself: eval(t), sample(rate), path and times"
_SAVE = "pickle it, or writeCsv(path, rate)"
_FEASIBLE = "feasible, and message with the reason"

GUESSED: dict[type, dict[str, str]] = {
    Config: {
        "q": _Q,
        "joints": "C.getJointNames()",
        "links": "C.getFrameNames()",
        "setJoints": "C.setJointState(q)",
        "getJointPositions": _Q,
        "setJointPositions": "C.setJointState(q)",
        "getJointValues": _Q,
        "setJointValues": "C.setJointState(q)",
        "setJointLimits": "C.getFrame(joint).setAttributes({'limits': [lower, upper]})",
        "nq": "C.getJointDimension()",
        "fk": "C.setJointState(q), then " + _POSE,
        "forwardKinematics": "C.setJointState(q), then " + _POSE,
        "ik": _IK,
        "solveIk": _IK,
        "plan": _PLAN,
        "planMotion": _PLAN,
        "load": _LOAD,
        "loadURDF": _LOAD,
        "addURDF": _LOAD,
        "addBox": _SHAPE,
        "addSphere": "C.addFrame(name).setShape(ry.ST.sphere, [radius])",
        "addShape": _SHAPE,
        "removeFrame": "C.delFrame(name)",
        "deleteFrame": "C.delFrame(name)",
        "getPose": _POSE,
        "setPose": "C.getFrame(name).setPose(pose)",
        "getPosition": "C.getFrame(name).getPosition()",
        "getMass": "C.getFrame(name).getMass(); 'kinegraph info' has the sum",
        "step": _SIMULATE,
        "simulate": _SIMULATE,
        "jacobian": "C.eval(ry.FS.position, [name]) has value and Jacobian",
        "getJacobian": "C.eval(ry.FS.position, [name]) has value and Jacobian",
        "inCollision": _FREE,
        "isColliding": _FREE,
        "checkCollision": _FREE,
        "show": "C.view()",
        "render": "C.view(), and C.viewer().savePng(file) for a picture",
        "save": "C.write(file)",
        "savePng": "C.viewer().savePng(file)",
        "saveHtml": "C.viewer().saveHtml(file)",
    },
    Frame: {
        "pose": "getPose()",
        "position": "getPosition()",
        "quaternion": "getQuaternion()",
        "parent": "getParent()",
        "children": "getChildren()",
        "mass": "getMass()",
        "size": "getSize()",
        "setSize": "setShape(frame.getShapeType(), size)",
        "setLimits": "setAttributes({'limits': [lower, upper]})",
        "setFriction": "setAttributes({'friction': value})",
        "setTransform": "setPose(pose), 7 numbers x y z qw qx qy qz",
        "getMatrix": "getTransform()",
        "transform": "getTransform()",
        "delete": "C.delFrame(name)",
        "remove": "C.delFrame(name)",
        "attach": "C.attach(hand, object)",
    },
    IkResult: {
        "success": _FEASIBLE,
        "solution": "q",
        "x": "q",
        "joints": "q",
        "error": "position_error and rotation_error",
    },
    MotionPlan: {
        "success": _FEASIBLE,
        "q": "path, one configuration per row",
        "waypoints": "path, one configuration per row",
        "trajectory": _TRAJECTORY,
        "save": _SAVE,
        "play": "C.view_path(plan.path, plan.duration), plan.view(C)",
        "execute": "bot.follow(plan), then bot.wait(C)",
        "retime": "velocity=, acceleration= and jerk= of ry.planMotion, or ry.retime(plan.path, velocity, acceleration)",
    },
    TimedPath: {
        "success": _FEASIBLE,
        "trajectory": _TRAJECTORY,
        "q": "path, one configuration per row, or eval(t)",
        "save": _SAVE,
    },
    TaskPlan: {
        "success": _FEASIBLE,
        "trajectory": _TRAJECTORY,
        "q": "path, one configuration per row",
        "save": _SAVE,
    },
    BotOp: {
        "q": "get_q()",
        "execute": "follow(plan), then wait(C)",
        "followTrajectory": "follow(plan), then wait(C)",
        "gripperPos": "getGripperPos(gripper)",
        "step": "sync(C, seconds)",
        "sleep": "sync(C, seconds)",
        "getJointState": "get_q()",
        "isMoving": "getTimeToEnd() > 0",
        "goHome": "home(C)",
        "openGripper": "gripperMove(0, width)",
        "closeGripper": "gripperClose(0)",
        "grasp": "gripperClose(0), then wait(C, forTimeToEnd=False, forGripper=True)",
        "release": "gripperMove(0, width)",
        "moveToPose": "moveTo(ry.solveIk(C, {name: pose}).q), or moveLinear(name, pose)",
        "setVelocity": "setLimits(velocity=...)",
    },
    Simulation: {
        "q": "get_q()",
        "follow": "ry.BotOp(C) simulates a robot that follows a plan: bot.follow(plan), then bot.wait(C)",
        "reset": "getState() and setState(state)",
        "time": "get_t()",
        "getTime": "get_t()",
        "getImage": "getImageAndDepth()",
        "addForce": "applyForce(frame, force)",
    },
    ConfigurationViewer: {
        "show": "C.view()",
        "screenshot": "savePng(file), getRgb()",
        "saveImage": "savePng(file)",
        "saveVideo": "ry.saveFilm(file, C, plan)",
        "saveFilm": "ry.saveFilm(file, C, plan)",
    },
}
