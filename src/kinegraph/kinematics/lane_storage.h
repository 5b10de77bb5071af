#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace kinegraph::inline kinematics_internal {

/// Assigns each part (a pointer and its number of rows of `lanes` numbers) its place in `storage`, aligned for
/// registers of this size. Fills the storage with zeros.
template <std::size_t Parts>
void layOutLanes(std::vector<double>& storage, int lanes, const std::pair<double**, std::size_t> (&parts)[Parts]) {
  std::size_t rows = 1;  // one more row for alignment
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

/// Sets the pose of the world, the first one, to the identity.
inline void setWorld(double* pose, int lanes) {
  for (int k : {0, 4, 8}) std::fill_n(pose + k * lanes, lanes, 1.);
}

}  // namespace kinegraph::inline kinematics_internal
