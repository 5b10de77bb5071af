#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "kinegraph/komo/path/mode.h"

namespace kinegraph {

/// Which structure the scene has in each slice. Slices count from 0, the first one before the start.
///
/// As long as there is one structure, the given one, the list is empty. From then on each slice has a mode, all modes
/// have the same frames in the same order, and modes that no slice has any more stay in the list.
class Modes {
 public:
  Modes() = default;
  explicit Modes(std::size_t slices) : of_slice_(slices, 0) {}

  /// Modes that are known. Throws ValueError if a slice has a mode that is not in the list.
  Modes(std::vector<Mode> modes, std::vector<int> of_slice, int next_joint);

  /// The same modes, to be edited apart from these.
  Modes clone() const;

  bool empty() const { return list_.empty(); }
  const std::vector<std::shared_ptr<Mode>>& list() const { return list_; }
  const std::vector<int>& ofSlices() const { return of_slice_; }
  const Mode& at(std::size_t slice) const { return *list_[std::size_t(of_slice_[slice])]; }
  Mode& at(std::size_t slice) { return *list_[std::size_t(of_slice_[slice])]; }

  /// Gives all slices a mode, that of the given scene, unless they have one.
  void begin(const SceneTree& given);

  /// A frame without parent in all modes. Returns its id.
  int addFrame(const std::string& name);

  /// In place of each mode that slices in [first, last) have, they get a copy of it that is edited.
  void replace(std::size_t first, std::size_t last, const std::function<void(Mode&)>& edit);

  /// Numbers of joints that were added; see Mode::Added::id.
  int newJoint() { return next_joint_++; }
  int nextJoint() const { return next_joint_; }

 private:
  std::vector<std::shared_ptr<Mode>> list_;
  std::vector<int> of_slice_;
  int next_joint_ = 1;
};

}  // namespace kinegraph
