#pragma once

#include <optional>
#include <vector>

#include "kinegraph/komo/path/path_motion.h"
#include "kinegraph/nlp/initial_guesses.h"

namespace kinegraph::inline komo_internal {

/// Distances of pairs of shapes along the motions between slices, for any interpolation of q. Times are fractions of
/// the motion to a slice, in [0, 1].
class SliceMotions {
 public:
  virtual ~SliceMotions() = default;

  virtual SliceMotion motionInto(int slice) const = 0;  ///< its end points; q need not move linearly in between

  /// Returns a pair that comes closer than `margin` (m) at any time. Returns nothing only if all pairs provably keep
  /// the margin.
  virtual std::optional<MotionContact> tooNear(int slice, double margin) = 0;

  /// Returns local minima of the distances of pairs along the motion that are below `max_distance` (m). The list may be
  /// incomplete.
  virtual std::vector<MotionContact> approaches(int slice, double max_distance) = 0;

  /// Returns the smallest distance of all pairs at the beginning of the motion, at most `max_distance`, m.
  virtual double clearanceAtBegin(int slice, double max_distance) = 0;
};

/// Classifies the motions to the slices [from, to].
GuessKind guessKindOf(SliceMotions& motions, int from, int to);

/// Linear motion of q between the slices of a path.
class LinearSliceMotions final : public SliceMotions {
 public:
  LinearSliceMotions(const Path& path, MotionProbe& probe) : path_(path), probe_(probe) {}

  SliceMotion motionInto(int slice) const override { return kinegraph::motionInto(path_, slice); }
  std::optional<MotionContact> tooNear(int slice, double margin) override {
    if (probe_.isFree(motionInto(slice), margin)) return std::nullopt;
    return probe_.lastHit();
  }
  std::vector<MotionContact> approaches(int slice, double max_distance) override {
    return probe_.approaches(motionInto(slice), max_distance);
  }
  double clearanceAtBegin(int slice, double max_distance) override {
    return probe_.clearance(motionInto(slice), 0., max_distance);
  }

 private:
  const Path& path_;
  MotionProbe& probe_;
};

}  // namespace kinegraph::inline komo_internal
