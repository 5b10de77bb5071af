#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

namespace {

void requireFrame(const Program& program, const std::string& name, const char* call) { frameId(program, name, call); }

}  // namespace

/// Until the first change all slices share the given configuration's Program; from then on each has a mode.
void Komo::makeModes() {
  if (!modes_.empty()) return;
  modes_.push_back(std::make_shared<Mode>(Mode{Config(*base_), {}}));
}

int Komo::addHiddenFrame(const std::string& name) {
  int id = 0;
  for (const auto& mode : modes_) id = mode->config.scene()->add(name, nullptr).id;
  return id;
}

void Komo::switchFrom(int slice, const std::string& parent, const std::string& object, const Attachment& attachment) {
  const int first = std::max(slice, -order_) + order_, joint = next_joint_++;
  const int base_frame = attachment.base ? addHiddenFrame(object + "_base") : -1;
  std::map<int, int> changed;  // old mode -> the mode that takes its place
  for (std::size_t i = std::size_t(first); i < states_.size(); ++i) {
    const auto [place, is_new] = changed.try_emplace(mode_of_[i], int(modes_.size()));
    if (is_new) {
      auto mode = std::make_shared<Mode>(*modes_[mode_of_[i]]);
      mode->attach(parent, object, attachment, base_frame, joint);
      modes_.push_back(std::move(mode));
    }
    mode_of_[i] = place->second;
  }
  rebuildStates();
}

/// Makes the states of all slices anew. Joints that were there before keep their dofs; new ones are where their mode
/// has them.
void Komo::rebuildStates() {
  std::vector<State> old = std::move(states_);
  states_.clear();
  states_.reserve(old.size());
  for (std::size_t i = 0; i < old.size(); ++i) {
    Mode& mode = *modes_[mode_of_[i]];
    State state(mode.config.program(), mode.config.parameters());
    VectorXd q = mode.config.getJointState();
    const Program &now = state.program(), &before = old[i].program();
    for (std::size_t frame = 0; frame < before.frame_dofs.size(); ++frame) {
      const auto [first, count] = now.frame_dofs[frame];
      const auto [first_before, count_before] = before.frame_dofs[frame];
      const auto added = mode.added.find(int(frame));
      const bool kept =
          count > 0 && count == count_before && (added == mode.added.end() || added->second.id != next_joint_ - 1);
      if (kept) q.segment(first, count) = old[i].q().segment(first_before, count);
    }
    state.setJoints(q.data());
    states_.push_back(std::move(state));
  }
  layout_ = makeLayout(states_, order_, stable_, modes_, mode_of_);
  ++structure_revision_;
}

void Komo::addContinuity(FeatureSymbol feature, const std::vector<std::string>& frames, double scale, int order,
                         int slice) {
  if (slice < 0 || slice >= slices_) return;
  const double time = double(slice + 1) / slices_per_phase_;
  add({featureInfo(feature).name,
       feature,
       frames,
       ObjectiveType::eq,
       MatrixXd::Constant(1, 1, scale),
       {},
       order,
       {time},
       0,
       0},
      0, 0);
}

void Komo::addModeSwitch(const std::vector<double>& times, SwitchMode mode,
                         const std::vector<std::string>& given_frames, bool first) {
  requireBuilt("addModeSwitch");
  std::vector<std::string> frames = given_frames;
  using M = SwitchMode;
  const bool moves_alone = mode == M::dynamic || mode == M::dynamicTrans || mode == M::quasiStatic || mode == M::magic;
  if (frames.size() == 1 && moves_alone) frames.insert(frames.begin(), program_->frame_name.front());
  if (times.empty() || times.size() > 2 || !(times[0] >= 0.)) {
    throw ValueError("addModeSwitch: times is [from, to], both phase times; to -1 where the mode holds to the end");
  }
  const bool ends = times.size() == 2 && times[1] >= 0.;
  if (frames.size() != 2) {
    throw ValueError(
        cat("addModeSwitch: frames are [parent, object]", moves_alone ? " or [object]" : "", ", got ", frames.size()));
  }
  const std::string &parent = frames[0], &object = frames[1];
  requireFrame(state(-order_).program(), parent, "addModeSwitch");
  requireFrame(state(-order_).program(), object, "addModeSwitch");
  makeModes();
  const int from = sliceAt(times[0]), to = ends ? sliceAt(times[1]) : slices_ - 1;
  if (from >= slices_) {
    warnings_.push_back(cat("addModeSwitch at time ", times[0], " has no effect; the path ends at ",
                            double(slices_) / slices_per_phase_));
    return;
  }
  if (ends && to < from)
    throw ValueError(cat("addModeSwitch: times [", times[0], ", ", times[1], "] end before they begin"));
  const bool dynamic = mode == SwitchMode::dynamic || mode == SwitchMode::dynamicOn ||
                       mode == SwitchMode::dynamicTrans || mode == SwitchMode::quasiStatic ||
                       mode == SwitchMode::quasiStaticOn;
  const bool magic = mode == SwitchMode::magic || mode == SwitchMode::magicTrans;  // nothing is asked of the motion
  if (first && from >= 0 && order_ < 1 && !magic) {
    throw ValueError(
        "addModeSwitch: that the object does not jump is about velocities; it needs a KOMO with kOrder 1 or more, or "
        "firstSwitch=False");
  }
  Mode& before = *modes_[mode_of_[std::max(from - 1, -order_) + order_]];
  const FrameData& root = before.movableRoot(object, parent);
  const std::string root_name = root.name;
  std::string held_by;  // where the object was in a stable mode until now
  if (const auto added = before.added.find(root.id); added != before.added.end() && added->second.stable)
    held_by = added->second.parent;
  switchFrom(from, parent, object, attachmentOf(mode, before.config.getFrame(parent), before.config.getFrame(object)));
  if (magic) return;
  if (first) {
    const double scale = dynamic ? 1e2 : 1e1;
    if (held_by.empty()) {
      addContinuity(FeatureSymbol::pose, {root_name}, scale, 1, from);
    } else {
      addContinuity(FeatureSymbol::poseRel, {object, held_by}, scale, 1, from);
    }
    if (order_ >= 2 && !dynamic) addContinuity(FeatureSymbol::linangVel, {object}, 1., 2, from + 1);
  }
  if (dynamic) return addPhysics(mode, object, from + 1, to);
  if (!ends) return;
  addContinuity(FeatureSymbol::poseRel, {object, parent}, 1e1, 1, to);
  if (order_ >= 2) addContinuity(FeatureSymbol::linangVel, {object}, 1., 2, to + 1);
}

void Komo::addRigidSwitch(double time, const std::string& parent, const std::string& object, bool no_jump) {
  requireBuilt("addRigidSwitch");
  requireFrame(state(-order_).program(), parent, "addRigidSwitch");
  requireFrame(state(-order_).program(), object, "addRigidSwitch");
  if (!(time >= 0.)) throw ValueError(cat("addRigidSwitch: time is ", time, "; expected a phase time"));
  const int from = sliceAt(time);
  if (from >= slices_) {
    warnings_.push_back(
        cat("addRigidSwitch at time ", time, " has no effect; the path ends at ", double(slices_) / slices_per_phase_));
    return;
  }
  makeModes();
  const std::string root = modes_[mode_of_[std::max(from - 1, -order_) + order_]]->movableRoot(object, parent).name;
  switchFrom(from, parent, object, {});
  if (!no_jump) return;
  addContinuity(FeatureSymbol::pose, {root}, 1e1, 1, from);
  if (order_ >= 2) addContinuity(FeatureSymbol::linangVel, {object}, 1., 2, from + 1);
}

void Komo::addFrameDof(const std::string& name, const std::string& parent, JointType type, bool stable,
                       const std::string& origin) {
  requireBuilt("addFrameDof");
  const Program& program = state(-order_).program();
  if (name.empty() || program.frame_index.contains(name)) {
    throw ValueError(cat("addFrameDof: there is a frame '", name, "' already; expected a new name"));
  }
  std::string below = parent;
  if (parent.empty() && type != JointType::none)
    below = program.frame_index.contains("world") ? "world" : program.frame_name.front();
  if (!below.empty()) requireFrame(program, below, "addFrameDof");
  if (!origin.empty()) requireFrame(program, origin, "addFrameDof");
  if (type == JointType::hinge || type == JointType::generic || type == JointType::tau) {
    throw ValueError(cat("addFrameDof: a ", jointTypeName(type), " joint cannot be added to a motion problem"));
  }
  makeModes();
  const int joint = next_joint_++;
  Pose X_origin;
  if (!origin.empty()) {
    const Config& given = modes_[mode_of_[0]]->config;
    X_origin = given.getFrame(origin).getPose();
    if (!below.empty()) X_origin = given.getFrame(below).getPose().inverse() * X_origin;
  }
  for (const auto& mode : modes_) {
    SceneTree& scene = *mode->config.scene();
    FrameData& frame = scene.add(name, nullptr);
    FrameData* seat = below.empty() ? nullptr : &scene.get(below, "addFrameDof");
    if (!origin.empty()) {
      FrameData& at = scene.add(name + "_origin", nullptr);
      if (seat) scene.link(at, *seat);
      at.pose = X_origin;
      seat = &at;
    }
    if (seat) scene.link(frame, *seat);
    Frame(mode->config.scene(), frame).setShape(ShapeType::marker, {.1});
    if (mode == modes_.front()) {
      shown_frames_.push_back(frame.id);
      if (!origin.empty()) shown_frames_.push_back(frame.id + 1);
    }
    if (type == JointType::none) continue;
    const Frame anchor = mode->config.getFrame(below);
    Attachment attachment;
    attachment.type = type;
    attachment.stable = stable;
    limitByType(attachment, anchor);
    addJoint(frame, attachment, Pose());
    if (frame.moves()) mode->added[frame.id] = {joint, stable, below};
    scene.structureChanged();
  }
  rebuildStates();
}

}  // namespace kinegraph
