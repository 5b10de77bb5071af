#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/held_shapes.h"
#include "kinegraph/task_planning/task_waypoints.h"

namespace kinegraph::inline task_planning_internal {

/// Returns the distance by which the fingers of a hand reach beyond its frame, m; 0 without modeled fingers.
double fingerReach(const Config& C, const std::string& hand);

/// Returns the colliding shapes of the fingers of a hand: those of its link that inactive joints move.
std::vector<std::string> fingerShapes(const Config& C, const std::string& hand);

/// Adds the frame by which a hand holds an object in a variant of graspVariants. It is shifted from the hand's frame
/// towards the tips of the fingers if the object is so low that they would meet the ground otherwise. Returns its name:
/// that of the hand if it is not shifted.
std::string addGripFrame(Config& scene, const std::string& hand, const std::string& obj, const std::string& variant);

/// Returns an initial guess of a grasp by a part of a body of several shapes; none for other grasps.
std::optional<GraspGuess> graspGuess(const Config& C, const std::string& obj, const std::string& hand,
                                     const std::string& variant);

/// Adds the constraints of a grasp at a time. `inside`: the distance of the grasp from the ends of the shape, m.
void addGrasp(TaskWaypoints& w, double time, const std::string& hand, const std::string& obj,
              const std::string& variant, double inside = kGraspInside);

/// Returns the beginning of a message: an object does not fit between the fingers of a hand, with their openings. The
/// attribute `least_opening` of the hand's frame is that of fingers that do not close completely.
std::string graspMisfit(const Config& C, const std::string& obj, const std::string& hand);

/// Returns why fingers do not get around an object as it lies: it is too wide across and lies flat, or it is too thin;
/// "" for other objects.
std::string graspFlaw(const Config& C, const std::string& obj, const std::string& place, const std::string& hand);

}  // namespace kinegraph::inline task_planning_internal
