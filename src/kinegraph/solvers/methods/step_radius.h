#pragma once

#include <algorithm>

namespace kinegraph {

/// The largest entry that a step may have: stepMax at first, more where long steps keep their promises.
class StepRadius {
 public:
  static constexpr double kAtEdge = .99;          ///< part of the radius from which on a step counts as stopped by it
  static constexpr int kStepsToGrow = 2;          ///< such steps in a row, before it grows
  static constexpr double kGrowth = 2.;           ///< its factor then,
  static constexpr double kRestoringGrowth = 4.;  ///< and where only the violation is reduced
  static constexpr double kFall = .25;            ///< factor after a refused step
  static constexpr double kMost = 1e6;            ///< largest value, in units of the first one
  static constexpr double kFree = .5;             ///< part of the radius up to which a step is the model's own

  explicit StepRadius(double first) : first_(first), value_(first) {}

  double value() const { return value_; }
  bool isAtEdge(double size) const { return size >= kAtEdge * value_; }

  /// Is a step of this size short enough that the radius had no part in it?
  bool leavesFree(double size) const { return size <= kFree * value_; }

  /// After an accepted step of this size; `good`: it did what was predicted.
  void accept(double size, bool good) {
    steps_at_edge_ = good && isAtEdge(size) ? steps_at_edge_ + 1 : 0;
    if (steps_at_edge_ >= kStepsToGrow) value_ = std::min(kGrowth * value_, kMost * first_);
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

}  // namespace kinegraph
