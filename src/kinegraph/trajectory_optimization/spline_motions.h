#pragma once

#include "kinegraph/komo/collision/slice_motions.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/trajectory_optimization/spline_curve.h"

namespace kinegraph {

/// q goes along a spline. What is proved is proved on chords, on which pairs have to be apart by so much more as the spline may
/// stray from them; chords that are not are halved, until they hardly differ from it.
class SplineMotions final : public SliceMotions {
 public:
  SplineMotions(SplineCurve& curve, MotionProbe& probe) : curve_(curve), probe_(probe) {}

  SliceMotion motionInto(int slice) const override { return curve_.motionInto(slice); }
  std::optional<MotionContact> tooNear(int slice, double margin) override;
  std::vector<MotionContact> approaches(int slice, double most) override;
  double clearanceAtBegin(int slice, double most) override {
    return probe_.clearance(curve_.motionInto(slice), 0., most);
  }

  /// The pairs that count for a motion and come nearer than `margin` (m) on the spline: on each chord the first one.
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

}  // namespace kinegraph
