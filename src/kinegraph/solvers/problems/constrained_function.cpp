#include "kinegraph/solvers/problems/constrained_function.h"

#include <algorithm>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/interface/requirements.h"

namespace kinegraph::inline solvers_internal {

ConstrainedFunction::ConstrainedFunction(Nlp& nlp)
    : nlp_(nlp),
      lazy_(nlp.lazyConstraints()),
      lower_(nlp.lower()),
      upper_(nlp.upper()),
      last_x_(lower_),
      moved_phi_(nlp.types().size()) {
  costs_.reserve(nlp.types().size());
  constraints_.reserve(nlp.types().size());
  std::vector<int> inequalities;
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    switch (nlp.types()[row]) {
      case ObjectiveType::f:
        has_f_ = true;
        [[fallthrough]];
      case ObjectiveType::sos:
      case ObjectiveType::ineqP:
        costs_.push_back(row);
        break;
      case ObjectiveType::eq:
        constraints_.push_back(row);
        break;
      case ObjectiveType::ineq:
      case ObjectiveType::ineqB:
        inequalities.push_back(row);
        break;
      case ObjectiveType::none:
        break;
    }
  }
  equalities_ = int(constraints_.size());
  constraints_.insert(constraints_.end(), inequalities.begin(), inequalities.end());
  only_squares_ =
      std::all_of(costs_.begin(), costs_.end(), [this](int row) { return types()[row] == ObjectiveType::sos; });
}

void ConstrainedFunction::begin(const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback) {
  options.validate();
  requireStart(nlp_, x0);
  callback_ = &callback;
  tolerance_ = options.constraintTolerance();
  lower_ = nlp_.lower();
  upper_ = nlp_.upper();
  if (!options.boundedNewton) {
    lower_.setConstant(-std::numeric_limits<double>::infinity());
    upper_ = -lower_;
  }
  evals_ = 0;
  has_best_ = false;
}

EvaluatedPoint ConstrainedFunction::makePoint() const {
  EvaluatedPoint point;
  point.x.setZero(nlp_.dimension());
  point.phi.setZero(Eigen::Index(types().size()));
  point.J = nlp_.makeJacobian();
  point.c.setZero(Eigen::Index(constraints_.size()));
  return point;
}

bool ConstrainedFunction::evaluate(EvaluatedPoint& point) {
  nlp_.evaluate(point.x, point.phi, &point.J);
  last_x_ = point.x;
  ++evals_;
  summarize(point);
  return !*callback_ || (*callback_)(point.x, point.phi);
}

/// Computes the members that follow from phi and J.
void ConstrainedFunction::summarize(EvaluatedPoint& point) const {
  for (std::size_t j = 0; j < constraints_.size(); ++j) point.c[Eigen::Index(j)] = point.phi[constraints_[j]];
  point.cost = cost(point.phi);
  const Eigen::Index inequalities = point.c.size() - equalities_;
  point.violation = 0.;
  if (equalities_ > 0) point.violation = point.c.head(equalities_).lpNorm<Eigen::Infinity>();
  if (inequalities > 0) point.violation = std::max(point.violation, point.c.tail(inequalities).maxCoeff());
  point.finite = describeNotFinite(nlp_, point.phi, &point.J).empty();
}

Refinement ConstrainedFunction::activateConstraints(EvaluatedPoint& point, bool is_solution,
                                                    std::vector<int>& activated) {
  activated.clear();
  if (!lazy_ || !lazy_->hasCapacity()) return Refinement::none;
  const Refinement found = lazy_->activate(point.x, is_solution, point.phi, point.J, activated);
  last_x_ = point.x;
  if (activated.empty()) return found;
  summarize(point);
  forceBest(point);
  return found;
}

void ConstrainedFunction::requireFiniteStart(const EvaluatedPoint& point) const {
  if (!point.finite) throw ValueError(cat("at the start, ", describeNotFinite(nlp_, point.phi, &point.J)));
}

double ConstrainedFunction::cost(const VectorXd& phi) const {
  double sum = 0.;
  if (only_squares_) {
    for (int row : costs_) sum += phi[row] * phi[row];
    return sum;
  }
  for (int row : costs_) {
    const ObjectiveType type = types()[row];
    if (type == ObjectiveType::f) sum += phi[row];
    if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && phi[row] > 0.)) sum += phi[row] * phi[row];
  }
  return sum;
}

void ConstrainedFunction::costGradient(const VectorXd& phi, const Jacobian& J, VectorXd& gradient) const {
  gradient.setZero(nlp_.dimension());
  for (int row : costs_) {
    const ObjectiveType type = types()[row];
    if (type == ObjectiveType::f) J.addRowTo(row, 1., gradient);
    if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && phi[row] > 0.))
      J.addRowTo(row, 2. * phi[row], gradient);
  }
}

void ConstrainedFunction::generalGradient(const Jacobian& J, const VectorXd& multipliers, VectorXd& gradient) const {
  gradient.setZero(nlp_.dimension());
  for (int row : costs_) {
    if (types()[row] == ObjectiveType::f) J.addRowTo(row, 1., gradient);
  }
  addConstraintGradient(J, multipliers, gradient);
}

void ConstrainedFunction::addConstraintGradient(const Jacobian& J, const VectorXd& multipliers,
                                                VectorXd& gradient) const {
  for (Eigen::Index j = 0; j < multipliers.size(); ++j)
    J.addRowTo(constraints_[std::size_t(j)], multipliers[j], gradient);
}

void ConstrainedFunction::moveTo(const PointValues& point) {
  if (evals_ > 0 && last_x_ == point.x) return;
  moved_phi_ = point.phi;
  nlp_.evaluate(point.x, moved_phi_, nullptr);
  last_x_ = point.x;
}

void ConstrainedFunction::remember(const PointValues& point) {
  const bool both_hold = point.violation <= tolerance_ && best_.violation <= tolerance_;
  if (!has_best_ || (both_hold ? point.cost < best_.cost : point.violation < best_.violation)) forceBest(point);
}

void ConstrainedFunction::forceBest(const PointValues& point) {
  has_best_ = true;
  best_ = point;
}

SolverResult ConstrainedFunction::result(const PointValues& point, const VectorXd& multipliers, SolverStatus status,
                                         std::string message) {
  SolverResult out;
  out.x = point.x;
  out.dual = VectorXd::Zero(point.phi.size());
  for (std::size_t j = 0; j < constraints_.size(); ++j) out.dual[constraints_[j]] = multipliers[Eigen::Index(j)];
  out.evals = evals_;
  out.setSums(types(), point.phi, tolerance_);
  out.status = status;
  out.message = std::move(message);
  moveTo(point);
  return out;
}

}  // namespace kinegraph::inline solvers_internal
