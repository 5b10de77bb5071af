#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/komo/objective.h"

namespace kinegraph::inline komo_internal {

/// The objectives of a trajectory optimization problem. Their order is that of the residuals. Each was validated
/// against the path when it was added: its frames, sizes and order fit.
class ObjectiveList {
 public:
  ObjectiveList() = default;
  explicit ObjectiveList(std::vector<Objective> objectives)
      : list_(std::move(objectives)) {}  ///< objectives of another, equal
                                         ///< problem

  /// Adds an objective in the slices that its times select; `delta_from` and `delta_to` shift the first and last one.
  /// Throws ValueError if it does not fit the path; adds a warning if it selects no slice.
  void add(Objective objective, const Path& path, const std::vector<ContactForce>& forces, int delta_from = 0,
           int delta_to = 0);

  void clear() { list_.clear(); }

  bool empty() const { return list_.empty(); }
  std::size_t size() const { return list_.size(); }
  const Objective& operator[](std::size_t i) const { return list_[i]; }
  auto begin() const { return list_.begin(); }
  auto end() const { return list_.end(); }
  const std::vector<Objective>& all() const { return list_; }

  /// Records a warning about a call without effect.
  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  std::vector<Objective> list_;
  std::vector<std::string> warnings_;
};

}  // namespace kinegraph::inline komo_internal
