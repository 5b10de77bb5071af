#pragma once

#include <memory>
#include <vector>

#include "bindings.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph::python {

/// What a user tells of a problem in Python, before it is made.
struct PyNlpFactory {
  int dimension = 0;
  std::vector<ObjectiveType> types;
  VectorXd lower, upper;
  nb::object function;

  std::shared_ptr<Nlp> make() const;
};

/// Reads what a user's function returned: (phi, J), J dense or triplets.
void readPythonEvaluation(nb::handle returned, int dimension, VectorXd& phi, MatrixXd& J);

}  // namespace kinegraph::python
