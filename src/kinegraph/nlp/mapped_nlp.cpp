#include "kinegraph/nlp/mapped_nlp.h"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph::inline nlp_internal {

namespace {

using Entry = Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator;

}  // namespace

VectorXd LinearMap::fit(const VectorXd& x) const {
  const Eigen::SparseMatrix<double> normal = M.transpose() * M;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(normal);
  return factor.solve(M.transpose() * (x - offset));
}

MappedNlp::MappedNlp(std::shared_ptr<Nlp> inner, std::shared_ptr<const LinearMap> map, const VectorXd& lower,
                     const VectorXd& upper)
    : inner_(std::move(inner)), map_(std::move(map)) {
  if (map_->M.rows() != inner_->dimension() || map_->offset.size() != inner_->dimension())
    throw ValueError(cat("linear map: the map has ", map_->M.rows(), " rows and an offset of size ",
                         map_->offset.size(), "; the problem has ", inner_->dimension(), " variables"));
  if (lower.size() != map_->M.cols() || upper.size() != map_->M.cols())
    throw ValueError(cat("linear map: got ", lower.size(), " lower and ", upper.size(), " upper bounds; expected ",
                         map_->M.cols(), " of each"));
  types_ = inner_->types();
  lower_ = lower, upper_ = upper;
  row_.assign(std::size_t(lower.size()), 0.);
  layOut();
}

/// Computes the sparsity pattern: a residual depends on all c that its variables depend on.
void MappedNlp::layOut() {
  inner_jacobian_ = inner_->makeJacobian();
  const Jacobian& from = inner_jacobian_;
  pattern_ = Jacobian();
  pattern_.columns = dimension();
  linear_.clear();
  std::vector<int> columns;
  for (int row = 0; row < from.rows(); ++row) {
    columns.clear();
    for (const Jacobian::Segment& segment : from.row_segments(row))
      for (int i = segment.column; i < segment.column + segment.width; ++i)
        for (Entry entry(map_->M, i); entry; ++entry) columns.push_back(int(entry.col()));
    std::ranges::sort(columns);
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    for (std::size_t i = 0; i < columns.size();) {
      std::size_t end = i + 1;
      while (end < columns.size() && columns[end] == columns[end - 1] + 1) ++end;
      pattern_.segments.push_back({columns[i], int(end - i), int(pattern_.values.size())});
      pattern_.values.resize(pattern_.values.size() + (end - i), 0.);
      i = end;
    }
    pattern_.row_start.push_back(int(pattern_.segments.size()));
    linear_.push_back(inner_->isLinear(row));
  }
  pattern_.zero_row.assign(std::size_t(from.rows()), 0);
  for (int row = 0; row < from.rows(); ++row)
    if (linear_[std::size_t(row)]) transform(row, from, pattern_);
  curved_.clear();
  for (const CurvedRows& rows : inner_->curvedRows()) {
    int first = dimension(), last = -1;
    for (int i = rows.column; i < rows.column + rows.width; ++i) {
      for (Entry entry(map_->M, i); entry; ++entry)
        first = std::min(first, int(entry.col())), last = std::max(last, int(entry.col()));
    }
    if (last < first) first = 0, last = 0;
    curved_.push_back({rows.first, rows.rows, first, last - first + 1});
  }
}

Jacobian MappedNlp::makeJacobian() const { return pattern_; }

void MappedNlp::transform(int row, const Jacobian& from, Jacobian& J) const {
  const auto to = J.row_segments(row);
  const std::size_t r = std::size_t(row);
  const bool is_zero = r < from.zero_row.size() && from.zero_row[r];
  if (!is_zero) {
    for (const Jacobian::Segment& segment : from.row_segments(row)) {
      const double* value = from.values.data() + segment.offset;
      for (int i = segment.column; i < segment.column + segment.width; ++i, ++value) {
        if (*value == 0.) continue;
        for (Entry entry(map_->M, i); entry; ++entry) row_[std::size_t(entry.col())] += *value * entry.value();
      }
    }
  } else if (J.zero_row[r]) {
    return;
  }
  J.zero_row[r] = is_zero;
  for (const Jacobian::Segment& segment : to) {
    double* at = row_.data() + segment.column;
    std::copy_n(at, segment.width, J.values.data() + segment.offset);
    std::fill_n(at, segment.width, 0.);
  }
}

void MappedNlp::evaluate(const VectorXd& c, VectorXd& phi, Jacobian* J) {
  prepareEvaluation(*this, c, phi, J);
  evaluateRows(c, phi, J);
}

void MappedNlp::evaluateRows(const VectorXd& c, VectorXd& phi, Jacobian* J) {
  inner_->evaluate(map_->at(c), phi, J ? &inner_jacobian_ : nullptr);
  if (!J) return;
  for (int row = 0; row < pattern_.rows(); ++row)
    if (!linear_[std::size_t(row)]) transform(row, inner_jacobian_, *J);
}

bool MappedNlp::addCostHessian(const VectorXd& c, MatrixXd& H) {
  MatrixXd of_x = MatrixXd::Zero(inner_->dimension(), inner_->dimension());
  if (!inner_->addCostHessian(map_->at(c), of_x)) return false;
  H += map_->M.transpose() * of_x * map_->M;
  return true;
}

void MappedNlp::addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) {
  const CurvedRows &of_x = inner_->curvedRows()[std::size_t(k)], &of_c = curved_[std::size_t(k)];
  MatrixXd curvature = MatrixXd::Zero(of_x.width, of_x.width), part = MatrixXd::Zero(of_x.width, of_c.width);
  inner_->addCurvature(k, weights, curvature);
  for (int i = 0; i < of_x.width; ++i)
    for (Entry entry(map_->M, of_x.column + i); entry; ++entry) part(i, entry.col() - of_c.column) = entry.value();
  const MatrixXd mapped = part.transpose() * curvature.selfadjointView<Eigen::Lower>() * part;
  H.triangularView<Eigen::Lower>() += mapped;
}

Separation MappedNlp::separation() {
  Separation separation = inner_->separation();
  if (separation.problem) separation.problem = std::make_shared<MappedNlp>(separation.problem, map_, lower_, upper_);
  return separation;
}

VectorXd MappedNlp::fitted(const VectorXd& x) const { return map_->fit(x).cwiseMax(lower_).cwiseMin(upper_); }

VectorXd MappedNlp::initialPoint(Rng& rng) { return fitted(inner_->initialPoint(rng)); }

/// Describes the inner variable with the largest coefficient.
VariableDescription MappedNlp::describeVariable(int variable) const {
  int strongest = -1;
  double weight = 0.;
  for (int i = 0; i < map_->M.rows(); ++i) {
    const double here = std::abs(map_->M.coeff(i, variable));
    if (here > weight) strongest = i, weight = here;
  }
  return strongest < 0 ? Nlp::describeVariable(variable) : inner_->describeVariable(strongest);
}

std::string MappedNlp::report(int verbose) const {
  return cat(dimension(), " variables that determine the ", inner_->dimension(),
             " variables of: ", inner_->report(verbose));
}

}  // namespace kinegraph::inline nlp_internal
