#pragma once

#include <memory>
#include <vector>

#include "bindings.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::python {

/// A problem that a user defines step by step, with a function x -> (phi, J).
class PyNlpFactory final : public Nlp {
 public:
  void setDimension(int n);
  void setTypes(std::vector<ObjectiveType> types) { types_ = std::move(types); }
  void setBounds(const VectorXd& lower, const VectorXd& upper);
  void setFunction(nb::object function) { function_ = std::move(function); }

  bool mayBeCancelled() const override { return true; }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  std::string report(int verbose) const override;

 private:
  nb::object function_;
  MatrixXd J_;
};

/// Wraps a Python object with `dimension`, `types` (or `featureTypes`), `bounds` and `evaluate(x) -> (phi, J)`, and
/// optionally `getFHessian(x)`, `getInitializationSample()` and `report(verbose)`.
std::shared_ptr<Nlp> fromPythonProblem(nb::object problem);

/// Binds NLP_Sampler.
void bindSampler(nb::module_& m);

/// Binds solveAll and KOMO.solveFromMany.
void bindSolveMany(nb::module_& m);

}  // namespace kinegraph::python
