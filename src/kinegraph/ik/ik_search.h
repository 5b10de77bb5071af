#pragma once

#include <memory>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/ik/ik_iterate.h"
#include "kinegraph/ik/solve_ik.h"

namespace kinegraph::inline ik_internal {

/// Solves problems that differ in the numbers of their targets only. One per thread.
class IkSearch {
 public:
  explicit IkSearch(std::shared_ptr<const IkProblem> problem);

  /// Solves one problem; `targets` have the problem's frames and kinds.
  /// `start` is the configuration (n,) of the first attempt; null: the Config's.
  IkResult solve(const std::vector<IkTarget>& targets, const CancellationToken& cancellation,
                 const VectorXd* start = nullptr);

  // The stages of solve, for callers that compute the approaches themselves: open, assess until it returns true,
  // finish.
  void open(IkJob& job, const std::vector<IkTarget>& targets, const VectorXd* start = nullptr);

  /// Completes attempt number `job.attempts`, whose approach ended at x, and records its result. Returns true if no
  /// further attempt is needed.
  bool assess(IkJob& job, const VectorXd& x, const IkApproach& approach, const CancellationToken& cancellation);
  IkResult finish(IkJob& job, bool cancelled, const CancellationToken& cancellation);

  /// Returns true if an approach should be abandoned at this step. `before` is its memory, large at first.
  static bool stalls(int step, double square, double& before);

 private:
  enum class Outcome { feasible, missed, cancelled };
  IkApproach approach();
  Outcome avoidCollisions(const CancellationToken& cancellation);
  Outcome moveApart(int steps, const CancellationToken& cancellation);
  Outcome approachPreferred(const CancellationToken& cancellation);
  double costOf(const VectorXd& x) const { return (x - job_->preferred).squaredNorm(); }
  bool polish(const CancellationToken& cancellation);
  std::string askAboutQuaternions(const IkJob& job, const CancellationToken& cancellation);

  std::shared_ptr<const IkProblem> problem_;
  IkIterate iterate_;
  IkJob* job_ = nullptr;  ///< the job that is being worked on
  VectorXd step_, best_;
};

}  // namespace kinegraph::inline ik_internal
