#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Numbers p that a problem depends on beside its variables, such as the target of an objective: how residuals and
/// their gradients move with them.
class NlpParameter {
 public:
  virtual ~NlpParameter() = default;

  const std::string& name() const { return name_; }
  const std::vector<std::string>& names() const { return names_; }  ///< one per number: "target of position of tip, x"
  int size() const { return int(names_.size()); }

  /// Where derivatives are asked for: residuals phi, their Jacobian, and a weight per residual.
  struct Point {
    Nlp& nlp;  ///< the problem, or its separate form
    const VectorXd &x, &phi;
    const Jacobian& J;
    const VectorXd& weights;
    const std::vector<int>& row_of;  ///< of a separate form: the problem's own rows; else empty
  };

  /// Adds d phi / dp to `phi` and sum_i weights_i d^2 phi_i / dx dp to `gradient`, for one of the numbers. The problem
  /// stands at x, before and after.
  virtual void differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) = 0;

  /// The bound that one of the numbers is, if it is one.
  struct Bound {
    int variable;
    bool is_upper;
  };
  virtual std::optional<Bound> bound(int number) const {
    (void)number;
    return {};
  }

 protected:
  NlpParameter(std::string name, std::vector<std::string> names) : name_(std::move(name)), names_(std::move(names)) {}

 private:
  std::string name_;
  std::vector<std::string> names_;
};

using NlpParameters = std::vector<std::shared_ptr<NlpParameter>>;

/// The values that residuals are to have: phi_i - p in place of phi_i. Throws ValueError for rows that are not there.
std::shared_ptr<NlpParameter> residualTargets(const Nlp& nlp, const std::vector<int>& rows);

/// The lower or upper bounds of variables. Throws ValueError for variables that are not there, or have none.
std::shared_ptr<NlpParameter> boundsOf(const Nlp& nlp, const std::vector<int>& variables, bool upper);

/// Numbers that can be moved: their derivatives are central differences, exact to about 1e-9.
class MovedParameter : public NlpParameter {
 public:
  void differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) final;

 protected:
  using NlpParameter::NlpParameter;

  /// Moves one of the numbers from where it was given; the others are there. By zero: back.
  virtual void move(Nlp& nlp, int number, double by) = 0;

  /// Says which rows may move with the numbers, ascending, where these are not all: false.
  virtual bool findRows(Nlp&, std::vector<int>&) { return false; }

  /// At x, where the problem stands; at least those rows.
  virtual void evaluate(Nlp& nlp, const VectorXd& x, VectorXd& phi, Jacobian& J) { nlp.evaluate(x, phi, &J); }

 private:
  void prepare(const Point& at);

  const Nlp* made_for_ = nullptr;
  std::vector<int> rows_;
  Jacobian J_;  ///< workspace, of that problem
  VectorXd phi_, phi_before_;
  VectorXd gradients_[2];  ///< apart, so that what does not move leaves zeros
};

}  // namespace kinegraph
