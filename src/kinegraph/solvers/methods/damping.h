#pragma once

#include <algorithm>
#include <limits>

namespace kinegraph {

/// Levenberg damping: the multiple of the identity that the model has on its Hessian. It keeps steps short where the
/// model predicts badly, falls with every step that did what was predicted, and grows faster and faster while steps are
/// refused. What is small or large is measured by the largest curvature of the costs.
/// Source: Nielsen, Damping parameter in Marquardt's method, 1999.
class Damping {
 public:
  static constexpr double kSmall = .1;     ///< part of the curvature below which steps are those of the problem
  static constexpr double kRelaxed = .01;  ///< factor where a step is to be tried again with less
  static constexpr double kHigh = 1e8;     ///< above, trying again with less is in vain
  static constexpr double kMost = 1e10;    ///< above, steps are shorter than what numbers can tell apart
  static constexpr double kLeast = 1e-6;
  static constexpr double kLeastRefused = 1e-3;             ///< least value after a refusal,
  static constexpr double kLeastRefusedOfCurvature = 1e-4;  ///< also as a part of the curvature
  static constexpr double kBestFall = .1;                   ///< least factor after an accepted step
  static constexpr double kWaryFall = .5;                   ///< the same where less damping has just failed
  static constexpr double kOvershot = .25;    ///< ratio of a step that is much too long for the curvature there
  static constexpr int kWarySteps = 3;        ///< steps after it that are wary
  static constexpr double kLackingPart = .5;  ///< part of the curvature that a model lacks that is made up for
  static constexpr double kMostLacking = 2.;  ///< in units of what it has
  static constexpr double kFirstGrowth = 2.;  ///< factor of a refusal; twice as much for the next one
  static constexpr double kMostRatio = 1.2;   ///< a decrease beyond this part of the predicted one says no more

  /// `first` is where it returns to by `restart`, `value` where it starts.
  Damping(double first, double value) : first_(first), value_(value) {}

  double value() const { return value_; }
  bool isSmall(double curvature) const { return value_ <= kSmall * curvature; }
  bool isHigh() const { return value_ >= kHigh; }
  bool isLost() const { return value_ > kMost; }

  /// Was the last step refused? The next one that is accepted then has less damping from a point where more was needed.
  bool wasRefused() const { return growth_ > kFirstGrowth; }

  /// After a step whose actual decrease was `ratio` times the predicted one. `wary`: do not fall far.
  void accept(double ratio, bool wary) {
    const double excess = 2. * std::min(ratio, kMostRatio) - 1.;
    if (wary_steps_ > 0) --wary_steps_;
    const double least = wary || wary_steps_ > 0 || wasRefused() ? kWaryFall : kBestFall;
    value_ = std::max(kLeast, value_ * std::max(least, 1. - excess * excess * excess));
    growth_ = kFirstGrowth;
  }

  /// What a model lacks that has this curvature along a step to its least value, where the step came out with this ratio.
  /// If the actual curvature is k times that, the ratio is 2 - k; half of what is missing is asked for. Growing factor by
  /// factor from its least value, damping would take a dozen steps to get there, each beyond the least value and back
  /// again; as a part of the largest curvature it may be a thousand times too large where curvatures differ by that.
  /// Source: Fletcher, A modified Marquardt subroutine for non-linear least squares, 1971.
  static double lacking(double ratio, double curvature) {
    return kLackingPart * std::min(1. - ratio, kMostLacking) * curvature;
  }

  /// After an accepted step that did less than it should: not below what the model lacks, and slower to fall from there.
  void meet(double ratio, double lacking) {
    if (ratio >= kOvershot || !(lacking > value_)) return;
    value_ = std::min(lacking, kHigh);
    wary_steps_ = kWarySteps;
  }

  /// `lacking`: of the model; infinite where that is not known.
  void refuse(double curvature, double lacking = std::numeric_limits<double>::infinity()) {
    value_ = std::max({value_ * growth_, std::min(kLeastRefusedOfCurvature * curvature, lacking), kLeastRefused});
    growth_ *= 2.;
  }

  /// For a step that may be tiny because of the damping, not because of the problem.
  void relax(double curvature) {
    value_ = std::max(kSmall * curvature, kRelaxed * value_);
    growth_ = kFirstGrowth;
  }

  void restart() { value_ = first_; }

 private:
  double first_, value_, growth_ = kFirstGrowth;
  int wary_steps_ = 0;
};

}  // namespace kinegraph
