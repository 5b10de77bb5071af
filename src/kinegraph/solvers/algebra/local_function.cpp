#include "kinegraph/solvers/algebra/local_function.h"

#include "kinegraph/solvers/algebra/band_algebra.h"
#include "kinegraph/solvers/algebra/dense_algebra.h"

namespace kinegraph::inline solvers_internal {

template <class Algebra>
LocalFunction<Algebra>::LocalFunction(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs,
                                      std::vector<int> constraints)
    : n_(nlp.dimension()),
      constraints_(std::move(constraints)),
      has_f_(hasRowsOfTypeF(nlp)),
      algebra_(nlp, pattern, constraints_, has_f_ || n_ <= kSmall),  // the Hessian of f terms may be full
      g_(algebra_.zeroVector()) {
  const int m = int(constraints_.size());
  linear_costs_.reserve(costs.size());
  is_equality_.reserve(std::size_t(m));
  for (int row : costs)
    (nlp.types()[row] == ObjectiveType::sos && nlp.isLinear(row) ? linear_costs_ : other_costs_).push_back(row);
  for (int j = 0; j < m; ++j) {
    is_equality_.push_back(nlp.types()[constraints_[j]] == ObjectiveType::eq);
    if (is_equality_[j]) equalities_.push_back(j);
  }
  inequalities_.reserve(std::size_t(m));
  const std::span<const Nlp::CurvedRows> curved = nlp.curvedRows();
  for (int k = 0; k < int(curved.size()); ++k) {
    const auto place = std::find(constraints_.begin(), constraints_.end(), curved[k].first);
    if (place == constraints_.end()) continue;
    curved_.push_back({k, int(place - constraints_.begin()), curved[k].rows, curved[k].column,
                       MatrixXd(curved[k].width, curved[k].width)});
  }
  linear_.setZero(m);
}

template <class Algebra>
void LocalFunction<Algebra>::setJacobian(const Jacobian& J) {
  algebra_.setJacobian(J);
  omitCurvature();
  is_new_ = true;
  inequalities_.clear();
  for (int j = int(equalities_.size()); j < int(constraints_.size()); ++j) {
    if (!is_equality_[j] && !J.zero_row[constraints_[j]]) inequalities_.push_back(j);
  }
}

template <class Algebra>
bool LocalFunction<Algebra>::setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature) {
  is_new_ = true;
  if (!knows_linear_costs_) algebra_.setLinearCosts(linear_costs_);
  knows_linear_costs_ = true;
  g_.setZero();
  algebra_.addLinearCostGradient(linear_costs_, phi, g_);
  algebra_.useLinearCosts();
  if (other_costs_.empty() && !has_f_) return true;
  algebra_.copyLinearCosts();
  for (int row : other_costs_) {
    if (nlp.types()[row] == ObjectiveType::f) {
      algebra_.addCostGradient(row, 1., g_);
    } else if (nlp.types()[row] == ObjectiveType::sos || phi[row] > 0.) {  // ineqP only where it is violated
      algebra_.addCostGradient(row, 2. * phi[row], g_);
      algebra_.addCost(row, 2.);
    }
  }
  if (!has_f_) return true;
  MatrixXd hessian = MatrixXd::Zero(n_, n_);
  const bool known = knows_f_ = nlp.addCostHessian(x, hessian);
  if (!known && curvature) hessian = *curvature;
  for (int j = 0; j < n_; ++j) {
    for (int i = j; i < n_; ++i) algebra_.addEntry(i, j, hessian(i, j));
  }
  return known;
}

template <class Algebra>
void LocalFunction<Algebra>::addCurvature(Nlp& nlp, const VectorXd& multipliers) {
  for (Curved& curved : curved_) {
    const std::span<const double> weights(multipliers.data() + curved.constraint, std::size_t(curved.rows));
    if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0.; })) continue;
    algebra_.addBlock(curved.column, curved.H,
                      [&](Eigen::Ref<MatrixXd> H) { nlp.addCurvature(curved.index, weights, H); });
    is_curved_ = true;
  }
}

template <class Algebra>
void LocalFunction<Algebra>::omitCurvature() {
  is_curved_ = false;
  algebra_.dropBlocks();
}

template <class Algebra>
void LocalFunction<Algebra>::setNoCosts(double weight) {
  is_new_ = true;
  g_.setZero();
  omitCurvature();
  algebra_.setMultipleOfIdentity(weight);
}

template <class Algebra>
double LocalFunction<Algebra>::largestCurvature() const {
  double largest = 1e-6;
  for (int i = 0; i < n_; ++i) largest = std::max(largest, algebra_.diagonal(i));
  return largest;
}

template class LocalFunction<BandAlgebra>;
template class LocalFunction<DenseAlgebra<8>>;

}  // namespace kinegraph::inline solvers_internal
