#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// Does a sequence pull something with a bar?
bool pullsWithBar(const Config& C, const std::vector<TaskAction>& actions);

/// The way of a pull to anywhere on the place that something stands on: .2 m towards the hand, along the side of a box that
/// the variant names (x, y), else straight; m. `end`: hook_end (obj hook to tool hand).
Vector3d usualPull(const Config& C, const TaskAction& end, const std::string& variant);

/// A starting point of a sequence in which something is pulled, action by action: grasps, placements and joints fit each
/// other. A hand comes from above, more or less inclined.
class PullStart {
 public:
  /// `slot`: where the dofs of an added frame are in x, -1 if there is none of that name. `rng` draws which grips are tried
  /// first, and how far is pulled.
  PullStart(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants,
            std::function<int(const std::string&)> slot, Rng* rng);

  /// Joints after an action that begins at q. The dofs of its slots are entered in x. None where nothing was found that
  /// fits.
  std::optional<VectorXd> after(std::size_t action, const VectorXd& q, VectorXd& x);

 private:
  struct Pull {
    Pose begin;    ///< of the bar
    Vector3d way;  ///< m
  };

  std::optional<VectorXd> pick(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> place(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> beginPull(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<VectorXd> endPerturbation(std::size_t i, const VectorXd& q, VectorXd& x);
  std::optional<Pull> pullOf(std::size_t begin, const VectorXd& x) const;
  std::optional<std::size_t> nextPullWith(const std::string& tool, std::size_t from) const;
  Pose barBehind(const TaskAction& begin, const Pose& obj, const Vector3d& way) const;
  std::vector<Pose> gripsOf(std::size_t pick) const;
  std::optional<VectorXd> reach(const std::string& hand, const Pose& there, const VectorXd& q, int attempts) const;
  std::optional<VectorXd> reachWithTool(const TaskAction& begin, const Pose& bar, const VectorXd& q,
                                        int attempts) const;

  const Config& C_;
  const std::vector<TaskAction>& actions_;
  const std::vector<std::string>& variants_;
  std::function<int(const std::string&)> slot_;
  Rng* rng_;
  double share_;                      ///< of the usual length of a pull
  std::map<std::string, Pose> at_;    ///< where objects are
  std::map<std::string, Pose> grip_;  ///< of what is held, in the hand
};

}  // namespace kinegraph
