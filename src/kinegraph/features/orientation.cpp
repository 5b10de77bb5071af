#include "kinegraph/features/orientation.h"

namespace kinegraph {

Eigen::Matrix<double, 4, 3> quaternionRates(const Quaterniond& q) {
  Eigen::Matrix<double, 4, 3> E;
  E.row(0) = -.5 * q.vec().transpose();
  E.bottomRows<3>() = .5 * (q.w() * Matrix3d::Identity() - skew(q.vec()));
  return E;
}

void Orientation::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  using Rates = Eigen::Matrix<double, 4, 3>;
  const Rates none = Rates::Zero();
  const Quaterniond q_WA(state.pose(a_).R);
  if (kind_ == Kind::relative) {
    const RigidTransform X_WB = state.pose(b_);
    const Quaterniond q_BA = Quaterniond(X_WB.R).conjugate() * q_WA;
    y = wxyz(q_BA);
    if (!J) return;
    const Rates rates = quaternionRates(q_BA) * X_WB.R.transpose();
    state.addJacobian(a_, Vector3d::Zero(), none, rates, *J);
    state.addJacobian(b_, Vector3d::Zero(), none, -rates, *J);
    return;
  }
  y = wxyz(q_WA);
  if (J) state.addJacobian(a_, Vector3d::Zero(), none, quaternionRates(q_WA), *J);
  if (kind_ == Kind::world) return;
  Quaterniond q_WB(state.pose(b_).R);
  if (wxyz(q_WA).dot(wxyz(q_WB)) < 0.) q_WB.coeffs() *= -1.;
  y -= wxyz(q_WB);
  if (J) state.addJacobian(b_, Vector3d::Zero(), none, -quaternionRates(q_WB), *J);
}

bool Orientation::addLaneRows(LaneRowList& list) const {
  using Block = LaneRows::Block;
  list.addQuaternion(kind_ == Kind::world        ? Block::quaternion
                     : kind_ == Kind::difference ? Block::quaternion_offset
                                                 : Block::quaternion_relative,
                     a_, b_);
  return true;
}

void Axis::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Matrix3d none = Matrix3d::Zero();
  const Vector3d u = state.pose(a_).R.col(axis_);
  if (kind_ == Kind::relative) {
    const Matrix3d R_BW = state.pose(b_).R.transpose();
    y = R_BW * u;
    if (!J) return;
    const Matrix3d turn = -R_BW * skew(u);
    state.addJacobian(a_, Vector3d::Zero(), none, turn, *J);
    state.addJacobian(b_, Vector3d::Zero(), none, -turn, *J);
    return;
  }
  y = u;
  if (J) state.addJacobian(a_, Vector3d::Zero(), none, -skew(u), *J);
  if (kind_ == Kind::world) return;
  const Vector3d v = state.pose(b_).R.col(axis_);
  y -= v;
  if (J) state.addJacobian(b_, Vector3d::Zero(), none, skew(v), *J);
}

bool Axis::addLaneRows(LaneRowList& list) const {
  using Block = LaneRows::Block;
  list.addAxis(kind_ == Kind::world        ? Block::axis
               : kind_ == Kind::difference ? Block::axis_offset
                                           : Block::axis_relative,
               axis_, a_, b_);
  return true;
}

/// Relative to a frame only where that stands still.
bool Axis::hasCurvature(const State& state) const {
  if (kind_ == Kind::relative && state.moves(b_)) return false;
  return state.hasCurvature(a_) && (kind_ == Kind::world || state.hasCurvature(b_));
}

void Axis::addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const {
  const Vector3d u = state.pose(a_).R.col(axis_);
  if (kind_ == Kind::relative) return state.addDirectionCurvature(a_, u, state.pose(b_).R * weights, H);
  state.addDirectionCurvature(a_, u, weights, H);
  if (kind_ == Kind::difference) state.addDirectionCurvature(b_, state.pose(b_).R.col(axis_), -weights, H);
}

void AxisProduct::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vector3d u = state.pose(a_).R.col(axis_a_), v = state.pose(b_).R.col(axis_b_);
  y[0] = u.dot(v);
  if (!J) return;
  const Eigen::RowVector3d turn = u.cross(v).transpose(), none = Eigen::RowVector3d::Zero();
  state.addJacobian(a_, Vector3d::Zero(), none, turn, *J);
  state.addJacobian(b_, Vector3d::Zero(), none, -turn, *J);
}

bool AxisProduct::addLaneRows(LaneRowList& list) const {
  list.addAxisProduct(axis_a_, axis_b_, a_, b_);
  return true;
}

/// Where one of the frames stands still.
bool AxisProduct::hasCurvature(const State& state) const {
  return !(state.moves(a_) && state.moves(b_)) && state.hasCurvature(a_) && state.hasCurvature(b_);
}

void AxisProduct::addCurvature(const State& state, const VectorXd& weights, Eigen::Ref<MatrixXd> H) const {
  const Vector3d u = state.pose(a_).R.col(axis_a_), v = state.pose(b_).R.col(axis_b_);
  state.addDirectionCurvature(a_, u, weights[0] * v, H);
  state.addDirectionCurvature(b_, v, weights[0] * u, H);
}

void AxisDifference::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vector3d z = state.pose(a_).R.col(2), other = state.pose(b_).R.col(axis_);
  y = z - other;
  if (!J) return;
  const Matrix3d none = Matrix3d::Zero();
  state.addJacobian(a_, state.position(a_), none, Matrix3d(-skew(z)), *J);
  state.addJacobian(b_, state.position(b_), none, skew(other), *J);
}

}  // namespace kinegraph
