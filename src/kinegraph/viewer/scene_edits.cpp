#include "kinegraph/viewer/scene_edits.h"

#include <algorithm>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph::inline viewer_internal {

namespace {

void place(Config& config, int id, const Pose& pose) {
  Frame frame = config.getFrame(id);
  frame.getParent() ? frame.setRelativePose(pose) : frame.setPose(pose);
}

}  // namespace

void SceneEdits::setScene(std::shared_ptr<const SceneTree> scene, int structure) {
  const std::lock_guard lock(mutex_);
  if (structure != structure_) {
    joints_.clear();
    frames_.clear();
    undo_.clear();
    redo_.clear();
  }
  structure_ = structure;
  scene_ = std::move(scene);
  edited_.reset();
}

std::optional<EditedScene> SceneEdits::apply(const Command& command) {
  const std::lock_guard lock(mutex_);
  if (!scene_ || !change(command)) return std::nullopt;
  EditedScene result{posesOf(*edited_), edited_->getJointState(), {}};
  if (margin_ > 0.) result.near = nearLines(*edited_, margin_);
  if (std::holds_alternative<WarningsCommand>(command)) result.warnings = sceneWarnings(*edited_);
  return result;
}

std::vector<SceneWarning> SceneEdits::warnings() {
  const std::lock_guard lock(mutex_);
  return scene_ ? sceneWarnings(edited()) : std::vector<SceneWarning>{};
}

bool SceneEdits::takeInto(Config& config) {
  const std::lock_guard lock(mutex_);
  if (joints_.empty() && frames_.empty()) return false;
  for (const auto& [id, pose] : frames_) place(config, id, pose);
  VectorXd q = config.getJointState();
  for (const auto& [joint, value] : joints_) q[joint] = value;
  config.setJointState(q);
  joints_.clear();
  frames_.clear();
  return true;
}

bool SceneEdits::hasAny() const {
  const std::lock_guard lock(mutex_);
  return !joints_.empty() || !frames_.empty();
}

double SceneEdits::margin() const {
  const std::lock_guard lock(mutex_);
  return margin_;
}

void SceneEdits::forgetMargin() {
  const std::lock_guard lock(mutex_);
  margin_ = 0.;
}

Config& SceneEdits::edited() {
  if (!edited_) {
    edited_.emplace(*scene_);
    for (const auto& [id, pose] : frames_) place(*edited_, id, pose);
    VectorXd q = edited_->getJointState();
    for (const auto& [joint, value] : joints_) q[joint] = value;
    edited_->setJointState(q);
  }
  return *edited_;
}

bool SceneEdits::change(const Command& command) {
  const bool current = std::visit(
      [&](const auto& c) {
        if constexpr (requires { c.structure; }) return c.structure == structure_;
        return false;
      },
      command);
  if (!current) return false;
  edited();
  if (std::holds_alternative<UndoCommand>(command)) return restore(undo_, redo_);
  if (std::holds_alternative<RedoCommand>(command)) return restore(redo_, undo_);
  if (std::holds_alternative<WarningsCommand>(command)) return true;
  if (const auto* near = std::get_if<NearCommand>(&command)) {
    margin_ = std::clamp(near->margin, 0., 1.);
    return true;
  }
  return edit(command);
}

bool SceneEdits::edit(const Command& command) {
  const VectorXd before = edited_->getJointState();
  Step step{{}, {}, {int(command.index()), -1}, std::chrono::steady_clock::now()};
  if (const auto* set = std::get_if<SetJointCommand>(&command)) {
    if (set->joint < 0 || set->joint >= edited_->getJointDimension()) return false;
    step.edited.second = set->joint;
    setJoint(set->joint, set->value);
  } else if (std::holds_alternative<ResetJointsCommand>(command)) {
    setAllJoints(edited_->model()->home);
  } else if (std::holds_alternative<RandomJointsCommand>(command)) {
    setAllJoints(randomJointState(*edited_, random_));
  } else if (const auto* move = std::get_if<MoveFrameCommand>(&command)) {
    if (move->frame < 0 || move->frame >= edited_->getFrameDimension()) return false;
    step.edited.second = move->frame;
    const Pose pose = edited_->getFrame(move->frame).data().relativePose();
    if (!moveFrame(move->frame, move->pose)) return false;
    if (frames_.contains(move->frame)) step.frames[move->frame] = pose;
  } else {
    return false;
  }
  const VectorXd after = edited_->getJointState();
  for (int i = 0; i < after.size(); ++i) {
    if (after[i] != before[i]) step.joints[i] = before[i];
  }
  remember(std::move(step));
  return true;
}

void SceneEdits::remember(Step step) {
  constexpr std::size_t kMost = 100;
  constexpr std::chrono::seconds kPause(1);  // a longer one separates edits of the same joint or frame
  if (step.joints.empty() && step.frames.empty()) return;
  redo_.clear();
  if (!undo_.empty() && step.edited.second >= 0 && undo_.back().edited == step.edited &&
      step.time - undo_.back().time < kPause) {
    Step& last = undo_.back();  // keeps the older values
    last.joints.merge(step.joints);
    last.frames.merge(step.frames);
    last.time = step.time;
    return;
  }
  undo_.push_back(std::move(step));
  if (undo_.size() > kMost) undo_.pop_front();
}

bool SceneEdits::restore(std::deque<Step>& from, std::deque<Step>& to) {
  if (from.empty()) return false;
  const Step step = std::move(from.back());
  from.pop_back();
  const VectorXd q = edited_->getJointState();
  Step inverse{{}, {}, {-1, -1}, {}};
  for (const auto& [id, pose] : step.frames) {
    inverse.frames[id] = edited_->getFrame(id).data().relativePose();
    place(*edited_, id, pose);
    frames_[id] = pose;
  }
  for (const auto& [joint, value] : step.joints) {
    inverse.joints[joint] = q[joint];
    setJoint(joint, value);
  }
  to.push_back(std::move(inverse));
  return true;
}

void SceneEdits::setJoint(int joint, double value) {
  const KinematicModel& program = *edited_->model();
  VectorXd q = edited_->getJointState();
  q[joint] = joints_[joint] = std::clamp(value, program.lower[joint], program.upper[joint]);
  edited_->setJointState(q);
}

void SceneEdits::setAllJoints(const VectorXd& q) {
  edited_->setJointState(q);
  for (int i = 0; i < q.size(); ++i) joints_[i] = q[i];
}

/// Moves a frame. A frame with a joint takes the nearest reachable pose: then joint values change, and no pose.
bool SceneEdits::moveFrame(int id, const std::vector<double>& numbers) {
  constexpr double kFar = 1e6;  // m: positions beyond are rejected
  if (id < 0 || id >= edited_->getFrameDimension() || numbers.size() != 7) return false;
  const Eigen::Map<const Vector7d> pose(numbers.data());
  if (pose.cwiseAbs().maxCoeff() > kFar || pose.tail<4>().norm() < 1e-3) return false;
  Frame frame = edited_->getFrame(id);
  const VectorXd before = edited_->getJointState();
  frame.setPose(Pose::fromNumbers(pose));
  const VectorXd after = edited_->getJointState();
  for (int i = 0; i < after.size(); ++i) {
    if (after[i] != before[i]) setJoint(i, after[i]);
  }
  if (!frame.data().moves() || !frame.data().joint->active) frames_[id] = frame.data().relativePose();
  return true;
}

}  // namespace kinegraph::inline viewer_internal
