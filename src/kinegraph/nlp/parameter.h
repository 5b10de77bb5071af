#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// Parameters p of a problem, such as the target of an objective, with the derivatives of residuals and their gradients
/// with respect to them.
class NlpParameter {
 public:
  virtual ~NlpParameter() = default;

  const std::string& name() const { return name_; }
  const std::vector<std::string>& names() const {
    return names_;
  }  ///< one per component: "target of position of tip, x"
  int size() const { return int(names_.size()); }

  /// A point at which derivatives are computed, with residuals phi, their Jacobian, and one weight per residual.
  struct Point {
    Nlp& nlp;  ///< the problem or its separate form
    const VectorXd &x, &phi;
    const Jacobian& J;
    const VectorXd& weights;
    const std::vector<int>& row_of;  ///< for a separate form: the residuals of the problem (see Separation); else empty
  };

  /// Adds d phi / dp to `phi` and sum_i weights_i d^2 phi_i / dx dp to `gradient`, for one component of p. The problem
  /// is at x before and after the call.
  virtual void differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) = 0;

  /// The bound of a variable that a component of p is.
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

/// Returns the targets of residuals as parameters: phi_i - p replaces phi_i. Throws ValueError for invalid indices.
std::shared_ptr<NlpParameter> residualTargets(const Nlp& nlp, const std::vector<int>& rows);

/// Returns lower or upper bounds of variables as parameters. Throws ValueError for invalid indices and for variables
/// without such a bound.
std::shared_ptr<NlpParameter> boundsOf(const Nlp& nlp, const std::vector<int>& variables, bool upper);

/// Parameters whose derivatives are computed by central differences, with an error of about 1e-9.
class FiniteDifferenceParameter : public NlpParameter {
 public:
  void differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) final;

 protected:
  using NlpParameter::NlpParameter;

  /// Sets a component to its given value plus `by`; the others keep their given values.
  virtual void move(Nlp& nlp, int number, double by) = 0;

  /// Sets `rows` to the residuals that may depend on the parameters, ascending, and returns true. False: all may.
  virtual bool findRows(Nlp&, std::vector<int>&) { return false; }

  /// Evaluates the problem at its point x; at least the residuals of `findRows`.
  virtual void evaluate(Nlp& nlp, const VectorXd& x, VectorXd& phi, Jacobian& J) { nlp.evaluate(x, phi, &J); }

 private:
  void prepare(const Point& at);

  const Nlp* made_for_ = nullptr;
  std::vector<int> rows_;
  Jacobian J_;  ///< workspace for made_for_
  VectorXd phi_, phi_before_;
  VectorXd gradients_[2];  ///< separate, so that constant residuals contribute exactly zero
};

}  // namespace kinegraph
