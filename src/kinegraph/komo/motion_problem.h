#pragma once

#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/contacts.h"

namespace kinegraph::inline komo_internal {

/// A path, its objectives, and its contact forces, which mode switches and contacts modify together.
struct MotionProblem {
  Path path;
  ObjectiveList objectives;
  Contacts contacts;

  /// Adds an objective; see ObjectiveList::add.
  void require(Objective objective, int delta_from = 0, int delta_to = 0) {
    objectives.add(std::move(objective), path, contacts.forces(), delta_from, delta_to);
  }
};

}  // namespace kinegraph::inline komo_internal
