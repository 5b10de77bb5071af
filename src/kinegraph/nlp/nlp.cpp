#include "kinegraph/nlp/nlp.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

std::string objectiveTypeName(ObjectiveType type) {
  constexpr const char* names[] = {"f", "sos", "ineq", "eq", "ineqB", "ineqP", "none"};
  return names[int(type)];
}

Jacobian Jacobian::dense(int rows, int columns) {
  Jacobian J;
  J.columns = columns;
  for (int i = 0; i < rows; ++i) J.addRow({{0, columns}});
  return J;
}

void Jacobian::addRow(std::initializer_list<std::pair<int, int>> column_and_width) {
  for (const auto& [column, width] : column_and_width) {
    segments.push_back({column, width, int(values.size())});
    values.resize(values.size() + std::size_t(width), 0.);
  }
  row_start.push_back(int(segments.size()));
  zero_row.push_back(false);
}

MatrixXd Jacobian::toDense() const {
  MatrixXd dense = MatrixXd::Zero(rows(), columns);
  for (int row = 0; row < rows(); ++row) {
    for (const Segment& segment : row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) dense(row, segment.column + i) += values[segment.offset + i];
    }
  }
  return dense;
}

void Jacobian::copyRows(const Jacobian& other) {
  values = other.values;
  std::copy(other.segments.begin(), other.segments.end(), segments.begin());
  std::copy(other.zero_row.begin(), other.zero_row.end(), zero_row.begin());
}

double Jacobian::rowTimes(int row, const VectorXd& x) const {
  double sum = 0.;
  for (const Segment& segment : row_segments(row)) {
    const double* v = values.data() + segment.offset;
    for (int i = 0; i < segment.width; ++i) sum += v[i] * x[segment.column + i];
  }
  return sum;
}

void Jacobian::addRowTo(int row, double factor, VectorXd& x) const {
  for (const Segment& segment : row_segments(row)) {
    const double* v = values.data() + segment.offset;
    for (int i = 0; i < segment.width; ++i) x[segment.column + i] += factor * v[i];
  }
}

bool Nlp::addCostHessian(const VectorXd&, MatrixXd&) { return false; }

void Nlp::addCurvature(int, std::span<const double>, Eigen::Ref<MatrixXd>) {}

VectorXd Nlp::initialPoint(Rng& rng) { return uniformPoint(rng); }

VectorXd Nlp::uniformPoint(Rng& rng) const {
  VectorXd x(dimension());
  for (int i = 0; i < dimension(); ++i) {
    double low = lower_[i], high = upper_[i];
    if (!std::isfinite(low)) low = std::isfinite(high) ? std::min(-1., high - 2.) : -1.;
    if (!std::isfinite(high)) high = std::max(1., low + 2.);
    x[i] = rng.uniform(low, high);
  }
  return x;
}

std::string Nlp::rowName(int row) const { return cat("row ", row, " (", objectiveTypeName(types_[row]), ")"); }

RowDescription Nlp::describeRow(int row) const {
  RowDescription description;
  description.objective = cat("row ", row);
  description.group = row;
  return description;
}

VariableDescription Nlp::describeVariable(int variable) const {
  VariableDescription description;
  description.name = cat("variable ", variable);
  return description;
}

std::vector<std::string> Nlp::detailsOf(int) const { return {}; }

std::string Nlp::report(int) const { return cat("NLP: ", dimension(), " variables, ", types_.size(), " residuals"); }

ErrorSums sumErrors(const std::vector<ObjectiveType>& types, const VectorXd& phi) {
  if (std::size_t(phi.size()) != types.size())
    throw ValueError(cat("sumErrors: got ", phi.size(), " residuals; expected ", types.size()));
  ErrorSums sums;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const double y = phi[Eigen::Index(i)];
    switch (types[i]) {
      case ObjectiveType::f:
        sums.f += y;
        break;
      case ObjectiveType::sos:
        sums.sos += y * y;
        break;
      case ObjectiveType::ineq:
      case ObjectiveType::ineqB:
      case ObjectiveType::ineqP:
        sums.ineq += std::max(0., y);
        break;
      case ObjectiveType::eq:
        sums.eq += std::abs(y);
        break;
      case ObjectiveType::none:
        break;
    }
  }
  return sums;
}

double violation(ObjectiveType type, double phi) {
  if (type == ObjectiveType::eq) return std::abs(phi);
  if (type == ObjectiveType::ineq || type == ObjectiveType::ineqB) return std::max(0., phi);
  return 0.;
}

double largestViolation(const std::vector<ObjectiveType>& types, const VectorXd& phi) {
  double worst = 0.;
  for (std::size_t row = 0; row < types.size(); ++row) {
    const double value = phi[Eigen::Index(row)];
    if (value <= worst && (types[row] != ObjectiveType::eq || -value <= worst)) continue;
    worst = std::max(worst, violation(types[row], value));
  }
  return worst;
}

std::string describeNotFinite(const Nlp& nlp, const VectorXd& phi, const Jacobian* J) {
  const auto finite = [](const double* values,
                         std::size_t count) {  // 0 times a value that is not finite is NaN
    return (0. * Eigen::Map<const VectorXd>(values, Eigen::Index(count)).array()).sum() == 0.;
  };
  const auto rowsAreFinite = [&] {
    return finite(J->values.data() + J->constant, J->values.size() - std::size_t(J->constant));
  };
  if (finite(phi.data(), std::size_t(phi.size())) && (!J || rowsAreFinite())) return {};
  for (int row = 0; row < phi.size(); ++row) {
    if (!std::isfinite(phi[row])) return cat(nlp.rowName(row), " is not finite: ", phi[row]);
    if (!J) continue;
    for (const Jacobian::Segment& segment : J->row_segments(row)) {
      const double* values = J->values.data() + segment.offset;
      for (int i = 0; i < segment.width; ++i) {
        if (std::isfinite(values[i])) continue;
        return cat("the Jacobian of ", nlp.rowName(row), " is not finite: ", values[i], " in column ",
                   segment.column + i);
      }
    }
  }
  return {};
}

namespace {

void checkCancellation(Nlp& nlp, const VectorXd& x, const CancellationToken& cancellation) {
  try {
    cancellation.check();
  } catch (...) {
    nlp.leaveAt(x);
    throw;
  }
}

/// Calls found(JacobianCheck) for every entry of J, and leaves the problem at x.
template <typename Found>
void compareWithDifferences(Nlp& nlp, const VectorXd& x, double step, const CancellationToken& cancellation,
                            const Found& found) {
  const int rows = int(nlp.types().size());
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(rows), plus(rows), minus(rows);
  nlp.evaluate(x, phi, &J);
  const MatrixXd analytic = J.toDense();
  for (int i = 0; i < nlp.dimension(); ++i) {
    checkCancellation(nlp, x, cancellation);
    VectorXd moved = x;
    moved[i] = x[i] + step;
    nlp.evaluate(moved, plus, nullptr);
    moved[i] = x[i] - step;
    nlp.evaluate(moved, minus, nullptr);
    for (int row = 0; row < rows; ++row) {
      const double numeric = (plus[row] - minus[row]) / (2. * step);
      found(JacobianCheck{std::abs(numeric - analytic(row, i)) / std::max(1., std::abs(numeric)), row, i,
                          analytic(row, i), numeric});
    }
  }
  nlp.evaluate(x, phi, nullptr);
}

bool worse(const JacobianCheck& a, const JacobianCheck& b) {
  return a.error > b.error || (!std::isfinite(a.error) && std::isfinite(b.error));
}

bool hasCostRows(const Nlp& nlp) {
  return std::find(nlp.types().begin(), nlp.types().end(), ObjectiveType::f) != nlp.types().end();
}

VectorXd costGradient(Nlp& nlp, const VectorXd& x) {
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(Eigen::Index(nlp.types().size())), gradient = VectorXd::Zero(x.size());
  nlp.evaluate(x, phi, &J);
  for (int row = 0; row < phi.size(); ++row) {
    if (nlp.types()[row] == ObjectiveType::f) J.addRowTo(row, 1., gradient);
  }
  return gradient;
}

}  // namespace

JacobianCheck checkJacobian(Nlp& nlp, const VectorXd& x, double step, const CancellationToken& cancellation) {
  JacobianCheck worst;
  compareWithDifferences(nlp, x, step, cancellation, [&](const JacobianCheck& entry) {
    if (entry.error > 0. || !std::isfinite(entry.error)) worst = worst.row < 0 || worse(entry, worst) ? entry : worst;
  });
  return worst;
}

std::vector<JacobianCheck> worstJacobianEntries(Nlp& nlp, const VectorXd& x, double tolerance, int count, double step,
                                                const CancellationToken& cancellation) {
  std::vector<JacobianCheck> entries;
  compareWithDifferences(nlp, x, step, cancellation, [&](const JacobianCheck& entry) {
    if (!(entry.error <= tolerance)) entries.push_back(entry);
  });
  std::stable_sort(entries.begin(), entries.end(), worse);
  if (int(entries.size()) > count) entries.resize(std::size_t(count));
  return entries;
}

JacobianCheck checkHessian(Nlp& nlp, const VectorXd& x, double step, const CancellationToken& cancellation) {
  MatrixXd H = MatrixXd::Zero(x.size(), x.size());
  JacobianCheck worst;
  if (!hasCostRows(nlp) || !nlp.addCostHessian(x, H)) return worst;
  for (int i = 0; i < x.size(); ++i) {
    checkCancellation(nlp, x, cancellation);
    VectorXd plus = x, minus = x;
    plus[i] += step;
    minus[i] -= step;
    const VectorXd column = (costGradient(nlp, plus) - costGradient(nlp, minus)) / (2. * step);
    for (int row = 0; row < x.size(); ++row) {
      const JacobianCheck entry = {std::abs(column[row] - H(row, i)) / std::max(1., std::abs(column[row])), row, i,
                                   H(row, i), column[row]};
      if (worst.row < 0 || worse(entry, worst)) worst = entry;
    }
  }
  costGradient(nlp, x);  // moves the problem back to x
  return worst;
}

ScalarEvaluation evaluateScalar(Nlp& nlp, const VectorXd& x) {
  ScalarEvaluation out{0., VectorXd::Zero(x.size()), MatrixXd::Zero(x.size(), x.size())};
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(Eigen::Index(nlp.types().size())), dense(x.size());
  nlp.evaluate(x, phi, &J);
  for (int row = 0; row < phi.size(); ++row) {
    const ObjectiveType type = nlp.types()[row];
    if (type == ObjectiveType::f) {
      out.value += phi[row];
      J.addRowTo(row, 1., out.gradient);
    } else if (type == ObjectiveType::sos) {
      out.value += phi[row] * phi[row];
      J.addRowTo(row, 2. * phi[row], out.gradient);
      dense.setZero();
      J.addRowTo(row, 1., dense);
      out.hessian.selfadjointView<Eigen::Lower>().rankUpdate(dense, 2.);
    } else if (type != ObjectiveType::none) {
      throw ValueError(
          cat("evaluateScalar: ", nlp.rowName(row), " is of type ", objectiveTypeName(type), "; expected f or sos"));
    }
  }
  out.hessian.triangularView<Eigen::StrictlyUpper>() = out.hessian.transpose();
  if (hasCostRows(nlp)) nlp.addCostHessian(x, out.hessian);
  return out;
}

}  // namespace kinegraph
