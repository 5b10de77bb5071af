#include "kinegraph/features/position.h"

#include "kinegraph/features/eval_formula.h"

namespace kinegraph::inline features_internal {

void Position::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const State& state = *states[0];
  const Vec3d p_a = vec3(state.position(a_));
  switch (kind_) {
    case Kind::world:
      return evalFormula(lanes::PositionRows<double>{p_a}, state, a_, -1, y, J);
    case Kind::difference:
      return evalFormula(lanes::OffsetRows<double>{p_a, vec3(state.position(b_))}, state, a_, b_, y, J);
    case Kind::relative: {
      const RigidTransform X = state.pose(b_);
      // Does not use the formula for the value: Eigen sums x + (y + z), lanes (x + y) + z, and recorded results depend
      // on the last bits of both.
      const Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> R_BW = X.R.transpose().topRows(rows_);
      y = R_BW * (state.position(a_) - X.p);
      const lanes::RelativePositionRows<double> formula{
          p_a, {vec3(X.R.col(0)), vec3(X.R.col(1)), vec3(X.R.col(2))}, vec3(X.p)};
      if (J) addFormulaRates(formula, state, a_, b_, rows_, *J);
    }
  }
}

/// A position relative to a frame is supported only if that frame is fixed.
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

}  // namespace kinegraph::inline features_internal
