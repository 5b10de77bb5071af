#pragma once

#include <mutex>
#include <vector>

#include "kinegraph/features/distance.h"
#include "kinegraph/komo/collision/collision_sample.h"

namespace kinegraph::inline komo_internal {

/// Distances of pairs of shapes at times of a motion of any form.
class SampledPairs {
 public:
  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  ///< one row

  /// Pairs closer than `max_distance` (m) count. `scene` is any State of the motion.
  SampledPairs(std::vector<CollisionSample> samples, double max_distance, const State& scene);

  int size() const { return int(samples_.size()); }
  bool areAllEmpty() const { return in_order_.empty(); }

  /// Calls `place(time, q)`, which writes the q of a fraction of the motion, for each sample in order of time. Calls
  /// `report(i, distance, gradient)` for each sample whose pair is near. The gradient is that of the distance by q, and
  /// undefined unless requested.
  template <class Place, class Report>
  void visit(const std::shared_ptr<const Parameters>& parameters, bool with_gradients, const Place& place,
             const Report& report) {
    const std::lock_guard lock(mutex_);
    if (state_.sharedParameters() != parameters) state_.replaceParameters(parameters);
    double placed = -1.;
    for (const int i : in_order_) {
      const CollisionSample& sample = samples_[std::size_t(i)];
      if (sample.time != placed) {
        place(placed = sample.time, q_);
        state_.setJoints(q_.data());
      }
      double distance;
      if (isNear(sample, with_gradients, distance)) report(i, distance, gradient_);
    }
  }

 private:
  bool isNear(const CollisionSample& sample, bool with_gradient, double& distance);

  std::vector<CollisionSample> samples_;
  std::vector<int> in_order_;  ///< numbers of the non-empty samples, sorted by time
  double max_distance_;
  std::mutex mutex_;
  State state_;
  VectorXd q_;
  Gradient gradient_;
};

}  // namespace kinegraph::inline komo_internal
