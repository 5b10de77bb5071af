#pragma once

#include <cstdint>

namespace kinegraph {

/// A random number generator with equal results on all machines (xoshiro256++, seeded by splitmix64).
/// Source: Blackman & Vigna, Scrambled Linear Pseudorandom Number Generators, 2021.
class Rng {
 public:
  explicit Rng(std::uint64_t seed = 0);
  std::uint64_t bits();
  double uniform();                            ///< in [0, 1)
  double uniform(double lower, double upper);  ///< in [lower, upper)
  double normal();                             ///< mean 0, standard deviation 1

 private:
  std::uint64_t state_[4];
};

}  // namespace kinegraph
