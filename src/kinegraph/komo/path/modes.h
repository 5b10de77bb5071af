#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "kinegraph/komo/path/mode.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

/// The kinematic structure of the scene in each slice. Slices count from 0, the first one before the start.
///
/// The list is empty while all slices have the initial structure. Afterwards each slice has a mode, all modes have the
/// same frames in the same order, and unused modes stay in the list.
class Modes {
 public:
  Modes() = default;
  explicit Modes(std::size_t slices) : of_slice_(slices, 0) {}

  /// Restores known modes. Throws ValueError if a slice has a mode that is not in the list.
  Modes(std::vector<Mode> modes, std::vector<int> of_slice, int next_joint);

  /// Returns an independent copy.
  Modes clone() const;

  bool empty() const { return list_.empty(); }
  const std::vector<std::shared_ptr<Mode>>& list() const { return list_; }
  const std::vector<int>& ofSlices() const { return of_slice_; }
  const Mode& at(std::size_t slice) const { return *list_[std::size_t(of_slice_[slice])]; }
  Mode& at(std::size_t slice) { return *list_[std::size_t(of_slice_[slice])]; }

  /// Gives all slices the mode of the initial scene, unless they have one.
  void begin(const SceneTree& initial);

  /// Adds a frame without parent to all modes. Returns its id.
  int addFrame(const std::string& name);

  /// Replaces each mode of the slices in [first, last) by an edited copy.
  void replace(std::size_t first, std::size_t last, const std::function<void(Mode&)>& edit);

  /// Numbers for added joints; see Mode::Added::id.
  int newJoint() { return next_joint_++; }
  int nextJoint() const { return next_joint_; }

 private:
  std::vector<std::shared_ptr<Mode>> list_;
  std::vector<int> of_slice_;
  int next_joint_ = 1;
};

}  // namespace kinegraph::inline komo_internal
