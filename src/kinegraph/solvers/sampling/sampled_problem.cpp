#include "kinegraph/solvers/sampling/sampled_problem.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline solvers_internal {

namespace {

double squaredViolation(const Nlp& nlp, const VectorXd& phi) {
  double sum = 0.;
  for (int row = 0; row < phi.size(); ++row) sum += std::pow(violation(nlp.types()[row], phi[row]), 2);
  return sum;
}

}  // namespace

VectorXd normalVector(Eigen::Index n, Rng& rng) {
  VectorXd z(n);
  for (double& value : z) value = rng.normal();
  return z;
}

SampledProblem::SampledProblem(Nlp& nlp, const SamplerOptions& options, const EvaluationCallback& callback)
    : nlp_(nlp), options_(options), callback_(callback), J_(nlp.makeJacobian()) {
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    if (nlp.types()[row] == ObjectiveType::eq) equalities_.push_back(row);
  }
}

SampledPoint SampledProblem::at(const VectorXd& x) {
  SampledPoint point{x, VectorXd(Eigen::Index(nlp_.types().size()))};
  nlp_.evaluate(x, point.phi, nullptr);
  ++evals_;
  if (callback_ && !callback_(x, point.phi)) cancelled_ = true;
  const std::string trouble = describeNotFinite(nlp_, point.phi, nullptr);
  if (!trouble.empty() && evals_ == 1) throw ValueError(cat("at the first point, ", trouble));
  if (!trouble.empty() || (x.array() < nlp_.lower().array()).any() || (x.array() > nlp_.upper().array()).any()) {
    point.slack = std::numeric_limits<double>::infinity();
    return point;
  }
  for (int row = 0; row < point.phi.size(); ++row) {
    const double y = point.phi[row];
    const ObjectiveType type = nlp_.types()[row];
    point.slack += violation(type, y);
    if (type == ObjectiveType::f) point.energy += y;
    if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && y > 0.)) point.energy += y * y;
  }
  return point;
}

void SampledProblem::differentiate(const SampledPoint& point) {
  if (differentiated_.size() == point.x.size() && differentiated_ == point.x) return;
  VectorXd phi(point.phi.size());
  nlp_.evaluate(point.x, phi, &J_);
  ++evals_;
  if (const std::string trouble = describeNotFinite(nlp_, phi, &J_); !trouble.empty())
    throw ValueError(cat("while sampling, ", trouble));
  differentiated_ = point.x;
}

VectorXd SampledProblem::equalities(const SampledPoint& point) const { return point.phi(equalities_); }

MatrixXd SampledProblem::equalityJacobian(const SampledPoint& point) {
  if (equalities_.empty()) return MatrixXd::Zero(0, point.x.size());
  differentiate(point);
  MatrixXd rows = MatrixXd::Zero(Eigen::Index(equalities_.size()), point.x.size());
  VectorXd row(point.x.size());
  for (std::size_t i = 0; i < equalities_.size(); ++i) {
    row.setZero();
    J_.addRowTo(equalities_[i], 1., row);
    rows.row(Eigen::Index(i)) = row;
  }
  return rows;
}

VectorXd SampledProblem::energyGradient(const SampledPoint& point) {
  differentiate(point);
  VectorXd gradient = VectorXd::Zero(point.x.size());
  for (int row = 0; row < point.phi.size(); ++row) {
    const ObjectiveType type = nlp_.types()[row];
    if (type == ObjectiveType::f) J_.addRowTo(row, 1., gradient);
    if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && point.phi[row] > 0.))
      J_.addRowTo(row, 2. * point.phi[row], gradient);
  }
  return gradient;
}

/// Returns -alpha (2 mu J_s^T J_s + lambda I)^-1 2 mu J_s^T s, among the variables that are not at active bounds, plus
/// noise.
VectorXd SampledProblem::downhillStep(const SampledPoint& point, double alpha, Rng& rng, bool noisy,
                                      double& predicted) {
  differentiate(point);
  const Eigen::Index n = point.x.size();
  MatrixXd H = MatrixXd::Zero(n, n);
  VectorXd g = VectorXd::Zero(n), row(n);
  for (int i = 0; i < point.phi.size(); ++i) {
    const ObjectiveType type = nlp_.types()[i];
    const double s = point.phi[i];
    if (violation(type, s) == 0.) continue;
    row.setZero();
    J_.addRowTo(i, type != ObjectiveType::eq && options_.ineqOverstep > 1. ? 1. / options_.ineqOverstep : 1., row);
    g += 2. * options_.penaltyMu * s * row;
    H.selfadjointView<Eigen::Lower>().rankUpdate(row, 2. * options_.penaltyMu);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool is_fixed = (point.x[i] <= nlp_.lower()[i] && g[i] > 0.) || (point.x[i] >= nlp_.upper()[i] && g[i] < 0.);
    if (!is_fixed) continue;
    g[i] = 0.;
    H.row(i).setZero();
    H.col(i).setZero();
  }
  H.diagonal().array() += options_.slackRegLambda;
  const Eigen::LLT<MatrixXd> factor(H);
  VectorXd step = -alpha * (options_.downhillMethod == "GN" ? VectorXd(factor.solve(g)) : g);
  const double length = step.norm();
  if (length > options_.slackMaxStep) step *= options_.slackMaxStep / length;
  predicted = -g.dot(step);
  if (noisy && options_.downhillNoiseMethod != "none") {
    VectorXd noise = options_.downhillNoiseSigma * normalVector(n, rng);
    if (options_.downhillNoiseMethod == "cov") factor.matrixU().solveInPlace(noise);
    step += noise;
  }
  return step;
}

bool SampledProblem::goDownhill(SampledPoint& point, Rng& rng, bool noisy) {
  double alpha = options_.slackStepAlpha;
  for (int step = 0; step < options_.downhillMaxSteps && !isFeasible(point) && !cancelled_; ++step) {
    if (alpha < 1e-6 * options_.slackStepAlpha) return false;
    double predicted = 0.;
    const VectorXd d = downhillStep(point, alpha, rng, noisy, predicted);
    SampledPoint next = at((point.x + d).cwiseMax(nlp_.lower()).cwiseMin(nlp_.upper()));
    const double before = options_.penaltyMu * squaredViolation(nlp_, point.phi);
    const double after = std::isfinite(next.slack) ? options_.penaltyMu * squaredViolation(nlp_, next.phi)
                                                   : std::numeric_limits<double>::infinity();
    bool accepted = std::isfinite(after);
    if (options_.downhillRejectMethod == "Wolfe") accepted = after <= before - .01 * predicted;
    if (options_.downhillRejectMethod == "MH") accepted = accepted && rng.uniform() < std::exp(before - after);
    alpha = accepted ? std::min(options_.slackStepAlpha, 2. * alpha) : .5 * alpha;
    if (accepted) point = std::move(next);
  }
  return isFeasible(point);
}

}  // namespace kinegraph::inline solvers_internal
