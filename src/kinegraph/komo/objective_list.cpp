#include "kinegraph/komo/objective_list.h"

#include <algorithm>
#include <tuple>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline komo_internal {

void ObjectiveList::add(Objective objective, const Path& path, const std::vector<ContactForce>& forces, int delta_from,
                        int delta_to) {
  const TimeGrid& grid = path.grid();
  std::tie(objective.from, objective.to) = grid.select(objective.times);
  objective.from = std::max(objective.from + delta_from, 0);
  objective.to = std::min(objective.to + delta_to, grid.slices() - 1);
  const bool empty = objective.from > objective.to;
  objective.order = residualIn(objective, path, forces, empty ? 0 : objective.from).order();
  if (objective.order > grid.order() && !objective.between_slices) {
    throw ValueError(cat(objective.name(), " of order ", objective.order, " needs a KOMO with kOrder ", objective.order,
                         " or more; this one has ", grid.order()));
  }
  if (empty) {
    std::vector<std::string> numbers;
    for (double time : objective.times) numbers.push_back(cat(time));
    warn(cat("objective ", objective.name(), " with times [", join(numbers), "] selects no slice; the ", grid.slices(),
             grid.slices() == 1 ? " slice is" : " slices are", " at phase times ", grid.timeOf(0), " to ",
             grid.timeOf(grid.slices() - 1)));
  }
  list_.push_back(std::move(objective));
}

}  // namespace kinegraph::inline komo_internal
