#include <algorithm>
#include <limits>
#include <set>

#include "kinegraph/scene/scene_tree.h"

namespace kinegraph {

namespace {

/// Is this frame moved by a joint whose dofs are in q?
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

/// Numbers the dofs in the order of the frame list and collects what belongs to each.
void compileDofs(const SceneTree& scene, Program& program) {
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<double> lower, upper, home, weight;
  program.frame_dofs.resize(scene.frames().size());
  for (const auto& frame : scene.frames()) {
    if (!isLinkFrame(*frame) || frame->joint->mimic) continue;
    const Joint& joint = *frame->joint;
    program.frame_dofs[frame->id] = {program.dofs, joint.dofs()};
    for (int i = 0; i < joint.dofs(); ++i) {
      const bool limited = joint.lower.size() > 0 && joint.lower[i] <= joint.upper[i];
      lower.push_back(limited ? joint.lower[i] : -inf);
      upper.push_back(limited ? joint.upper[i] : inf);
      home.push_back(joint.home[i]);
      weight.push_back(joint.control_weight);
    }
    int first = program.dofs;
    for (const MotionStep& step : joint.steps) {
      if (step.dofs() > 1) program.unit_norms.push_back({first, step.dofs()});
      first += step.dofs();
    }
    program.dofs += joint.dofs();
  }
  for (const auto& frame : scene.frames()) {
    if (isLinkFrame(*frame)) program.frame_dofs[frame->id] = program.frame_dofs[dofSource(*frame).id];
  }
  const auto vector = [](const std::vector<double>& values) {
    return VectorXd(Eigen::Map<const VectorXd>(values.data(), Eigen::Index(values.size())));
  };
  program.lower = vector(lower);
  program.upper = vector(upper);
  program.home = vector(home);
  program.control_weight = vector(weight);
}

}  // namespace

std::shared_ptr<const Program> compileProgram(const SceneTree& scene) {
  auto program = std::make_shared<Program>();
  const std::size_t count = scene.frames().size();
  compileDofs(scene, *program);
  program->links.push_back({});
  nameFrames(*program, scene.names());
  program->frame_link.resize(count);
  for (const FrameData* frame : topologicalOrder(scene)) {
    const int parent_link = frame->parent ? program->frame_link[frame->parent->id] : 0;
    program->frame_link[frame->id] = parent_link;
    if (!isLinkFrame(*frame)) continue;
    Program::Link link;
    link.parent = parent_link;
    link.frame = frame->id;
    link.first_step = int(program->steps.size());
    link.steps = int(frame->joint->steps.size());
    link.dof = program->frame_dofs[frame->id].first;
    link.scale = motionScale(*frame);
    link.axis = frame->joint->axis;
    program->steps.insert(program->steps.end(), frame->joint->steps.begin(), frame->joint->steps.end());
    program->frame_link[frame->id] = int(program->links.size());
    program->links.push_back(link);
  }
  connectChains(*program);
  program->geometry.resize(count);
  program->body.resize(count);
  for (const auto& frame : scene.frames()) {
    if (!frame->shape) continue;
    program->geometry[frame->id] = frame->shape->geometry;
    program->body[frame->id] = frame->shape->body();
  }
  program->collidable = collidablePairs(scene);
  return program;
}

std::shared_ptr<const Parameters> collectParameters(const SceneTree& scene, const Program& program) {
  auto parameters = std::make_shared<Parameters>();
  parameters->joint_base.resize(program.links.size());
  parameters->frame_offset.resize(scene.frames().size());
  parameters->frame_mass.resize(scene.frames().size());
  for (const FrameData* frame : topologicalOrder(scene)) {
    const RigidTransform base = frame->parent ? parameters->frame_offset[frame->parent->id] : RigidTransform{};
    if (isLinkFrame(*frame)) {
      parameters->joint_base[program.frame_link[frame->id]] = base;
    } else {
      parameters->frame_offset[frame->id] = base * frame->relativePose().transform();
    }
    if (frame->inertia) parameters->frame_mass[frame->id] = {frame->inertia->mass, frame->inertia->com};
  }
  return parameters;
}

std::vector<LinkInertia> collectInertias(const SceneTree& scene, const Program& program, const Parameters& parameters) {
  std::vector<LinkInertia> links(program.links.size());
  for (const auto& frame : scene.frames()) {
    if (!frame->inertia) continue;
    links[program.frame_link[frame->id]].add({frame->inertia->mass, frame->inertia->com, frame->inertia->matrix},
                                             parameters.frame_offset[frame->id]);
  }
  return links;
}

namespace {

const FrameData* linkFrame(const FrameData* frame) {
  while (!frame->joint && frame->parent) frame = frame->parent;
  return frame;
}

/// Does the contact flag of A's frame exclude contacts with B's link, an ancestor that is few joints away?
bool excludedByFlag(const FrameData* link_a, int contact_a, const FrameData* link_b) {
  int left = -contact_a;
  for (const FrameData* frame = link_a->parent; frame; frame = frame->parent) {
    if (frame->joint && --left < 0) return false;
    if (frame == link_b) return true;
  }
  return false;
}

/// Pairs of frames whose shapes are told not to collide.
class ExcludedContacts {
 public:
  explicit ExcludedContacts(const SceneTree& scene) {
    for (const auto& frame : scene.frames()) {
      for (const FrameData* other : frame->no_contact) pairs_.insert(std::minmax<const FrameData*>(frame.get(), other));
    }
  }

  /// A shape belongs to its frame, and to that one's parent if it is fixed to it.
  bool contains(const FrameData& a, const FrameData& b) const {
    if (pairs_.empty()) return false;
    for (const FrameData* x : {&a, ownerOf(a)}) {
      for (const FrameData* y : {&b, ownerOf(b)}) {
        if (pairs_.contains(std::minmax(x, y))) return true;
      }
    }
    return false;
  }

 private:
  static const FrameData* ownerOf(const FrameData& frame) {
    return frame.parent && !frame.joint ? frame.parent : &frame;
  }

  std::set<std::pair<const FrameData*, const FrameData*>> pairs_;
};

}  // namespace

std::vector<std::pair<int, int>> collidablePairs(const SceneTree& scene) {
  const ExcludedContacts excluded(scene);
  struct Candidate {
    const FrameData* frame;
    const FrameData* link;
    int contact;
  };
  std::vector<Candidate> candidates;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || frame->shape->contact == 0) continue;
    const ShapeType type = frame->shape->geometry->type;
    if (type == ShapeType::marker || type == ShapeType::camera) continue;
    candidates.push_back({frame.get(), linkFrame(frame.get()), frame->shape->contact});
  }
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (std::size_t j = i + 1; j < candidates.size(); ++j) {
      const Candidate &a = candidates[i], &b = candidates[j];
      if (a.link == b.link) continue;
      if (a.contact < 0 && excludedByFlag(a.link, a.contact, b.link)) continue;
      if (b.contact < 0 && excludedByFlag(b.link, b.contact, a.link)) continue;
      if (excluded.contains(*a.frame, *b.frame)) continue;
      pairs.emplace_back(a.frame->id, b.frame->id);
    }
  }
  return pairs;
}

}  // namespace kinegraph
