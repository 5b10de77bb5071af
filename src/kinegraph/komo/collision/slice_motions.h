#pragma once

#include <optional>
#include <vector>

#include "kinegraph/komo/path/path_motion.h"
#include "kinegraph/nlp/initial_guesses.h"

namespace kinegraph {

/// How near pairs of shapes come on the motions from slice to slice, however q goes there. Times are shares of the way to a
/// slice, in [0, 1].
class SliceMotions {
 public:
  virtual ~SliceMotions() = default;

  virtual SliceMotion motionInto(int slice) const = 0;  ///< with its ends; in between q may go another way

  /// A pair that comes nearer than `margin` (m), at any time. None only where it is proved that all pairs keep it.
  virtual std::optional<MotionContact> tooNear(int slice, double margin) = 0;

  /// Where pairs come nearer than `most` (m) on the way, and nearer than just before and just after: what is found, not a
  /// proof.
  virtual std::vector<MotionContact> approaches(int slice, double most) = 0;

  /// The least distance of all pairs where the motion begins, at most `most`, m.
  virtual double clearanceAtBegin(int slice, double most) = 0;
};

/// Of the motions that lead to the slices [from, to].
GuessKind wayOf(SliceMotions& motions, int from, int to);

/// q goes straight from slice to slice of a path.
class LinearSliceMotions final : public SliceMotions {
 public:
  LinearSliceMotions(const Path& path, MotionProbe& probe) : path_(path), probe_(probe) {}

  SliceMotion motionInto(int slice) const override { return kinegraph::motionInto(path_, slice); }
  std::optional<MotionContact> tooNear(int slice, double margin) override {
    if (probe_.isFree(motionInto(slice), margin)) return std::nullopt;
    return probe_.lastHit();
  }
  std::vector<MotionContact> approaches(int slice, double most) override {
    return probe_.approaches(motionInto(slice), most);
  }
  double clearanceAtBegin(int slice, double most) override { return probe_.clearance(motionInto(slice), 0., most); }

 private:
  const Path& path_;
  MotionProbe& probe_;
};

}  // namespace kinegraph
