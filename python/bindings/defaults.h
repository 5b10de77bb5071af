#pragma once

#include <cstdint>

#include "kinegraph/base/random.h"
#include "kinegraph/solvers/interface/options.h"

namespace kinegraph::python {

/// What `rnd_seed` and `params_add({'opt/..': ..})` set: read where a random generator or an options struct is made.
struct Defaults {
  std::uint64_t seed = 0;  ///< of a solver's initial points
  Rng random{0};           ///< of random joint states; goes on from call to call
  SolverOptions solver;
};

Defaults& defaults();

}  // namespace kinegraph::python
