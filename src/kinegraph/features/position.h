#pragma once

#include "kinegraph/features/feature.h"

namespace kinegraph::inline features_internal {

/// Position of frame A (m):                                            J
///
///     world                y = p_WA                                   Jp_A
///     difference to B      y = p_WA - p_WB                            Jp_A - Jp_B
///     relative to B        y = R_WB^T (p_WA - p_WB)                   R_WB^T (Jp_A - Jp_B at p_WA)
///
/// `rows` limits the relative position to its first rows: the xy part is the offset from the axis of a camera B
/// (gazeAt).
class Position final : public Feature {
 public:
  enum class Kind { world, difference, relative };
  Position(Kind kind, int a, int b = -1, int rows = 3) : kind_(kind), a_(a), b_(b), rows_(rows) {}

  int rows() const override { return rows_; }
  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override;
  bool addLaneRows(LaneRowList& list) const override;
  bool hasCurvature(const State& state) const override;
  void addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const override;

 private:
  Kind kind_;
  int a_, b_, rows_;
};

}  // namespace kinegraph::inline features_internal
