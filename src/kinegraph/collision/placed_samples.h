#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "kinegraph/collision/sample_kernel.h"
#include "kinegraph/geometry/distance/separation.h"
#include "kinegraph/kinematics/link_bodies.h"

namespace kinegraph::inline collision_internal {

/// The bodies of a scene in several configurations, side by side.
class PlacedSamples {
 public:
  static constexpr int kMost = 8;  ///< configurations
  using Lane = Eigen::Array<double, kMost, 1>;

  /// `bodies` must outlive it.
  PlacedSamples(const State& scene, const LinkBodies& bodies, const SampleKernel& kernel = sampleKernel());
  PlacedSamples(const PlacedSamples&) = delete;

  void setJoints(int sample, const double* q) {
    std::copy_n(q, model_.variables, Q_.data() + sample * model_.variables);
  }

  /// Places the first `count` samples, after setJoints. setDeviation adds the deviation (m) of points of a group from
  /// straight lines between consecutive samples.
  void place(int count);
  void setDeviation(int group, double deviation) { spheres_[std::size_t(group)].radius += deviation; }

  int count() const { return count_; }
  /// X_WL of a link.
  RigidTransform linkPose(int link, int sample) const {
    return poseIn(memory_.pose, model_.links * LaneMemory::kPerPose, link * LaneMemory::kPerPose, sample);
  }

  /// A sphere around a group in all samples and between them.
  struct Sphere {
    Vector3d center;
    double radius;
  };
  const Sphere& sphere(int group) const { return spheres_[std::size_t(group)]; }

  /// False only if no two bodies of these groups come within `margin` (m) of each other, in samples and between them.
  bool mayBeNear(int group_a, int group_b, double margin) const;

  /// The same for a moving group and every static group; zero means false. Only for few bodies.
  const std::vector<std::int64_t>& nearFixed(int group, double margin);

  /// X_WB of a body.
  RigidTransform pose(int body, int sample) { return poseIn(placed(body).rows, SampleKernel::kPerBody, 0, sample); }

  /// Bounds of the distance of two bodies in each sample, m. `least` is the gap of their boxes along the direction
  /// between their centers; -infinity: unknown. Values of `most` or more may be smaller than that gap. `most` is the
  /// distance of a ball inside of one and the box of the other; infinity: unknown.
  struct Bounds {
    Lane least, most;
  };
  Bounds distanceBounds(int body_a, int body_b, double most = std::numeric_limits<double>::infinity());

  /// The gap of two convex bodies along a direction in each sample, m: a lower bound of their distance. The unit vector
  /// n, from b to a, is fixed in a link. The search for support corners begins at `corners`.
  Lane gaps(int body_a, int body_b, const Vector3d& n, int link, SupportCorners& corners);

 private:
  struct Placed {
    alignas(64) double rows[SampleKernel::kPerBody * kMost];
    SampleKernel::Offset offset;
    SampleKernel::Convex core;  ///< of a convex body
    int stamp = 0;
  };
  const Placed& placed(int body);
  std::unique_ptr<Placed> unplaced(int body) const;

  /// Reads the pose of one sample from rows of lanes.
  RigidTransform poseIn(const double* from, int rows, int row, int sample) const {
    const int width = kernel_->width;
    from += (sample / width * rows + row) * width + sample % width;
    RigidTransform X;
    for (int k = 0; k < 9; ++k) X.R.data()[k] = from[k * width];
    for (int k = 0; k < 3; ++k) X.p[k] = from[(9 + k) * width];
    return X;
  }
  SampleKernel::Box boxOf(int body);
  void layOutFixed();

  const SampleKernel* kernel_;
  std::shared_ptr<const Parameters> parameters_;
  const LinkBodies* bodies_;
  LaneModel model_;
  LaneMemory memory_{};
  std::vector<double> storage_;  ///< of memory_
  std::vector<double> Q_;        ///< a row per sample
  std::vector<Sphere> spheres_;  ///< per group
  std::vector<double> fixed_storage_;
  SampleKernel::FixedBoxes fixed_{};             ///< of static groups, in their order
  std::vector<std::int64_t> near_;               ///< per static group
  std::vector<std::unique_ptr<Placed>> placed_;  ///< per body; for many bodies constructed on demand
  int count_ = 0, groups_ = 0, stamp_ = 0;
};

}  // namespace kinegraph::inline collision_internal
