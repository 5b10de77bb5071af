#pragma once

#include <mutex>
#include <vector>

#include "kinegraph/features/distance.h"
#include "kinegraph/komo/collision/collision_sample.h"

namespace kinegraph {

/// Pairs of shapes at instants of a motion, however q goes there: how near they are.
class SampledPairs {
 public:
  using Gradient = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;  ///< one row

  /// Pairs count that are nearer than `most`, m. `scene` is any State of the motion.
  SampledPairs(std::vector<CollisionSample> samples, double most, const State& scene);

  int size() const { return int(samples_.size()); }
  bool areAllEmpty() const { return in_order_.empty(); }

  /// Calls `place(share, q)`, which writes the q of a share of the way, for each instant in time, and `see(i, distance,
  /// gradient)` for each of those whose pair is near; the gradient is that of the distance by q, of no meaning where it was not
  /// asked for.
  template <class Place, class See>
  void visit(const std::shared_ptr<const Parameters>& parameters, bool with_gradients, const Place& place,
             const See& see) {
    const std::lock_guard lock(mutex_);
    if (state_.sharedParameters() != parameters) state_.replaceParameters(parameters);
    double placed = -1.;
    for (const int i : in_order_) {
      const CollisionSample& sample = samples_[std::size_t(i)];
      if (sample.share != placed) {
        place(placed = sample.share, q_);
        state_.setJoints(q_.data());
      }
      double distance;
      if (isNear(sample, with_gradients, distance)) see(i, distance, gradient_);
    }
  }

 private:
  bool isNear(const CollisionSample& sample, bool with_gradient, double& distance);

  std::vector<CollisionSample> samples_;
  std::vector<int> in_order_;  ///< those that are not empty, by their shares
  double most_;
  std::mutex mutex_;
  State state_;
  VectorXd q_;
  Gradient gradient_;
};

}  // namespace kinegraph
