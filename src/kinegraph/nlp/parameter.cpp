#include "kinegraph/nlp/parameter.h"

#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

constexpr double kStep = 3e-5;

std::vector<std::string> rowTargetNames(const Nlp& nlp, const std::vector<int>& rows) {
  std::vector<std::string> names;
  for (const int row : rows) {
    if (row < 0 || row >= int(nlp.types().size()))
      throw ValueError(cat("there is no residual ", row, "; the problem has ", nlp.types().size()));
    names.push_back(cat("target of ", nlp.rowName(row)));
  }
  return names;
}

std::vector<std::string> boundNames(const Nlp& nlp, const std::vector<int>& variables, bool upper) {
  std::vector<std::string> names;
  for (const int variable : variables) {
    if (variable < 0 || variable >= nlp.dimension())
      throw ValueError(cat("there is no variable ", variable, "; the problem has ", nlp.dimension()));
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

void MovedParameter::differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) {
  if (made_for_ != &at.nlp) {
    J_ = at.nlp.makeJacobian();
    made_for_ = &at.nlp;
  }
  VectorXd gradients[2];  // apart, so that what does not move leaves zeros
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1. : -1.;
    gradients[side].setZero(gradient.size());
    try {
      move(at.nlp, number, sign * kStep);
      phi_.resize(phi.size());
      at.nlp.evaluate(at.x, phi_, &J_);
    } catch (...) {
      move(at.nlp, number, 0.);
      throw;
    }
    if (side == 0)
      phi_before_ = phi_;
    else
      phi += (phi_before_ - phi_) / (2. * kStep);
    for (int row = 0; row < int(phi.size()); ++row) {
      if (at.weights[row] != 0. && !J_.zero_row[std::size_t(row)]) J_.addRowTo(row, at.weights[row], gradients[side]);
    }
  }
  gradient += (gradients[0] - gradients[1]) / (2. * kStep);
  move(at.nlp, number, 0.);
}

}  // namespace kinegraph
