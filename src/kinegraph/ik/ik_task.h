#pragma once

#include <memory>
#include <string>

#include "kinegraph/features/residual.h"
#include "kinegraph/ik/ik_target.h"

namespace kinegraph::inline ik_internal {

/// The part of a target that several problems share: everything except its numbers.
struct IkTask {
  using Kind = IkTarget::Kind;

  /// Throws FrameNotFound, and ValueError for an unsupported feature.
  IkTask(const State& scene, const IkTarget& target);

  IkTarget target;                           ///< axis normalized
  int frame = -1;                            ///< id; -1 for features
  int reference = -1;                        ///< id of the frame that the target is relative to; -1 for the world
  std::shared_ptr<const Residual> residual;  ///< of a feature; users copy it because it contains a workspace

  Kind kind() const { return target.kind; }
  bool hasPosition() const { return kind() == Kind::pose || kind() == Kind::position; }
  bool hasRotation() const { return kind() == Kind::pose || kind() == Kind::rotation; }
  bool hasDirection() const { return kind() == Kind::direction || kind() == Kind::gaze; }
  bool inLanes() const { return reference < 0 && kind() != Kind::gaze && kind() != Kind::feature; }
  int rows() const;

  /// Returns the dofs that influence the target, ascending.
  std::vector<int> dofs(const State& scene) const;

  std::string name() const;           ///< "frame 'hand'", for messages
  std::string goal() const;           ///< "position relative to 'cup'"
  std::string unitOf(int row) const;  ///< unit of a feature's component, such as " m"; "" if a scale mixes or changes
                                      ///< components

  /// Throws ValueError unless `other`, a target of problem number `problem`, belongs to this task and has valid
  /// numbers.
  void requireSame(const IkTarget& other, std::size_t problem) const;
};

/// Throws ValueError for numbers that are not finite, and for zero axes and quaternions.
void requireNumbers(const IkTarget& target);

}  // namespace kinegraph::inline ik_internal
