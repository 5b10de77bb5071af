#pragma once

// Forward kinematics of one configuration, for vectors of type V in registers; local to each source file that includes
// it.

#include "kinegraph/kinematics/place_links.h"
#include "kinegraph/kinematics/state_kernel.h"

namespace kinegraph::lanes {

namespace {

/// Stores the twists of a step.
template <class V>
struct TwistWriter {
  double* twist;

  void rotates(int k, const V& angular, const V& point) const {
    store(angular, twist + 6 * k);
    store(cross(point, angular), twist + 6 * k + 3);
  }
  void translates(int k, const V& velocity) const {
    store(V{}, twist + 6 * k);
    store(velocity, twist + 6 * k + 3);
  }
  void rests(int k) const {
    store(V{}, twist + 6 * k);
    store(V{}, twist + 6 * k + 3);
  }
};

/// Returns true if any lane of a comparison is set.
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

/// Computes sines and cosines of `Width` angles from `first` on.
template <int Width>
[[gnu::always_inline]] inline void sineAndCosineAt(const StateArrays& state, int first) {
  using Angles = Pack<Width>;
  Angles q, factors, sines, cosines;
  for (int k = 0; k < Width; ++k) q[k] = state.q[state.angle_dof[first + k]];
  __builtin_memcpy(&factors, state.angle_factor + first, sizeof(factors));
  const Angles angles = factors * q;
  if (!anySet(magnitude(angles) > kMostAngle)) [[likely]] {
    sineAndCosine(angles, sines, cosines);
  } else {
    sineAndCosineOfAny(angles, sines, cosines);
  }
  Angles low, high;  // interleaved in pairs
  if constexpr (Width == 2) {
    low = __builtin_shufflevector(sines, cosines, 0, 2);
    high = __builtin_shufflevector(sines, cosines, 1, 3);
  } else {
    low = __builtin_shufflevector(sines, cosines, 0, 4, 1, 5);
    high = __builtin_shufflevector(sines, cosines, 2, 6, 3, 7);
  }
  __builtin_memcpy(state.sines_cosines + 2 * first, &low, sizeof(low));
  __builtin_memcpy(state.sines_cosines + 2 * first + Width, &high, sizeof(high));
}

struct SineAndCosine {
  double sine, cosine;
};

template <class V>
[[gnu::always_inline]] inline Place<V> loadPlace(const double* from) {
  return {{loadVector<V>(from), loadVector<V>(from + 3), loadVector<V>(from + 6)}, loadVector<V>(from + 9)};
}

/// Moves the pose at `place` by one of the less frequent kinds of steps. It is a separate function so that the loop
/// keeps the pose in registers for the others.
template <class V>
[[gnu::noinline]] void moveInMemory(const LaneModel::Step& step, const double* q, const double* sine_cosine,
                                    double* place, double* twist) {
  const auto angle = [sine_cosine](double) __attribute__((always_inline)) {
    return SineAndCosine{sine_cosine[0], sine_cosine[1]};
  };
  Place<V> X = loadPlace<V>(place);
  moveBy(step.kind, step.axis, step.factor, step.about, q + step.variable, angle, X, TwistWriter<V>{twist});
  storePlace(X, place);
}

/// Returns the number of kinds of motion that are angles, which updateState distinguishes.
constexpr int rotationalKinds() {
  int count = 0;
  for (const MotionFacts& facts : kMotionFacts) count += facts.effect == MotionFacts::Effect::rotates;
  return count;
}
static_assert(rotationalKinds() == 2, "updateState must handle each rotational kind: rotate and rotateAbout");

/// `Width` is the number of angles whose sines and cosines are computed together.
template <class V, int Width>
void updateState(const StateArrays& state) {
  int i = 0;
  for (; i + Width <= state.angles; i += Width) sineAndCosineAt<Width>(state, i);
  for (; i < state.angles; i += 2) sineAndCosineAt<2>(state, i);
  // Local copies, since the compiler assumes that the stores below may change the originals.
  const LaneModel::Link* const links = state.links;
  const LaneModel::Step* step = state.steps;
  const double *sine_cosine = state.sines_cosines, *const q = state.q;
  double *pose = state.poses, *const twists = state.twists;
  Place<V> X = loadPlace<V>(pose);  // pose of the previous link, in registers: reading it back from memory is slow
  for (int l = 1, count = state.link_count; l < count; ++l) {
    const LaneModel::Link& link = links[l];
    if (link.parent != l - 1) X = loadPlace<V>(state.poses + kPerPlace * link.parent);
    X.p = X.p + ((link.p[0] * X.R[0] + link.p[1] * X.R[1]) + link.p[2] * X.R[2]);
    if (link.rotation.kind != ConstantRotation::none) rotateBy(link.R, X);
    pose += kPerPlace;
    for (int s = 0; s < link.steps; ++s, ++step) {
      double* const twist = twists + 6 * step->column;
      if (step->kind == MotionKind::rotate) {
        rotateAboutAxis(step->axis, step->factor, sine_cosine[0], sine_cosine[1], X, TwistWriter<V>{twist});
        sine_cosine += 2;
      } else {
        storePlace(X, pose);
        moveInMemory<V>(*step, q, sine_cosine, pose, twist);
        X = loadPlace<V>(pose);
        // The only other rotational kind. A look-up in kMotionFacts here takes registers from the loop: 902
        // instructions for a Panda instead of 856.
        if (step->kind == MotionKind::rotateAbout) sine_cosine += 2;
      }
    }
    storePlace(X, pose);
  }
}

}  // namespace

}  // namespace kinegraph::lanes
