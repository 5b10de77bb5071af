#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

/// Tolerance of margins: motions are planned with them, and checked with this much less, m.
inline constexpr double kMarginSlack = 2e-4;

/// Two bodies and their distance, m.
struct NearBodies {
  std::string a, b;
  double distance = 0.;
};

/// The bodies around a motion of an action. Some contacts are meant: of the hand with the object that it takes or has
/// put down, of the object with what it stands on, of a pusher, of a door with its case. All other pairs keep a margin.
/// While the hand is more than 8 cm away from both ends of the motion, all pairs keep it. Contacts of a push, of a
/// guided door, and of the initial configuration are meant during the whole motion. Pairs that are equally near at both
/// ends, such as a base and its floor, keep no margin.
class Surroundings {
 public:
  /// `C`: the scene of the motion, with held objects attached; it must outlive the surroundings. The motion leads from
  /// q0 to q1; `before` is the action that ended at q0, empty if there is none.
  Surroundings(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
               const TaskAction& before, const std::vector<std::string>& hands);

  /// Returns the first violation along a path, checked continuously: a joint limit, an overlap of more than 1 mm, or a
  /// pair whose contact is not meant, and that is closer than `margin` (m). "" if there is none.
  std::string violation(const MatrixXd& path, double margin) const;
  bool isFree(const MatrixXd& path, double margin) const { return violation(path, margin).empty(); }

  /// Returns the nearest pair of bodies, among those whose contact is not meant, at the rows of a path. Its distance is
  /// `limit` if none is closer. With `of_world`, pairs of two parts of the robot, or of what it carries, do not count.
  NearBodies nearest(const MatrixXd& path, double limit, bool of_world = false) const;

 private:
  /// The position of a hand at an end of the motion.
  struct End {
    std::string hand;
    Vector3d at;
  };

  /// For each row of a path, whether a hand is close to an end.
  std::vector<bool> closeToEnds(const MatrixXd& path) const;

  const Config& all_;
  Config unmeant_;                ///< without the pairs whose contact is meant
  std::optional<Config> middle_;  ///< without those whose contact is meant during the whole motion; none: all_
  std::vector<End> ends_;
};

}  // namespace kinegraph::inline task_planning_internal
