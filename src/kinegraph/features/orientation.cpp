#include "kinegraph/features/orientation.h"

#include "kinegraph/features/eval_formula.h"

namespace kinegraph::inline features_internal {

Eigen::Matrix<double, 4, 3> quaternionRates(const Quaterniond& q) {
  Eigen::Matrix<double, 4, 3> E;
  E.row(0) = -.5 * q.vec().transpose();
  E.bottomRows<3>() = .5 * (q.w() * Matrix3d::Identity() - skew(q.vec()));
  return E;
}

/// Does not use row_formulas.h: Eigen sums the trace and products of quaternions in another order, and the rates here
/// are a 4 x 3 matrix that all dofs share. Both round differently, and recorded results depend on the last bits of
/// both.
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
  const Vec3d u = vec3(state.pose(a_).R.col(axis_));
  switch (kind_) {
    case Kind::world:
      return evalFormula(lanes::AxisRows<double>{u}, state, a_, -1, y, J);
    case Kind::difference:
      return evalFormula(lanes::AxisOffsetRows<double>{u, vec3(state.pose(b_).R.col(axis_))}, state, a_, b_, y, J);
    case Kind::relative: {
      // Does not use RelativeAxisRows, which rotates u and then changes its frame. Here this is one matrix for all
      // dofs, whose products round differently, and recorded results depend on the last bits of both.
      const Matrix3d R_BW = state.pose(b_).R.transpose(), none = Matrix3d::Zero();
      const Vector3d axis = state.pose(a_).R.col(axis_);
      y = R_BW * axis;
      if (!J) return;
      const Matrix3d rates = -R_BW * skew(axis);
      state.addJacobian(a_, Vector3d::Zero(), none, rates, *J);
      state.addJacobian(b_, Vector3d::Zero(), none, -rates, *J);
    }
  }
}

bool Axis::addLaneRows(LaneRowList& list) const {
  using Block = LaneRows::Block;
  list.addAxis(kind_ == Kind::world        ? Block::axis
               : kind_ == Kind::difference ? Block::axis_offset
                                           : Block::axis_relative,
               axis_, a_, b_);
  return true;
}

/// An axis relative to a frame is supported only if that frame is fixed.
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
  const Vec3d u = vec3(state.pose(a_).R.col(axis_a_)), v = vec3(state.pose(b_).R.col(axis_b_));
  evalFormula(lanes::AxisProductRows<double>(u, v), state, a_, b_, y, J);
}

bool AxisProduct::addLaneRows(LaneRowList& list) const {
  list.addAxisProduct(axis_a_, axis_b_, a_, b_);
  return true;
}

/// Supported if one of the frames is fixed.
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
  const Vec3d u = vec3(state.pose(a_).R.col(2)), v = vec3(state.pose(b_).R.col(axis_));
  evalFormula(lanes::AxisOffsetRows<double>{u, v}, state, a_, b_, y, J);
}

}  // namespace kinegraph::inline features_internal
