#include "kinegraph/solvers/problems/relaxed_nlp.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph::inline solvers_internal {

RelaxedNlp::RelaxedNlp(Nlp& nlp, const std::vector<bool>& relaxed, int variable)
    : nlp_(nlp), variable_(variable), inner_phi_(Eigen::Index(nlp.types().size())), inner_(nlp.makeJacobian()) {
  using T = ObjectiveType;
  types_ = nlp.types();
  for (std::size_t row = 0; row < types_.size(); ++row) {
    T& type = types_[row];
    if (type == T::eq) {
      type = relaxed[row] ? T::sos : T::eq;
    } else if (type == T::ineq || type == T::ineqB) {
      type = relaxed[row] ? T::ineqP : T::ineq;
    } else {
      type = T::none;
    }
  }
  lower_ = nlp.lower();
  upper_ = nlp.upper();
  if (variable_ < 0) return;
  types_.insert(types_.end(), {T::ineqP, T::ineqP});
  lower_[variable_] = -std::numeric_limits<double>::infinity();
  upper_[variable_] = std::numeric_limits<double>::infinity();
}

Jacobian RelaxedNlp::makeJacobian() const {
  Jacobian J = nlp_.makeJacobian();
  if (variable_ >= 0) {
    J.addRow({{variable_, 1}});
    J.addRow({{variable_, 1}});
  }
  return J;
}

void RelaxedNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, x, phi, J);
  nlp_.evaluate(x, inner_phi_, J ? &inner_ : nullptr);
  phi.head(inner_phi_.size()) = inner_phi_;
  for (int row = 0; padding_ != 0. && row < inner_phi_.size(); ++row) {
    if (types_[row] == ObjectiveType::ineqP) phi[row] += padding_;
  }
  if (J) J->copyRows(inner_);
  if (variable_ < 0) return;
  const double low = nlp_.lower()[variable_], high = nlp_.upper()[variable_], far = -1.;
  phi[inner_phi_.size()] = std::isfinite(low) ? low - x[variable_] : far;
  phi[inner_phi_.size() + 1] = std::isfinite(high) ? x[variable_] - high : far;
  if (!J) return;
  J->segments[inner_.segments.size()].offset = int(J->values.size());
  J->segments[inner_.segments.size() + 1].offset = int(J->values.size()) + 1;
  J->values.push_back(std::isfinite(low) ? -1. : 0.);
  J->values.push_back(std::isfinite(high) ? 1. : 0.);
}

}  // namespace kinegraph::inline solvers_internal
