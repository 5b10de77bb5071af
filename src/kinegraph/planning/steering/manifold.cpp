#include "kinegraph/planning/steering/manifold.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/make_residual.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr int kProjections = 30;
constexpr double kLongestProjection = .3;  // of a dof, rad or m
constexpr double kAim = 1e-2;              // target of projections, as a share of the tolerance
constexpr int kDeepest = 10;               // halvings of an interval

}  // namespace

Manifold::Manifold(const State& scene, const JointSpace& space, const std::vector<MotionConstraint>& constraints,
                   double tolerance)
    : space_(&space), tolerance_(tolerance), state_(scene), edge_(scene) {
  for (const MotionConstraint& constraint : constraints) {
    const std::string name = cat(constraint.feature.name(), "(", join(constraint.frames), ")");
    if (constraint.type != ObjectiveType::eq && constraint.type != ObjectiveType::ineq)
      throw ValueError(cat("planMotion: the constraint ", name, " is neither eq nor ineq"));
    Residual residual = makeResidual(scene, constraint.feature, constraint.frames, constraint.scale, constraint.target);
    if (residual.order() != 0)
      throw ValueError(
          cat("planMotion: the constraint ", name, " needs several configurations; expected a feature of one"));
    const bool is_equality = constraint.type == ObjectiveType::eq;
    is_equality_.insert(is_equality_.end(), std::size_t(residual.rows()), is_equality);
    ConstraintBounds bounds(scene, residual);
    const bool is_bounded = bounds.areKnown() && (is_equality || residual.feature().quaternionRow() < 0);
    residuals_.push_back({std::move(residual), constraint.type, name, std::move(bounds), is_bounded});
  }
  const auto rows = Eigen::Index(is_equality_.size());
  y_.resize(rows);
  J_.resize(rows, scene.dofs());
  curvature_.resize(rows), deviation_.resize(rows);
}

/// Calls visit(row, first, count) for each constraint.
template <class Visit>
void Manifold::forRows(const Visit& visit) {
  int first = 0;
  for (Row& row : residuals_) {
    const int count = row.residual.rows();
    visit(row, first, count);
    first += count;
  }
}

/// Evaluates all rows into y_.
void Manifold::evalRows(const VectorXd& q, JacobianRows* J) {
  ++evaluations;
  state_.setJoints(q.data());
  const std::array<const State*, 1> states = {&state_};
  forRows([&](Row& row, int first, int count) {
    if (!J) return row.residual.eval(states, 1., y_.segment(first, count), nullptr);
    JacobianRows own = J->middleRows(first, count);
    row.residual.eval(states, 1., y_.segment(first, count), &own);
  });
}

void Manifold::measure(const VectorXd& q, bool with_jacobian) {
  J_.setZero();
  JacobianRows J = J_;
  evalRows(q, with_jacobian ? &J : nullptr);
  for (Eigen::Index i = 0; i < y_.size(); ++i) {
    if (is_equality_[std::size_t(i)] || y_[i] > 0.) continue;
    y_[i] = 0.;
    J_.row(i).setZero();
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

std::vector<std::string> Manifold::sampled() const {
  std::vector<std::string> names;
  for (const Row& row : residuals_)
    if (!row.is_bounded) names.push_back(row.name);
  return names;
}

/// Sets curvature_ and deviation_ for an edge.
void Manifold::boundRates(const VectorXd& from, const VectorXd& change, double deviation) {
  const VectorXd to = from + change;
  VectorXd unused(curvature_.size());
  curvature_.setZero(), deviation_.setZero();
  const auto bound = [&](const VectorXd& change, VectorXd& speed, VectorXd& curvature) {
    forRows([&](Row& row, int first, int count) {
      if (row.is_bounded) row.bounds.eval(edge_, change, speed.segment(first, count), curvature.segment(first, count));
    });
  };
  edge_.setEdge(from.data(), to.data());
  bound(change, unused, curvature_);
  if (deviation == 0.) return;
  const VectorXd away = VectorXd::Constant(from.size(), deviation), farthest = from.cwiseAbs().cwiseMax(to.cwiseAbs()),
                 beyond = farthest + away;
  edge_.setEdge(farthest.data(), beyond.data());
  unused.setZero();
  bound(away, deviation_, unused);
}

Manifold::Moment Manifold::momentAt(const VectorXd& from, const VectorXd& change, double time) {
  evalRows(from + time * change, nullptr);
  return {time, y_};
}

/// Whether all rows are within the tolerance, less the slack.
bool Manifold::keep(const VectorXd& values, const VectorXd& slack) const {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const double violation = is_equality_[std::size_t(i)] ? std::abs(values[i]) : values[i];
    if (!(violation + slack[i] <= tolerance_)) return false;
  }
  return true;
}

bool Manifold::holdsBetween(const VectorXd& from, const VectorXd& change, const Moment& a, const Moment& b, int depth) {
  const double width = b.time - a.time;
  const VectorXd slack = deviation_ + .125 * width * width * curvature_;
  if (keep(a.values, slack) && keep(b.values, slack)) return true;
  if (depth == kDeepest) return false;
  const Moment middle = momentAt(from, change, .5 * (a.time + b.time));
  return keep(middle.values, deviation_) && holdsBetween(from, change, a, middle, depth + 1) &&
         holdsBetween(from, change, middle, b, depth + 1);
}

bool Manifold::holdsAlong(const VectorXd& from, const VectorXd& to, double spacing, double deviation) {
  if (isEmpty()) return true;
  const VectorXd change = space_->difference(from, to);
  const int parts = std::max(2, int(std::ceil(space_->distance(from, to) / spacing)));
  boundRates(from, change, deviation);
  Moment before = momentAt(from, change, 0.);
  if (!keep(before.values, deviation_)) return false;
  for (int i = 1; i <= parts; ++i) {
    Moment now = momentAt(from, change, double(i) / parts);
    if (!keep(now.values, deviation_) || !holdsBetween(from, change, before, now, 0)) return false;
    before = std::move(now);
  }
  return true;
}

}  // namespace kinegraph::inline planning_internal
