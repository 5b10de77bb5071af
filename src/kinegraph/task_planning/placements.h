#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// The base of an upright object: its extent along x and y of its frame, m.
struct Footprint {
  Eigen::Vector2d low = Eigen::Vector2d::Zero(), high = Eigen::Vector2d::Zero();
  double radius = 0.;     ///< of the circle around the origin that contains it
  double height = 0.;     ///< of the object
  bool is_round = false;  ///< the circle itself

  /// Half of the sides of a rectangle around the origin that contains it.
  Eigen::Vector2d half() const { return low.cwiseAbs().cwiseMax(high.cwiseAbs()); }
};

/// Returns the footprint of a body with everything fixed to it, after a rotation; a point without shapes. Its axes are
/// those of the rotated frame.
Footprint footprintOf(const Frame& body, const Matrix3d& rotation = Matrix3d::Identity());

/// The variant of `place` that puts an object down on the side on which it lies now (restingRotation).
inline constexpr char kAsItLies[] = "as it lies";

/// Where an object is put.
struct Placement {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< position in the frame of the place, m
  double angle = 0.;                             ///< rotation about z relative to the place, rad
  bool is_whole = false;                         ///< the whole footprint has room on the place
  bool is_near = false;                          ///< the place is large: `at` is a free spot near the object
};

/// Chooses where the `place` actions of a sequence put their objects; none for other actions. Objects on one place are
/// packed together, apart from each other and from what stands there, and towards the middle. On a large place, such as
/// a table, an object is put down near its current position, where it is in the way of nothing. Objects are put down as
/// they lie, but for those with the variant "upright".
std::vector<std::optional<Placement>> placementsOf(const Config& C, const std::vector<TaskAction>& actions,
                                                   const std::vector<std::string>& variants = {});

}  // namespace kinegraph::inline task_planning_internal
