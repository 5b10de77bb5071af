#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/progress.h"
#include "kinegraph/ik/ik_options.h"
#include "kinegraph/ik/ik_target.h"

namespace kinegraph {

enum class IkStatus {
  solved,            ///< all targets within tolerance, no pair nearer than the margin
  goal_unreachable,  ///< in no attempt; the nearest one misses a target
  in_collision,      ///< in no attempt; the nearest one meets its targets with pairs nearer than the margin
  cancelled,         ///< before there was an answer
};

std::string ikStatusName(IkStatus status);

struct IkQuestion;

struct IkResult {
  VectorXd q;  ///< (n,), within the limits: the answer, or the attempt that missed least
  IkStatus status = IkStatus::cancelled;
  double position_error = 0.;  ///< of the worst target, m
  double rotation_error = 0.;  ///< of the worst target, rad
  double feature_error = 0.;   ///< of the worst row of a feature, in its units times its scale
  double penetration = 0.;     ///< by which the worst pair is nearer than the margin, m
  int attempts = 0;            ///< starting points used
  int evals = 0;               ///< forward kinematics with Jacobian
  std::string message{};       ///< "" if solved, else what misses what by how much, and what is in the way
  std::shared_ptr<const IkQuestion> question{};  ///< for makeNlp (ik_nlp.h); null of a result that was loaded
  int number = 0;                                ///< of the problem there

  bool feasible() const { return status == IkStatus::solved; }
  std::string str() const;  ///< "solved in 2 attempts, within 1e-8 m and 3e-9 rad", or the status and the message
};

/// Joint values within their limits that bring frames to their targets, without collisions.
///
/// Damped Gauss-Newton steps on positions and rotation vectors from many starting points: the Config's q, then an
/// additive (Kronecker) low-discrepancy sequence. An attempt that reaches its targets in collision goes on with the
/// distances as further rows. Joints that move none of the targets stay where they are: those that move a frame and
/// what its target is relative to alike, too. The pairs that count
/// are those that joints move apart; where one that only such joints move is too near, no answer is `solved`. The
/// Config is not changed; the same arguments give the same bits. Throws FrameNotFound, and ValueError for targets that
/// no active joint moves, and for those taken from a frame that the targets move. Source: Buss, Introduction to inverse
/// kinematics with Jacobian transpose, pseudoinverse and damped least squares, 2004.
IkResult solveIk(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {},
                 const CancellationToken& cancellation = {});

/// One problem per entry of `problems`. All have the frames and kinds of the first one's targets; else ValueError.
/// Every result is the one that `solveIk` would give, whatever the number of threads. The calling thread now and then
/// calls `progress` with the number of solved problems, and asks `cancellation`, which ends the search with the best
/// answers so far.
std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options = {}, int threads = 1,
                                   const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

struct IkProblem;

/// The same in two parts: what can be computed before the targets' numbers are known, and the search. It keeps what it
/// needs of the Config as it was, so that `solve` may run while the Config changes.
class IkSolver {
 public:
  /// Of the targets all matters here but poses, directions and values.
  IkSolver(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {});

  std::vector<IkResult> solve(std::vector<std::vector<IkTarget>> problems, int threads = 1,
                              const ProgressCallback& progress = {}, const CancellationToken& cancellation = {}) const;

 private:
  std::shared_ptr<const IkProblem> problem_;
};

}  // namespace kinegraph
