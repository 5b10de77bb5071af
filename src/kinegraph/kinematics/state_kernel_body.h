#pragma once

// Forward kinematics of one configuration, for vectors of type V in registers; local to each source file that includes
// it.

#include "kinegraph/kinematics/place_links.h"
#include "kinegraph/kinematics/state_kernel.h"

namespace kinegraph::lanes {

namespace {

/// Writes the twists of a step where they belong.
template <class V>
struct TwistWriter {
  double* twist;

  void turns(int k, const V& angular, const V& point) const {
    store(angular, twist + 6 * k);
    store(cross(point, angular), twist + 6 * k + 3);
  }
  void slides(int k, const V& velocity) const {
    store(V{}, twist + 6 * k);
    store(velocity, twist + 6 * k + 3);
  }
  void rests(int k) const {
    store(V{}, twist + 6 * k);
    store(V{}, twist + 6 * k + 3);
  }
};

/// Is a lane of a comparison set?
template <class Mask>
[[gnu::always_inline]] inline bool anySet(const Mask& mask) {
#ifdef __AVX2__
  if constexpr (sizeof(mask) == 32) {
    typedef long long Bits __attribute__((vector_size(32)));
    return !__builtin_ia32_ptestz256((Bits)mask, (Bits)mask);
  }
#endif
  long long found = 0;
  for (int i = 0; i < int(sizeof(mask) / sizeof(double)); ++i) found |= mask[i];
  return found != 0;
}

/// Of `Width` turns from `first` on.
template <int Width>
[[gnu::always_inline]] inline void sineAndCosineAt(const StateArrays& state, int first) {
  using Angles = Pack<Width>;
  Angles q, factors, sines, cosines;
  for (int k = 0; k < Width; ++k) q[k] = state.q[state.turn_dof[first + k]];
  __builtin_memcpy(&factors, state.turn_factor + first, sizeof(factors));
  const Angles angles = factors * q;
  if (!anySet(magnitude(angles) > kMostAngle)) [[likely]] {
    sineAndCosine(angles, sines, cosines);
  } else {
    sineAndCosineOfAny(angles, sines, cosines);
  }
  Angles low, high;  // in pairs
  if constexpr (Width == 2) {
    low = __builtin_shufflevector(sines, cosines, 0, 2);
    high = __builtin_shufflevector(sines, cosines, 1, 3);
  } else {
    low = __builtin_shufflevector(sines, cosines, 0, 4, 1, 5);
    high = __builtin_shufflevector(sines, cosines, 2, 6, 3, 7);
  }
  __builtin_memcpy(state.turned + 2 * first, &low, sizeof(low));
  __builtin_memcpy(state.turned + 2 * first + Width, &high, sizeof(high));
}

struct SineAndCosine {
  double sine, cosine;
};

template <class V>
[[gnu::always_inline]] inline Place<V> loadPlace(const double* from) {
  return {{loadVector<V>(from), loadVector<V>(from + 3), loadVector<V>(from + 6)}, loadVector<V>(from + 9)};
}

/// Moves the pose at `place` by one of the less frequent steps; apart from the others, where the pose stays in
/// registers.
template <class V>
[[gnu::noinline]] void moveInMemory(const LaneModel::Step& step, const double* q, const double* turned, double* place,
                                    double* twist) {
  const auto angle = [turned](double) __attribute__((always_inline)) { return SineAndCosine{turned[0], turned[1]}; };
  Place<V> X = loadPlace<V>(place);
  moveBy(step.kind, step.axis, step.factor, step.about, q + step.variable, angle, X, TwistWriter<V>{twist});
  storePlace(X, place);
}

/// How many kinds of motion are angles: those that updateState tells apart.
constexpr int kindsThatTurn() {
  int count = 0;
  for (const MotionFacts& facts : kMotionFacts) count += facts.effect == MotionFacts::Effect::turns;
  return count;
}
static_assert(kindsThatTurn() == 2, "updateState knows rotate and rotateAbout: tell it of the new kind");

/// `Width`: of the packs of angles, whose sines and cosines are computed beforehand.
template <class V, int Width>
void updateState(const StateArrays& state) {
  int i = 0;
  for (; i + Width <= state.turns; i += Width) sineAndCosineAt<Width>(state, i);
  for (; i < state.turns; i += 2) sineAndCosineAt<2>(state, i);
  // Copies, as the compiler takes it that what is stored below might change the originals.
  const LaneModel::Link* const links = state.links;
  const LaneModel::Step* step = state.steps;
  const double *turned = state.turned, *const q = state.q;
  double *pose = state.poses, *const twists = state.twists;
  Place<V> X = loadPlace<V>(pose);  // of the link before, in registers: what has just been written is slow to read
  for (int l = 1, count = state.link_count; l < count; ++l) {
    const LaneModel::Link& link = links[l];
    if (link.parent != l - 1) X = loadPlace<V>(state.poses + kPerPlace * link.parent);
    X.p = X.p + ((link.p[0] * X.R[0] + link.p[1] * X.R[1]) + link.p[2] * X.R[2]);
    if (link.turn.kind != ConstantRotation::none) turnBy(link.R, X);
    pose += kPerPlace;
    for (int s = 0; s < link.steps; ++s, ++step) {
      double* const twist = twists + 6 * step->column;
      if (step->kind == MotionKind::rotate) {
        turnAboutAxis(step->axis, step->factor, turned[0], turned[1], X, TwistWriter<V>{twist});
        turned += 2;
      } else {
        storePlace(X, pose);
        moveInMemory<V>(*step, q, turned, pose, twist);
        X = loadPlace<V>(pose);
        // Of the kinds that turn the only other one. Asking kMotionFacts here takes registers from the loop: 902
        // instructions for a Panda instead of 856.
        if (step->kind == MotionKind::rotateAbout) turned += 2;
      }
    }
    storePlace(X, pose);
  }
}

}  // namespace

}  // namespace kinegraph::lanes
