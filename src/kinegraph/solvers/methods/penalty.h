#pragma once

#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/interface/options.h"

namespace kinegraph {

/// The weight mu of the squared constraints in the augmented Lagrangian: muInit, times muInc after a round that has not
/// reduced the violation enough, at most muMax; all of them in units of how steep the costs are.
class Penalty {
 public:
  static constexpr double kMuch = 1e3;      ///< times the first value: the violation is expected to fall
  static constexpr double kRestored = 10.;  ///< factor of the first value, for each restoration so far
  static constexpr double kSteering = .3;  ///< part of the violation that a step at the beginning of a round may leave,
  static constexpr double kWorthwhile = .7;  ///< and factor of that for which a larger penalty is taken
  static constexpr double kSteepness = .01;  ///< cost weight for a gradient of the costs of 1

  Penalty(const SolverOptions& options, double cost_weight)
      : init_(options.muInit),
        growth_(options.muInc),
        most_(cost_weight * options.muMax),
        cost_weight_(cost_weight),
        value_(cost_weight * options.muInit) {}

  /// Where costs are steep, as numbers without a unit may be, penalties must be as well. `steepness` is the largest
  /// entry of the gradient of what Gauss-Newton knows no curvature of.
  static double costWeight(double steepness) { return std::max(1., kSteepness * steepness); }

  double value() const { return value_; }
  bool isMuch() const { return value_ >= kMuch * cost_weight_ * init_; }
  void grow() { value_ = std::min(most_, growth_ * value_); }
  void restart(int restorations) { value_ = std::min(most_, std::pow(kRestored, restorations) * cost_weight_ * init_); }

 private:
  double init_, growth_, most_, cost_weight_, value_;
};

}  // namespace kinegraph
