#include "kinegraph/control/horizon_nlp.h"

#include <algorithm>

namespace kinegraph::inline control_internal {

HorizonNlp::HorizonNlp(std::shared_ptr<Nlp> problem)
    : problem_(std::move(problem)),
      past_(problem_->types().size(), false),
      offset_(VectorXd::Zero(Eigen::Index(problem_->types().size()))) {
  types_ = problem_->types();
  lower_ = problem_->lower();
  upper_ = problem_->upper();
  for (int row = 0; row < int(types_.size()); ++row) linear_.push_back(problem_->isLinear(row));
}

void HorizonNlp::free() {
  std::fill(past_.begin(), past_.end(), false);
  lower_ = problem_->lower();
  upper_ = problem_->upper();
}

/// Past residuals keep their Jacobian: it has no effect, since bounds fix all past variables.
void HorizonNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  problem_->evaluate(x, phi, J);
  phi += offset_;
  for (std::size_t row = 0; row < past_.size(); ++row) {
    if (past_[row]) phi[Eigen::Index(row)] = 0.;
  }
}

}  // namespace kinegraph::inline control_internal
