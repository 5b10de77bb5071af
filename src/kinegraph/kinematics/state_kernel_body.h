#pragma once

// Forward kinematics of one configuration, for vectors of type V in registers; local to each source file that includes it.

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

inline int dofsOf(MotionKind kind) { return kind == MotionKind::quaternion ? 4 : kind == MotionKind::circle ? 2 : 1; }

struct SineAndCosine {
  double sine, cosine;
};

/// A joint that turns about an axis of its base, which is a quarter turn or none away from the link before: what most joints are.
/// The same numbers as by movedBy and moveBy, as signs may be multiplied in any order. `pose` goes on to this link.
template <class V>
[[gnu::always_inline]] inline void turnLink(const ConstantTurn& turn, int axis, double factor, double sine, double cosine, const V& p, V* pose,
                                            const TwistWriter<V>& sink) {
  constexpr int kNext[5] = {0, 1, 2, 0, 1};
  const int i = kNext[axis + 1], j = kNext[axis + 2];
  const V n = turn.sign[axis] * pose[turn.column[axis]], a = pose[turn.column[i]], b = pose[turn.column[j]];
  sink.turns(0, factor * n, p);
  pose[axis] = n;
  pose[i] = (cosine * turn.sign[i]) * a + (sine * turn.sign[j]) * b;
  pose[j] = (cosine * turn.sign[j]) * b - (sine * turn.sign[i]) * a;
  pose[3] = p;
}

/// `Width`: of the packs of angles, whose sines and cosines are computed beforehand.
template <class V, int Width>
void updateState(const StateArrays& state) {
  int i = 0;
  for (; i + Width <= state.turns; i += Width) sineAndCosineAt<Width>(state, i);
  for (; i < state.turns; i += 2) sineAndCosineAt<2>(state, i);
  const double* turn = state.turned;
  V pose[4];  // of the link before, by columns; what has just been written in parts is slow to read as a whole
  for (int k = 0; k < 4; ++k) load(state.poses + 3 * k, pose[k]);
  const auto column = [&pose](int k) __attribute__((always_inline)) { return pose[k]; };
  const auto angle = [&](double) __attribute__((always_inline)) {
    const SineAndCosine pair{turn[0], turn[1]};
    turn += 2;
    return pair;
  };
  for (int l = 1; l < state.link_count; ++l) {
    const Program::Link& link = state.links[l];
    const JointBase& base = state.bases[l];
    const double *R = reinterpret_cast<const double*>(&base), *p = R + 9;  // the columns of R, then p
    if (link.parent != l - 1) {
      for (int k = 0; k < 4; ++k) load(state.poses + kPerPlace * link.parent + 3 * k, pose[k]);
    }
    TwistWriter<V> sink{state.twists + 6 * link.first_column};
    const MotionStep* step = state.steps + link.first_step;
    if (link.steps == 1 && step->kind == MotionKind::rotate && base.turn.kind != ConstantTurn::general) {
      const V at = ((pose[3] + p[0] * pose[0]) + p[1] * pose[1]) + p[2] * pose[2];
      turnLink(base.turn, step->axis, step->sign * link.scale, turn[0], turn[1], at, pose, sink);
      turn += 2;
    } else {
      Place<V> X = movedBy<V>(column, base.turn, R, p);
      const double* q = state.q + link.dof;
      for (const MotionStep* end = step + link.steps; step < end; ++step) {
        moveBy(step->kind, step->axis, step->sign * link.scale, reinterpret_cast<const double*>(&link.axis), q, angle, X, sink);
        q += dofsOf(step->kind);
        sink.twist += 6 * dofsOf(step->kind);
      }
      for (int k = 0; k < 3; ++k) pose[k] = X.R[k];
      pose[3] = X.p;
    }
    for (int k = 0; k < 4; ++k) store(pose[k], state.poses + kPerPlace * l + 3 * k);
  }
}

}  // namespace

}  // namespace kinegraph::lanes
