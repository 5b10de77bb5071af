#include "kinegraph/simulation/scene_bodies.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/inertia_edits.h"

namespace kinegraph {

namespace {

using Kind = SceneBody::Kind;

bool isRigidLink(const FrameData& frame) {
  return !frame.parent || (frame.joint && frame.joint->type == JointType::rigid);
}

bool isFree(const FrameData& frame) { return frame.joint && frame.joint->type == JointType::free; }

/// Calls `visit` for a frame and everything rigidly attached to it; returns whether a joint with dofs follows below.
template <class Visit>
bool forLink(const FrameData& frame, const Visit& visit) {
  visit(frame);
  bool carries = false;
  for (const FrameData* child : frame.children) {
    if (child->joint) {
      carries |= child->moves() && !isFree(*child);
    } else {
      carries |= forLink(*child, visit);
    }
  }
  return carries;
}

/// Returns whether a link without a joint is a free object: its root frame has a mass, or all of its shapes have one.
bool isLoose(const FrameData& root, std::vector<std::string>& warnings) {
  bool weighs = false, all_weigh = true;
  std::string heavy, massless;
  const bool carries = forLink(root, [&](const FrameData& frame) {
    if (frame.inertia && frame.inertia->mass > 0.) {
      weighs = true;
      if (heavy.empty()) heavy = frame.name;
    } else if (takesPart(frame)) {
      all_weigh = false;
      massless = frame.name;
    }
  });
  if (carries || !weighs) return false;
  if (all_weigh || root.inertia) return true;
  warnings.push_back(
      cat("Simulation: frame '", heavy, "' has a mass, but is rigidly attached to '", root.name, "' like '", massless,
          "', which has no mass: the object does not move. Give it a joint of type rigid to let it fall"));
  return false;
}

void checkInertia(const FrameData& frame) {
  const Inertia& inertia = *frame.inertia;
  if (!(inertia.mass >= 0.) || !std::isfinite(inertia.mass))
    throw ValueError(
        cat("Simulation: frame '", frame.name, "' has a mass of ", inertia.mass, " kg; expected a finite number >= 0"));
  if (!inertia.com.allFinite() || !inertia.matrix.allFinite())
    throw ValueError(cat("Simulation: frame '", frame.name, "' has a center of mass or an inertia that is not finite"));
  if (inertia.matrix.diagonal().minCoeff() < 0.)
    throw ValueError(cat("Simulation: frame '", frame.name,
                         "' has an inertia with a negative diagonal: ", inertia.matrix.diagonal().transpose()));
}

/// Warns of an inertia that no body has: a principal moment larger than the sum of the other two.
void warnOfImpossibleInertia(const FrameData& frame, std::vector<std::string>& warnings) {
  const Vector3d moments = frame.inertia->matrix.selfadjointView<Eigen::Lower>().eigenvalues();
  if (2. * moments.maxCoeff() > 1.001 * moments.sum())
    warnings.push_back(
        cat("Simulation: frame '", frame.name, "' has principal moments of inertia ", moments.transpose(),
            ", which are impossible: one exceeds the sum of the other two. Their mean is used for all three"));
}

LinkInertia surfaceInertia(const Geometry& geometry, double mass) {
  const ShellMass shell = shellMass(geometry);
  return {mass < 0. ? kSurfaceDensity * shell.area : mass, shell.com, shell.inertia_per_mass};
}

class Divider {
 public:
  Divider(const SceneTree& scene, const std::set<int>& measured) : scene_(scene), measured_(measured) {
    result_.bodies.emplace_back();
    result_.frames.resize(scene.frames().size());
  }

  SceneBodies divide() {
    for (const auto& frame : scene_.frames()) {
      if (!frame->parent) visit(*frame, {});
    }
    for (const auto& frame : scene_.frames()) addMass(*frame);
    for (std::size_t b = 1; b < result_.bodies.size(); ++b) completeMass(int(b));
    return std::move(result_);
  }

 private:
  struct Robot {
    int number = -1;
    bool has_gravity = true;
  };

  void visit(const FrameData& frame, const Robot& above) {
    const PlacedFrame parent = frame.parent ? result_.frames[std::size_t(frame.parent->id)] : PlacedFrame{};
    Robot robot = above;
    const bool begins = attributeFlag(frame, "multibody", false);
    if (begins) robot = {result_.robots++, attributeFlag(frame, "multibody_gravity", false)};
    if (frame.moves() && !isFree(frame)) {
      if (robot.number < 0) robot.number = result_.robots++;
      place(frame, parent, Kind::jointed, robot);
    } else if (isFree(frame) || isLooseLink(frame, parent, begins, robot)) {
      if (!begins) robot = {};
      place(frame, {}, Kind::free, robot);
    } else {
      fix(frame, parent, robot);
    }
    for (const FrameData* child : frame.children) visit(*child, robot);
  }

  bool isLooseLink(const FrameData& frame, const PlacedFrame& parent, bool begins, const Robot& robot) {
    if (!isRigidLink(frame)) return begins && !attributeFlag(frame, "multibody_fixedBase", true);
    if (begins) return !attributeFlag(frame, "multibody_fixedBase", true);
    const Kind on = result_.bodies[std::size_t(parent.body)].kind;
    return robot.number < 0 && (on == Kind::world || on == Kind::free) && isLoose(frame, result_.warnings);
  }

  void place(const FrameData& frame, const PlacedFrame& parent, Kind kind, const Robot& robot) {
    SceneBody body;
    body.kind = kind;
    body.frame = &frame;
    body.parent = kind == Kind::free ? 0 : parent.body;
    body.X_PB = kind == Kind::free ? frame.worldPose() : parent.X_BF;
    body.robot = robot.number;
    body.has_gravity = robot.has_gravity;
    result_.frames[std::size_t(frame.id)] = {int(result_.bodies.size()), Pose{}, robot.number};
    result_.bodies.push_back(body);
  }

  void fix(const FrameData& frame, const PlacedFrame& parent, const Robot& robot) {
    const Pose X_BF = parent.X_BF * frame.relativePose();
    if (!measured_.contains(frame.id)) {
      result_.frames[std::size_t(frame.id)] = {parent.body, X_BF, robot.number};
      return;
    }
    place(frame, {parent.body, X_BF, robot.number}, Kind::fixed, robot);
  }

  void addMass(const FrameData& frame) {
    if (!frame.inertia) return;
    checkInertia(frame);
    warnOfImpossibleInertia(frame, result_.warnings);
    const PlacedFrame& placed = result_.frames[std::size_t(frame.id)];
    LinkInertia part{frame.inertia->mass, frame.inertia->com, frame.inertia->matrix};
    if (part.matrix.isZero() && frame.shape && shapeKind(frame.shape->geometry->type).has_inertia)
      part = surfaceInertia(*frame.shape->geometry, part.mass);
    result_.bodies[std::size_t(placed.body)].inertia.add(part, placed.X_BF.transform());
  }

  /// Computes the inertia of a moving body without mass from its surfaces.
  void completeMass(int number) {
    SceneBody& body = result_.bodies[std::size_t(number)];
    if (body.inertia.mass > 0.) return;
    for (const auto& frame : scene_.frames()) {
      const PlacedFrame& placed = result_.frames[std::size_t(frame->id)];
      if (placed.body != number || !frame->shape || !takesPart(*frame)) continue;
      if (!shapeKind(frame->shape->geometry->type).has_inertia) continue;
      body.inertia.add(surfaceInertia(*frame->shape->geometry, -1.), placed.X_BF.transform());
    }
  }

  const SceneTree& scene_;
  const std::set<int>& measured_;
  SceneBodies result_;
};

}  // namespace

bool attributeFlag(const FrameData& frame, const char* key, bool otherwise) {
  const Node* node = frame.attributes->find(key);
  if (!node) return otherwise;
  if (const bool* flag = node->value.as<bool>()) return *flag;
  if (const double* number = node->value.as<double>()) return *number != 0.;
  throw ValueError(cat("Simulation: frame '", frame.name, "': attribute ", key, " is ", describe(node->value),
                       "; expected true or false"));
}

double attributeNumber(const FrameData& frame, const char* key, double otherwise) {
  const Node* node = frame.attributes->find(key);
  if (!node) return otherwise;
  const double* number = node->value.as<double>();
  if (!number || !std::isfinite(*number))
    throw ValueError(cat("Simulation: frame '", frame.name, "': attribute ", key, " is ", describe(node->value),
                         "; expected a finite number"));
  return *number;
}

bool takesPart(const FrameData& frame) {
  if (!frame.shape) return false;
  const Shape& shape = *frame.shape;
  const ShapeKind& kind = shapeKind(shape.geometry->type);
  if (!kind.has_inertia) return false;
  if (kind.hasPoints() && (!shape.geometry->mesh || shape.geometry->mesh->vertices.empty())) return false;
  return attributeFlag(frame, "simulate", !shape.color || (*shape.color)[3] >= 1.);
}

SceneBodies divideScene(const SceneTree& scene, const std::set<int>& measured) {
  return Divider(scene, measured).divide();
}

}  // namespace kinegraph
