#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/ik/ik_task.h"
#include "kinegraph/ik/low_discrepancy.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph {

/// What inverse kinematics needs of a Config, computed once: immutable, shared by all attempts, problems and threads.
/// Its variables x are the dofs that move a target.
struct IkProblem {
  using Task = IkTask;

  /// Throws FrameNotFound, and ValueError for what makes no sense.
  IkProblem(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options);

  int variables() const { return int(dofs.size()); }

  /// x of starting point i: the Config's own, or one of the sequence.
  void startingPoint(int i, double* x) const;

  /// Brings quaternions among the dofs back to norm one.
  void normalize(double* x) const;

  IkOptions options;
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  std::vector<Task> tasks;
  int rows = 0;
  std::vector<int> dofs;                   ///< entry of q per variable
  std::vector<int> variable;               ///< per entry of q, -1 if it does not move
  VectorXd q;                              ///< of the Config, within the limits
  VectorXd lower, upper;                   ///< per variable
  VectorXd longest;                        ///< per variable: of a step
  VectorXd nearest;                        ///< per variable: where answers are wanted
  bool pulls = false;                      ///< the answer is to be brought as near to `nearest` as the targets allow
  std::vector<std::pair<int, int>> pairs;  ///< of frames that the variables move relative to each other
  std::optional<BodyPairs> bodies;         ///< of these pairs
  std::string in_the_way;                  ///< pairs that collide whatever the variables are, in words; "" if none do

 private:
  void chooseVariables(const State& state);
  void requireAtRest(const Task& task) const;
  void choosePairs();
  void describeStuck(const std::vector<std::pair<int, int>>& unmoved);

  VectorXd draw_lower_, draw_upper_;
  std::vector<std::pair<int, int>> norms_;  ///< first variable and count
  LowDiscrepancy sequence_{0, 0};
};

/// The frame whose joint has a dof.
const std::string& jointName(const KinematicModel& model, int dof);

}  // namespace kinegraph
