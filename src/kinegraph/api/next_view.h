#pragma once

#include <string>

#include "kinegraph/perception/occupancy_map.h"
#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {

/// A configuration that holds a camera, and the motion to get there.
struct NextView {
  VectorXd q;           ///< the configuration: collision-free and within limits; empty if there is none
  Pose pose;            ///< of the camera there, in the world
  int visible = 0;      ///< cells in question that the camera should see from there
  int cells = 0;        ///< cells in question
  MotionPlan plan;      ///< the motion from the scene's configuration to `q`
  std::string message;  ///< "" if there is a view, else why there is none

  bool feasible() const { return plan.feasible(); }
  std::string str() const;
};

struct NextViewOptions {
  double nearest = .25, farthest = .8;  ///< distance of the camera from the cells in question, m
  double margin = .005;                 ///< kept by the configuration and the motion, m

  /// Throws ValueError for invalid numbers.
  void validate() const;
};

/// Finds a view that answers the question of a plan: whether the unseen cells that prevent the motion
/// (plan.blockedByUnseen) are free.
///
/// Eyes are tried in directions and at distances around these cells, in the order of the number of cells that neither
/// occupied cells nor shapes of the scene hide.
/// The first ones with a configuration and a collision-free motion to it are compared, with the robot itself in view.
/// The scene must have the map attached (OccupancyMap::attach), so that the motion leads through free space only.
/// Deterministic.
///
/// Throws ValueError if the plan is not blocked by unseen cells, and if no joint moves the camera.
NextView nextView(const Config& config, const OccupancyMap& map, const std::string& camera, const MotionPlan& plan,
                  const NextViewOptions& options = {});

}  // namespace kinegraph
