#include "kinegraph/solvers/problems/penalty_nlp.h"

#include <cmath>
#include <optional>

#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph::inline solvers_internal {

bool isInequality(ObjectiveType type) { return type == ObjectiveType::ineq || type == ObjectiveType::ineqB; }

PenaltyNlp::PenaltyNlp(Nlp& nlp) : nlp_(nlp), inner_(nlp.makeJacobian()) {
  types_ = nlp.types();
  for (ObjectiveType& type : types_) {
    if (type == ObjectiveType::eq) type = ObjectiveType::sos;
    if (isInequality(type)) type = ObjectiveType::ineqP;
  }
  lower_ = nlp.lower();
  upper_ = nlp.upper();
}

void PenaltyNlp::setWeight(double mu) { root_ = std::sqrt(mu); }

void PenaltyNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, x, phi, J);
  nlp_.evaluate(x, phi, J ? &inner_ : nullptr);
  if (J) J->copyRows(inner_);
  for (int row = 0; row < phi.size(); ++row) {
    if (types_[row] == nlp_.types()[row]) continue;
    phi[row] *= root_;
    if (!J || J->zero_row[std::size_t(row)]) continue;
    for (const Jacobian::Segment& segment : J->row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) J->values[segment.offset + i] *= root_;
    }
  }
}

BarrierNlp::BarrierNlp(Nlp& nlp) : nlp_(nlp), inner_(nlp.makeJacobian()), inner_phi_(Eigen::Index(nlp.types().size())) {
  types_ = nlp.types();
  for (ObjectiveType& type : types_) {
    if (isInequality(type)) type = ObjectiveType::f;
  }
  lower_ = nlp.lower();
  upper_ = nlp.upper();
}

void BarrierNlp::evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, x, phi, J);
  nlp_.evaluate(x, phi, J ? &inner_ : nullptr);
  if (J) J->copyRows(inner_);
  for (int row = 0; row < phi.size(); ++row) {
    if (!isInequality(nlp_.types()[row])) continue;
    const double room = -phi[row];
    phi[row] = room > 0. ? -mu_ * std::log(room) : std::nan("");
    if (!J || J->zero_row[std::size_t(row)]) continue;
    for (const Jacobian::Segment& segment : J->row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) J->values[segment.offset + i] *= mu_ / room;
    }
  }
}

bool BarrierNlp::addCostHessian(const VectorXd& x, MatrixXd& H) {
  nlp_.addCostHessian(x, H);
  nlp_.evaluate(x, inner_phi_, &inner_);
  VectorXd row_vector(x.size());
  for (int row = 0; row < inner_phi_.size(); ++row) {
    if (!isInequality(nlp_.types()[row])) continue;
    row_vector.setZero();
    inner_.addRowTo(row, 1. / inner_phi_[row], row_vector);
    H.noalias() += mu_ * row_vector * row_vector.transpose();
  }
  return true;
}

std::shared_ptr<Nlp> makePenalized(std::shared_ptr<Nlp> nlp, double mu, double barrier) {
  struct Chain {
    std::shared_ptr<Nlp> given;
    std::optional<BarrierNlp> barrier;
    std::optional<PenaltyNlp> penalty;
  };
  auto chain = std::make_shared<Chain>();
  Nlp* last = nlp.get();
  chain->given = std::move(nlp);
  if (barrier >= 0.) {
    chain->barrier.emplace(*last).setWeight(barrier);
    last = &*chain->barrier;
  }
  if (mu >= 0.) {
    chain->penalty.emplace(*last).setWeight(mu);
    last = &*chain->penalty;
  }
  return {chain, last};
}

}  // namespace kinegraph::inline solvers_internal
