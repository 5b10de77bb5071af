#include "kinegraph/simulation/scene_bodies.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/inertia_edits.h"

namespace kinegraph::inline simulation_internal {

namespace {

using Kind = SceneBody::Kind;

constexpr double kBesideJoint = .1;  ///< m: shapes farther from the first joint are no part of its base
constexpr double kInTheAir = .01;    ///< m: a base that is this far from everything hangs in the air

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

bool weighs(const FrameData& frame) { return frame.inertia && frame.inertia->mass > 0.; }

/// Returns whether the frame, or one above it in the same link, has a mass.
bool isWeighed(const FrameData& frame, const FrameData& root) {
  for (const FrameData* f = &frame;; f = f->parent) {
    if (weighs(*f)) return true;
    if (f == &root) return false;
  }
}

/// Returns whether the frame is a world: a root of this name, or one that ends with it after a prefix.
bool isWorld(const FrameData& frame) { return !frame.parent && !frame.shape && frame.name.ends_with("world"); }

bool isOpaque(const Shape& shape) { return !shape.color || (*shape.color)[3] >= 1.; }

/// Returns whether the shape of a frame has a volume that the simulation can represent.
bool hasVolume(const FrameData& frame) {
  const Geometry& geometry = *frame.shape->geometry;
  const ShapeKind& kind = shapeKind(geometry.type);
  if (geometry.type == ShapeType::plane) return true;
  return kind.has_inertia && !(kind.hasPoints() && (!geometry.mesh || geometry.mesh->vertices.empty()));
}

/// Returns whether the shape of a frame is opaque and stands for its object although its `contact` is 0.
bool isSolidToLookAt(const FrameData& frame) {
  return frame.shape->contact == 0 && hasVolume(frame) &&
         attributeFlag(frame, "simulate", isOpaque(*frame.shape) && !attributeFlag(frame, "visual", false));
}

/// Decides which shapes take part in the simulation: those that `simulate` names, those that collide in plans, and
/// opaque ones, unless they have the attribute `visual`. A transparent shape that is drawn
/// around an opaque one of its link with contact 0 leaves its place to that one.
std::vector<bool> collidingFrames(const SceneTree& scene, std::vector<std::string>& warnings) {
  const auto ownerOf = [](const FrameData& f) {  // the frame of the joint that moves it, or else its parent
    const FrameData* link = &f;
    while (link->parent && !link->moves()) link = link->parent;
    return link->moves() ? link->id : f.parent && !f.joint ? f.parent->id : f.id;
  };
  const auto& frames = scene.frames();
  std::vector<std::vector<const FrameData*>> solids(frames.size());  // by owner
  for (const auto& frame : frames) {
    if (frame->shape && isSolidToLookAt(*frame)) solids[std::size_t(ownerOf(*frame))].push_back(frame.get());
  }
  const auto isDrawnAround = [&](const FrameData& frame, const FrameData& solid) {
    const CollisionBody &a = *frame.shape->body(), &b = *solid.shape->body();
    const double reach = a.boundRadius() + b.boundRadius();
    const RigidTransform X_a = frame.worldPose().transform(), X_b = solid.worldPose().transform();
    return (X_a * a.boundCenter() - X_b * b.boundCenter()).norm() < reach;
  };
  std::vector<bool> collide(frames.size(), false);
  std::string flat;
  for (const auto& frame : frames) {
    if (!frame->shape || shapeKind(frame->shape->geometry->type).is_symbol) continue;
    const bool in_plans = frame->shape->contact != 0;
    if (!hasVolume(*frame)) {
      if (in_plans && attributeFlag(*frame, "simulate", true) && flat.empty()) flat = frame->name;
      continue;
    }
    const auto& near = solids[std::size_t(ownerOf(*frame))];
    const bool replaced =
        in_plans && !isOpaque(*frame->shape) &&
        std::any_of(near.begin(), near.end(), [&](const FrameData* solid) { return isDrawnAround(*frame, *solid); });
    collide[std::size_t(frame->id)] = in_plans ? attributeFlag(*frame, "simulate", !replaced) : isSolidToLookAt(*frame);
  }
  if (!flat.empty())
    warnings.push_back(cat("Simulation: frame '", flat,
                           "' has contact, but shapes without a volume (quad, pointCloud, ",
                           "lines) do not collide in the simulation; `simulate: false` silences this warning"));
  return collide;
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
    const std::vector<bool> colliding = collidingFrames(scene_, result_.warnings);
    for (std::size_t i = 0; i < colliding.size(); ++i) result_.frames[i].collides = colliding[i];
    for (const auto& frame : scene_.frames()) {
      if (!frame->parent) visit(*frame, {});
    }
    for (const FrameData* joint : undeclared_) adoptBase(*joint);
    for (const auto& frame : scene_.frames()) addMass(*frame);
    for (std::size_t b = 1; b < result_.bodies.size(); ++b) completeMass(int(b));
    warnOfHangingRobots();
    warnOfWhatFallsThrough();
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
    const bool begins = beginsRobot(frame);
    if (begins)
      robot = {newRobot(attributeFlag(frame, "multibody", false)),
               attributeFlag(frame, "multibody_gravity", !hasFixedBase(frame))};
    if (frame.moves() && !isFree(frame)) {
      if (robot.number < 0) {
        robot.number = newRobot(false);
        if (parent.body == 0) undeclared_.push_back(&frame);
      }
      place(frame, parent, Kind::jointed, robot);
    } else if (isFree(frame) || isLooseLink(frame, parent, begins, robot)) {
      if (!begins) robot = {};
      place(frame, {}, Kind::free, robot);
    } else {
      fix(frame, parent, robot);
    }
    for (const FrameData* child : frame.children) visit(*child, robot);
  }

  /// Gives the shapes of a base that collide in no plan to the robot whose first joint stands on it: its links pass
  /// through its base as they do through each other. What stands beside this joint is no part of the base.
  void adoptBase(const FrameData& joint) {
    const int robot = result_.frames[std::size_t(joint.id)].robot;
    const RigidTransform at{Matrix3d::Identity(), joint.worldPose().p};
    bool is_base = false;
    const auto adopt = [&](const FrameData& frame) {
      PlacedFrame& placed = result_.frames[std::size_t(frame.id)];
      if (!frame.shape || placed.body != 0) return;
      const RigidTransform X = frame.worldPose().transform();
      if (proximity(*pointBody(), at, *frame.shape->body(), X).distance > kBesideJoint) return;
      is_base = true;
      if (frame.shape->contact == 0 && placed.robot < 0) placed.robot = robot;
    };
    for (const FrameData* up = joint.parent; up && !is_base; up = up->parent) {
      adopt(*up);
      for (const FrameData* child : up->children)
        if (!child->joint) adopt(*child);
    }
  }

  bool isLooseLink(const FrameData& frame, const PlacedFrame& parent, bool begins, const Robot& robot) {
    if (begins) return !hasFixedBase(frame);
    if (!isRigidLink(frame)) return false;
    const Kind on = result_.bodies[std::size_t(parent.body)].kind;
    return robot.number < 0 && (on == Kind::world || on == Kind::free) && isLoose(frame, result_.warnings);
  }

  /// Returns whether a link without a joint is a free object: its root frame has a mass, or all of its shapes have one.
  /// The mass of a frame counts for the shapes below it.
  bool isLoose(const FrameData& root, std::vector<std::string>& warnings) {
    std::string heavy, massless;
    const bool carries = forLink(root, [&](const FrameData& frame) {
      if (weighs(frame) && heavy.empty()) heavy = frame.name;
      if (result_.frames[std::size_t(frame.id)].collides && !isWeighed(frame, root)) massless = frame.name;
    });
    if (carries || heavy.empty()) return false;
    if (weighs(root) || root.joint || (massless.empty() && !isWorld(root))) return true;
    warnings.push_back(cat("Simulation: frame '", heavy, "' has a mass, but is rigidly attached to '", root.name, "'",
                           massless.empty() ? "" : cat(" like '", massless, "', which has no mass"),
                           ": the object does not move. Give it a joint of type rigid to let it fall"));
    return false;
  }

  /// Warns of robots whose base is fixed in the air although it weighs something and nothing says that it is fixed.
  void warnOfHangingRobots() {
    std::set<const FrameData*> seen;
    for (const FrameData* frame : undeclared_) {
      const FrameData* root = frame;
      while (root->parent) root = root->parent;
      if (!seen.insert(root).second || isWorld(*root) || root->attributes->find("multibody_fixedBase")) continue;
      bool heavy = false, has_shape = false;
      double lowest = root->worldPose().p.z();
      forLink(*root, [&](const FrameData& part) {
        heavy |= weighs(part);
        if (!result_.frames[std::size_t(part.id)].collides) return;
        const double z = lowestPoint(part);
        lowest = has_shape ? std::min(lowest, z) : z;
        has_shape = true;
      });
      if (!heavy || lowest < kInTheAir || isSupported(*root)) continue;
      result_.warnings.push_back(cat(
          "Simulation: the base '", root->name, "' of a robot is fixed in the air, ", std::round(100. * lowest) / 100.,
          " m above the ground. To let the robot fall, load its file with the option `floating`, or give the base"
          " `multibody_fixedBase: false`; `multibody_fixedBase: true` silences this warning"));
    }
  }

  /// Warns of free bodies that collide with nothing, in scenes in which other things do.
  void warnOfWhatFallsThrough() {
    std::vector<bool> solid(result_.bodies.size(), false);
    bool others = false;
    for (const auto& frame : scene_.frames()) {
      const PlacedFrame& placed = result_.frames[std::size_t(frame->id)];
      if (placed.collides) solid[std::size_t(placed.body)] = others = true;
    }
    if (!others) return;
    for (std::size_t b = result_.bodies.size() - 1; b > 0; --b) {
      if (solid[b]) solid[std::size_t(result_.bodies[b].parent)] = true;
    }
    std::vector<std::string> names;
    for (std::size_t b = 1; b < result_.bodies.size(); ++b) {
      const SceneBody& body = result_.bodies[b];
      if (body.kind == Kind::free && body.has_gravity && !solid[b]) names.push_back(body.frame->name);
    }
    if (names.empty()) return;
    result_.warnings.push_back(cat("Simulation: frame '", names.front(), "'",
                                   names.size() > 1 ? cat(" and ", names.size() - 1, " more") : "",
                                   " can fall, but no shape collides: nothing stops the fall. Give shapes `contact: 1`"
                                   " (URDF: <collision>, MJCF: contype and conaffinity)"));
  }

  static double lowestPoint(const FrameData& frame) {
    const CollisionBody& body = *frame.shape->body();
    const RigidTransform X = frame.worldPose().transform();
    if (!body.convex()) return (X * body.boundCenter()).z() - body.boundRadius();
    return (X * body.support(X.R.transpose() * -Vector3d::UnitZ())).z() - body.radius();
  }

  /// Returns whether the base of a robot touches something of another tree.
  bool isSupported(const FrameData& root) {
    bool touches = false;
    forLink(root, [&](const FrameData& part) {
      if (touches || !result_.frames[std::size_t(part.id)].collides) return;
      for (const auto& other : scene_.frames()) {
        const FrameData* top = other.get();
        while (top->parent) top = top->parent;
        if (top == &root || !result_.frames[std::size_t(other->id)].collides) continue;
        const CollisionBody &a = *part.shape->body(), &b = *other->shape->body();
        const RigidTransform X_a = part.worldPose().transform(), X_b = other->worldPose().transform();
        touches |= proximity(a, X_a, b, X_b).distance < kInTheAir;
      }
    });
    return touches;
  }

  static bool hasFixedBase(const FrameData& frame) { return attributeFlag(frame, "multibody_fixedBase", true); }

  static bool beginsRobot(const FrameData& frame) { return attributeFlag(frame, "multibody", !hasFixedBase(frame)); }

  int newRobot(bool declared) {
    result_.declared.push_back(declared);
    return int(result_.declared.size()) - 1;
  }

  void place(const FrameData& frame, const PlacedFrame& parent, Kind kind, const Robot& robot) {
    SceneBody body;
    body.kind = kind;
    body.frame = &frame;
    body.parent = kind == Kind::free ? 0 : parent.body;
    body.X_PB = kind == Kind::free ? frame.worldPose() : parent.X_BF;
    body.robot = robot.number;
    body.has_gravity = robot.has_gravity;
    setPlace(frame, int(result_.bodies.size()), Pose{}, robot.number);
    result_.bodies.push_back(body);
  }

  void setPlace(const FrameData& frame, int body, const Pose& X_BF, int robot) {
    PlacedFrame& placed = result_.frames[std::size_t(frame.id)];
    placed.body = body;
    placed.X_BF = X_BF;
    placed.robot = robot;
  }

  void fix(const FrameData& frame, const PlacedFrame& parent, const Robot& robot) {
    const Pose X_BF = parent.X_BF * frame.relativePose();
    if (!measured_.contains(frame.id)) {
      setPlace(frame, parent.body, X_BF, robot.number);
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
    const auto addSurfaces = [&](bool colliding) {
      for (const auto& frame : scene_.frames()) {
        const PlacedFrame& placed = result_.frames[std::size_t(frame->id)];
        if (placed.body != number || !frame->shape || placed.collides != colliding || !hasVolume(*frame)) continue;
        if (!colliding && !attributeFlag(*frame, "visual", false)) continue;
        body.inertia.add(surfaceInertia(*frame->shape->geometry, -1.), placed.X_BF.transform());
      }
    };
    addSurfaces(true);
    if (body.inertia.mass == 0.) addSurfaces(false);  // a link of visual shapes only
  }

  const SceneTree& scene_;
  const std::set<int>& measured_;
  SceneBodies result_;
  std::vector<const FrameData*> undeclared_;  ///< first joints of robots without `multibody`, fixed to the world
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

SceneBodies divideScene(const SceneTree& scene, const std::set<int>& measured) {
  return Divider(scene, measured).divide();
}

}  // namespace kinegraph::inline simulation_internal
