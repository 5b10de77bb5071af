#include "kinegraph/nlp/finite_difference_nlp.h"

#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph::inline nlp_internal {

FiniteDifferenceNlp::FiniteDifferenceNlp(Nlp& nlp, double step)
    : nlp_(nlp), step_(step), plus_(Eigen::Index(nlp.types().size())), minus_(plus_.size()) {
  types_ = nlp.types();
  lower_ = nlp.lower();
  upper_ = nlp.upper();
}

void FiniteDifferenceNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, x, phi, J);
  if (J) {
    moved_ = x;
    for (int i = 0; i < x.size(); ++i) {
      moved_[i] = x[i] + step_;
      nlp_.evaluate(moved_, plus_, nullptr);
      moved_[i] = x[i] - step_;
      nlp_.evaluate(moved_, minus_, nullptr);
      moved_[i] = x[i];
      for (Eigen::Index row = 0; row < plus_.size(); ++row)
        J->values[std::size_t(row * x.size() + i)] = (plus_[row] - minus_[row]) / (2. * step_);
    }
  }
  nlp_.evaluate(x, phi, nullptr);
}

}  // namespace kinegraph::inline nlp_internal
