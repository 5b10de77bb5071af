#include "kinegraph/komo/path/time_grid.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr int kMaxSlices = 10'000'000;  // several GB of states

}  // namespace

TimeGrid::TimeGrid(double phases, int slices_per_phase, double duration_per_phase, int order) {
  if (!(phases > 0.) || !std::isfinite(phases))
    throw ValueError(cat("KOMO: phases is ", phases, "; expected a positive number"));
  if (slices_per_phase < 1)
    throw ValueError(cat("KOMO: slicesPerPhase is ", slices_per_phase, "; expected at least 1"));
  if (order < 0 || order > 10)
    throw ValueError(cat("KOMO: kOrder is ", order, "; expected 0 (poses) to 2 (accelerations), at most 10"));
  if (!(duration_per_phase > 0.))
    throw ValueError(cat("KOMO: durationPerPhase is ", duration_per_phase, " s; expected a positive number"));
  if (!(phases * slices_per_phase <= kMaxSlices))
    throw ValueError(cat("KOMO: ", phases, " phases of ", slices_per_phase, " slices are more than ", kMaxSlices,
                         " slices; phases and slicesPerPhase are counts, not seconds or steps of a controller"));
  phases_ = phases;
  slices_ = int(std::ceil(phases * slices_per_phase - 1e-9));
  slices_per_phase_ = slices_per_phase;
  tau_ = duration_per_phase / slices_per_phase;
  order_ = order;
}

int TimeGrid::sliceAt(double time) const { return int(std::floor(time * slices_per_phase_ + .500001)) - 1; }

std::pair<int, int> TimeGrid::select(const std::vector<double>& times) const {
  if (times.size() > 2)
    throw ValueError(cat("KOMO: times has ", times.size(), " entries; expected [] (all), [time] or [from, to]"));
  for (double time : times) {
    if (!std::isfinite(time))
      throw ValueError(cat("KOMO: times has the entry ", time, "; expected phase times, or -1 for the end"));
  }
  const auto slice = [&](double time) { return time < 0. ? slices_ - 1 : sliceAt(time); };
  if (times.empty()) return {0, slices_ - 1};
  const int from = slice(times.front()), to = slice(times.back());
  return {std::max(from, 0), std::min(to, slices_ - 1)};
}

}  // namespace kinegraph::inline komo_internal
