#pragma once

#include <atomic>
#include <vector>

#include "kinegraph/ik/ik_kernel.h"
#include "kinegraph/ik/ik_search.h"
#include "kinegraph/kinematics/lane_kinematics.h"

namespace kinegraph::inline ik_internal {

/// The kinematics of a problem as arrays for ik_kernel.h, which this class owns.
class IkLaneModel {
 public:
  explicit IkLaneModel(const IkProblem& problem);

  /// False if the lanes cannot solve the problem: a joint has quaternions, there are too many rows, or a target is
  /// neither a pose nor a direction in the world.
  bool supported() const { return supported_; }
  IkKernelModel view() const;

 private:
  void addTasks(const IkProblem& problem);

  bool supported_ = true;
  int rows_;
  LaneLinks links_;
  std::vector<IkKernelModel::Task> task_;
  std::vector<IkKernelModel::Column> column_;
  const double *lower_, *upper_, *longest_;  ///< owned by the problem
};

/// Memory for a number of lanes.
struct LaneBuffer {
  LaneBuffer(const IkKernelModel& model, int lanes);
  LaneBuffer(const LaneBuffer&) = delete;

  IkKernelMemory memory;

 private:
  std::vector<double> storage_;
};

/// Solves problems that differ in their targets, several attempts side by side in the lanes of wide registers. Lanes
/// take attempts of different problems first, then further attempts of the same ones. The attempts of a problem are
/// assessed in their order, so the number of lanes does not change answers.
class IkLanes {
 public:
  /// `width`: number of lanes, one of laneWidths(); 0 selects the largest.
  explicit IkLanes(std::shared_ptr<const IkProblem> problem, int width = 0);

  /// Writes the result of problems[i] to results[i]; `done` counts solved problems. `starts` are the configurations
  /// (n,) of first attempts, one per problem; null: the Config's.
  void solve(const std::vector<IkTarget>* problems, const VectorXd* starts, int count, IkResult* results,
             std::atomic<int>& done, const CancellationToken& cancellation);

 private:
  /// An attempt that has ended and waits until all earlier ones are assessed.
  struct Ended {
    int attempt;
    IkApproach approach;
    VectorXd x;
  };
  struct Open {
    int problem = -1;  ///< -1: free
    IkJob job;
    int next_attempt = 0;
    std::vector<Ended> ended;
  };
  struct Lane {
    int open = -1;  ///< -1: idle
    int attempt = 0;
    int evals = 0;
    double before = 0.;
  };

  bool fill(int lane);
  void start(int lane, int open);
  void advance(int lane);
  void end(int lane, bool met);
  void assessEnded(int open);
  void close(int open, bool cancelled);
  double& at(double* rows, int row, int lane) const { return rows[row * kernel_.lanes + lane]; }

  std::shared_ptr<const IkProblem> problem_;
  IkLaneModel model_;
  IkKernelModel view_;
  IkKernel kernel_;
  IkSearch search_;
  LaneBuffer buffer_;
  const IkKernelMemory& memory_;
  std::vector<Open> open_;
  std::vector<Lane> lanes_;
  VectorXd start_;

  const VectorXd* startOf(int problem) const { return starts_ ? starts_ + problem : nullptr; }

  const std::vector<IkTarget>* problems_ = nullptr;
  const VectorXd* starts_ = nullptr;
  IkResult* results_ = nullptr;
  std::atomic<int>* done_ = nullptr;
  const CancellationToken* cancellation_ = nullptr;
  int count_ = 0, next_ = 0;
  bool cancelled_ = false;
};

}  // namespace kinegraph::inline ik_internal
