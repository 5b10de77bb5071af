#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

Komo Komo::clone() const {
  Komo copy(*this);
  for (std::shared_ptr<Mode>& mode : copy.modes_) mode = std::make_shared<Mode>(*mode);
  return copy;
}

Komo::Parts Komo::parts() const {
  Parts parts;
  if (base_) {
    parts.config = Config(*base_);
    parts.config.setJointState(start_);
    const auto& frames = parts.config.scene()->frames();
    for (const auto& source : source_->frames()) {
      if (source->id < int(frames.size()) && frames[source->id]->name == source->name)
        frames[source->id]->attributes = source->attributes;
    }
  }
  if (states_.empty()) return parts;
  parts.phases = phases_;
  parts.duration_per_phase = tau_ * slices_per_phase_;
  parts.slices_per_phase = slices_per_phase_;
  parts.order = order_;
  parts.next_joint = next_joint_;
  for (const auto& mode : modes_) parts.modes.push_back({mode->config, mode->added});
  parts.mode_of = mode_of_;
  parts.shown_frames = shown_frames_;
  parts.objectives = objectives_;
  parts.contacts = contacts_;
  for (const State& state : states_) parts.states.push_back(state.q());
  return parts;
}

Komo::Komo(Parts parts) {
  setConfig(parts.config);
  if (parts.states.empty()) return;
  setTiming(parts.phases, parts.slices_per_phase, parts.duration_per_phase, parts.order);
  next_joint_ = parts.next_joint;
  shown_frames_ = std::move(parts.shown_frames);
  const std::size_t count = states_.size();
  bool fits = parts.states.size() == count && parts.mode_of.size() == count;
  for (Parts::Structure& mode : parts.modes)
    modes_.push_back(std::make_shared<Mode>(Mode{std::move(mode.config), std::move(mode.added)}));
  for (std::size_t i = 0; fits && i < count; ++i) {
    const int mode = parts.mode_of[i];
    if (!modes_.empty()) {
      if (mode < 0 || mode >= int(modes_.size()))
        throw ValueError(cat("KOMO: slice ", i, " has mode ", mode, " of ", modes_.size()));
      states_[i] = State(modes_[mode]->config.program(), modes_[mode]->config.parameters());
    }
    fits = parts.states[i].size() == states_[i].dofs();
    if (fits) states_[i].setJoints(parts.states[i].data());
  }
  if (!fits) throw ValueError("KOMO: the parts do not fit together");
  mode_of_ = std::move(parts.mode_of);
  layout_ = makeLayout(states_, order_, stable_, modes_, mode_of_);
  objectives_ = std::move(parts.objectives);
  contacts_ = std::move(parts.contacts);
}

}  // namespace kinegraph
