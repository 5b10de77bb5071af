#include "kinegraph/planning/steering/constraint_bounds.h"

#include <cmath>

namespace kinegraph {

namespace {

using Rates = MotionBounds::Rates;

Rates sum(const Rates& a, const Rates& b) { return {a.speed + b.speed, a.bend + b.bend, a.reach + b.reach}; }

/// Of a product, `reach` being a bound of its size.
Rates product(const Rates& a, const Rates& b) {
  return {a.speed * b.reach + a.reach * b.speed, a.bend * b.reach + 2. * a.speed * b.speed + a.reach * b.bend,
          a.reach * b.reach};
}

/// A rotation by half of the angle, as quaternions turn.
Rates half(const Rates& turn) {
  const double twist = turn.bend - turn.speed * turn.speed;
  return {.5 * turn.speed, .25 * turn.speed * turn.speed + .5 * twist, 1.};
}

/// How the rows of the feature enter those of the residual, without signs.
MatrixXd weightsOf(const Residual& residual) {
  const MatrixXd& scale = residual.scale();
  const int rows = residual.feature().rows();
  if (scale.size() == 0) return MatrixXd::Identity(rows, rows);
  if (residual.mixesRows()) return scale.cwiseAbs();
  if (scale.size() == 1) return std::abs(scale(0, 0)) * MatrixXd::Identity(rows, rows);
  return scale.col(0).cwiseAbs().asDiagonal();
}

}  // namespace

ConstraintBounds::ConstraintBounds(const State& scene, const Residual& residual)
    : model_(scene.sharedModel()),
      parameters_(scene.sharedParameters()),
      weights_(weightsOf(residual)),
      known_(residual.order() == 0 && residual.feature().addLaneRows(list_)) {
  // Both signs of a quaternion are one rotation. Where just some of its rows count, nothing says which one is meant.
  const bool turns = residual.feature().quaternionRow() >= 0;
  if (turns && (residual.mixesRows() || (weights_.diagonal().array() == 0.).any())) known_ = false;
}

/// The origin of a frame, as seen from a link that it hangs on.
Rates ConstraintBounds::point(const MotionBounds& bounds, int frame, int ancestor) const {
  return bounds.ratesOf(model_->frame_link[std::size_t(frame)], parameters_->frame_offset[std::size_t(frame)].p.norm(),
                        ancestor);
}

/// The largest of a block's rows.
Rates ConstraintBounds::ratesOf(const LaneRows::Block& block, const MotionBounds& bounds,
                                const VectorXd& change) const {
  using Block = LaneRows::Block;
  const auto link = [&](int frame) { return model_->frame_link[std::size_t(frame)]; };
  const auto ancestor = [&] { return bounds.commonLink(link(block.a), link(block.b)); };
  const auto turn = [&](int frame, int of) { return bounds.directionOf(link(frame), of); };
  const auto turnBetween = [&] { return product(turn(block.a, ancestor()), turn(block.b, ancestor())); };
  switch (block.kind) {
    case Block::position:
      return point(bounds, block.a, 0);
    case Block::offset:
      return sum(point(bounds, block.a, 0), point(bounds, block.b, 0));
    case Block::relative:
      return product(turn(block.b, ancestor()),
                     sum(point(bounds, block.a, ancestor()), point(bounds, block.b, ancestor())));
    case Block::quaternion:
      return half(turn(block.a, 0));
    case Block::quaternion_offset:
      return sum(half(turn(block.a, 0)), half(turn(block.b, 0)));
    case Block::quaternion_relative:
      return product(half(turn(block.a, ancestor())), half(turn(block.b, ancestor())));
    case Block::axis:
      return turn(block.a, 0);
    case Block::axis_offset:
      return sum(turn(block.a, 0), turn(block.b, 0));
    case Block::axis_relative:
    case Block::axis_product:
      return turnBetween();
    case Block::joint:
      return {std::abs(block.scale * change[block.a]), 0., 0.};
    case Block::twist:
      break;  // no values
  }
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  return {kUnknown, kUnknown, kUnknown};
}

void ConstraintBounds::eval(const MotionBounds& bounds, const VectorXd& change, Eigen::Ref<VectorXd> speed,
                            Eigen::Ref<VectorXd> bend) const {
  speed.setZero(), bend.setZero();
  for (const LaneRows::Block& block : list_.blocks()) {
    const Rates rates = ratesOf(block, bounds, change);
    const VectorXd weight = weights_.middleCols(block.row, block.rows).rowwise().norm();
    for (Eigen::Index i = 0; i < weight.size(); ++i) {
      if (weight[i] == 0.) continue;
      speed[i] += weight[i] * rates.speed;
      bend[i] += weight[i] * rates.bend;
    }
  }
}

}  // namespace kinegraph
