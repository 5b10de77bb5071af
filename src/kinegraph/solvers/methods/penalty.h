#pragma once

#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/interface/options.h"

namespace kinegraph::inline solvers_internal {

/// The weight mu of the squared constraints in the augmented Lagrangian. It starts at muInit and grows by the factor
/// muInc, up to muMax, after outer iterations with an insufficient decrease of the violation. All are in units of the
/// steepness of the costs.
class Penalty {
 public:
  static constexpr double kLarge =
      1e3;  ///< in units of the initial value: a large penalty, under which the violation should decrease
  static constexpr double kRestored = 10.;  ///< factor of the initial value per restoration
  static constexpr double kSteering =
      .3;  ///< share of the violation that the first step of an outer iteration may leave,
  static constexpr double kWorthwhile = .7;  ///< and factor of that share which justifies a larger penalty
  static constexpr double kCurved =
      .1;  ///< share of the violation, to first order, after a step that needs no larger penalty,
  static constexpr int kMostKept = 3;        ///< and number of outer iterations that keep the penalty for this reason
  static constexpr double kSteepness = .01;  ///< cost weight for a gradient of the costs of 1

  Penalty(const SolverOptions& options, double cost_weight)
      : init_(options.muInit),
        growth_(options.muInc),
        most_(cost_weight * options.muMax),
        cost_weight_(cost_weight),
        value_(cost_weight * options.muInit) {}

  /// Returns the scale of penalties for steep costs. `steepness` is the largest entry of the gradient of general costs.
  static double costWeight(double steepness) { return std::max(1., kSteepness * steepness); }

  double value() const { return value_; }
  bool isLarge() const { return value_ >= kLarge * cost_weight_ * init_; }
  void grow() { value_ = std::min(most_, growth_ * value_); }
  void restart(int restorations) { value_ = std::min(most_, std::pow(kRestored, restorations) * cost_weight_ * init_); }

 private:
  double init_, growth_, most_, cost_weight_, value_;
};

}  // namespace kinegraph::inline solvers_internal
