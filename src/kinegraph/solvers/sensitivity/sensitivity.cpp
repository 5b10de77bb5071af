#include "kinegraph/solvers/sensitivity/sensitivity.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/sensitivity/polished_solution.h"
#include "kinegraph/solvers/sensitivity/redundant_bounds.h"

namespace kinegraph {

namespace {

constexpr double kSolved = 1e-7;  // largest relative residual of the linear system
constexpr std::size_t kNamed = 4;

const SolverResult& requireSolution(const SolverResult& result) {
  if (!result.problem)
    throw ValueError("the result has no problem, because it was loaded or made by hand; solve the problem first");
  if (!result.feasible)
    throw ValueError(cat("the result violates its constraints (the worst by ", result.violation,
                         ", scaled); expected a feasible solution: ", solverStatusName(result.status), ", ",
                         result.message));
  return result;
}

std::string listed(std::vector<std::string> names) {
  const std::size_t more = names.size() > kNamed ? names.size() - kNamed : 0;
  names.resize(names.size() - more);
  return cat(join(names, "; "), more > 0 ? cat("; and ", more, " more") : "");
}

/// Marks the terms of sums with a positive multiplier: it is not known which of them are active.
std::vector<char> unknownRows(const Separation& separation, const VectorXd& dual) {
  std::vector<char> unknown(separation.row_of.size(), false);
  for (std::size_t i = 0; i < unknown.size(); ++i)
    unknown[i] = separation.is_term[i] && (dual.size() == 0 || dual[separation.row_of[i]] > 0.);
  return unknown;
}

VectorXd separateDual(const Separation& separation, const VectorXd& dual) {
  if (dual.size() == 0) return dual;
  VectorXd separate = VectorXd::Zero(Eigen::Index(separation.row_of.size()));
  for (std::size_t i = 0; i < separation.row_of.size(); ++i) {
    if (!separation.is_term[i]) separate[Eigen::Index(i)] = dual[separation.row_of[i]];
  }
  return separate;
}

}  // namespace

Sensitivity::Sensitivity(const SolverResult& result, NlpParameters parameters, const SensitivityOptions& options)
    : Sensitivity(requireSolution(result).problem, result.x, result.dual, std::move(parameters), options) {}

Sensitivity::Sensitivity(std::shared_ptr<Nlp> problem, const VectorXd& x, const VectorXd& dual,
                         NlpParameters parameters, const SensitivityOptions& options)
    : problem_(std::move(problem)), parameters_(std::move(parameters)), holds_weak_(options.hold_weak) {
  const auto rows = Eigen::Index(problem_->types().size());
  if (x.size() != problem_->dimension())
    throw ValueError(cat("x has ", x.size(), " entries; the problem has ", problem_->dimension(), " variables"));
  if (dual.size() != 0 && dual.size() != rows)
    throw ValueError(cat("dual has ", dual.size(), " multipliers; the problem has ", rows, " residuals"));
  for (const auto& parameter : parameters_)
    names_.insert(names_.end(), parameter->names().begin(), parameter->names().end());
  separation_ = problem_->separation();
  nlp_ = separation_.problem ? separation_.problem.get() : problem_.get();
  try {
    if (separation_.problem) {
      solution_ = std::make_unique<PolishedSolution>(*nlp_, x, separateDual(separation_, dual),
                                                     unknownRows(separation_, dual), options.hold_weak);
      dual_ = separation_.joinedDual(solution_->dual, rows);
    } else {
      solution_ = std::make_unique<PolishedSolution>(*nlp_, x, dual, std::vector<char>(std::size_t(rows), false),
                                                     options.hold_weak);
      dual_ = solution_->dual;
    }
  } catch (...) {
    problem_->leaveAt(x);
    throw;
  }
  redundant_ = std::make_unique<RedundantBounds>(*solution_);
  problem_->leaveAt(solution_->x);
}

Sensitivity::~Sensitivity() = default;
Sensitivity::Sensitivity(Sensitivity&&) noexcept = default;
Sensitivity& Sensitivity::operator=(Sensitivity&&) noexcept = default;

const VectorXd& Sensitivity::x() const { return solution_->x; }
const VectorXd& Sensitivity::dual() const { return dual_; }
int Sensitivity::evals() const { return solution_->evals; }
int Sensitivity::freeDirections() const { return solution_->system().freeDirections(); }
bool Sensitivity::isSaddle() const { return solution_->system().isIndefinite(); }

/// Computes the derivatives of the conditions with respect to each parameter.
void Sensitivity::differentiate() {
  if (is_differentiated_) return;
  PolishedSolution& at = *solution_;
  const Eigen::Index n = at.x.size(), rows = at.phi.size();
  of_gradient_.setZero(n, size());
  of_rows_.setZero(Eigen::Index(at.active.size()), size());
  moved_bound_.assign(std::size_t(size()), -1);
  problem_->leaveAt(at.x);
  const NlpParameter::Point point{*nlp_, at.x, at.phi, at.J, at.weights, separation_.row_of};
  VectorXd phi(rows), gradient(n);
  int column = 0;
  for (const auto& parameter : parameters_) {
    for (int number = 0; number < parameter->size(); ++number, ++column) {
      phi.setZero();
      gradient.setZero();
      parameter->differentiate(point, number, phi, gradient);
      for (const int row : at.squared()) {
        if (phi[row] != 0.) at.J.addRowTo(row, 2. * phi[row], gradient);
      }
      of_gradient_.col(column) = gradient;
      for (std::size_t k = 0; k < at.active.size(); ++k) of_rows_(Eigen::Index(k), column) = phi[at.active[k]];
      const auto bound = parameter->bound(number);
      redundant_->move(at, *nlp_, phi, bound);
      if (!bound || !at.fixed[std::size_t(bound->variable)]) continue;
      const double value = bound->is_upper ? nlp_->upper()[bound->variable] : nlp_->lower()[bound->variable];
      if (at.x[bound->variable] == value) moved_bound_[std::size_t(column)] = bound->variable;
    }
  }
  problem_->leaveAt(at.x);
  is_differentiated_ = true;
}

void Sensitivity::checkResidual(double residual) { is_solvable_ = is_solvable_ && residual < kSolved; }

const MatrixXd& Sensitivity::jacobian() {
  if (has_jacobian_) return jacobian_;
  differentiate();
  PolishedSolution& at = *solution_;
  jacobian_.resize(at.x.size(), size());
  VectorXd dx(at.x.size()), dl;
  for (int column = 0; column < size(); ++column) {
    dx.setZero();
    if (const int variable = moved_bound_[std::size_t(column)]; variable >= 0) dx[variable] = 1.;
    checkResidual(at.system().solve(-of_gradient_.col(column), -of_rows_.col(column), dx, dl));
    jacobian_.col(column) = dx;
  }
  has_jacobian_ = true;
  return jacobian_;
}

VectorXd Sensitivity::gradient(const VectorXd& v) {
  PolishedSolution& at = *solution_;
  if (v.size() != at.x.size())
    throw ValueError(cat("the gradient has ", v.size(), " entries; the solution has ", at.x.size()));
  if (!v.allFinite()) throw ValueError("the gradient has entries that are not finite");
  differentiate();
  VectorXd w = VectorXd::Zero(v.size()), u;
  checkResidual(at.system().solve(v, VectorXd::Zero(Eigen::Index(at.active.size())), w, u));
  VectorXd sum = -(of_gradient_.transpose() * w) - of_rows_.transpose() * u;
  if (std::ranges::all_of(moved_bound_, [](int variable) { return variable < 0; })) return sum;
  const VectorXd left = at.system().leftBy(v, w, u);
  for (int column = 0; column < size(); ++column) {
    if (const int variable = moved_bound_[std::size_t(column)]; variable >= 0) sum[column] += left[variable];
  }
  return sum;
}

std::string Sensitivity::nameOfBound(int variable, bool is_upper) const {
  const VariableDescription of = problem_->describeVariable(variable);
  return cat(is_upper ? "upper" : "lower", " bound of ", of.name, of.slice >= 0 ? cat(" in slice ", of.slice) : "");
}

std::vector<std::string> Sensitivity::active() const {
  const PolishedSolution& at = *solution_;
  std::vector<std::string> names;
  for (const int row : at.active) {
    if (nlp_->types()[std::size_t(row)] != ObjectiveType::eq) names.push_back(nlp_->rowName(row));
  }
  for (int i = 0; i < int(at.x.size()); ++i) {
    if (at.fixed[std::size_t(i)] && nlp_->lower()[i] < nlp_->upper()[i])
      names.push_back(nameOfBound(i, at.x[i] >= nlp_->upper()[i]));
  }
  return names;
}

std::vector<std::string> Sensitivity::weak() {
  differentiate();
  std::vector<std::string> names;
  for (const int row : solution_->weak_rows) names.push_back(nlp_->rowName(row));
  for (const int i : solution_->weak_lower) names.push_back(nameOfBound(i, false));
  for (const int i : solution_->weak_upper) names.push_back(nameOfBound(i, true));
  return names;
}

bool Sensitivity::isRegular() { return message().empty(); }

std::string Sensitivity::message() {
  std::vector<std::string> sentences;
  if (const auto weak_names = weak(); !weak_names.empty())
    sentences.push_back(cat("the solution is not differentiable: the one-sided derivative ",
                            holds_weak_ ? "with" : "without",
                            " these weakly active constraints is given: ", listed(weak_names)));
  if (freeDirections() > 0)
    sentences.push_back(cat("costs and constraints leave ", freeDirections(),
                            freeDirections() == 1 ? " direction" : " directions",
                            " free: the derivative is the shortest one"));
  if (isSaddle())
    sentences.push_back("the solution is a saddle, not a minimum: the costs decrease in a feasible direction");
  if (!is_solvable_)
    sentences.push_back(
        "some parameters have no solution nearby: they separate redundant constraints or change the slope in a free "
        "direction");
  return join(sentences, ". ");
}

std::vector<std::string> Sensitivity::withoutEffect() {
  differentiate();
  std::vector<std::string> names;
  for (int column = 0; column < size(); ++column) {
    if (of_gradient_.col(column).isZero(0.) && of_rows_.col(column).isZero(0.) && moved_bound_[std::size_t(column)] < 0)
      names.push_back(names_[std::size_t(column)]);
  }
  return names;
}

}  // namespace kinegraph
