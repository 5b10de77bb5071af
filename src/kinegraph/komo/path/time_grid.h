#pragma once

#include <utility>
#include <vector>

namespace kinegraph::inline komo_internal {

/// The slices of a path in time. There are T = ceil(phases * slices_per_phase) slices. Slice t is at phase time (t+1) /
/// slices_per_phase, so the last one of a phase is at its end. `order` more slices precede slice 0.
class TimeGrid {
 public:
  TimeGrid() = default;  ///< no slices

  /// `duration_per_phase` in s. Throws ValueError for numbers that are not positive, and an order outside of 0..10.
  TimeGrid(double phases, int slices_per_phase, double duration_per_phase, int order);

  bool empty() const { return slices_ == 0; }
  int slices() const { return slices_; }  ///< T
  int order() const { return order_; }    ///< k: largest number of preceding slices that an objective may depend on
  int slicesPerPhase() const { return slices_per_phase_; }
  double phases() const { return phases_; }
  double tau() const { return tau_; }  ///< s per slice
  double durationPerPhase() const { return tau_ * slices_per_phase_; }

  /// Convert a slice to its phase time, and a phase time to its slice: -order .. beyond the horizon.
  double timeOf(int slice) const { return double(slice + 1) / slices_per_phase_; }
  int sliceAt(double time) const;

  /// Returns the slices [from, to] that `times` selects, clipped to the horizon: [] all, [a] the one at time a, [a, b]
  /// those from a to b inclusive. A negative time is the last slice. Empty if from > to. Throws ValueError.
  std::pair<int, int> select(const std::vector<double>& times) const;

 private:
  double phases_ = 0., tau_ = 1.;
  int slices_ = 0, slices_per_phase_ = 0, order_ = 0;
};

}  // namespace kinegraph::inline komo_internal
