#include "kinegraph/scene/tree/scene_tree.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <unordered_map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/frame_cycle.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr auto kAdopted = std::numeric_limits<std::uint64_t>::max();  // revision of a model adopted from an equal scene

/// Returns whether the dofs of the frame's joint are entries of q.
bool isDofFrame(const FrameData& frame) { return frame.moves() && frame.joint->active && !frame.joint->mimic; }

}  // namespace

SceneTree::~SceneTree() { clear(); }

FrameData& SceneTree::add(std::string name, FrameData* parent) {
  auto frame = std::make_shared<FrameData>();
  frame->name = std::move(name);
  frame->id = int(frames_.size());
  frame->tree = this;
  frames_.push_back(frame);
  if (names_.ready()) names_.append(*frame);
  if (parent) link(*frame, *parent);
  structureChanged();
  return *frame;
}

void SceneTree::remove(FrameData& frame) {
  for (FrameData* child : std::vector<FrameData*>(frame.children)) {
    const Pose X = child->worldPose();
    unlink(*child);
    child->joint.reset();
    child->pose = X;
  }
  if (frame.parent) unlink(frame);
  for (const auto& other : frames_) {
    if (!other->joint || other->joint->mimic != &frame) continue;
    other->joint->q = dofSource(frame).joint ? dofSource(frame).joint->q : other->joint->home;
    other->joint->mimic = nullptr;
  }
  for (const auto& other : frames_) std::erase(other->no_contact, &frame);
  const auto place = frames_.begin() + frame.id;
  frame.tree = nullptr;
  for (auto later = place + 1; later != frames_.end(); ++later) --(*later)->id;
  frames_.erase(place);
  names_.forget();
  structureChanged();
}

void SceneTree::clear() {
  for (const auto& frame : frames_) {
    frame->tree = nullptr;
    frame->parent = nullptr;
    frame->children.clear();
    frame->no_contact.clear();
    if (frame->joint) frame->joint->mimic = nullptr;
  }
  frames_.clear();
  names_.forget();
  structureChanged();
}

FrameData* SceneTree::find(std::string_view name) const {
  if (names_.ready()) return names_.first(name);
  const auto found =
      std::ranges::find(frames_, name, [](const auto& frame) -> std::string_view { return frame->name; });
  return found == frames_.end() ? nullptr : found->get();
}

FrameData* SceneTree::findLast(std::string_view name) {
  indexNames();
  if (names_.ready()) return names_.last(name);
  for (auto frame = frames_.rbegin(); frame != frames_.rend(); ++frame) {
    if ((*frame)->name == name) return frame->get();
  }
  return nullptr;
}

const SceneTree& SceneTree::indexNames() {
  if (frames_.size() >= kFewFrames && !names_.ready()) names_.build(frames_);
  return *this;
}

void SceneTree::rename(FrameData& frame, std::string name) {
  frame.name = std::move(name);
  names_.forget();
  structureChanged();
}

FrameData& SceneTree::get(std::string_view name, std::string_view who) const {
  if (FrameData* frame = find(name)) return *frame;
  throw FrameNotFound(cat(who, ": frame name '", name, "' doesn't exist", similarHint(name, names())));
}

std::vector<std::string> SceneTree::names() const {
  std::vector<std::string> names;
  for (const auto& frame : frames_) names.push_back(frame->name);
  return names;
}

void SceneTree::link(FrameData& frame, FrameData& parent) {
  for (const FrameData* above = &parent; above; above = above->parent) {
    if (above == &frame) {
      throw FrameCycle(cat("frame '", frame.name, "' cannot be attached to '", parent.name, "', which is ",
                           &frame == &parent ? "the same frame" : "one of its descendants"));
    }
  }
  if (frame.parent) unlink(frame);
  frame.parent = &parent;
  parent.children.push_back(&frame);
  structureChanged();
}

void SceneTree::sortByDepth() {
  const auto depth = [](const std::shared_ptr<FrameData>& frame) {
    int steps = 0;
    for (const FrameData* above = frame->parent; above; above = above->parent) ++steps;
    return steps;
  };
  std::stable_sort(frames_.begin(), frames_.end(), [&](const auto& a, const auto& b) { return depth(a) < depth(b); });
  for (std::size_t i = 0; i < frames_.size(); ++i) frames_[i]->id = int(i);
  names_.forget();
  structureChanged();
}

void SceneTree::unlink(FrameData& frame) {
  std::erase(frame.parent->children, &frame);
  frame.parent = nullptr;
  structureChanged();
}

FrameData* SceneTree::append(const SceneTree& other, const std::string& prefix, bool with_attributes) {
  const std::size_t first = frames_.size(), count = other.frames_.size();
  if (count == 0) return nullptr;
  std::unordered_map<const Shape*, std::shared_ptr<Shape>> shared;
  frames_.reserve(first + count);
  for (std::size_t i = 0; i < count; ++i) {
    const FrameData& original = *other.frames_[i];
    FrameData& copy = add(prefix + original.name, nullptr);
    copy.pose = original.pose;
    copy.joint = original.joint;
    copy.inertia = original.inertia;
    if (with_attributes) copy.attributes = original.attributes;
    if (!original.shape) continue;
    if (original.shape.use_count() > 1) copy.shape = shared[original.shape.get()];
    if (copy.shape) continue;
    copy.shape = std::make_shared<Shape>(*original.shape);
    looksChanged(*copy.shape);
    if (original.shape.use_count() > 1) shared[original.shape.get()] = copy.shape;
  }
  const auto copyOf = [&](const FrameData* original) { return frames_[first + original->id].get(); };
  for (std::size_t i = 0; i < count; ++i) {
    const FrameData& original = *other.frames_[i];
    FrameData& copy = *frames_[first + i];
    if (original.parent) copy.parent = copyOf(original.parent);
    copy.children.reserve(original.children.size());
    for (const FrameData* child : original.children) copy.children.push_back(copyOf(child));
    for (const FrameData* excluded : original.no_contact) copy.no_contact.push_back(copyOf(excluded));
    if (copy.joint && copy.joint->mimic) copy.joint->mimic = copyOf(original.joint->mimic);
  }
  structureChanged();
  if (first == 0 && prefix.empty() && other.model_ && other.compiled_revision_ == other.structure_revision_) {
    model_ = other.model_;  // the scenes are equal
    compiled_revision_ = kAdopted;
    model();
  }
  return frames_[first].get();
}

/// Updates a snapshot after edits that keep the structure: joint states, and everything else that may have changed.
void SceneTree::updateSnapshot(Snapshot& snapshot) const {
  const std::vector<std::shared_ptr<FrameData>>& copies = snapshot.scene->frames_;
  const bool just_dofs = !snapshot.is_stale && compiled_revision_ == structure_revision_;
  if (just_dofs) {
    for (const FrameData* frame : dof_frames_) copies[std::size_t(frame->id)]->joint->q = frame->joint->q;
  }
  for (std::size_t i = 0; i < frames_.size() && !just_dofs; ++i) {
    const FrameData& source = *frames_[i];
    FrameData& copy = *copies[i];
    if (source.joint) copy.joint->q = source.joint->q;
    copy.pose = source.pose;
    copy.inertia = source.inertia;
    if (copy.shape && copy.shape->revision != source.shape->revision) *copy.shape = *source.shape;
  }
  for (int id : snapshot.moved) copies[std::size_t(id)]->pose = frames_[std::size_t(id)]->pose;
  snapshot.moved.clear();
  snapshot.is_stale = false;
  snapshot.scene->posesChanged();
  snapshot.scene->jointsChanged();
}

std::shared_ptr<const SceneTree> SceneTree::snapshot() {
  constexpr std::size_t kKept = 4;
  if (snapshot_revision_ != structure_revision_) snapshots_.clear();
  snapshot_revision_ = structure_revision_;
  for (Snapshot& kept : snapshots_) {
    if (kept.scene.use_count() > 1) continue;
    updateSnapshot(kept);
    return kept.scene;
  }
  const auto copy = std::make_shared<SceneTree>();
  copy->append(*this, {}, false);
  if (snapshots_.size() < kKept) snapshots_.push_back({copy, {}, false});
  return copy;
}

const std::shared_ptr<const KinematicModel>& SceneTree::model() {
  if (compiled_revision_ != structure_revision_) {
    if (compiled_revision_ != kAdopted) model_ = compileModel(*this);
    compiled_revision_ = structure_revision_;
    steps_to_parents_ = 0;
    dof_frames_.clear();
    for (const auto& frame : frames_) {
      if (isDofFrame(*frame)) dof_frames_.push_back(frame.get());
    }
    parameters_.reset();
    previous_parameters_.reset();
    state_.reset();
    near_pairs_.reset();
    q_.resize(model_->dofs);
    poses_stale_ = q_stale_ = true;
  }
  return model_;
}

const std::shared_ptr<const Parameters>& SceneTree::parameters() {
  model();
  if (poses_stale_ || !moved_.empty()) {
    if (poses_stale_) {
      parameters_ = collectParameters(*this, *model_);
      previous_parameters_.reset();
    } else {
      updateMovedParameters();
    }
    moved_.clear();
    inertias_.clear();
    motion_checker_.reset();
    poses_stale_ = false;
    q_stale_ = true;
  }
  return parameters_;
}

/// Reuses the previous parameters if no one else holds them, and updates all frames moved since; copies otherwise.
void SceneTree::updateMovedParameters() {
  std::shared_ptr<Parameters> next = std::move(previous_parameters_);
  if (next && next.use_count() == 1) {
    std::atomic_thread_fence(std::memory_order_acquire);
    for (const FrameData* frame : previous_moved_) updateParameters(*frame, *model_, *next);
  } else {
    next = std::make_shared<Parameters>(*parameters_);
  }
  for (const FrameData* frame : moved_) updateParameters(*frame, *model_, *next);
  previous_parameters_ = std::const_pointer_cast<Parameters>(std::exchange(parameters_, std::move(next)));
  previous_moved_.swap(moved_);
}

const State& SceneTree::state() {
  parameters();
  if (!state_) {
    state_ = std::make_unique<State>(model_, parameters_);
    q_stale_ = true;
  }
  if (q_stale_) {
    gatherJointState(q_.data());
    if (&state_->parameters() != parameters_.get()) state_->replaceParameters(parameters_);
    state_->setJoints(q_.data());
    q_stale_ = false;
    bodies_stale_ = true;
  }
  return *state_;
}

const std::vector<LinkInertia>& SceneTree::inertias() {
  parameters();
  if (inertias_.empty()) inertias_ = collectInertias(*this, *model_, *parameters_);
  return inertias_;
}

NearPairs& SceneTree::nearPairs() {
  const State& now = state();
  if (!near_pairs_) near_pairs_ = std::make_unique<NearPairs>(model_);
  if (bodies_stale_) near_pairs_->place(now);
  bodies_stale_ = false;
  return *near_pairs_;
}

MotionChecker& SceneTree::motionChecker() {
  const State& now = state();
  if (!motion_checker_) motion_checker_ = std::make_unique<MotionChecker>(now);
  return *motion_checker_;
}

Pose SceneTree::worldPose(const FrameData& frame) {
  const bool is_compiled = compiled_revision_ == structure_revision_;
  const bool pays = is_compiled ? queried_since_edit_ : steps_to_parents_ > kCompileSteps * frames_.size();
  return pays ? Pose(state().pose(frame.id)) : poseAlongParents(frame);
}

Pose SceneTree::poseAlongParents(const FrameData& frame) {
  queried_since_edit_ = true;
  for (const FrameData* above = &frame; above; above = above->parent) ++steps_to_parents_;
  return frame.worldPose();
}

void SceneTree::gatherJointState(double* q) const {
  for (const FrameData* frame : dof_frames_) q = std::copy(frame->joint->q.begin(), frame->joint->q.end(), q);
}

VectorXd SceneTree::jointState() {
  if (compiled_revision_ == structure_revision_) {
    VectorXd q(model_->dofs);
    gatherJointState(q.data());
    return q;
  }
  // Between edits of the structure, reading all frames costs a small part of compiling them.
  std::vector<double> values;
  for (const auto& frame : frames_) {
    if (isDofFrame(*frame)) values.insert(values.end(), frame->joint->q.begin(), frame->joint->q.end());
  }
  return Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size()));
}

void SceneTree::setJointState(const double* q) {
  model();
  for (FrameData* frame : dof_frames_) {
    std::copy_n(q, frame->joint->dofs(), frame->joint->q.data());
    q += frame->joint->dofs();
  }
  jointsChanged();
}

}  // namespace kinegraph::inline scene_internal
