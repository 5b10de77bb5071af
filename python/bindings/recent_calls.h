#pragma once

#include "arrays.h"
#include "kinegraph/features/residual_cache.h"

namespace kinegraph::python {

/// Caches the last few calls of `eval` with built-in features by the identity of their arguments, kept alive here:
/// strings and symbols. A repeated call converts nothing and reuses its returned arrays if they have no other owner.
class RecentCalls {
 public:
  struct Call {
    std::shared_ptr<const KinematicModel> model;
    nb::object symbol;
    std::vector<nb::object> frames;  ///< strings
    int order = -1;
    std::shared_ptr<Residual> residual;
    ReusedArrays y, J;
  };

  RecentCalls() = default;
  RecentCalls(const RecentCalls&) {}  ///< a copy starts empty
  RecentCalls& operator=(const RecentCalls&) { return *this; }

  /// Returns the matching call, or null. The pointer is valid until `add`.
  Call* find(const State& scene, nb::handle symbol, nb::handle frames, int order);

  /// Stores a call in place of the oldest one. Returns null unless the frames are plain strings.
  Call* add(const State& scene, nb::handle symbol, nb::handle frames, int order,
            const std::shared_ptr<Residual>& residual);

 private:
  std::vector<Call> calls_;
  std::size_t oldest_ = 0;
};

}  // namespace kinegraph::python
