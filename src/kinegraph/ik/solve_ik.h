#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/ik/ik_target.h"
#include "kinegraph/nlp/parameter.h"

namespace kinegraph::inline ik_internal {
struct IkProblem;
}

namespace kinegraph {
/// How solveIk ended.
enum class IkStatus {
  solved,            ///< all targets are within tolerance, and no pair is closer than the margin
  goal_unreachable,  ///< no attempt succeeded; the best one misses a target
  in_collision,      ///< no attempt succeeded; the best one meets its targets, but pairs are closer than the margin
  cancelled,         ///< the search was cancelled before it found an answer
};

std::string ikStatusName(IkStatus status);

struct IkRequest;
/// The answer of solveIk, with its errors.
struct IkResult {
  VectorXd q;  ///< (n,), within the limits: the answer, or the attempt with the least error
  IkStatus status = IkStatus::cancelled;
  double position_error = 0.;  ///< of the worst target, m
  double rotation_error = 0.;  ///< of the worst target, rad
  double feature_error = 0.;   ///< largest component of a feature's error, in its units times its scale
  double penetration = 0.;     ///< how much closer than the margin the worst pair is, m
  int attempts = 0;            ///< number of starting points used
  int evals = 0;               ///< evaluations of the forward kinematics with Jacobian
  std::string message{};       ///< "" if solved, else the missed targets with their errors, and the pairs that collide
  std::vector<std::string> warnings{};         ///< caveats of the answer, such as fingers that touch at the start
  std::shared_ptr<const IkRequest> request{};  ///< input of makeNlp; null for results loaded from a file
  int number = 0;                              ///< index of the problem in the request

  bool feasible() const { return status == IkStatus::solved; }
  std::string str() const;  ///< "solved in 2 attempts, within 1e-8 m and 3e-9 rad", or the status and the message
};

/// Finds joint values within their limits that bring frames to their targets without collisions.
///
/// The method takes damped Gauss-Newton steps on positions and rotation vectors from many starting points: first the q
/// of the Config, then an additive (Kronecker) low-discrepancy sequence. An attempt that reaches its targets in
/// collision continues with the distances as additional rows.
///
/// Joints that move no target relative to its reference frame keep their values. Only pairs that joints move relative
/// to each other count as collisions. If only joints that keep their values could separate such a pair, an overlap of
/// up to `max_start_penetration` is a warning, as at the start of planMotion; if it is deeper, the status is not
/// `solved`.
///
/// The Config is not changed, and the same arguments give the same bits. Throws FrameNotFound, and ValueError for
/// targets that no active joint moves, and for targets taken from a frame that the targets move.
/// Source: Buss, Introduction to inverse kinematics with Jacobian transpose, pseudoinverse and damped least squares,
/// 2004.
IkResult solveIk(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {},
                 const CancellationToken& cancellation = {});

/// Solves one problem per entry of `problems`. All must have the frames and kinds of the first one's targets; otherwise
/// throws ValueError. Each result equals that of `solveIk`, for any number of threads. The calling
/// thread regularly calls `progress` with the number of solved problems and asks `cancellation`, which ends the search
/// with the best answers so far. `starts` as for IkSolver::solve.
std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options = {}, int threads = 1,
                                   const ProgressCallback& progress = {}, const CancellationToken& cancellation = {},
                                   std::vector<VectorXd> starts = {});

/// Finds all solutions, the nearest to the Config's q first. Solutions that differ by whole turns of hinges count once,
/// with the turns that are the nearest to q.
///
/// The pose of a frame that six hinges move has solutions in closed form if the arm has a spherical wrist or shoulder,
/// or three parallel axes as UR arms have (closed_form.h). If six of seven hinges are such an arm, the other one steps
/// over its range in 32 steps: these are samples of curves of solutions. Other targets have the solutions that the
/// method of solveIk finds from `options.attempts` starting points, and perhaps more. That method checks and polishes
/// each solution: it is within limits and tolerances, and collision-free if `options.collisions`.
///
/// Without a solution, the only result is that of solveIk, with its message. Throws as solveIk does.
std::vector<IkResult> solveIkAll(const Config& config, const std::vector<IkTarget>& targets,
                                 const IkOptions& options = {}, const CancellationToken& cancellation = {});

/// solveIk in two stages: the constructor computes everything that does not depend on the numbers of the targets,
/// `solve` searches. The solver copies the data of the Config, so `solve` may run while the Config changes.
class IkSolver {
 public:
  /// Uses all of `targets` except their poses, directions and values.
  IkSolver(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {});

  /// `starts` has the configuration (n,) of the first attempt of each problem; empty: the q of the Config. The options
  /// `best` and `start_weight` measure the distance of answers from there. Throws ValueError for another number.
  std::vector<IkResult> solve(std::vector<std::vector<IkTarget>> problems, int threads = 1,
                              const ProgressCallback& progress = {}, const CancellationToken& cancellation = {},
                              std::vector<VectorXd> starts = {}) const;

 private:
  std::shared_ptr<const IkProblem> problem_;
};

/// Input of solveIk, which its results hold for makeNlp.
struct IkRequest {
  std::shared_ptr<const IkProblem> problem;
  std::vector<std::vector<IkTarget>> problems;
  std::vector<VectorXd> starts{};  ///< of the first attempts, (n,); empty: the q of the Config
};

/// Returns the optimization problem that an answer of solveIk solves, in the neighborhood of that answer. Targets are
/// equalities of q, or inequalities for bounds; near pairs are inequalities, and limits are bounds. If the answer was
/// moved close to a preferred configuration, the squared distance from it is the cost. Joints that move no target are
/// fixed by bounds. Throws ValueError for a result without a solution or without a request, such as one loaded from a
/// file.
std::shared_ptr<Nlp> makeNlp(const IkResult& result);

/// Returns the number of a target from the name of its frame or feature. Throws NameError unless exactly one matches.
int ikTargetNumber(const Nlp& nlp, const std::string& name);

int ikTargetCount(const Nlp& nlp);  ///< Returns the number of targets.

/// Returns the numbers of a target as a parameter, in their original order:
/// - position or gaze: x y z (m)
/// - pose: x y z, then a rotation vector r (rad) about its own origin, R <- exp(r) R
/// - rotation: the rotation vector alone
/// - direction or feature: its entries
///
/// Axes are those of the frame that the target is relative to. `nlp` comes from makeNlp. Throws ValueError if there is
/// no such target.
std::shared_ptr<NlpParameter> ikTarget(const Nlp& nlp, int target);

}  // namespace kinegraph
