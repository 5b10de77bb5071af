#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/ik/ik_task.h"
#include "kinegraph/ik/low_discrepancy.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph::inline ik_internal {

/// The data of a Config that inverse kinematics needs, computed once. It is immutable and shared by all attempts,
/// problems and threads. Its variables x are the dofs that move a target.
struct IkProblem {
  using Task = IkTask;

  /// Throws FrameNotFound, and ValueError for invalid targets or options.
  IkProblem(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options);

  int variables() const { return int(dofs.size()); }

  /// Writes starting point i: `first` for i = 0, the Config's own x if it is empty, else a point of the sequence.
  void startingPoint(int i, double* x, const VectorXd& first = {}) const;

  /// The variables of a configuration (n,), within the limits.
  VectorXd variablesOf(const VectorXd& q) const;

  /// The x from which the cost of answers is measured for a start: the start, or its mean with the home pose.
  VectorXd preferredFor(const VectorXd& start) const;

  /// Scales quaternions among the variables to norm one.
  void normalize(double* x) const;

  IkOptions options;
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  std::vector<Task> tasks;
  int rows = 0;
  std::vector<int> dofs;                   ///< entry of q per variable
  std::vector<int> variable;               ///< per entry of q; -1 for constant ones
  VectorXd q;                              ///< of the Config, within the limits
  VectorXd lower, upper;                   ///< per variable
  VectorXd longest;                        ///< per variable: largest step
  VectorXd preferred;                      ///< per variable: preferredFor the Config's own x
  bool has_preference = false;             ///< answers are moved as close to the preferred x as the targets allow
  std::vector<std::pair<int, int>> pairs;  ///< frames that the variables move relative to each other
  std::optional<BodyPairs> bodies;         ///< the bodies of `pairs`
  std::string blocking;  ///< description of the pairs that collide for all values of the variables; "" if none do
  std::string slight;    ///< the same of those that overlap by max_start_penetration at most
  std::string question;  ///< about a target that seems to be in the order x y z w; "" if none does

 private:
  void chooseVariables(const State& state);
  void requireAtRest(const Task& task) const;
  void choosePairs();
  void describeUnmoved(const std::vector<std::pair<int, int>>& unmoved);

  VectorXd sample_lower_, sample_upper_;
  std::vector<std::pair<int, int>> norms_;  ///< first variable and count
  LowDiscrepancy sequence_{0, 0};
};

/// Returns the name of the frame whose joint has a dof.
const std::string& jointName(const KinematicModel& model, int dof);

}  // namespace kinegraph::inline ik_internal
