#pragma once

#include <cstdint>

#include "kinegraph/solvers/options.h"

namespace kinegraph::python {

/// What `rnd_seed` and `params_add({'opt/..': ..})` set: read where a random generator or an options struct is made.
struct Defaults {
  std::uint64_t seed = 0;
  SolverOptions solver;
};

Defaults& defaults();

}  // namespace kinegraph::python
