#include "kinegraph/solvers/problems/cost_function.h"

#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/interface/requirements.h"

namespace kinegraph::inline solvers_internal {

CostFunction::CostFunction(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                           const EvaluationCallback& callback, const char* method, bool with_gradient)
    : nlp_(nlp),
      options_(options),
      callback_(callback),
      phi_(Eigen::Index(nlp.types().size())),
      J_(nlp.makeJacobian()) {
  options.validate();
  requireNoConstraints(nlp, method);
  requireStart(nlp, x0);
  const double inf = std::numeric_limits<double>::infinity();
  lower_ = options.boundedNewton ? nlp.lower() : VectorXd::Constant(nlp.dimension(), -inf);
  upper_ = options.boundedNewton ? nlp.upper() : VectorXd::Constant(nlp.dimension(), inf);
  start_ = best_x_ = clip(x0);
  best_value_ = inf;
  start_value_ = evaluate(start_, with_gradient ? &start_gradient_ : nullptr);
  if (!trouble_.empty()) throw ValueError(cat("at the start, ", trouble_));
}

double CostFunction::evaluate(const VectorXd& x, VectorXd* gradient) {
  nlp_.evaluate(x, phi_, gradient ? &J_ : nullptr);
  ++evals_;
  if (callback_ && !callback_(x, phi_)) cancelled_ = true;
  trouble_ = describeNotFinite(nlp_, phi_, gradient ? &J_ : nullptr);
  if (!trouble_.empty()) return std::numeric_limits<double>::infinity();
  if (gradient) gradient->setZero(x.size());
  double sum = 0.;
  for (int row = 0; row < phi_.size(); ++row) {
    const ObjectiveType type = nlp_.types()[row];
    const double y = phi_[row];
    if (type == ObjectiveType::f) {
      sum += y;
      if (gradient) J_.addRowTo(row, 1., *gradient);
    } else if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && y > 0.)) {
      sum += y * y;
      if (gradient) J_.addRowTo(row, 2. * y, *gradient);
    }
  }
  if (sum < best_value_) {
    best_value_ = sum;
    best_x_ = x;
  }
  return sum;
}

VectorXd CostFunction::freeGradient(const VectorXd& x, const VectorXd& gradient) const {
  VectorXd free = gradient;
  for (int i = 0; i < x.size(); ++i) {
    if ((gradient[i] > 0. && x[i] <= lower_[i]) || (gradient[i] < 0. && x[i] >= upper_[i])) free[i] = 0.;
  }
  return free;
}

SolverResult CostFunction::result(SolverStatus status, std::string message) {
  SolverResult out;
  out.x = best_x_;
  out.evals = evals_;
  out.status = cancelled_ ? SolverStatus::cancelled : status;
  out.message = cancelled_ ? "cancelled by the caller" : std::move(message);
  if (!cancelled_ && status != SolverStatus::converged && evals_ >= options_.stopEvals) {
    out.status = SolverStatus::limit;
    out.message = cat("limit of ", options_.stopEvals, " evaluations");
  }
  if (out.status == SolverStatus::stalled && !trouble_.empty()) out.message += cat("; at the next point, ", trouble_);
  nlp_.evaluate(best_x_, phi_, nullptr);
  out.setSums(nlp_.types(), phi_, options_.constraintTolerance());
  return out;
}

}  // namespace kinegraph::inline solvers_internal
