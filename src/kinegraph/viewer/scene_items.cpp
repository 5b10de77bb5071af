#include "kinegraph/viewer/scene_items.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/gfile/writer.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline viewer_internal {

namespace {

/// Returns the unit of each dof of a joint.
std::vector<std::string> unitsOf(const Joint& joint) {
  std::vector<std::string> units;
  for (const MotionStep& step : joint.steps) {
    const char* unit = step.rotates() ? "rad" : step.translates() ? "m" : "";
    units.insert(units.end(), std::size_t(step.dofs()), unit);
  }
  return units;
}

/// Returns whether a frame's details depend on other frames.
bool refersToOthers(const FrameData& frame) { return frame.joint || !frame.no_contact.empty(); }

/// Returns how a frame's dofs move it; without steps if they do not.
MovingItem movingOf(const FrameData& frame, int dof) {
  MovingItem moving{frame.id, dof, motionScale(frame), {}, {}};
  for (const MotionStep& step : frame.joint->steps) {
    const bool is_axial = step.rotates() || step.translates();
    moving.steps.push_back(step.rotates()                              ? "turn"
                           : step.translates()                         ? "shift"
                           : step.kind == MotionStep::Kind::quaternion ? "quaternion"
                           : step.kind == MotionStep::Kind::circle     ? "circle"
                                                                       : "time");
    const Vector3d axis = is_axial ? Vector3d(step.sign * step.direction(frame.joint->axis)) : Vector3d::Zero();
    moving.axes.insert(moving.axes.end(), axis.begin(), axis.end());
  }
  return moving;
}

ShownJoints jointsOf(const Config& config) {
  const auto program = config.model();
  const std::vector<std::string> names = config.getJointNames();
  const MatrixXd limits = config.getJointLimits();
  std::vector<ShownJoint> joints(names.size());
  std::vector<MovingItem> moving;
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->joint) continue;
    const KinematicModel::DofRange dofs = program->frame_dofs[frame->id];
    if (dofs.count > 0) moving.push_back(movingOf(*frame, dofs.first));
    if (frame->joint->mimic) continue;
    const std::vector<std::string> units = unitsOf(*frame->joint);
    for (int i = 0; i < dofs.count; ++i) {
      const int dof = dofs.first + i;
      const bool limited = limits.col(dof).allFinite();  // the page has no infinities: 0 and -1
      joints[dof] = {names[dof], frame->id, units[i], limited ? limits(0, dof) : 0., limited ? limits(1, dof) : -1.};
    }
  }
  return {std::move(joints), std::move(moving)};
}

}  // namespace

std::string detailsOf(const FrameData& frame) {
  constexpr std::size_t kLongest = 40;
  Graph graph = describeFrame(frame);
  for (const char* key : {"pose", "q"}) graph.erase(key);
  std::erase_if(graph.nodes, [](const Node& node) {
    const auto* numbers = node.value.as<NumberArray>();
    const auto* entries = node.value.as<Graph>();
    return (numbers && numbers->numbers.size() > kLongest) || (entries && entries->nodes.empty());
  });
  return writeEntries(graph);
}

std::vector<Pose> posesOf(const Config& config) {
  const State& state = config.state();
  std::vector<Pose> poses;
  for (int i = 0; i < config.getFrameDimension(); ++i) poses.push_back(Pose(state.pose(i)));
  return poses;
}

bool SceneItems::SentFrame::knows(const FrameData& frame) const {
  const auto same_numbers = [](const Inertia& a, const Inertia& b) {
    return a.mass == b.mass && a.com == b.com && a.matrix == b.matrix;
  };
  if (&*attributes != &*frame.attributes || inertia.has_value() != frame.inertia.has_value()) return false;
  if (inertia && !same_numbers(*inertia, *frame.inertia)) return false;
  if (!frame.shape) return !geometry;
  return shape.lock() == frame.shape && geometry == frame.shape->geometry && shape_revision == frame.shape->revision &&
         contact == frame.shape->contact;
}

void SceneItems::SentFrame::remember(const FrameData& frame) {
  refers_to_others = refersToOthers(frame);
  attributes = frame.attributes;
  inertia = frame.inertia;
  shape = frame.shape;
  geometry = frame.shape ? frame.shape->geometry : nullptr;
  shape_revision = frame.shape ? frame.shape->revision : 0;
  contact = frame.shape ? frame.shape->contact : 0;
}

/// Returns whether a frame's details are unchanged. Most frames of a scene under construction are, and writing all
/// details again would take most of the time.
bool SceneItems::isUnchanged(const FrameData& frame, bool same_structure) const {
  const SentFrame& sent = sent_[std::size_t(frame.id)];
  const bool refers = sent.refers_to_others || refersToOthers(frame);
  return (same_structure || !refers) && sent.knows(frame);
}

bool SceneItems::isOf(const Config& config) const {
  return scene_.lock() == config.scene() && scene_structure_ == config.scene()->structureRevision();
}

void SceneItems::read(const Config& config) {
  const bool same = structure_ > 0 && isOf(config);
  const auto& frames = config.scene()->frames();
  const State& state = config.state();
  if (!same) {
    scene_ = config.scene();
    scene_structure_ = config.scene()->structureRevision();
    ++structure_;
    joints_ = jointsOf(config);
    items_.resize(frames.size());
    sent_.resize(frames.size());
  }
  poses_.resize(frames.size());
  changed_.clear();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameData& frame = *frames[i];
    ViewItem& item = items_[i];
    const RigidTransform pose = state.pose(int(i));
    const int parent = frame.parent ? frame.parent->id : -1;
    const bool rests = same && pose.p == poses_[i].p && pose.R == poses_[i].R;
    const bool unchanged = isUnchanged(frame, same);
    if (rests && unchanged && item.parent == parent && item.name == frame.name) continue;
    changed_.push_back(int(i));
    item.name = frame.name;
    item.parent = parent;
    item.pose = Pose(pose);
    poses_[i] = pose;
    if (unchanged) continue;
    sent_[i].remember(frame);
    item.details = detailsOf(frame);
    item.geometry = nullptr;
    if (!frame.shape) continue;
    const std::shared_ptr<const Geometry> visual = visual_meshes_.of(*frame.shape);
    item.geometry = visual ? visual : frame.shape->geometry;
    item.collides = frame.shape->contact != 0;
    item.color = frame.shape->color.value_or(Vector4d(.8, .8, .8, 1.));
  }
}

}  // namespace kinegraph::inline viewer_internal
