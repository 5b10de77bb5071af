#include "kinegraph/nlp/parameter.h"

#include <cmath>
#include <numeric>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kStep = 3e-5;

std::vector<std::string> rowTargetNames(const Nlp& nlp, const std::vector<int>& rows) {
  std::vector<std::string> names;
  for (const int row : rows) {
    if (row < 0 || row >= int(nlp.types().size()))
      throw ValueError(cat("there is no residual ", row, "; the problem has ", nlp.types().size(), " residuals"));
    names.push_back(cat("target of ", nlp.rowName(row)));
  }
  return names;
}

std::vector<std::string> boundNames(const Nlp& nlp, const std::vector<int>& variables, bool upper) {
  std::vector<std::string> names;
  for (const int variable : variables) {
    if (variable < 0 || variable >= nlp.dimension())
      throw ValueError(cat("there is no variable ", variable, "; the problem has ", nlp.dimension(), " variables"));
    if (!std::isfinite(upper ? nlp.upper()[variable] : nlp.lower()[variable]))
      throw ValueError(cat("variable ", variable, " has no ", upper ? "upper" : "lower", " bound"));
    names.push_back(cat(upper ? "upper" : "lower", " bound of ", nlp.describeVariable(variable).name));
  }
  return names;
}

class ResidualTargets final : public NlpParameter {
 public:
  ResidualTargets(const Nlp& nlp, std::vector<int> rows)
      : NlpParameter("targets of residuals", rowTargetNames(nlp, rows)), rows_(std::move(rows)) {}

  void differentiate(const Point& at, int number, VectorXd& phi, VectorXd&) override {
    const int row = rows_[std::size_t(number)];
    if (at.row_of.empty()) phi[row] -= 1.;
    for (std::size_t i = 0; i < at.row_of.size(); ++i) {
      if (at.row_of[i] == row) phi[Eigen::Index(i)] -= 1.;
    }
  }

 private:
  std::vector<int> rows_;
};

class Bounds final : public NlpParameter {
 public:
  Bounds(const Nlp& nlp, std::vector<int> variables, bool upper)
      : NlpParameter(upper ? "upper bounds" : "lower bounds", boundNames(nlp, variables, upper)),
        variables_(std::move(variables)),
        upper_(upper) {}

  void differentiate(const Point&, int, VectorXd&, VectorXd&) override {}
  std::optional<Bound> bound(int number) const override { return Bound{variables_[std::size_t(number)], upper_}; }

 private:
  std::vector<int> variables_;
  bool upper_;
};

}  // namespace

std::shared_ptr<NlpParameter> residualTargets(const Nlp& nlp, const std::vector<int>& rows) {
  return std::make_shared<ResidualTargets>(nlp, rows);
}

std::shared_ptr<NlpParameter> boundsOf(const Nlp& nlp, const std::vector<int>& variables, bool upper) {
  return std::make_shared<Bounds>(nlp, variables, upper);
}

void FiniteDifferenceParameter::prepare(const Point& at) {
  if (made_for_ == &at.nlp) return;
  made_for_ = &at.nlp;
  J_ = at.J;
  if (findRows(at.nlp, rows_)) return;
  rows_.resize(at.nlp.types().size());
  std::iota(rows_.begin(), rows_.end(), 0);
}

void FiniteDifferenceParameter::differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) {
  prepare(at);
  for (const int side : {0, 1}) {
    gradients_[side].setZero(gradient.size());
    try {
      move(at.nlp, number, side == 0 ? kStep : -kStep);
      phi_.resize(phi.size());
      evaluate(at.nlp, at.x, phi_, J_);
    } catch (...) {
      move(at.nlp, number, 0.);
      throw;
    }
    if (side == 0) phi_before_ = phi_;
    for (const int row : rows_) {
      if (side == 1) phi[row] += (phi_before_[row] - phi_[row]) / (2. * kStep);
      if (at.weights[row] != 0. && !J_.zero_row[std::size_t(row)]) J_.addRowTo(row, at.weights[row], gradients_[side]);
    }
  }
  gradient += (gradients_[0] - gradients_[1]) / (2. * kStep);
  move(at.nlp, number, 0.);
}

}  // namespace kinegraph
