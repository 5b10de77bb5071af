#pragma once

// Forward kinematics of a LaneModel in packs S; local to each source file that includes it.

#include "kinegraph/kinematics/lane_model.h"
#include "kinegraph/kinematics/place_links.h"

namespace kinegraph::lanes {

namespace {

/// Stores the motion of a step.
template <class S>
struct MotionWriter {
  S* to;

  void rotates(int k, const Vec3<S>& angular, const Vec3<S>& point) const {
    store(angular, to + LaneMemory::kPerColumn * k);
    store(point, to + LaneMemory::kPerColumn * k + 3);
  }
  void translates(int k, const Vec3<S>& velocity) const { rotates(k, {S{}, S{}, S{}}, velocity); }
  void rests(int k) const { rotates(k, {S{}, S{}, S{}}, {S{}, S{}, S{}}); }
};

/// Computes the poses of all links except the world, and the motions of all columns.
template <class S>
void placeLinks(const LaneModel& model, const S* x, S* pose, S* motion) {
  struct SineAndCosine {
    S sine, cosine;
  };
  S most{};
  for (int s = 0; s < model.steps; ++s) {
    const LaneModel::Step& step = model.step[s];
    if (kMotionFacts[int(step.kind)].effect == MotionFacts::Effect::rotates)
      most = larger(most, magnitude(step.factor * x[step.variable]));
  }
  const bool far = any(most > kMostAngle);
  const auto angle = [far](S value) __attribute__((always_inline)) {
    SineAndCosine both;
    if (far) {
      sineAndCosineOfAny(value, both.sine, both.cosine);
    } else {
      sineAndCosine(value, both.sine, both.cosine);
    }
    return both;
  };
  for (int l = 1; l < model.links; ++l) {
    const LaneModel::Link& link = model.link[l];
    auto X = moved<Vec3<S>>(pose + link.parent * LaneMemory::kPerPose, link.rotation, link.R, link.p);
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const LaneModel::Step& step = model.step[s];
      moveBy(step.kind, step.axis, step.factor, step.about, x + step.variable, angle, X,
             MotionWriter<S>{motion + step.column * LaneMemory::kPerColumn});
    }
    storePlace(X, pose + l * LaneMemory::kPerPose);
  }
}

}  // namespace

}  // namespace kinegraph::lanes
