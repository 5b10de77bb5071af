#pragma once

#include "kinegraph/common/random.h"
#include "kinegraph/nlp/nlp.h"
#include "tests/solvers/numbers.h"

namespace kinegraph {

inline VectorXd randomVector(int size, Rng& rng) { return randomMatrix(size, 1, rng); }

inline int randomInt(int first, int last, Rng& rng) { return first + int(rng.uniform(0., last - first + .999)); }

/// Linear rows phi = b + J x of random pattern: those of a path, each on a few neighboring variables, and a few that
/// also touch the last variables. With `shared`, all rows touch the first variable, as what all slices of a path share.
class RandomRows final : public Nlp {
 public:
  RandomRows(int variables, std::vector<ObjectiveType> types, Rng& rng, bool shared = false) {
    types_ = std::move(types);
    lower_ = VectorXd::Constant(variables, -1.);
    upper_ = VectorXd::Constant(variables, 1.);
    linear_.assign(types_.size(), true);
    J_.columns = variables;
    for (int row = 0; row < int(types_.size()); ++row) {
      const int width = std::min(variables, randomInt(1, 4, rng)), column = randomInt(0, variables - width, rng);
      if (shared && column > 0) {
        J_.addRow({{0, 1}, {column, width}});
      } else {
        J_.addRow({{column, width}});
      }
    }
    for (double& value : J_.values) value = rng.normal();
    b_ = randomVector(int(types_.size()), rng);
  }

  Jacobian makeJacobian() const override { return J_; }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    phi = b_ + J_.toDense() * x;
    if (J) J->values = J_.values;
  }

 private:
  Jacobian J_;
  VectorXd b_;
};

}  // namespace kinegraph
