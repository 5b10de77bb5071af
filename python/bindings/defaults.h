#pragma once

#include <cstdint>

#include "kinegraph/common/random.h"
#include "kinegraph/solvers/interface/options.h"

namespace kinegraph::python {

/// State set by `rnd_seed`; read whenever a random generator is created.
struct Defaults {
  std::uint64_t seed = 0;  ///< seed of a solver's initial points
  Rng random{0};           ///< generator of random joint states; continues from call to call
};

Defaults& defaults();

/// The default options of a solver, including those set by `params_add({'opt/..': ..})` in older scripts. Requires the
/// GIL.
SolverOptions startingOptions();

}  // namespace kinegraph::python
