#pragma once

#include <optional>

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// Checks a plan by playing it in a copy of the scene. Returns the violations, a sentence each. The check knows the
/// scene, the actions and the motion, and nothing of the search. Objects move only by being taken along.
///
/// - Logic: the goal holds after the last action. `states`, as of statesAlong, has the facts; without them this is
/// skipped.
/// - Timing: the motion does not jump, rests at the beginning and the end of each action, and keeps its velocity and
///   acceleration limits.
/// - Joints stay within their limits, and nothing overlaps by more than 1 mm, continuously (Config::checkMotion).
/// - Pairs whose contact is not meant keep `margin` (m); none: that of the plan. Slides and doors are exempt.
/// - A hand touches the object that it takes, to 1 mm.
/// - An object that is put down stands level to half a degree, at the height of its place to 1 mm, with its center 5 mm
///   inside the edges. Its center of mass, with everything fixed to it, is above the area shared with the place.
/// - Objects that stand on a carried object tilt by less than 5 degrees and are accelerated by at most 2 m/s^2.
/// - A pushed object moves straight and level, away from the pusher and from the contact. A tool that pulls is held.
/// - Doors move only while a hand holds their handle to 1 mm and half a degree, except for the rotation that a round
/// handle   allows. Afterwards they are open or closed.
/// - At rest, nothing overlaps. An object that is held at the start may overlap the robot as it does then, until it is
/// put   down and the hand has left it.
///
/// Throws ValueError for a plan whose parts do not fit each other or the scene.
std::vector<std::string> checkTaskPlan(const Config& C, const TaskPlan& plan,
                                       const std::vector<std::vector<Literal>>& states = {},
                                       std::optional<double> margin = {});

}  // namespace kinegraph
