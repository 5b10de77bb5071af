#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline scene_internal {

/// The first and the last frame of each name, for fast look-up in scenes of thousands of frames. `ready` reports
/// whether the index is complete; small scenes are searched without it.
class NameIndex {
 public:
  bool ready() const { return ready_; }

  /// Clears the index; `ready` is false until `build`.
  void forget() {
    ends_.clear();
    ready_ = false;
  }

  void build(const std::vector<std::shared_ptr<FrameData>>& frames) {
    ends_.clear();
    for (const auto& frame : frames) append(*frame);
    ready_ = true;
  }

  /// Adds a frame that comes after all indexed ones.
  void append(FrameData& frame) { ends_.try_emplace(frame.name, Ends{&frame, &frame}).first->second.last = &frame; }

  FrameData* first(std::string_view name) const {
    const auto found = ends_.find(name);
    return found == ends_.end() ? nullptr : found->second.first;
  }
  FrameData* last(std::string_view name) const {
    const auto found = ends_.find(name);
    return found == ends_.end() ? nullptr : found->second.last;
  }

 private:
  struct Ends {
    FrameData *first, *last;
  };
  struct Hash : std::hash<std::string_view> {
    using is_transparent = void;
  };
  std::unordered_map<std::string, Ends, Hash, std::equal_to<>> ends_;
  bool ready_ = false;
};

}  // namespace kinegraph::inline scene_internal
