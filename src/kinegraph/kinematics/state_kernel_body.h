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

template <int Width>
[[gnu::always_inline]] inline void sineAndCosineAt(const StateArrays& state, int first) {
  Pack<Width> angles, sines, cosines;
  bool small = true;
  for (int k = 0; k < Width; ++k) {
    angles[k] = state.turn_factor[first + k] * state.q[state.turn_dof[first + k]];
    small &= magnitude(double(angles[k])) <= kMostAngle;
  }
  if (small) [[likely]] {
    sineAndCosine(angles, sines, cosines);
  } else {
    sineAndCosineOfAny(angles, sines, cosines);
  }
  for (int k = 0; k < Width; ++k) {
    state.sines_cosines[2 * (first + k)] = sines[k];
    state.sines_cosines[2 * (first + k) + 1] = cosines[k];
  }
}

inline int dofsOf(MotionKind kind) { return kind == MotionKind::quaternion ? 4 : kind == MotionKind::circle ? 2 : 1; }

struct SineAndCosine {
  double sine, cosine;
};

/// `Width`: of the packs of angles, whose sines and cosines are computed beforehand.
template <class V, int Width>
void updateState(const StateArrays& state) {
  int i = 0;
  for (; i + Width <= state.turns; i += Width) sineAndCosineAt<Width>(state, i);
  for (; i < state.turns; i += 2) sineAndCosineAt<2>(state, i);
  const double* turn = state.sines_cosines;
  V pose[4];  // of the link before, by columns; what has just been written in parts is slow to read as a whole
  for (int k = 0; k < 4; ++k) load(state.poses + 3 * k, pose[k]);
  for (int l = 1; l < state.link_count; ++l) {
    const Program::Link& link = state.links[l];
    const JointBase& base = state.bases[l];
    const double* numbers = reinterpret_cast<const double*>(&base);  // the columns of R, then p
    if (link.parent != l - 1) {
      for (int k = 0; k < 4; ++k) load(state.poses + kPerPlace * link.parent + 3 * k, pose[k]);
    }
    Place<V> X = movedBy<V>([&pose](int k) __attribute__((always_inline)) { return pose[k]; }, base.turn, numbers, numbers + 9);
    const double* q = state.q + link.dof;
    TwistWriter<V> sink{state.twists + 6 * link.first_column};
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = state.steps[s];
      const auto angle = [&turn](double) __attribute__((always_inline)) {
        const SineAndCosine pair{turn[0], turn[1]};
        turn += 2;
        return pair;
      };
      moveBy(step.kind, step.axis, step.sign * link.scale, reinterpret_cast<const double*>(&link.axis), q, angle, X, sink);
      q += dofsOf(step.kind);
      sink.twist += 6 * dofsOf(step.kind);
    }
    storePlace(X, state.poses + kPerPlace * l);
    for (int k = 0; k < 3; ++k) pose[k] = X.R[k];
    pose[3] = X.p;
  }
}

}  // namespace

}  // namespace kinegraph::lanes
