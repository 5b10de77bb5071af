#include "kinegraph/solvers/methods/penalty_methods.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/interface/requirements.h"
#include "kinegraph/solvers/problems/penalty_nlp.h"
#include "kinegraph/solvers/problems/relaxed_nlp.h"

namespace kinegraph::inline solvers_internal {

namespace {

/// Solves a sequence of auxiliary problems for `nlp`; the callback and the limits refer to `nlp`.
class Sequence {
 public:
  Sequence(Nlp& nlp, const SolverOptions& options, const EvaluationCallback& callback)
      : nlp_(nlp), options_(options), callback_(callback), phi_(Eigen::Index(nlp.types().size())) {
    options.validate();
    options_.verbose = std::max(0, options.verbose - 1);
  }

  SolverOptions& options() { return options_; }

  /// False if the limit is reached or the callback cancels the solve.
  bool solve(Nlp& other, VectorXd& x) {
    options_.stopEvals = limit_ - evals_;
    const auto callback = [&](const VectorXd& at, const VectorXd&) {
      nlp_.evaluate(at, phi_, nullptr);
      return callback_(at, phi_);
    };
    last_ = solveAugmentedLagrangian(other, x, options_, last_.dual,
                                     callback_ ? EvaluationCallback(callback) : EvaluationCallback());
    evals_ += last_.evals;
    x = last_.x;
    nlp_.evaluate(x, phi_, nullptr);
    return last_.status != SolverStatus::cancelled && evals_ < limit_;
  }

  const VectorXd& phi() const { return phi_; }
  const SolverResult& last() const { return last_; }

  /// Returns the result for the original problem. The status of a cancelled or limited solve comes first.
  SolverResult result(const VectorXd& x, double tolerance, SolverStatus status, std::string message) {
    SolverResult out;
    out.x = x;
    out.dual = VectorXd::Zero(phi_.size());
    out.evals = evals_;
    const bool ended =
        last_.status == SolverStatus::cancelled || (last_.status == SolverStatus::limit && evals_ >= limit_);
    out.status = ended ? last_.status : status;
    out.message = ended ? last_.message : std::move(message);
    nlp_.evaluate(x, phi_, nullptr);
    out.setSums(nlp_.types(), phi_, tolerance);
    return out;
  }

 private:
  Nlp& nlp_;
  SolverOptions options_;
  const EvaluationCallback& callback_;
  VectorXd phi_;
  SolverResult last_;
  int evals_ = 0, limit_ = options_.stopEvals;
};

double violationAfter(const Nlp& nlp, const Sequence& sequence) {
  return largestViolation(nlp.types(), sequence.phi());
}

}  // namespace

SolverResult solveSquaredPenalty(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                 const EvaluationCallback& callback, bool single) {
  const double tolerance = options.constraintTolerance();
  Sequence sequence(nlp, options, callback);
  PenaltyNlp penalized(nlp);
  VectorXd x = x0;
  double mu = options.muInit;
  bool continues = true;
  for (int round = 0; continues && round < options.stopOuters; ++round) {
    penalized.setWeight(mu);
    continues = sequence.solve(penalized, x);
    if (single || violationAfter(nlp, sequence) <= tolerance || mu >= options.muMax) break;
    mu = std::min(options.muMax, options.muInc * mu);
  }
  const double violation = violationAfter(nlp, sequence);
  const std::string message = cat("penalty weight ", mu, ", violation ", violation, "; ", sequence.last().message);
  if (single || violation <= tolerance) return sequence.result(x, tolerance, sequence.last().status, message);
  return sequence.result(x, tolerance, SolverStatus::stalled, message);
}

SolverResult solveLogBarrier(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                             const EvaluationCallback& callback) {
  requireStart(nlp, x0);
  VectorXd x = x0, phi(Eigen::Index(nlp.types().size()));
  if (options.boundedNewton) x = x.cwiseMax(nlp.lower()).cwiseMin(nlp.upper());
  nlp.evaluate(x, phi, nullptr);
  for (int row = 0; row < phi.size(); ++row) {
    if (!isInequality(nlp.types()[row]) || phi[row] < 0. || !std::isfinite(phi[row])) continue;
    throw ValueError(cat("OptMethod::logBarrier needs a start that strictly fulfills all inequalities; ",
                         nlp.rowName(row), " is ", phi[row], "; use slackGN_logBarrier, which finds such a start"));
  }
  Sequence sequence(nlp, options, callback);
  BarrierNlp barrier(nlp);
  const double tolerance = options.constraintTolerance();
  const bool needs_barrier = std::any_of(nlp.types().begin(), nlp.types().end(), isInequality);
  double mu = options.muLBInit;
  bool continues = true;
  for (int round = 0; continues && round < options.stopOuters; ++round) {
    barrier.setWeight(mu);
    continues = sequence.solve(barrier, x);
    if (!needs_barrier || mu <= .01 * options.stopTolerance) break;
    mu *= options.muLBDec;
  }
  SolverStatus status = sequence.last().status;
  if (status == SolverStatus::stalled && sequence.last().violation <= tolerance)
    status = SolverStatus::converged;  // stalled at the rounding of the barrier
  return sequence.result(x, tolerance, status, cat("barrier weight ", mu, "; ", sequence.last().message));
}

SolverResult solveSlack(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                        const EvaluationCallback& callback) {
  Sequence sequence(nlp, options, callback);
  const double tolerance = options.constraintTolerance();
  sequence.options().stopTolerance = std::min(options.stopTolerance, tolerance);
  RelaxedNlp slack(nlp, std::vector<bool>(nlp.types().size(), true));
  slack.setPadding(options.interiorPadding);
  VectorXd x = x0;
  bool continues = sequence.solve(slack, x);
  if (continues && violationAfter(nlp, sequence) > tolerance && options.interiorPadding > 0.) {
    slack.setPadding(0.);  // the interior may be empty
    sequence.solve(slack, x);
  }
  const double violation = violationAfter(nlp, sequence);
  const bool holds = violation <= tolerance;
  return sequence.result(
      x, tolerance, holds ? SolverStatus::converged : SolverStatus::infeasible,
      holds ? cat("all constraints hold to ", violation) : cat("no step reduces the violation ", violation));
}

}  // namespace kinegraph::inline solvers_internal
