#include "kinegraph/features/position.h"

namespace kinegraph {

void Position::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vector3d p_WA = state.position(a_);
  if (kind_ == Kind::relative) {
    const RigidTransform X_WB = state.pose(b_);
    const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> R_BW = X_WB.R.transpose().topRows(rows_);
    y = R_BW * (p_WA - X_WB.p);
    if (!J) return;
    const Matrix3d zero = Matrix3d::Zero();
    state.addJacobian(a_, p_WA, R_BW, zero, *J);
    state.addJacobian(b_, p_WA, -R_BW, zero, *J);
    return;
  }
  y = p_WA;
  if (J) state.addPointJacobian(a_, p_WA, 1., *J);
  if (kind_ == Kind::world) return;
  const Vector3d p_WB = state.position(b_);
  y -= p_WB;
  if (J) state.addPointJacobian(b_, p_WB, -1., *J);
}

/// Relative to a frame only where that stands still.
bool Position::hasCurvature(const State& state) const {
  if (kind_ == Kind::relative && state.moves(b_)) return false;
  return state.hasCurvature(a_) && (kind_ == Kind::world || state.hasCurvature(b_));
}

void Position::addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const {
  if (kind_ == Kind::relative) {
    return state.addPointCurvature(a_, state.position(a_), state.pose(b_).R.leftCols(rows_) * weights, H);
  }
  state.addPointCurvature(a_, state.position(a_), weights, H);
  if (kind_ == Kind::difference) state.addPointCurvature(b_, state.position(b_), -weights, H);
}

bool Position::addLaneRows(LaneRowList& list) const {
  using Block = LaneRows::Block;
  list.addPosition(kind_ == Kind::world        ? Block::position
                   : kind_ == Kind::difference ? Block::offset
                                               : Block::relative,
                   a_, b_, rows_);
  return true;
}

}  // namespace kinegraph
