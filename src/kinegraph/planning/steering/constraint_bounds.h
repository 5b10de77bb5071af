#pragma once

#include "kinegraph/collision/motion_bounds.h"
#include "kinegraph/features/residual.h"

namespace kinegraph {

/// How fast the rows y of a residual change along a straight motion q(s), and how far from straight, at most:
///
///     |dy/ds| <= speed,    |d^2y/ds^2| <= bend
///
/// A row is a sum of products of points, directions and joints, whose bounds MotionBounds has; of a product a b, it is
/// |a''| |b| + 2 |a'| |b'| + |a| |b''|. That is known of positions, directions, quaternions, poses and joints.
class ConstraintBounds {
 public:
  ConstraintBounds(const State& scene, const Residual& residual);

  /// False where nothing is known of its feature.
  bool areKnown() const { return known_; }

  /// For the motion that `bounds` has, whose dofs change by `change`. Both have a number per row.
  void eval(const MotionBounds& bounds, const VectorXd& change, Eigen::Ref<VectorXd> speed,
            Eigen::Ref<VectorXd> bend) const;

 private:
  using Rates = MotionBounds::Rates;
  Rates ratesOf(const LaneRows::Block& block, const MotionBounds& bounds, const VectorXd& change) const;
  Rates point(const MotionBounds& bounds, int frame, int ancestor) const;

  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  LaneRowList list_;
  MatrixXd weights_;  ///< of the feature's rows in those of the residual
  bool known_;
};

}  // namespace kinegraph
