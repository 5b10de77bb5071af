#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kinegraph {

/// Gives each part (a pointer and its number of rows of `lanes` numbers) its place in `storage`, aligned for registers
/// of that size. All zeros.
template <std::size_t Parts>
void layOutLanes(std::vector<double>& storage, int lanes, const std::pair<double**, std::size_t> (&parts)[Parts]) {
  std::size_t rows = 1;  // one more, to begin at a multiple of the register's size
  for (const auto& [part, size] : parts) rows += size;
  storage.assign(rows * lanes, 0.);
  const std::uintptr_t width = lanes * sizeof(double);
  double* from =
      reinterpret_cast<double*>((reinterpret_cast<std::uintptr_t>(storage.data()) + width - 1) / width * width);
  for (const auto& [part, size] : parts) {
    *part = from;
    from += size * lanes;
  }
}

/// Makes the pose of the world, the first one, the identity.
inline void setWorld(double* pose, int lanes) {
  for (int k : {0, 4, 8}) std::fill_n(pose + k * lanes, lanes, 1.);
}

}  // namespace kinegraph
