#include "kinegraph/komo/path/path_layout.h"

#include <map>

namespace kinegraph::inline komo_internal {

namespace {

struct DofSet {
  int frame;
  KinematicModel::DofRange dofs;
};

/// Returns the dofs of a model, joint by joint in the order of q.
std::vector<DofSet> dofSets(const KinematicModel& model) {
  std::map<int, DofSet> by_first;  // mimicking joints repeat the dofs of another
  for (int frame = 0; frame < int(model.frame_dofs.size()); ++frame) {
    const KinematicModel::DofRange& dofs = model.frame_dofs[frame];
    if (dofs.count > 0) by_first.try_emplace(dofs.first, DofSet{frame, dofs});
  }
  std::vector<DofSet> sets;
  for (const auto& [first, set] : by_first) sets.push_back(set);
  return sets;
}

PathLayout plainLayout(const std::vector<State>& states, int prefix) {
  PathLayout layout;
  const KinematicModel& model = states.front().model();
  const int slices = int(states.size()) - prefix;
  layout.dimension = slices * model.dofs;
  layout.lower = model.lower.replicate(slices, 1);
  layout.upper = model.upper.replicate(slices, 1);
  return layout;
}

}  // namespace

PathLayout makeLayout(const std::vector<State>& states, int prefix, const std::set<int>& stable, const Modes& modes) {
  if (modes.empty() && stable.empty()) return plainLayout(states, prefix);
  PathLayout layout;
  layout.plain = false;
  layout.column.resize(states.size());
  layout.owned.resize(states.size());
  std::vector<double> lower, upper;
  std::map<int, int> shared;  // joint -> its first column; the key of original stable joints is -1 - frame
  std::map<const KinematicModel*, std::vector<DofSet>> sets;
  for (std::size_t i = 0; i < states.size(); ++i) {
    const KinematicModel& model = states[i].model();
    auto [place, is_new] = sets.try_emplace(&model);
    if (is_new) place->second = dofSets(model);
    std::vector<int>& column = layout.column[i];
    column.assign(model.dofs, -1);
    for (const DofSet& set : place->second) {
      const Mode::Added* added = nullptr;
      if (!modes.empty()) {
        const Mode& mode = modes.at(i);
        if (const auto found = mode.added.find(set.frame); found != mode.added.end()) added = &found->second;
      }
      const bool is_shared = added ? added->stable : stable.contains(set.frame);
      if (!added && !is_shared && int(i) < prefix) continue;
      int first = int(lower.size());
      bool owner = true;
      if (is_shared) {
        const auto [known, fresh] = shared.try_emplace(added ? added->id : -1 - set.frame, first);
        first = known->second;
        owner = fresh;
      }
      for (int d = 0; d < set.dofs.count; ++d) {
        column[set.dofs.first + d] = first + d;
        if (!owner) continue;
        lower.push_back(model.lower[set.dofs.first + d]);
        upper.push_back(model.upper[set.dofs.first + d]);
      }
      if (owner) layout.owned[i].push_back(set.dofs);
    }
  }
  layout.dimension = int(lower.size());
  layout.lower = Eigen::Map<VectorXd>(lower.data(), layout.dimension);
  layout.upper = Eigen::Map<VectorXd>(upper.data(), layout.dimension);
  return layout;
}

}  // namespace kinegraph::inline komo_internal
