#pragma once

#include <memory>
#include <string>

#include "kinegraph/features/residual.h"
#include "kinegraph/ik/ik_target.h"

namespace kinegraph {

/// What the targets of several problems have in common: all but their numbers.
struct IkTask {
  using Kind = IkTarget::Kind;

  /// Throws FrameNotFound, and ValueError for a feature that cannot be asked for.
  IkTask(const State& scene, const IkTarget& target);

  IkTarget target;                           ///< the axis is a unit vector
  int frame = -1;                            ///< id; -1 of a feature
  int reference = -1;                        ///< id of the frame that the target is relative to; -1: the world
  std::shared_ptr<const Residual> residual;  ///< of a feature; to be copied, as it has a workspace

  Kind kind() const { return target.kind; }
  bool placed() const { return kind() == Kind::pose || kind() == Kind::position; }
  bool turned() const { return kind() == Kind::pose || kind() == Kind::rotation; }
  bool pointed() const { return kind() == Kind::direction || kind() == Kind::gaze; }
  bool inLanes() const { return reference < 0 && kind() != Kind::gaze && kind() != Kind::feature; }
  int rows() const;

  /// The dofs that change what is asked for, ascending.
  std::vector<int> dofs(const State& scene) const;

  std::string name() const;           ///< "frame 'hand'", for messages
  std::string goal() const;           ///< "position relative to 'cup'"
  std::string unitOf(int row) const;  ///< of a feature's row: " m"; "" where a scale mixes or changes rows

  /// Throws ValueError unless `other`, of problem number `problem`, is of this task, and its numbers make sense.
  void requireSame(const IkTarget& other, std::size_t problem) const;
};

/// Throws ValueError for numbers that make no sense.
void requireNumbers(const IkTarget& target);

}  // namespace kinegraph
