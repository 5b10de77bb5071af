#pragma once

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph {

/// Plays a plan in a copy of the scene, and says what is wrong, a line each; none if nothing is. It knows the scene, the
/// actions and the motion, and nothing of how they were found: objects are taken along from where they are, never moved
/// otherwise.
///
/// Looked at: that the goal holds in logic after the last action (where `states`, as of statesAlong, are given); that the
/// motion does not jump, is at rest where an action begins and ends, and keeps its limits of velocity and acceleration;
/// that joints are within their limits and nothing overlaps by more than 1 mm, at all times and not only in samples
/// (Config::checkMotion); that a hand touches what it takes, to 1 mm; that what is put down stands level to half a degree,
/// at the height of its place to 1 mm, with its center 5 mm inside the edges, and its center of mass, with all that is fixed
/// to it, above what it shares with the place; that what stands on something that is
/// carried tilts by less than 5 degrees and is accelerated by at most 2 m/s^2; that what is pushed moves straight and
/// level, away from what pushes it and from where their surfaces touch, and what is pulled by a tool that a hand holds; that
/// doors move only while a hand that has taken their handle holds it to 1 mm and half a degree (as far as a round handle
/// does not turn in it), and are open or closed then; and that nothing that is at rest then overlaps.
/// What a hand holds at the start may overlap the robot as it does then, until it is put down and the hand has left it.
/// Throws ValueError for a plan whose parts do not fit each other and the scene.
std::vector<std::string> checkTaskPlan(const Config& C, const TaskPlan& plan,
                                       const std::vector<std::vector<Literal>>& states = {});

}  // namespace kinegraph
