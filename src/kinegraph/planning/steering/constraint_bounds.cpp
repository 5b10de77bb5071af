#include "kinegraph/planning/steering/constraint_bounds.h"

#include <cmath>

namespace kinegraph::inline planning_internal {

namespace {

using Rates = DisplacementBound::Rates;

Rates sum(const Rates& a, const Rates& b) { return {a.speed + b.speed, a.curvature + b.curvature, a.reach + b.reach}; }

/// The rates of a product; `reach` bounds the size of a factor.
Rates product(const Rates& a, const Rates& b) {
  return {a.speed * b.reach + a.reach * b.speed, a.curvature * b.reach + 2. * a.speed * b.speed + a.reach * b.curvature,
          a.reach * b.reach};
}

/// The rates of a quaternion, which rotates by half of the angle.
Rates half(const Rates& rotation) {
  const double change = rotation.curvature - rotation.speed * rotation.speed;
  return {.5 * rotation.speed, .25 * rotation.speed * rotation.speed + .5 * change, 1.};
}

/// Absolute weights of the rows of the feature in those of the residual.
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
  // Both signs of a quaternion are one rotation. If only some of its rows count, the sign is ambiguous.
  const bool has_quaternion = residual.feature().quaternionRow() >= 0;
  if (has_quaternion && (residual.mixesRows() || (weights_.diagonal().array() == 0.).any())) known_ = false;
}

/// The rates of the origin of a frame relative to an ancestor of its link.
Rates ConstraintBounds::point(const DisplacementBound& bounds, int frame, int ancestor) const {
  return bounds.ratesOf(model_->frame_link[std::size_t(frame)], parameters_->frame_offset[std::size_t(frame)].p.norm(),
                        ancestor);
}

/// The largest rates of a block's rows.
Rates ConstraintBounds::ratesOf(const LaneRows::Block& block, const DisplacementBound& bounds,
                                const VectorXd& change) const {
  using Block = LaneRows::Block;
  const auto link = [&](int frame) { return model_->frame_link[std::size_t(frame)]; };
  const auto ancestor = [&] { return bounds.commonLink(link(block.a), link(block.b)); };
  const auto axis = [&](int frame, int of) { return bounds.directionRates(link(frame), of); };
  const auto axisProduct = [&] { return product(axis(block.a, ancestor()), axis(block.b, ancestor())); };
  switch (block.kind) {
    case Block::position:
      return point(bounds, block.a, 0);
    case Block::offset:
      return sum(point(bounds, block.a, 0), point(bounds, block.b, 0));
    case Block::relative:
      return product(axis(block.b, ancestor()),
                     sum(point(bounds, block.a, ancestor()), point(bounds, block.b, ancestor())));
    case Block::quaternion:
      return half(axis(block.a, 0));
    case Block::quaternion_offset:
      return sum(half(axis(block.a, 0)), half(axis(block.b, 0)));
    case Block::quaternion_relative:
      return product(half(axis(block.a, ancestor())), half(axis(block.b, ancestor())));
    case Block::axis:
      return axis(block.a, 0);
    case Block::axis_offset:
      return sum(axis(block.a, 0), axis(block.b, 0));
    case Block::axis_relative:
    case Block::axis_product:
      return axisProduct();
    case Block::joint:
      return {std::abs(block.scale * change[block.a]), 0., 0.};
    case Block::twist:
      break;  // no values
  }
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  return {kUnknown, kUnknown, kUnknown};
}

void ConstraintBounds::eval(const DisplacementBound& bounds, const VectorXd& change, Eigen::Ref<VectorXd> speed,
                            Eigen::Ref<VectorXd> curvature) const {
  speed.setZero(), curvature.setZero();
  for (const LaneRows::Block& block : list_.blocks()) {
    const Rates rates = ratesOf(block, bounds, change);
    const VectorXd weight = weights_.middleCols(block.row, block.rows).rowwise().norm();
    for (Eigen::Index i = 0; i < weight.size(); ++i) {
      if (weight[i] == 0.) continue;
      speed[i] += weight[i] * rates.speed;
      curvature[i] += weight[i] * rates.curvature;
    }
  }
}

}  // namespace kinegraph::inline planning_internal
