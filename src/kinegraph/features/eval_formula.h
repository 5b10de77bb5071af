#pragma once

// Evaluates a formula of kinematics/row_formulas.h for a single State. Like the formulas it is local to each source
// file that includes it.

#include "kinegraph/features/feature.h"
#include "kinegraph/kinematics/row_formulas.h"

namespace kinegraph::inline features_internal {

namespace {

using Vec3d = lanes::Vec3<double>;

inline Vec3d vec3(const Vector3d& a) { return {a[0], a[1], a[2]}; }

/// The motion of a dof, as input of the formulas.
struct TwistMotion {
  Vec3d angular, linear;

  Vec3d velocityAt(const Vec3d& point) const { return linear + cross(angular, point); }
};

/// Adds the Jacobian of the first rows of a formula of frames a and b (b = -1: of a alone) to J.
template <class Formula>
void addFormulaRates(const Formula& formula, const State& state, int a, int b, Eigen::Index rows, JacobianRows J) {
  double* const entries = J.data();
  const Eigen::Index stride = J.outerStride();
  const auto add = [&](int frame, bool of_b) {
    state.forTwists(frame, [&](int dof, const State::Twist& twist) {
      double rate[Formula::kRows];
      formula.rate(TwistMotion{vec3(twist.angular), vec3(twist.linear)}, of_b, rate);
      for (Eigen::Index r = 0; r < rows; ++r) entries[r * stride + dof] += rate[r];
    });
  };
  add(a, false);
  if (b >= 0) add(b, true);
}

/// Sets y to the value of a formula, and adds its Jacobian to J unless J is null.
template <class Formula>
void evalFormula(const Formula& formula, const State& state, int a, int b, Eigen::Ref<VectorXd> y, JacobianRows* J) {
  formula.value(y.data());
  if (J) addFormulaRates(formula, state, a, b, Formula::kRows, *J);
}

}  // namespace

}  // namespace kinegraph::inline features_internal
