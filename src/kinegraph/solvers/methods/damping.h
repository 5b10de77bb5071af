#pragma once

#include <algorithm>
#include <limits>

namespace kinegraph::inline solvers_internal {

/// Levenberg damping: the multiple of the identity that is added to the Hessian of the model. It shortens steps if the
/// model is inaccurate, decreases after accurate steps, and grows faster and faster while steps are refused. The scale
/// is the largest curvature of the costs.
/// Source: Nielsen, Damping parameter in Marquardt's method, 1999.
class Damping {
 public:
  static constexpr double kSmall = .1;     ///< share of the curvature below which damping hardly affects steps
  static constexpr double kRelaxed = .01;  ///< factor before another try with less damping
  static constexpr double kHigh = 1e8;     ///< above this value less damping is not tried
  static constexpr double kMax = 1e10;     ///< above this value steps are below the rounding error
  static constexpr double kMin = 1e-6;
  static constexpr double kMinRefused = 1e-3;       ///< least value after a refusal,
  static constexpr double kMinRefusedShare = 1e-4;  ///< also as a share of the curvature
  static constexpr double kBestFall = .1;           ///< least factor after an accepted step
  static constexpr double kWaryFall = .5;           ///< the same if less damping has just failed
  static constexpr double kOvershot = .25;          ///< ratio of a step that is much too long
  static constexpr int kWarySteps = 3;              ///< number of careful steps after it
  static constexpr double kLackingPart = .5;        ///< share of the missing curvature that damping replaces
  static constexpr double kMaxLacking = 2.;         ///< largest missing curvature, in units of that of the model
  static constexpr double kFirstGrowth = 2.;        ///< factor of a refusal; doubles with each further one
  static constexpr double kMaxRatio = 1.2;  ///< larger ratios of actual and predicted decrease count as this one

  /// `first` is the value after `restart`, `value` the initial one.
  Damping(double first, double value) : first_(first), value_(value) {}

  double value() const { return value_; }
  bool isSmall(double curvature) const { return value_ <= kSmall * curvature; }
  bool isHigh() const { return value_ >= kHigh; }
  bool isLost() const { return value_ > kMax; }

  /// Whether the last step was refused.
  bool wasRefused() const { return growth_ > kFirstGrowth; }

  /// Adapts after an accepted step whose actual decrease was `ratio` times the predicted one. `wary` limits the
  /// decrease.
  void accept(double ratio, bool wary) {
    const double excess = 2. * std::min(ratio, kMaxRatio) - 1.;
    if (wary_steps_ > 0) --wary_steps_;
    const double least = wary || wary_steps_ > 0 || wasRefused() ? kWaryFall : kBestFall;
    value_ = std::max(kMin, value_ * std::max(least, 1. - excess * excess * excess));
    growth_ = kFirstGrowth;
  }

  /// Returns the damping that a model with this curvature along its minimizing step lacks, given the ratio of actual
  /// and predicted decrease. If the actual curvature is k times that of the model, the ratio is 2 - k; the result is
  /// half of the missing curvature. Growth by constant factors would take a dozen steps beyond the minimum and back; a
  /// share of the largest curvature may be a thousand times too large if curvatures differ that much.
  /// Source: Fletcher, A modified Marquardt subroutine for non-linear least squares, 1971.
  static double lacking(double ratio, double curvature) {
    return kLackingPart * std::min(1. - ratio, kMaxLacking) * curvature;
  }

  /// Raises the damping to the missing curvature after an accepted step with a small ratio, and lets it decrease
  /// slowly.
  void meet(double ratio, double lacking) {
    if (ratio >= kOvershot || !(lacking > value_)) return;
    value_ = std::min(lacking, kHigh);
    wary_steps_ = kWarySteps;
  }

  /// Adapts after a refused step. `lacking`: missing curvature of the model; infinite if unknown.
  void refuse(double curvature, double lacking = std::numeric_limits<double>::infinity()) {
    value_ = std::max({value_ * growth_, std::min(kMinRefusedShare * curvature, lacking), kMinRefused});
    growth_ *= 2.;
  }

  /// Reduces the damping, to check whether a step is tiny because of it.
  void relax(double curvature) {
    value_ = std::max(kSmall * curvature, kRelaxed * value_);
    growth_ = kFirstGrowth;
  }

  void restart() { value_ = first_; }

 private:
  double first_, value_, growth_ = kFirstGrowth;
  int wary_steps_ = 0;
};

}  // namespace kinegraph::inline solvers_internal
