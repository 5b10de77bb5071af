#include "kinegraph/motion/manifold.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

constexpr int kProjections = 30;
constexpr double kLongestProjection = .3;  // of a dof
constexpr double kAim = 1e-2;              // projections go for this share of the tolerance

}  // namespace

Manifold::Manifold(const State& scene, const JointSpace& space, const std::vector<MotionConstraint>& constraints,
                   double tolerance)
    : space_(&space), tolerance_(tolerance), state_(scene) {
  int rows = 0;
  for (const MotionConstraint& constraint : constraints) {
    const std::string name = cat(constraint.feature.name(), "(", join(constraint.frames), ")");
    if (constraint.type != ObjectiveType::eq && constraint.type != ObjectiveType::ineq)
      throw ValueError(cat("planMotion: the constraint ", name, " is neither eq nor ineq"));
    Residual residual = makeResidual(scene, constraint.feature, constraint.frames, constraint.scale, constraint.target);
    if (residual.order() != 0)
      throw ValueError(
          cat("planMotion: the constraint ", name, " needs several configurations; expected one of positions"));
    rows += residual.rows();
    residuals_.push_back({std::move(residual), constraint.type, name});
  }
  y_.resize(rows);
  J_.resize(rows, scene.dofs());
}

void Manifold::measure(const VectorXd& q, bool with_jacobian) {
  ++evaluations;
  state_.setJoints(q.data());
  const std::array<const State*, 1> states = {&state_};
  J_.setZero();
  int first = 0;
  for (Row& row : residuals_) {
    const int rows = row.residual.rows();
    JacobianRows J = J_.middleRows(first, rows);
    row.residual.eval(states, 1., y_.segment(first, rows), with_jacobian ? &J : nullptr);
    for (int i = first; i < first + rows; ++i) {
      if (row.type == ObjectiveType::eq || y_[i] > 0.) continue;
      y_[i] = 0.;
      J_.row(i).setZero();
    }
    first += rows;
  }
}

double Manifold::violation(const VectorXd& q) {
  if (isEmpty()) return 0.;
  measure(q, false);
  return y_.cwiseAbs().maxCoeff();
}

std::string Manifold::worst(const VectorXd& q) {
  measure(q, false);
  Eigen::Index worst = 0;
  if (y_.size() > 0) y_.cwiseAbs().maxCoeff(&worst);
  int first = 0;
  for (const Row& row : residuals_) {
    first += row.residual.rows();
    if (worst < first) return row.name;
  }
  return "";
}

bool Manifold::project(VectorXd& q) {
  if (isEmpty()) return true;
  for (int step = 0; step < kProjections; ++step) {
    measure(q, true);
    if (!y_.allFinite()) return false;
    if (y_.cwiseAbs().maxCoeff() <= kAim * tolerance_) return true;
    MatrixXd A = J_ * J_.transpose();
    A.diagonal().array() += 1e-9 + 1e-6 * A.diagonal().maxCoeff();
    VectorXd change = -(J_.transpose() * A.ldlt().solve(y_));
    const double longest = change.cwiseAbs().maxCoeff();
    if (longest > kLongestProjection) change *= kLongestProjection / longest;
    if (longest < 1e-14) break;
    q += change;
    space_->clamp(q);
    space_->normalize(q);
  }
  return violation(q) <= .5 * tolerance_;
}

bool Manifold::holdsAlong(const VectorXd& from, const VectorXd& to, double spacing) {
  if (isEmpty()) return true;
  const VectorXd change = space_->difference(from, to);
  const int parts = std::max(2, int(std::ceil(space_->distance(from, to) / spacing)));
  for (int i = 1; i <= parts; ++i)
    if (!(violation(from + double(i) / parts * change) <= tolerance_)) return false;
  return true;
}

}  // namespace kinegraph
