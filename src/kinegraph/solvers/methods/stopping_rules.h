#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/solvers/interface/options.h"

namespace kinegraph {

/// When an inner problem (the least Lagrangian for these multipliers and this penalty) is solved well enough for new
/// multipliers: roughly at first, and more exactly from round to round.
class InnerTest {
 public:
  static constexpr double kFirstStep = .1;       ///< largest entry of a step that counts as none, in the first round
  static constexpr double kStepFall = .3;        ///< its factor from round to round,
  static constexpr double kStepFallOfMany = .5;  ///< and where there are many variables
  static constexpr double kFirstDecrease = .02;  ///< relative decrease that counts as none, in the first round
  static constexpr double kDecreaseFall = .5;    ///< its factor from round to round where constraints hold
  static constexpr double kLeastDecrease = 1e-6;
  static constexpr double kLeastValue = .01;  ///< least value of the Lagrangian that decreases are relative to

  explicit InnerTest(bool has_many_variables) : step_fall_(has_many_variables ? kStepFallOfMany : kStepFall) {}

  bool isSolved(double step_size, bool is_damped) const {
    return (step_size <= step_ && !is_damped) || last_decrease_ <= decrease_;
  }

  /// The Lagrangian before and after an accepted step.
  void sawStep(double before, double after) {
    last_decrease_ = (before - after) / std::max(std::abs(before), kLeastValue);
  }

  void tighten(double least_step, bool constraints_hold) {
    step_ = std::max(step_fall_ * step_, least_step);
    if (constraints_hold) decrease_ = std::max(kDecreaseFall * decrease_, kLeastDecrease);
  }
  void beginRound() { last_decrease_ = 1.; }

 private:
  double step_fall_, step_ = kFirstStep, decrease_ = kFirstDecrease, last_decrease_ = 1.;
};

/// Do the costs creep: do the constraints hold, are steps refused again and again, and do those that are not hardly
/// decrease the costs, as along a kink?
class CreepTest {
 public:
  static constexpr int kWindow = 10;          ///< evaluations that are looked at together
  static constexpr int kRefused = 3;          ///< steps among them that are refused, at least
  static constexpr double kLeastCost = 1e-4;  ///< least costs that a decrease is relative to

  /// Costs creep if they fall by less than the lesser of stopTolerance and stopFTolerance an evaluation.
  explicit CreepTest(const SolverOptions& options)
      : least_decrease_(kWindow * std::min(options.stopTolerance, options.stopFTolerance)) {}

  void refuse() { ++refused_; }

  bool creeps(int evals, double cost, bool constraints_hold) {
    if (constraints_hold && evals < first_ + kWindow) return false;
    const bool slow = constraints_hold && refused_ >= kRefused &&
                      cost_ - cost < least_decrease_ * std::max(std::abs(cost), kLeastCost);
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

/// Does the violation fall from round to round?
class ViolationTest {
 public:
  static constexpr double kEnough = .25;     ///< factor that a round should reach, or the penalty grows
  static constexpr double kHardly = .7;      ///< factor of a bad round, if the penalty is large
  static constexpr int kBadRounds = 2;       ///< in a row: constraints may contradict each other
  static constexpr int kMostFailures = 6;    ///< times in a row that this came without progress: give up
  static constexpr double kHalf = .5;        ///< factor that is progress of the violation,
  static constexpr double kCostFall = 1e-4;  ///< and part of the costs that is progress as well

  bool fellEnough(double violation) const { return violation <= kEnough * least_; }

  /// Ends a round in which constraints do not hold. True after bad rounds.
  bool isStuck(double violation, bool penalty_is_much) {
    bad_rounds_ = violation > kHardly * least_ && penalty_is_much ? bad_rounds_ + 1 : 0;
    return bad_rounds_ >= kBadRounds;
  }

  /// Where it is stuck, though constraints do not contradict each other: true if that has happened too often.
  bool isHopeless(double violation, double cost) {
    bad_rounds_ = 0;
    const bool falls = violation < kHalf * violation_, is_first = cost_ == kInfinity;
    if (falls || is_first || cost < cost_ - kCostFall * std::abs(cost_)) {  // slow, but it goes on
      if (falls) violation_ = violation;
      cost_ = cost;
      failures_ = 0;
    }
    return ++failures_ == kMostFailures;
  }

  void sawRound(double violation) { least_ = std::min(least_, violation); }

  /// Elsewhere: forgets what fell, not how often it was in vain.
  void restart() { least_ = violation_ = cost_ = kInfinity; }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  double least_ = kInfinity;                         ///< of all rounds
  double violation_ = kInfinity, cost_ = kInfinity;  ///< where it was stuck, and there was progress
  int bad_rounds_ = 0, failures_ = 0;
};

/// Whether to try second-order corrections, which cost an evaluation each: seldom where they do not help.
class CorrectionTest {
 public:
  static constexpr int kFailures = 2;  ///< in a row, before steps go without
  static constexpr int kLongest = 32;  ///< steps without, at most

  /// Counts a step that a correction might help.
  bool isDue() {
    if (wait_ == 0) return true;
    --wait_;
    return false;
  }

  void saw(bool helped) {
    failures_ = helped ? 0 : failures_ + 1;
    if (failures_ >= kFailures) wait_ = std::min(2 << std::min(failures_, 4), kLongest);
  }

 private:
  int wait_ = 0, failures_ = 0;
};

}  // namespace kinegraph
