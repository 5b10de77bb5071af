#pragma once

#include <atomic>
#include <vector>

#include "kinegraph/planning/ik_search.h"
#include "kinegraph/planning/lane_kernel.h"

namespace kinegraph {

/// The kinematics of a problem for lane_kernel.h, and who owns its arrays.
class IkLaneModel {
 public:
  explicit IkLaneModel(const IkProblem& problem);

  /// False where a joint has quaternions, or there are too many rows: lanes cannot do these.
  bool supported() const { return supported_; }
  LaneModel view() const;

 private:
  void addLinks(const IkProblem& problem);
  void addTasks(const IkProblem& problem);

  bool supported_ = true;
  int variables_, rows_;
  std::vector<int> lane_link_;        ///< per link of the Program, -1 if it moves no target
  std::vector<LaneModel::Link> link_;
  std::vector<LaneModel::Step> step_;
  std::vector<LaneModel::Task> task_;
  std::vector<int> column_;
  const double *lower_, *upper_, *longest_;  ///< the problem's
};

/// Memory for a number of lanes.
struct LaneBuffer {
  LaneBuffer(const LaneModel& model, int lanes);
  LaneBuffer(const LaneBuffer&) = delete;

  LaneMemory memory;

 private:
  std::vector<double> storage_;
};

/// Solves problems that differ in their targets, several attempts side by side in the lanes of wide registers: of different
/// problems while there are some, else of the same ones. Attempts of a problem are judged in their order, so that lanes
/// and their number do not change answers.
class IkLanes {
 public:
  explicit IkLanes(std::shared_ptr<const IkProblem> problem);

  /// results[i] answers problems[i]; `done` counts them.
  void solve(const std::vector<IkTarget>* problems, int count, IkResult* results, std::atomic<int>& done, const Stop& stop);

 private:
  /// An attempt that has ended and waits for those before it to be judged.
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
  void judgeEnded(int open);
  void close(int open, bool cancelled);
  double& at(double* rows, int row, int lane) const { return rows[row * kernel_.lanes + lane]; }

  std::shared_ptr<const IkProblem> problem_;
  IkLaneModel model_;
  LaneModel view_;
  LaneKernel kernel_;
  IkSearch search_;
  LaneBuffer buffer_;
  const LaneMemory& memory_;
  std::vector<Open> open_;
  std::vector<Lane> lanes_;
  VectorXd start_;

  const std::vector<IkTarget>* problems_ = nullptr;
  IkResult* results_ = nullptr;
  std::atomic<int>* done_ = nullptr;
  const Stop* stop_ = nullptr;
  int count_ = 0, next_ = 0;
  bool cancelled_ = false;
};

}  // namespace kinegraph
