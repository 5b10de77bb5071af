#pragma once

#include "arrays.h"
#include "kinegraph/features/residual_cache.h"

namespace kinegraph::python {

/// What the last few calls of `eval` with built-in features asked, by the identity of their arguments, which strings
/// and symbols keep: the same call again converts nothing, and takes the arrays that it returned before if they are
/// free.
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

  /// Null if there was no such call. It stays until `add`.
  Call* find(const State& scene, nb::handle symbol, nb::handle frames, int order);

  /// Remembers a call in place of the oldest one. Null for frames that are not plain strings.
  Call* add(const State& scene, nb::handle symbol, nb::handle frames, int order,
            const std::shared_ptr<Residual>& residual);

 private:
  std::vector<Call> calls_;
  std::size_t oldest_ = 0;
};

}  // namespace kinegraph::python
