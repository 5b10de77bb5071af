#include "kinegraph/features/box.h"

namespace kinegraph::inline features_internal {

BoxRegion::BoxRegion(Kind kind, int object, int box, const Geometry& geometry)
    : dims_(kind == Kind::above ? 2 : 3), object_(object), box_(box) {
  half_ << geometry.size[0], geometry.size[1], geometry.size[2];
  half_ *= .5;
  const double rounding = geometry.size.size() > 3 ? geometry.size[3] : 0.;
  half_ = kind == Kind::above ? Vector3d(half_.array() - rounding) : Vector3d((half_.array() - .01).max(.01));
}

void BoxRegion::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vector3d p_WA = state.position(object_);
  const RigidTransform X_WB = state.pose(box_);
  const Matrix3d R_BW = X_WB.R.transpose();
  const Vector3d p_BA = R_BW * (p_WA - X_WB.p);
  y.head(dims_) = (p_BA - half_).head(dims_);
  y.tail(dims_) = (-p_BA - half_).head(dims_);
  if (!J) return;
  const Matrix3d none = Matrix3d::Zero();
  for (double sign : {1., -1.}) {
    const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> rows = sign * R_BW.topRows(dims_);
    JacobianRows own = sign > 0. ? J->topRows(dims_) : J->bottomRows(dims_);
    state.addJacobian(object_, p_WA, rows, none, own);
    state.addJacobian(box_, p_WA, -rows, none, own);
  }
}

void StandingAbove::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vector3d p_WA = state.position(object_), p_WB = state.position(support_);
  y[0] = p_WA.z() - p_WB.z() - gap_;
  if (!J) return;
  const Eigen::RowVector3d up(0., 0., 1.), none(0., 0., 0.);
  state.addJacobian(object_, p_WA, up, none, *J);
  state.addJacobian(support_, p_WB, -up, none, *J);
}

}  // namespace kinegraph::inline features_internal
