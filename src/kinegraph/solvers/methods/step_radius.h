#pragma once

#include <algorithm>

namespace kinegraph::inline solvers_internal {

/// The largest entry of a step: stepMax at first, and more after accurate long steps.
class StepRadius {
 public:
  static constexpr double kAtEdge = .99;          ///< share of the radius beyond which it limits a step
  static constexpr int kStepsToGrow = 2;          ///< number of consecutive limited steps before the radius grows
  static constexpr double kGrowth = 2.;           ///< factor of growth,
  static constexpr double kRestoringGrowth = 4.;  ///< and in restorations
  static constexpr double kFall = .25;            ///< factor after a refused step
  static constexpr double kMax = 1e6;             ///< largest value, in units of the initial one
  static constexpr double kFree = .5;             ///< share of the radius below which it does not affect a step

  explicit StepRadius(double first) : first_(first), value_(first) {}

  double value() const { return value_; }
  bool isAtEdge(double size) const { return size >= kAtEdge * value_; }

  /// Whether a step of this size is too short for the radius to affect it.
  bool leavesFree(double size) const { return size <= kFree * value_; }

  /// Adapts after an accepted step of this size; `good`: its decrease was as predicted.
  void accept(double size, bool good) {
    steps_at_edge_ = good && isAtEdge(size) ? steps_at_edge_ + 1 : 0;
    if (steps_at_edge_ >= kStepsToGrow) value_ = std::min(kGrowth * value_, kMax * first_);
  }

  void refuse() {
    shrink();
    steps_at_edge_ = 0;
  }

  void growRestoring() { value_ *= kRestoringGrowth; }
  void shrink() { value_ = std::max(first_, kFall * value_); }

 private:
  double first_, value_;
  int steps_at_edge_ = 0;
};

}  // namespace kinegraph::inline solvers_internal
