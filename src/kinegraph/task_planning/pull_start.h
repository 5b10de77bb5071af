#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// Whether a sequence pulls an object with a bar.
bool pullsWithBar(const Config& C, const std::vector<TaskAction>& actions);

/// Returns the default displacement of a pull on the current place of an object, m: .2 m towards the hand, along the
/// side of a box that the variant names (x, y), else straight. `end`: hook_end (obj hook to tool hand).
Vector3d usualPull(const Config& C, const TaskAction& end, const std::string& variant);

/// Builds the initial guess of a sequence with a pull, action by action, so that grasps, placements and joints fit each
/// other. Hands come from above, at several inclinations.
class PullStart {
 public:
  /// `slot` returns the index of the dofs of an added frame in x, -1 for unknown names. `rng` samples the order of
  /// grips and the length of pulls.
  PullStart(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants,
            std::function<int(const std::string&)> slot, Rng* rng);

  /// Returns the joints after an action that begins at q, and writes the dofs of its slots to x. None if no guess fits.
  std::optional<VectorXd> after(std::size_t action, const VectorXd& q, VectorXd& x);

 private:
  struct Pull {
    Pose begin;             ///< pose of the bar
    Vector3d displacement;  ///< m
  };

  std::optional<VectorXd> pick(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> place(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> beginPull(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> endPull(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<Pull> pullOf(std::size_t begin, const VectorXd& x) const;
  std::optional<std::size_t> nextPullWith(const std::string& tool, std::size_t from) const;
  Pose barBehind(const TaskAction& begin, const Pose& obj, const Vector3d& displacement) const;
  std::vector<Pose> gripsOf(std::size_t pick) const;
  std::optional<VectorXd> reach(const std::string& hand, const Pose& there, const VectorXd& q, int attempts) const;
  std::optional<VectorXd> reachWithTool(const TaskAction& begin, const Pose& bar, const VectorXd& q,
                                        int attempts) const;

  const Config& C_;
  const std::vector<TaskAction>& actions_;
  const std::vector<std::string>& variants_;
  std::function<int(const std::string&)> slot_;
  Rng* rng_;
  double share_;                      ///< factor on the default length of a pull
  std::map<std::string, Pose> at_;    ///< poses of objects
  std::map<std::string, Pose> grip_;  ///< poses of held objects in the hand
};

}  // namespace kinegraph::inline task_planning_internal
