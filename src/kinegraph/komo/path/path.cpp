#include "kinegraph/komo/path/path.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/unit_norms.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr std::size_t kUsualDofs = 256;

/// The q of a state, with quaternions of length 1; a solver's variables have any length.
VectorXd unitJoints(const State& state) {
  VectorXd q = state.q();
  scaleToUnitNorms(state.model().unit_norms, q);
  return q;
}

}  // namespace

void Path::setScene(const Config& config) {
  initial_ = InitialConfiguration(config);
  shown_frames_.clear();
  for (const auto& frame : config.scene()->frames()) shown_frames_.push_back(frame->id);
  build();
}

void Path::setGrid(const TimeGrid& time_grid) {
  grid_ = time_grid;
  build();
}

void Path::build() {
  if (initial_.empty() || grid_.empty()) return;
  const std::size_t count = std::size_t(grid_.slices() + grid_.order());
  states_.clear();
  states_.reserve(count);
  State first(initial_.model, initial_.parameters);
  first.setJoints(initial_.q.data());
  for (std::size_t i = 1; i < count; ++i) states_.push_back(first);
  states_.push_back(std::move(first));
  modes_ = Modes(count);
  layOut();
  ++revision_;
}

Path Path::clone() const {
  Path copy(*this);
  copy.modes_ = modes_.clone();
  return copy;
}

void Path::requireBuilt(const char* call) const {
  if (states_.empty())
    throw Error(cat("KOMO: ", call, " needs a configuration and a timing; call setConfig and setTiming first"));
}

void Path::requireSlice(int slice) const {
  if (slice < -grid_.order() || slice >= grid_.slices())
    throw ValueError(cat("KOMO: slice ", slice, " is not in ", -grid_.order(), " .. ", grid_.slices() - 1));
}

VectorXd Path::ownDofs(int slice) const {
  if (layout_.plain) return state(slice).q();
  std::vector<double> values;
  for (const auto& [first, count] : layout_.owned[std::size_t(slice + grid_.order())]) {
    for (int i = first; i < first + count; ++i) values.push_back(state(slice).q()[i]);
  }
  return Eigen::Map<VectorXd>(values.data(), Eigen::Index(values.size()));
}

VectorXd Path::variables() const {
  VectorXd x(layout_.dimension);
  int first = 0;
  for (int t = layout_.plain ? 0 : -grid_.order(); t < grid_.slices(); ++t) {
    const VectorXd own = ownDofs(t);
    x.segment(first, own.size()) = own;
    first += int(own.size());
  }
  return x;
}

void Path::setVariables(const VectorXd& x) {
  if (layout_.plain) {
    for (int t = 0; t < grid_.slices(); ++t) setSlice(t, x.data() + t * initial_.model->dofs);
    return;
  }
  double usual[kUsualDofs];  // solvers call this in their loop, so it must not allocate
  std::vector<double> many;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const std::vector<int>& column = layout_.column[i];
    if (column.size() > kUsualDofs) many.resize(column.size());
    double* q = column.size() > kUsualDofs ? many.data() : usual;
    bool moves = false;
    for (std::size_t d = 0; d < column.size(); ++d) {
      q[d] = column[d] < 0 ? states_[i].q()[Eigen::Index(d)] : x[column[d]];
      moves = moves || column[d] >= 0;
    }
    if (moves) states_[i].setJoints(q);
  }
}

std::vector<int> Path::dofsOf(const std::vector<int>& frames, int slice) const {
  const KinematicModel& model = state(slice).model();
  std::vector<int> dofs;
  for (int frame : frames) {
    if (frame < 0 || frame >= int(model.frame_dofs.size()) || model.frame_dofs[frame].count == 0) {
      throw ValueError(cat("KOMO: frame ", frame, " has no active joint in slice ", slice));
    }
    const auto [first, count] = model.frame_dofs[frame];
    for (int i = first; i < first + count; ++i) dofs.push_back(i);
  }
  return dofs;
}

MatrixXd Path::joints(const std::vector<int>& frames) const {
  MatrixXd joints;
  if (layout_.plain && frames.empty()) {
    joints.resize(grid_.slices(), state(0).dofs());
    for (int t = 0; t < grid_.slices(); ++t) joints.row(t) = unitJoints(state(t));
    return joints;
  }
  for (int t = 0; t < grid_.slices(); ++t) {
    const std::vector<int> dofs = dofsOf(frames.empty() ? initial_.joint_frames : frames, t);
    if (t == 0) joints.resize(grid_.slices(), Eigen::Index(dofs.size()));
    const VectorXd q = unitJoints(state(t));
    for (std::size_t i = 0; i < dofs.size(); ++i) joints(t, Eigen::Index(i)) = q[dofs[i]];
  }
  return joints;
}

void Path::setJoints(int slice, const VectorXd& q) {
  VectorXd all = state(slice).q();
  const std::vector<int> dofs = dofsOf(initial_.joint_frames, slice);
  for (std::size_t i = 0; i < dofs.size(); ++i) all[dofs[i]] = q[Eigen::Index(i)];
  setSlice(slice, all.data());
}

MatrixXd Path::framePoses(int slice) const {
  requireSlice(slice);
  MatrixXd poses(Eigen::Index(shown_frames_.size()), 7);
  for (std::size_t i = 0; i < shown_frames_.size(); ++i) {
    Pose X(state(slice).pose(shown_frames_[i]));
    if (X.q.w() < 0.) X.q.coeffs() *= -1.;
    poses.row(Eigen::Index(i)) = X.numbers();
  }
  return poses;
}

Config Path::configuration(int slice) const {
  requireSlice(slice);
  Config config = modes_.empty() ? Config(*initial_.tree) : mode(slice).config;
  config.setJointState(state(slice).q());
  initial_.restoreAttributes(config);
  return config;
}

/// Rebuilds the states of all slices. Existing joints keep their dofs; new ones get the values of their mode.
void Path::rebuildStates() {
  const int newest = modes_.nextJoint() - 1;
  std::vector<State> old = std::move(states_);
  states_.clear();
  states_.reserve(old.size());
  for (std::size_t i = 0; i < old.size(); ++i) {
    Mode& mode = modes_.at(i);
    State state(mode.config.model(), mode.config.parameters());
    VectorXd q = mode.config.getJointState();
    const KinematicModel &now = state.model(), &before = old[i].model();
    for (std::size_t frame = 0; frame < before.frame_dofs.size(); ++frame) {
      const auto [first, count] = now.frame_dofs[frame];
      const auto [first_before, count_before] = before.frame_dofs[frame];
      const auto added = mode.added.find(int(frame));
      const bool keeps_dofs =
          count > 0 && count == count_before && (added == mode.added.end() || added->second.id != newest);
      if (keeps_dofs) q.segment(first, count) = old[i].q().segment(first_before, count);
    }
    state.setJoints(q.data());
    states_.push_back(std::move(state));
  }
  layOut();
  ++revision_;
}

void Path::attach(int from, const std::string& parent, const std::string& object, const Attachment& attachment) {
  const int first = std::max(from, -grid_.order()) + grid_.order(), joint = modes_.newJoint();
  const int base_frame = attachment.base ? modes_.addFrame(object + "_base") : -1;
  modes_.replace(std::size_t(first), states_.size(),
                 [&](Mode& mode) { mode.attach(parent, object, attachment, base_frame, joint); });
  rebuildStates();
}

int Path::addDofs(const std::string& name, int from, int to, const Attachment& attachment) {
  const int id = modes_.addFrame(name), joint = modes_.newJoint();
  modes_.replace(std::size_t(from + grid_.order()), std::size_t(to + 1 + grid_.order()), [&](Mode& mode) {
    SceneTree& scene = *mode.config.scene();
    FrameData& frame = *scene.frames()[id];
    scene.link(frame, *scene.frames().front());
    addJoint(frame, attachment, Pose());
    mode.added[id] = {joint, false, scene.frames().front()->name};
    scene.structureChanged();
  });
  rebuildStates();
  return id;
}

void Path::addFrame(const std::string& name, const std::string& parent, JointType type, bool stable,
                    const std::optional<Pose>& origin) {
  const int joint = modes_.newJoint();
  Pose X_origin = origin.value_or(Pose());
  if (origin && !parent.empty()) X_origin = modes_.at(0).config.getFrame(parent).getPose().inverse() * X_origin;
  for (const auto& mode : modes_.list()) {
    SceneTree& scene = *mode->config.scene();
    FrameData& frame = scene.add(name, nullptr);
    FrameData* seat = parent.empty() ? nullptr : &scene.get(parent, "addFrameDof");
    if (origin) {
      FrameData& at = scene.add(name + "_origin", nullptr);
      if (seat) scene.link(at, *seat);
      at.pose = X_origin;
      seat = &at;
    }
    if (seat) scene.link(frame, *seat);
    Frame(mode->config.scene(), frame).setShape(ShapeType::marker, {.1});
    if (mode == modes_.list().front()) {
      shown_frames_.push_back(frame.id);
      if (origin) shown_frames_.push_back(frame.id + 1);
    }
    if (type == JointType::none) continue;
    Attachment attachment;
    attachment.type = type;
    attachment.stable = stable;
    limitByType(attachment, mode->config.getFrame(parent));
    addJoint(frame, attachment, Pose());
    if (frame.moves()) mode->added[frame.id] = {joint, stable, parent};
    scene.structureChanged();
  }
  rebuildStates();
}

void Path::updateRootObjects(const Config& config) {
  const auto model = config.model();
  if (model != initial_.model &&
      (model->frame_name != initial_.model->frame_name || model->dofs != initial_.model->dofs)) {
    throw ValueError(
        "KOMO: updateRootObjects needs the configuration that the KOMO was made from, with the same frames, joints and "
        "shapes");
  }
  if (model == initial_.model && modes_.empty()) {
    initial_.tree.reset();  // frees its memory for the new snapshot
    initial_.tree = config.scene()->snapshot();
    initial_.parameters = config.parameters();
  } else {
    initial_.transferPoses(config);
    for (const auto& mode : modes_.list()) transferPoses(*mode->config.scene(), config);
  }
  for (std::size_t i = 0; i < states_.size(); ++i)
    states_[i].setParameters(modes_.empty() ? initial_.parameters : modes_.at(i).config.parameters());
  if (const VectorXd q = config.getJointState(); q != initial_.q) moveStart(q);
}

/// Sets the slices before the first to q, for joints that they share with the initial configuration.
void Path::moveStart(const VectorXd& q) {
  initial_.q = q;
  const KinematicModel& initial = *initial_.model;
  for (int slice = -grid_.order(); slice < 0; ++slice) {
    VectorXd all = state(slice).q();
    for (int frame : initial_.joint_frames) {
      const auto [first_initial, count_initial] = initial.frame_dofs[std::size_t(frame)];
      const auto [first, count] = state(slice).model().frame_dofs[std::size_t(frame)];
      const bool is_constant =
          layout_.plain || layout_.column[std::size_t(slice + grid_.order())][std::size_t(first)] < 0;
      if (count == count_initial && is_constant) all.segment(first, count) = q.segment(first_initial, count);
    }
    setSlice(slice, all.data());
  }
}

Path::Content Path::content() const {
  Content content;
  for (const auto& mode : modes_.list()) content.modes.push_back(*mode);
  content.mode_of = modes_.ofSlices();
  content.shown_frames = shown_frames_;
  content.next_joint = modes_.nextJoint();
  for (const State& state : states_) content.states.push_back(state.q());
  return content;
}

void Path::setContent(Content content) {
  const std::size_t count = states_.size();
  bool fits = content.states.size() == count && content.mode_of.size() == count;
  if (fits) modes_ = Modes(std::move(content.modes), std::move(content.mode_of), content.next_joint);
  for (std::size_t i = 0; fits && i < count; ++i) {
    if (!modes_.empty()) states_[i] = State(modes_.at(i).config.model(), modes_.at(i).config.parameters());
    fits = content.states[i].size() == states_[i].dofs();
    if (fits) states_[i].setJoints(content.states[i].data());
  }
  if (!fits) throw ValueError("KOMO: the parts do not fit together");
  shown_frames_ = std::move(content.shown_frames);
  layOut();
}

}  // namespace kinegraph::inline komo_internal
