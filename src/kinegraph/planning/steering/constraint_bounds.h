#pragma once

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/features/residual.h"

namespace kinegraph::inline planning_internal {

/// Bounds of the derivatives of the rows y of a residual along an edge q(s):
///
///     |dy/ds| <= speed,    |d^2y/ds^2| <= curvature
///
/// A row is a sum of products of points, directions and joints, whose bounds DisplacementBound has. The bound of a
/// product a b is |a''| |b| + 2 |a'| |b'| + |a| |b''|. Bounds exist for positions, directions, quaternions, poses and
/// joints.
class ConstraintBounds {
 public:
  ConstraintBounds(const State& scene, const Residual& residual);

  /// False if there are no bounds for the feature.
  bool areKnown() const { return known_; }

  /// Writes the bounds for the edge that `bounds` was set to, whose dofs change by `change`: one number per row.
  void eval(const DisplacementBound& bounds, const VectorXd& change, Eigen::Ref<VectorXd> speed,
            Eigen::Ref<VectorXd> curvature) const;

 private:
  using Rates = DisplacementBound::Rates;
  Rates ratesOf(const LaneRows::Block& block, const DisplacementBound& bounds, const VectorXd& change) const;
  Rates point(const DisplacementBound& bounds, int frame, int ancestor) const;

  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  LaneRowList list_;
  MatrixXd weights_;  ///< of the rows of the feature in those of the residual
  bool known_;
};

}  // namespace kinegraph::inline planning_internal
