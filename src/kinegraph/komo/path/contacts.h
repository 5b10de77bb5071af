#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/features/forces.h"
#include "kinegraph/komo/path/path.h"

namespace kinegraph {

/// A contact force in a slice.
struct Interaction {
  int slice;
  std::string object, from;
  Vector3d point;  ///< m, in the world
  Vector3d force;  ///< N, on the object, in the world
};

/// The contact forces of a motion problem, each with a point and dofs on its path, in the order in which they were
/// added.
class Contacts {
 public:
  Contacts() = default;
  explicit Contacts(std::vector<ContactForce> known) : forces_(std::move(known)) {}

  const std::vector<ContactForce>& forces() const { return forces_; }
  void add(const ContactForce& force) { forces_.push_back(force); }

  /// Those that act in each slice of the path they are on, slice after slice.
  std::vector<Interaction> interactions(const Path& path) const;

 private:
  std::vector<ContactForce> forces_;
};

}  // namespace kinegraph
