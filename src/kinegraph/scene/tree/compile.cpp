#include <algorithm>
#include <limits>
#include <utility>

#include "kinegraph/common/parallel.h"
#include "kinegraph/geometry/distance/shared_body.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr std::size_t kLargeMesh = 2000;  ///< vertices: the hull takes about a millisecond
constexpr int kHullThreads = 8;

/// Builds the bodies of large meshes that have none yet, on several threads: a robot may have a hundred.
void buildLargeBodies(const SceneTree& scene) {
  std::vector<const Shape*> large;
  for (const auto& frame : scene.frames()) {
    const Geometry* geometry = frame->shape ? frame->shape->geometry.get() : nullptr;
    if (geometry && geometry->mesh && geometry->mesh->vertices.size() >= kLargeMesh && !hasSharedBody(*geometry))
      large.push_back(&*frame->shape);
  }
  if (large.size() < 2) return;
  parallelFor(int(large.size()), 1, kHullThreads, [&](int, int from, int to) {
    for (int i = from; i < to; ++i) large[std::size_t(i)]->body();
  });
}

/// Returns whether the frame has a joint with dofs in q.
bool isLinkFrame(const FrameData& frame) { return frame.moves() && dofSource(frame).joint->active; }

/// All frames, parents before children.
std::vector<const FrameData*> topologicalOrder(const SceneTree& scene) {
  std::vector<const FrameData*> order;
  order.reserve(scene.frames().size());
  for (const auto& frame : scene.frames()) {
    if (!frame->parent) order.push_back(frame.get());
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    order.insert(order.end(), order[i]->children.begin(), order[i]->children.end());
  }
  return order;
}

/// Numbers the dofs in frame order and collects their limits, homes and weights.
void compileDofs(const SceneTree& scene, KinematicModel& model) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<double> lower, upper, home, weight;
  model.frame_dofs.resize(scene.frames().size());
  for (const auto& frame : scene.frames()) {
    if (!isLinkFrame(*frame) || frame->joint->mimic) continue;
    const Joint& joint = *frame->joint;
    model.frame_dofs[frame->id] = {model.dofs, joint.dofs()};
    for (int i = 0; i < joint.dofs(); ++i) {
      const bool limited = joint.lower.size() > 0 && joint.lower[i] <= joint.upper[i];
      lower.push_back(limited ? joint.lower[i] : -inf);
      upper.push_back(limited ? joint.upper[i] : inf);
      home.push_back(joint.home[i]);
      weight.push_back(joint.control_weight);
    }
    int first = model.dofs;
    for (const MotionStep& step : joint.steps) {
      if (step.orients()) model.unit_norms.push_back({first, step.dofs()});
      first += step.dofs();
    }
    model.dofs += joint.dofs();
  }
  for (const auto& frame : scene.frames()) {
    if (isLinkFrame(*frame)) model.frame_dofs[frame->id] = model.frame_dofs[dofSource(*frame).id];
  }
  const auto vector = [](const std::vector<double>& values) {
    return VectorXd(Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size())));
  };
  model.lower = vector(lower);
  model.upper = vector(upper);
  model.home = vector(home);
  model.control_weight = vector(weight);
}

}  // namespace

std::shared_ptr<const KinematicModel> compileModel(const SceneTree& scene) {
  auto model = std::make_shared<KinematicModel>();
  const std::size_t count = scene.frames().size();
  compileDofs(scene, *model);
  model->links.push_back({});
  nameFrames(*model, scene.names());
  model->frame_link.resize(count);
  for (const FrameData* frame : topologicalOrder(scene)) {
    const int parent_link = frame->parent ? model->frame_link[frame->parent->id] : 0;
    model->frame_link[frame->id] = parent_link;
    if (!isLinkFrame(*frame)) continue;
    KinematicModel::Link link;
    link.parent = parent_link;
    link.frame = frame->id;
    link.first_step = int(model->steps.size());
    link.steps = int(frame->joint->steps.size());
    link.dof = model->frame_dofs[frame->id].first;
    link.scale = motionScale(*frame);
    link.axis = frame->joint->axis;
    model->steps.insert(model->steps.end(), frame->joint->steps.begin(), frame->joint->steps.end());
    model->frame_link[frame->id] = int(model->links.size());
    model->links.push_back(link);
  }
  connectChains(*model);
  model->geometry.resize(count);
  model->body.resize(count);
  buildLargeBodies(scene);
  for (const auto& frame : scene.frames()) {
    if (!frame->shape) continue;
    model->geometry[frame->id] = frame->shape->geometry;
    model->body[frame->id] = frame->shape->body();
  }
  model->contacts = contactRules(scene);
  return model;
}

namespace {

/// Computes the frame's offset in its link; the parent must be placed already.
RigidTransform placeInLink(const FrameData& frame, const KinematicModel& model, Parameters& parameters) {
  const RigidTransform base = frame.parent ? parameters.frame_offset[frame.parent->id] : RigidTransform{};
  if (isLinkFrame(frame)) return placeJoint(model, model.frame_link[frame.id], base, parameters);
  return base * frame.relativePose().transform();
}

}  // namespace

void updateParameters(const FrameData& frame, const KinematicModel& model, Parameters& parameters) {
  RigidTransform& offset = parameters.frame_offset[frame.id];
  const RigidTransform before = std::exchange(offset, placeInLink(frame, model, parameters));
  if (isLinkFrame(frame) && offset.R == before.R) return;  // frames below are relative to the unchanged link
  for (const FrameData* child : frame.children) updateParameters(*child, model, parameters);
}

std::shared_ptr<const Parameters> collectParameters(const SceneTree& scene, const KinematicModel& model) {
  auto parameters = std::make_shared<Parameters>(emptyParameters(model));
  for (const FrameData* frame : topologicalOrder(scene)) {
    parameters->frame_offset[frame->id] = placeInLink(*frame, model, *parameters);
    if (frame->inertia) parameters->frame_mass[frame->id] = {frame->inertia->mass, frame->inertia->com};
  }
  return parameters;
}

std::vector<LinkInertia> collectInertias(const SceneTree& scene, const KinematicModel& model,
                                         const Parameters& parameters) {
  std::vector<LinkInertia> links(model.links.size());
  for (const auto& frame : scene.frames()) {
    if (!frame->inertia) continue;
    links[model.frame_link[frame->id]].add({frame->inertia->mass, frame->inertia->com, frame->inertia->matrix},
                                           parameters.frame_offset[frame->id]);
  }
  return links;
}

namespace {

/// Whether a frame is the base of a robot.
bool isRobotBase(const FrameData& frame) {
  const Node* node = frame.attributes->find("multibody");
  if (!node) return false;
  if (const double* number = node->value.as<double>()) return *number != 0.;
  const bool* flag = node->value.as<bool>();
  return flag && *flag;
}

bool takesPart(const FrameData& frame) {
  return frame.shape && frame.shape->contact != 0 && !shapeKind(frame.shape->geometry->type).is_symbol;
}

/// The frames without joints on which robots and other things stand, each for itself: a root `world`, and the body to
/// which the base of a robot (`multibody`) is attached, with all above it, if they are fixed.
std::vector<char> groundFrames(const SceneTree& scene) {
  const auto isFixed = [](const FrameData& frame) { return !frame.joint; };
  std::vector<char> grounds(scene.frames().size(), 0), robots(scene.frames().size(), 0);
  for (const FrameData* frame : topologicalOrder(scene)) {
    const bool is_base = isRobotBase(*frame);
    robots[frame->id] = is_base || (frame->parent && robots[frame->parent->id]);
    if (!frame->parent) grounds[frame->id] = isFixed(*frame) && frame->name == "world";
    if (!is_base || !frame->parent || robots[frame->parent->id]) continue;
    std::vector<const FrameData*> above;
    for (const FrameData* base = frame->parent; base && isFixed(*base); base = base->parent) above.push_back(base);
    if (above.empty() || above.back()->parent) continue;  // it stands on something that moves
    if (!takesPart(*above.front())) continue;             // what it stands on is beside it
    for (const FrameData* ground : above) grounds[ground->id] = 1;
  }
  return grounds;
}

/// The nearest frame at or above with a joint, the root, or one fixed to the ground: `frame` is rigidly fixed to it.
const FrameData* partFrame(const FrameData* frame, const std::vector<char>& grounds) {
  while (!frame->joint && frame->parent && !grounds[frame->parent->id]) frame = frame->parent;
  return frame;
}

/// Excludes what never moves against each other: links of a robot that stand still, within `contact: -k` joints, and
/// what is fixed to the ground.
void excludeStandingLinks(const SceneTree& scene, ContactRules& rules) {
  const auto rootOf = [](const FrameData* frame) {
    while (frame->parent) frame = frame->parent;
    return frame;
  };
  for (const ContactRules::Body& a : rules.bodies) {
    int joints = 0;
    bool is_still = true;
    const FrameData* link = scene.frames()[std::size_t(a.frame)].get();
    for (const FrameData* frame = link; frame; frame = frame->parent) {
      joints += frame->joint.has_value();
      is_still = is_still && !frame->moves();
    }
    if (!is_still || joints == 0 || joints > -a.flag) continue;
    for (const ContactRules::Body& b : rules.bodies) {
      if (rules.parts[std::size_t(b.part)].jointed) continue;
      if (rootOf(scene.frames()[std::size_t(b.frame)].get()) == rootOf(link))
        rules.excluded.push_back(std::minmax(a.frame, b.frame));
    }
  }
}

}  // namespace

ContactRules contactRules(const SceneTree& scene) {
  ContactRules rules;
  const std::vector<char> grounds = groundFrames(scene);
  const auto partOf = [&](const FrameData* frame) { return partFrame(frame, grounds); };
  std::vector<int> part_of(scene.frames().size(), -1);  // per frame, for the first frame of each part
  for (const auto& frame : scene.frames()) {
    if (partOf(frame.get()) != frame.get()) continue;
    part_of[frame->id] = int(rules.parts.size());
    rules.parts.push_back({-1, frame->joint.has_value()});
  }
  for (const auto& frame : scene.frames()) {
    if (part_of[frame->id] >= 0 && frame->parent)
      rules.parts[part_of[frame->id]].parent = part_of[partOf(frame->parent)->id];
    for (const FrameData* other : frame->no_contact) rules.excluded.push_back(std::minmax(frame->id, other->id));
    if (!takesPart(*frame)) continue;
    const int owner =
        frame->parent && !frame->joint ? frame->parent->id : frame->id;  // a fixed shape belongs to its parent
    rules.bodies.push_back({frame->id, part_of[partOf(frame.get())->id], frame->shape->contact, owner});
  }
  excludeStandingLinks(scene, rules);
  std::sort(rules.excluded.begin(), rules.excluded.end());
  return rules;
}

}  // namespace kinegraph::inline scene_internal
