#pragma once

#include "kinegraph/komo/collision/slice_motions.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/trajectory_optimization/spline_curve.h"

namespace kinegraph::inline trajectory_optimization_internal {

/// Motion of q along a spline. Checks are made on chords with a margin that is larger by the deviation of the spline;
/// chords that fail are bisected until the deviation is negligible.
class SplineMotions final : public SliceMotions {
 public:
  SplineMotions(SplineCurve& curve, MotionProbe& probe) : curve_(curve), probe_(probe) {}

  SliceMotion motionInto(int slice) const override { return curve_.motionInto(slice); }
  std::optional<MotionContact> tooNear(int slice, double margin) override;
  std::vector<MotionContact> approaches(int slice, double max_distance) override;
  double clearanceAtBegin(int slice, double max_distance) override {
    return probe_.clearance(curve_.motionInto(slice), 0., max_distance);
  }

  /// Returns the constrained pairs that come closer than `margin` (m) on the spline: the first one of each chord.
  std::vector<PathContact> contacts(const SliceMotion& motion, double margin);

 private:
  struct Part {
    double begin, end;
  };
  std::optional<MotionContact> tooNear(int slice, Part part, double margin);
  void addContacts(const SliceMotion& motion, Part part, double margin, std::vector<PathContact>& contacts);

  SplineCurve& curve_;
  MotionProbe& probe_;
};

}  // namespace kinegraph::inline trajectory_optimization_internal
