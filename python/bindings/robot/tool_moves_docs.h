#pragma once

/// The docstrings of bind_tool_moves.cpp. Each has a first sentence, `moveAbout`, its own arguments, `moveOptions`, and
/// `moveReturns`.
namespace kinegraph::python::docs::robot {

inline constexpr char moveAbout[] = R"(

The motion is that of planToolPath and starts where the present motion ends: the tool's deviation and freedom of
collisions are proven, and the limits of the robot hold. Without a motion the robot gets no command, and a
KinegraphWarning has the place and the cause. Does not wait.

Args:
)";

inline constexpr char moveFrame[] =
    R"(    frame: Name of the frame that moves, the tool.
)";

inline constexpr char moveOptions[] =
    R"(    speed: Speed of the tool, m/s.
    tolerance: Largest distance of the tool from its curve, m.
    rotation_tolerance: Largest rotation of the tool from its curve, rad.
    margin: Distance that all pairs keep, m.
    touching: Names of frames that the tool's link may touch.
    velocity: Limit of |dq/dt|, a number or one per joint, in addition to the robot's. None: the robot's.
    acceleration: Limit of |d2q/dt2|, likewise. None: full speed within a quarter of a second.
    jerk: Limit of |d3q/dt3|. None: no limit.
    tool_acceleration: Limit along the curve, m/s^2.
    tool_jerk: Limit along the curve, m/s^3; counts if jerk is given.
    time_limit: Ends the search after so many seconds.
    overwrite: True: the robot brakes now, and the motion starts where it comes to rest. False: it starts at the end of
        the present motion.
)";

inline constexpr char moveReturns[] =
    R"(Returns:
    The ToolPathPlan. If it is not feasible, status, message and where tell why.
Raises:
    FrameNotFound: A frame does not exist.
    ArgumentError: An argument is invalid, or the motion exceeds an effort limit.
    RobotFault: The robot was stopped, or is not at the start of the motion.)";

inline constexpr char moveLinear[] = "Moves a tool along a straight line and rests at its end.";
inline constexpr char moveLinearArgs[] =
    R"(    target: Its end in the world, shape (7,): x y z qw qx qy qz, m; or (3,) to keep the rotation.
)";

inline constexpr char moveCircular[] = "Moves a tool along a circular arc and rests at its end.";
inline constexpr char moveCircularArgs[] =
    R"(    via: A position on the arc, shape (3,), m.
    target: Its end in the world, shape (7,): x y z qw qx qy qz, m; or (3,) to keep the rotation.
)";

inline constexpr char moveSequence[] = "Moves a tool along straight lines through several poses and rests at the end.";
inline constexpr char moveSequenceArgs[] =
    R"(    targets: Sequence of poses in the world, shape (7,) each; or (3,) to keep the rotation.
    blend: Radius (m) within which a smooth curve replaces each corner; 0: the tool stops at corners.
)";

inline constexpr char moveSequencePath[] = "Moves a tool along a ToolPath and rests at its end.";
inline constexpr char moveSequencePathArgs[] =
    R"(    path: The ToolPath. A collision-free motion, the transfer, leads to a start of its own and to an approach.
)";
inline constexpr char moveSequencePathOptions[] =
    R"(    approach: Length (m) of a straight approach before the path, as in planToolPath. 0: none.
    retract: Length (m) of a straight retract after the path. 0: none.
    flow: Where the transfer ends with the speed of what follows, if that takes less time: "approach"; "path" also at a
        path without an approach; "none": it ends at rest.
)";

}  // namespace kinegraph::python::docs::robot
