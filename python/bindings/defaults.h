#pragma once

#include <cstdint>

#include "kinegraph/common/random.h"
#include "kinegraph/solvers/interface/options.h"

namespace kinegraph::python {

/// What `rnd_seed` has set: read where a random generator is made.
struct Defaults {
  std::uint64_t seed = 0;  ///< of a solver's initial points
  Rng random{0};           ///< of random joint states; goes on from call to call
};

Defaults& defaults();

/// The options that a solver has where a script gives none: their defaults, with what scripts of earlier years have set
/// by `params_add({'opt/..': ..})`. Needs the interpreter lock.
SolverOptions startingOptions();

}  // namespace kinegraph::python
