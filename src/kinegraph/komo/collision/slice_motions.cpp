#include "kinegraph/komo/collision/slice_motions.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr double kStill = .1;  // rad or m: larger than the noise of initial points

}  // namespace

GuessKind guessKindOf(SliceMotions& motions, int from, int to) {
  VectorXd begin;
  bool moves = false;
  for (int slice = from; slice <= to; ++slice) {
    const SliceMotion motion = motions.motionInto(slice);
    if (slice == from || motion.to.size() != begin.size()) begin = motion.from;
    moves = moves || (motion.to - begin).lpNorm<Eigen::Infinity>() > kStill;
    if (motions.tooNear(slice, 0.)) return GuessKind::invalid;
  }
  return moves ? GuessKind::valid : GuessKind::stationary;
}

}  // namespace kinegraph::inline komo_internal
