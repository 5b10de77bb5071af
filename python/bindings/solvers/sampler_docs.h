#pragma once

/// The manual of what bind_sampler.cpp binds.
namespace kinegraph::python::docs::sampler {

inline constexpr char make[] = R"(A sampler of a problem.

Args:
    problem: The problem.)";

inline constexpr char setSeed[] = R"(Sets what the samples that follow depend on. Without it they depend on ry.rnd_seed.

Args:
    seed: A number.
Returns:
    The sampler itself.)";

inline constexpr char sample[] =
    R"(Draws a sample. The SolverReturn is feasible, or its message says where the way down ended. Ctrl-C ends it.)";

}  // namespace kinegraph::python::docs::sampler
