#include "kinegraph/common/random.h"

#include <bit>
#include <cmath>
#include <numbers>

namespace kinegraph {

Rng::Rng(std::uint64_t seed) {
  for (std::uint64_t& word : state_) {
    seed += 0x9e3779b97f4a7c15ull;
    std::uint64_t z = seed;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    word = z ^ (z >> 31);
  }
}

std::uint64_t Rng::bits() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Rng::uniform() { return double(bits() >> 11) * 0x1p-53; }

double Rng::uniform(double lower, double upper) { return lower + (upper - lower) * uniform(); }

double Rng::normal() {
  const double radius = std::sqrt(-2. * std::log(1. - uniform()));
  return radius * std::cos(2. * std::numbers::pi * uniform());
}

}  // namespace kinegraph
