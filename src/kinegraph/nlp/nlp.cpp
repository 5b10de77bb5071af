#include "kinegraph/nlp/nlp.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/text.h"

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
  ErrorSums sums;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const double y = phi[Eigen::Index(i)];
    switch (types[i]) {
      case ObjectiveType::f: sums.f += y; break;
      case ObjectiveType::sos: sums.sos += y * y; break;
      case ObjectiveType::ineq:
      case ObjectiveType::ineqB:
      case ObjectiveType::ineqP: sums.ineq += std::max(0., y); break;
      case ObjectiveType::eq: sums.eq += std::abs(y); break;
      case ObjectiveType::none: break;
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
  for (std::size_t row = 0; row < types.size(); ++row) worst = std::max(worst, violation(types[row], phi[Eigen::Index(row)]));
  return worst;
}

std::string describeNotFinite(const Nlp& nlp, const VectorXd& phi, const Jacobian* J) {
  for (int row = 0; row < phi.size(); ++row) {
    if (!std::isfinite(phi[row])) return cat(nlp.rowName(row), " is not finite: ", phi[row]);
    if (!J) continue;
    for (const Jacobian::Segment& segment : J->row_segments(row)) {
      const double* values = J->values.data() + segment.offset;
      for (int i = 0; i < segment.width; ++i) {
        if (std::isfinite(values[i])) continue;
        return cat("the Jacobian of ", nlp.rowName(row), " is not finite: ", values[i], " in column ", segment.column + i);
      }
    }
  }
  return {};
}

JacobianCheck checkJacobian(Nlp& nlp, const VectorXd& x, double step) {
  const int rows = int(nlp.types().size());
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(rows), plus(rows), minus(rows);
  nlp.evaluate(x, phi, &J);
  const MatrixXd analytic = J.toDense();
  JacobianCheck check;
  for (int i = 0; i < nlp.dimension(); ++i) {
    VectorXd moved = x;
    moved[i] = x[i] + step;
    nlp.evaluate(moved, plus, nullptr);
    moved[i] = x[i] - step;
    nlp.evaluate(moved, minus, nullptr);
    for (int row = 0; row < rows; ++row) {
      const double numeric = (plus[row] - minus[row]) / (2. * step);
      const double error = std::abs(numeric - analytic(row, i)) / std::max(1., std::abs(numeric));
      if (error > check.error || !std::isfinite(error)) check = {error, row, i, analytic(row, i), numeric};
    }
  }
  nlp.evaluate(x, phi, nullptr);
  return check;
}

}  // namespace kinegraph
