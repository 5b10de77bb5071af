#pragma once

#include <string>
#include <string_view>
#include <unordered_map>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph {

/// The first and the last frame of each name, so that scenes of thousands of frames find one without looking at all.
/// `ready` says whether it knows all names; small scenes do without.
class NameIndex {
 public:
  bool ready() const { return ready_; }

  /// Forgets all; `ready` is false until `build`.
  void forget() {
    ends_.clear();
    ready_ = false;
  }

  void build(const std::vector<std::shared_ptr<FrameData>>& frames) {
    ends_.clear();
    for (const auto& frame : frames) append(*frame);
    ready_ = true;
  }

  /// A frame that comes after all that are known.
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

}  // namespace kinegraph
