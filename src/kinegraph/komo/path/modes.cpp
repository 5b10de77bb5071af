#include "kinegraph/komo/path/modes.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

Modes::Modes(std::vector<Mode> modes, std::vector<int> of_slice, int next_joint)
    : of_slice_(std::move(of_slice)), next_joint_(next_joint) {
  for (std::size_t slice = 0; !modes.empty() && slice < of_slice_.size(); ++slice) {
    const int mode = of_slice_[slice];
    if (mode < 0 || mode >= int(modes.size()))
      throw ValueError(cat("KOMO: slice ", slice, " has mode ", mode, " of ", modes.size()));
  }
  for (Mode& mode : modes) list_.push_back(std::make_shared<Mode>(std::move(mode)));
}

Modes Modes::clone() const {
  Modes copy(*this);
  for (std::shared_ptr<Mode>& mode : copy.list_) mode = std::make_shared<Mode>(*mode);
  return copy;
}

void Modes::begin(const SceneTree& initial) {
  if (empty()) list_.push_back(std::make_shared<Mode>(Mode{Config(initial), {}}));
}

int Modes::addFrame(const std::string& name) {
  int id = 0;
  for (const auto& mode : list_) id = mode->config.scene()->add(name, nullptr).id;
  return id;
}

void Modes::replace(std::size_t first, std::size_t last, const std::function<void(Mode&)>& edit) {
  std::map<int, int> changed;  // old mode -> its replacement
  for (std::size_t slice = first; slice < last; ++slice) {
    int& mode_of_slice = of_slice_[slice];
    const auto [place, is_new] = changed.try_emplace(mode_of_slice, int(list_.size()));
    if (is_new) {
      auto mode = std::make_shared<Mode>(at(slice));
      edit(*mode);
      list_.push_back(std::move(mode));
    }
    mode_of_slice = place->second;
  }
}

}  // namespace kinegraph::inline komo_internal
