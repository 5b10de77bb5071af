#pragma once

#include <memory>
#include <vector>

#include "kinegraph/kinematics/link_bodies.h"

namespace kinegraph {

/// The bodies of a scene in several configurations, side by side.
class PlacedSamples {
 public:
  static constexpr int kMost = 8;  ///< configurations
  using Lane = Eigen::Array<double, kMost, 1>;

  /// `bodies` must stay.
  PlacedSamples(const State& scene, const LinkBodies& bodies);

  void setJoints(int sample, const double* q) { states_[std::size_t(sample)].setJoints(q); }

  /// To be called when the first `count` samples have their joints. Between samples that follow one another, no point of
  /// a group strays from a straight line by more than its `stray`, m.
  void place(int count);
  void setStray(int group, double stray) { spheres_[std::size_t(group)].radius += stray; }

  int count() const { return count_; }
  const State& state(int sample) const { return states_[std::size_t(sample)]; }

  /// A sphere around a group in all samples and between them.
  struct Sphere {
    Vector3d center;
    double radius;
  };
  const Sphere& sphere(int group) const { return spheres_[std::size_t(group)]; }

  /// May any two bodies of these groups come within `margin` (m) of each other, in any sample or between them? False is
  /// certain.
  bool mayBeNear(int group_a, int group_b, double margin) const;

  /// X_WB of a body.
  const RigidTransform& pose(int body, int sample);

  /// Lower bounds of the distance of two bodies in each sample, m: how far their boxes are apart along the direction
  /// from one's to the other's middle. -infinity where that says nothing.
  Lane distanceBounds(int body_a, int body_b);

 private:
  struct Placed {
    int stamp = 0;
    RigidTransform pose[kMost];
    Lane R[3][3], center[3];
  };
  const Placed& placed(int body);

  const LinkBodies* bodies_;
  std::vector<State> states_;
  std::vector<Sphere> spheres_;                  ///< per group
  std::vector<std::unique_ptr<Placed>> placed_;  ///< per body; of many bodies those that were asked for
  int count_ = 0, stamp_ = 0;
};

}  // namespace kinegraph
