#pragma once

/// The manual of what bind_sampler.cpp binds.
namespace kinegraph::python::docs::sampler {

inline constexpr char make[] = R"(Creates a sampler of a problem.

Args:
    problem: The problem.)";

inline constexpr char setSeed[] = R"(Sets the seed of the following samples. By default the seed is ry.rnd_seed.

Args:
    seed: The seed.
Returns:
    The sampler itself.)";

inline constexpr char sample[] =
    R"(Samples a point. The SolverReturn is feasible, or its message describes the end of the descent. Ctrl-C ends the
call.)";

}  // namespace kinegraph::python::docs::sampler
