#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/features/forces.h"
#include "kinegraph/komo/path/path_records.h"

namespace kinegraph::inline komo_internal {

class Path;

/// The contact forces of a trajectory optimization problem in the order of addition, each with a point and dofs on its
/// path.
class Contacts {
 public:
  Contacts() = default;
  explicit Contacts(std::vector<ContactForce> forces) : forces_(std::move(forces)) {}

  const std::vector<ContactForce>& forces() const { return forces_; }
  void add(const ContactForce& force) { forces_.push_back(force); }

  /// Lists the forces that act in each slice of their path, slice by slice.
  std::vector<Interaction> interactions(const Path& path) const;

 private:
  std::vector<ContactForce> forces_;
};

}  // namespace kinegraph::inline komo_internal
