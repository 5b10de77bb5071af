#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/solvers/interface/options.h"

namespace kinegraph::inline solvers_internal {

/// Decides whether an inner problem (minimize the Lagrangian for given multipliers and penalty) is solved well enough
/// to update the multipliers. Each outer iteration is more accurate than the one before.
class InnerTest {
 public:
  static constexpr double kFirstStep = .1;       ///< step tolerance of the first outer iteration
  static constexpr double kStepFall = .3;        ///< factor of the step tolerance per outer iteration,
  static constexpr double kStepFallOfMany = .5;  ///< and for many variables
  static constexpr double kFirstDecrease = .02;  ///< tolerance of the relative decrease in the first outer iteration
  static constexpr double kDecreaseFall =
      .5;  ///< factor of that tolerance per outer iteration, if the constraints hold
  static constexpr double kMinDecrease = 1e-6;
  static constexpr double kMinValue = .01;  ///< least magnitude of the Lagrangian for relative decreases

  explicit InnerTest(bool has_many_variables) : step_fall_(has_many_variables ? kStepFallOfMany : kStepFall) {}

  bool isSolved(double step_size, bool is_damped) const {
    return (step_size <= step_ && !is_damped) || last_decrease_ <= decrease_;
  }

  /// Records the Lagrangian before and after an accepted step.
  void addStep(double before, double after) {
    last_decrease_ = (before - after) / std::max(std::abs(before), kMinValue);
  }

  void tighten(double least_step, bool constraints_hold) {
    step_ = std::max(step_fall_ * step_, least_step);
    if (constraints_hold) decrease_ = std::max(kDecreaseFall * decrease_, kMinDecrease);
  }
  void beginRound() { last_decrease_ = 1.; }

 private:
  double step_fall_, step_ = kFirstStep, decrease_ = kFirstDecrease, last_decrease_ = 1.;
};

/// Detects stagnation: the constraints hold, many steps are refused, and accepted steps hardly decrease the cost, as at
/// non-smooth points.
class StagnationTest {
 public:
  static constexpr int kWindow = 10;        ///< number of evaluations per check
  static constexpr int kRefused = 3;        ///< least number of refused steps among them
  static constexpr double kMinCost = 1e-4;  ///< least magnitude of the cost for relative decreases

  /// The solve stagnates if the relative decrease of the cost per evaluation is less than stopTolerance and
  /// stopFTolerance.
  explicit StagnationTest(const SolverOptions& options)
      : least_decrease_(kWindow * std::min(options.stopTolerance, options.stopFTolerance)) {}

  void addRefusal() { ++refused_; }

  bool stagnates(int evals, double cost, bool constraints_hold) {
    if (constraints_hold && evals < first_ + kWindow) return false;
    const bool slow =
        constraints_hold && refused_ >= kRefused && cost_ - cost < least_decrease_ * std::max(std::abs(cost), kMinCost);
    first_ = evals;
    refused_ = 0;
    cost_ = cost;
    return slow;
  }

 private:
  double least_decrease_;
  int first_ = 0, refused_ = 0;
  double cost_ = std::numeric_limits<double>::infinity();
};

/// Decides whether the costs of a path are close enough to their minimum. Near a solution the decreases of Gauss-Newton
/// steps fall by a constant factor, so that the remaining ones are a geometric series.
class RemainderTest {
 public:
  static constexpr double kShare = .3;      ///< remaining share of the costs, in units of the tolerances
  static constexpr double kSlowest = .9;    ///< largest factor between decreases that counts as convergence
  static constexpr double kMinCost = 1e-4;  ///< least magnitude of the cost for relative decreases

  /// The tolerance is the lesser of stopTolerance and stopFTolerance.
  explicit RemainderTest(const SolverOptions& options)
      : most_(kShare * std::min(options.stopTolerance, options.stopFTolerance)) {}

  /// Records the predicted decrease of an accepted step.
  void addStep(double predicted) { last_ = predicted; }

  /// Whether this step and all later ones hardly decrease the cost.
  bool isSmall(double predicted, double cost) const {
    const double rate = predicted / last_;
    return rate <= kSlowest && predicted <= (1. - rate) * most_ * std::max(std::abs(cost), kMinCost);
  }

 private:
  double most_, last_ = 0.;
};

/// Observes the decrease of the violation over outer iterations.
class ViolationTest {
 public:
  static constexpr double kSufficient = .25;   ///< factor of a sufficient decrease; otherwise the penalty grows
  static constexpr double kInsufficient = .7;  ///< factor of an insufficient decrease under a large penalty
  static constexpr int kBadRounds = 2;         ///< consecutive ones suggest that constraints contradict each other
  static constexpr int kMaxFailures = 6;       ///< the solve ends after as many of these without progress
  static constexpr double kHalf = .5;          ///< factor of the violation that counts as progress,
  static constexpr double kCostFall = 1e-4;    ///< and relative decrease of the cost that does

  bool fellEnough(double violation) const { return violation <= kSufficient * least_; }

  /// Ends an outer iteration with violated constraints. True after several insufficient decreases.
  bool isStuck(double violation, bool penalty_is_much) {
    bad_rounds_ = violation > kInsufficient * least_ && penalty_is_much ? bad_rounds_ + 1 : 0;
    return bad_rounds_ >= kBadRounds;
  }

  /// Called if the violation is stuck although the constraints do not contradict each other. True if that happened too
  /// often.
  bool isHopeless(double violation, double cost) {
    bad_rounds_ = 0;
    const bool falls = violation < kHalf * violation_, is_first = cost_ == kInfinity;
    if (falls || is_first || cost < cost_ - kCostFall * std::abs(cost_)) {  // slow progress
      if (falls) violation_ = violation;
      cost_ = cost;
      failures_ = 0;
    }
    return ++failures_ == kMaxFailures;
  }

  void addRound(double violation) { least_ = std::min(least_, violation); }

  /// Forgets violations and costs, after a move to another point, but not the number of failures.
  void restart() { least_ = violation_ = cost_ = kInfinity; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  double least_ = kInfinity;                         ///< over all outer iterations
  double violation_ = kInfinity, cost_ = kInfinity;  ///< when it was stuck last with progress
  int bad_rounds_ = 0, failures_ = 0;
};

/// Decides whether to try a second-order correction, which costs one evaluation. They become rare if they do not help.
class CorrectionTest {
 public:
  static constexpr int kFailures = 2;  ///< consecutive failures before corrections are skipped
  static constexpr int kLongest = 32;  ///< largest number of skipped corrections

  /// Whether a step that a correction may improve shall be corrected.
  bool isDue() {
    if (wait_ == 0) return true;
    --wait_;
    return false;
  }

  void addCorrection(bool helped) {
    failures_ = helped ? 0 : failures_ + 1;
    if (failures_ >= kFailures) wait_ = std::min(2 << std::min(failures_, 4), kLongest);
  }

 private:
  int wait_ = 0, failures_ = 0;
};

}  // namespace kinegraph::inline solvers_internal
