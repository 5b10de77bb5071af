#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/task_planning/search/task_plan.h"

namespace kinegraph::inline api_internal {

/// The cosine of the angle between the orientation of an object and another one. It ignores rotations after which the
/// object looks the same: those of round objects about their axis, and all of balls.
double cosineBetween(const Frame& obj, const Matrix3d& rotation);

/// Whether the same side of an object points up in another orientation, to 10 degrees. Lying round objects may roll.
bool hasSameSideUp(const Frame& obj, const Matrix3d& rotation);

/// Whether an object leans against a wall of the narrow place that it stands on, as a pen does in a cup: it is longer
/// than the place is wide, tilted by up to 45 degrees against an orientation, and touches another part of the place.
bool leansInside(const Config& C, const std::string& obj, const std::string& place, const Matrix3d& rotation);

/// The orientations that objects shall have at the end of an execution, as far as the side that points up matters.
class StandingSides {
 public:
  /// Takes over the end of a first plan. Later plans matter only for objects that they turn over.
  void setPlan(const TaskPlan& plan);

  /// Returns the objects, but for those in hands, of which another side points up.
  std::vector<std::string> fallen(const Config& C, const std::map<std::string, std::string>& in_hands) const;

  /// Returns literals of a goal, (up axis obj), with which objects stand as they shall; with them those that lie, which
  /// such a goal would put up. Empty without objects.
  std::string asGoal(const std::vector<std::string>& objects) const;

 private:
  std::map<std::string, Matrix3d> rotations_;
};

}  // namespace kinegraph::inline api_internal
