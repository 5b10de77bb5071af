#include "kinegraph/simulation/model_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/body_tree.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline simulation_internal {

namespace {

constexpr double kThinnest = 1e-5;  ///< m: smallest half-extent of a core
/// m: distance at which contact points are searched already. MuJoCo decides on contact by the least distance of two
/// shapes and then measures between faces, which yields up to 1e-5 m less: without this gap, contacts of small forces
/// flicker.
constexpr double kContactGap = 5e-4;
constexpr int kNonRobot = 1;    ///< contact bit of everything outside robots
constexpr int kMaxRobots = 30;  ///< each has its own contact bit

int contactBit(int robot) { return robot < 0 ? kNonRobot : 1 << (1 + robot % kMaxRobots); }

/// Returns whether two shapes may collide: all pairs do, except those within one robot.
bool mayTouch(int robot_a, int robot_b) {
  return contactBit(robot_a) == kNonRobot || contactBit(robot_a) != contactBit(robot_b);
}

void setContactNumbers(mjsGeom* geom, const std::array<double, 3>& friction) {
  const double solref[] = {.005, 1.}, solimp[] = {.98, .99, .001, .5, 2.};
  std::copy_n(solref, 2, geom->solref);
  std::copy_n(solimp, 5, geom->solimp);
  geom->condim = 6;
  geom->gap = kContactGap;
  std::copy_n(friction.data(), 3, geom->friction);
  geom->mass = 0.;
}

/// Returns whether contacts of two such frames have the larger friction, as in MuJoCo, instead of the mean.
bool takesLargest(const FrameData& frame) {
  const Node* rule = frame.attributes->find("frictionRule");
  if (!rule) return false;
  const std::string* word = rule->value.as<std::string>();
  if (!word || (*word != "max" && *word != "mean"))
    throw ValueError(cat("Simulation: frame '", frame.name, "': attribute frictionRule is ", describe(rule->value),
                         "; expected max or mean"));
  return *word == "max";
}

/// Thickens points in a plane or on a line slightly, because a mesh needs a volume.
std::vector<Vector3d> withVolume(const std::vector<Vector3d>& points) {
  if (points.size() >= 4 && spanVolume(points)) return points;
  std::vector<Vector3d> thick;
  for (const Vector3d& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      thick.push_back(p + 1e-3 * Vector3d::Unit(axis));
      thick.push_back(p - 1e-3 * Vector3d::Unit(axis));
    }
  }
  return thick;
}

}  // namespace

void ModelShapes::addGround() {
  const Physics& mj = physics();
  mjsBody* body = mj.mjs_addBody(mj.mjs_findBody(spec_, "world"), nullptr);
  mj.mjs_setName(body->element, "ground");
  mjsGeom* geom = mj.mjs_addGeom(body, nullptr);
  geom->type = mjGEOM_PLANE;
  geom->size[2] = .05;
  mj.mjs_setName(geom->element, "ground");
  const std::array<double, 3> friction = {options_.friction, options_.torsional_friction, options_.rolling_friction};
  setContactNumbers(geom, friction);
  geom->contype = kNonRobot;
  geom->conaffinity = -1;
  geoms.push_back({geom, "ground", "ground", -1, kGroundBody, -1, false, friction, false, false, 0.});
}

mjsGeom* ModelShapes::addGeom(mjsBody* body, const FrameData& frame, const Pose& X_BF, int robot) {
  const Physics& mj = physics();
  mjsGeom* geom = mj.mjs_addGeom(body, nullptr);
  const std::string name = cat("g", geoms.size());
  mj.mjs_setName(geom->element, name.c_str());
  std::copy_n(X_BF.p.data(), 3, geom->pos);
  std::copy_n(wxyz(X_BF.q).data(), 4, geom->quat);
  const std::array<double, 3> friction = {attributeNumber(frame, "friction", options_.friction),
                                          attributeNumber(frame, "torsionalFriction", options_.torsional_friction),
                                          attributeNumber(frame, "rollingFriction", options_.rolling_friction)};
  for (const double x : friction) {
    if (x < 0.)
      throw ValueError(cat("Simulation: frame '", frame.name, "' has friction ", x, "; expected a number >= 0"));
  }
  const double restitution = attributeNumber(frame, "restitution", 0.);
  if (!(restitution >= 0. && restitution <= 1.))
    throw ValueError(cat("Simulation: frame '", frame.name, "' has restitution ", restitution, "; expected 0 to 1"));
  setContactNumbers(geom, friction);
  geom->contype = contactBit(robot);
  geom->conaffinity = robot < 0 ? -1 : ~contactBit(robot);
  geoms.push_back({geom, name, body_name, frame.id, body_number, robot, body_moves, friction, takesLargest(frame),
                   frame.attributes->find("friction") != nullptr, restitution});
  return geom;
}

void ModelShapes::setMesh(mjsGeom* geom, const std::vector<Vector3d>& points, const void* key) {
  const Physics& mj = physics();
  std::string& name = meshes_[key];
  if (name.empty()) {
    name = cat("m", meshes_.size());
    mjsMesh* mesh = mj.mjs_addMesh(spec_, nullptr);
    mj.mjs_setName(mesh->element, name.c_str());
    std::vector<float> vertices;
    for (const Vector3d& p : withVolume(points)) {
      for (int i = 0; i < 3; ++i) vertices.push_back(float(p[i]));
    }
    mj.mjs_setFloat(mesh->uservert, vertices.data(), int(vertices.size()));
    mesh->inertia = mjMESH_INERTIA_CONVEX;
  }
  geom->type = mjGEOM_MESH;
  mj.mjs_setString(geom->meshname, name.c_str());
}

void ModelShapes::addBody(const CollisionBody& core, const FrameData& frame, mjsBody* body, const Pose& X_BF,
                          int robot) {
  using Core = CollisionBody::Core;
  if (core.core() == Core::compound) {
    for (const auto& part : core.tree().bodies) addBody(*part, frame, body, X_BF, robot);
    return;
  }
  mjsGeom* geom = addGeom(body, frame, X_BF, robot);
  geom->margin = core.radius();  // the margin inflates the core
  switch (core.core()) {
    case Core::point:
      geom->type = mjGEOM_SPHERE;
      geom->size[0] = std::max(core.radius(), kThinnest);
      geom->margin = 0.;
      return;
    case Core::segment:
      geom->type = mjGEOM_CAPSULE;
      geom->size[0] = core.radius();
      geom->size[1] = std::max(core.halfLength(), kThinnest);
      geom->margin = 0.;
      return;
    case Core::box:
      geom->type = mjGEOM_BOX;
      for (int i = 0; i < 3; ++i) geom->size[i] = std::max(core.halfSides()[i], kThinnest);
      return;
    case Core::cylinder:
      geom->type = mjGEOM_CYLINDER;
      geom->size[0] = std::max(core.coreRadius(), kThinnest);
      geom->size[1] = std::max(core.halfLength(), kThinnest);
      return;
    case Core::half_space:
      geom->type = mjGEOM_PLANE;
      geom->size[2] = .05;
      geom->margin = 0.;
      if (body_moves)
        throw ValueError(cat("Simulation: frame '", frame.name,
                             "' is a plane that moves; only planes that are fixed to the world collide. Use a box"));
      return;
    case Core::hull:
      setMesh(geom, core.hull().points, &core);
      return;
    default:  // a grid, or a box or ellipsoid with a radius: the hull of its surface
      geom->margin = 0.;
      setMesh(geom, shapeKind(frame.shape->geometry->type).surface(*frame.shape->geometry).vertices, &core);
  }
}

void ModelShapes::add(const FrameData& frame, mjsBody* body, const Pose& X_BF, int robot) {
  const std::size_t first = geoms.size();
  addBody(*frame.shape->body(), frame, body, X_BF, robot);
  const Node* node = frame.attributes->find("surfaceVelocity");
  if (!node) return;
  const NumberArray* velocity = node->value.as<NumberArray>();
  if (!velocity || velocity->numbers.size() != 3)
    throw ValueError(cat("Simulation: frame '", frame.name, "': attribute surfaceVelocity is ", describe(node->value),
                         "; expected 3 numbers, m/s in the frame's axes"));
  for (std::size_t i = first; i < geoms.size(); ++i) {
    if (geoms[i].spec->type == mjGEOM_MESH)
      throw ValueError(cat("Simulation: frame '", frame.name,
                           "': surfaceVelocity is for boxes, cylinders, capsules and spheres, not for meshes"));
    std::copy_n(velocity->numbers.data(), 3, geoms[i].spec->surfacevel);
  }
}

void ModelShapes::exclude(const std::string& a, const std::string& b) {
  const Physics& mj = physics();
  mjsExclude* pair = mj.mjs_addExclude(spec_);
  mj.mjs_setString(pair->bodyname1, a.c_str());
  mj.mjs_setString(pair->bodyname2, b.c_str());
}

void ModelShapes::addPair(const Geom& a, const Geom& b) {
  const Physics& mj = physics();
  mjsPair* pair = mj.mjs_addPair(spec_, nullptr);
  mj.mjs_setString(pair->geomname1, a.name.c_str());
  mj.mjs_setString(pair->geomname2, b.name.c_str());
  pair->condim = 6;
  pair->margin = a.spec->margin + b.spec->margin;
  pair->gap = kContactGap;
  std::copy_n(a.spec->solref, 2, pair->solref);
  std::copy_n(a.spec->solimp, 5, pair->solimp);
  const bool largest = a.largest && b.largest;
  const auto of = [&](std::size_t i) {
    return largest ? std::max(a.friction[i], b.friction[i]) : .5 * (a.friction[i] + b.friction[i]);
  };
  const double friction[] = {of(0), of(0), of(1), of(2), of(2)};
  std::copy_n(friction, 5, pair->friction);
}

void ModelShapes::addPairs(const ContactRules& rules, const std::vector<bool>& declared, const BodyPairs& overlapping,
                           bool all_listed) {
  std::map<int, std::size_t> rule_of;  // by frame
  for (std::size_t i = 0; i < rules.bodies.size(); ++i) rule_of[rules.bodies[i].frame] = i;
  std::vector<std::optional<std::size_t>> rule;  // per geom, if its frame collides in plans
  for (const Geom& geom : geoms) {
    const auto found = rule_of.find(geom.frame);
    rule.push_back(found != rule_of.end() ? std::optional(found->second) : std::nullopt);
  }
  const auto forPairs = [&](const auto& visit) {
    for (std::size_t i = 0; i < geoms.size(); ++i) {
      for (std::size_t j = i + 1; j < geoms.size(); ++j) {
        const Geom &a = geoms[i], &b = geoms[j];
        if (a.body == b.body || !(a.moves || b.moves) || overlapping.contains(std::minmax(a.body, b.body))) continue;
        const bool in_plans = rule[i] && rule[j], within_robot = !mayTouch(a.robot, b.robot);
        if (within_robot && (!in_plans || a.robot != b.robot || declared[std::size_t(a.robot)])) continue;
        visit(a, b, !in_plans || rules.allow(*rule[i], *rule[j]), within_robot);
      }
    }
  };
  BodyPairs excluded;
  forPairs([&](const Geom& a, const Geom& b, bool collide, bool within_robot) {
    if (!collide && !within_robot && excluded.insert(std::minmax(a.body, b.body)).second)
      exclude(a.body_name, b.body_name);
  });
  forPairs([&](const Geom& a, const Geom& b, bool collide, bool within_robot) {
    const bool differ =
        (a.friction != b.friction && !(a.largest && b.largest)) || (all_listed && (a.has_friction || b.has_friction));
    if (collide && (differ || within_robot || excluded.contains(std::minmax(a.body, b.body)))) addPair(a, b);
  });
}

}  // namespace kinegraph::inline simulation_internal
