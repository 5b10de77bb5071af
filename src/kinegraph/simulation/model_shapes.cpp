#include "kinegraph/simulation/model_shapes.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/body_tree.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph {

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

void setContactNumbers(mjsGeom* geom, const SimulationOptions& options, double friction) {
  const double solref[] = {.005, 1.}, solimp[] = {.98, .99, .001, .5, 2.};
  std::copy_n(solref, 2, geom->solref);
  std::copy_n(solimp, 5, geom->solimp);
  geom->condim = 6;
  geom->gap = kContactGap;
  geom->friction[0] = friction;
  geom->friction[1] = options.torsional_friction;
  geom->friction[2] = options.rolling_friction;
  geom->mass = 0.;
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
  setContactNumbers(geom, options_, options_.friction);
  geom->contype = kNonRobot;
  geom->conaffinity = -1;
  geoms.push_back({geom, "ground", -1, kGroundBody, -1, false, options_.friction, false});
}

mjsGeom* ModelShapes::addGeom(mjsBody* body, const FrameData& frame, const Pose& X_BF, int robot) {
  const Physics& mj = physics();
  mjsGeom* geom = mj.mjs_addGeom(body, nullptr);
  const std::string name = cat("g", geoms.size());
  mj.mjs_setName(geom->element, name.c_str());
  std::copy_n(X_BF.p.data(), 3, geom->pos);
  std::copy_n(wxyz(X_BF.q).data(), 4, geom->quat);
  const double friction = attributeNumber(frame, "friction", options_.friction);
  if (friction < 0.)
    throw ValueError(cat("Simulation: frame '", frame.name, "' has friction ", friction, "; expected a number >= 0"));
  setContactNumbers(geom, options_, friction);
  geom->contype = contactBit(robot);
  geom->conaffinity = robot < 0 ? -1 : ~contactBit(robot);
  geoms.push_back(
      {geom, name, frame.id, body_number, robot, body_moves, friction, frame.attributes->find("friction") != nullptr});
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

void ModelShapes::addFrictionPairs(const std::set<std::pair<int, int>>& excluded, bool all_listed) {
  const Physics& mj = physics();
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    for (std::size_t j = i + 1; j < geoms.size(); ++j) {
      const Geom &a = geoms[i], &b = geoms[j];
      const bool differ = a.friction != b.friction || (all_listed && (a.has_friction || b.has_friction));
      if (!differ || a.body == b.body || !(a.moves || b.moves) || !mayTouch(a.robot, b.robot)) continue;
      if (excluded.contains(std::minmax(a.body, b.body))) continue;
      mjsPair* pair = mj.mjs_addPair(spec_, nullptr);
      mj.mjs_setString(pair->geomname1, a.name.c_str());
      mj.mjs_setString(pair->geomname2, b.name.c_str());
      pair->condim = 6;
      pair->margin = a.spec->margin + b.spec->margin;
      pair->gap = kContactGap;
      std::copy_n(a.spec->solref, 2, pair->solref);
      std::copy_n(a.spec->solimp, 5, pair->solimp);
      const double mean = .5 * (a.friction + b.friction);
      const double friction[] = {mean, mean, options_.torsional_friction, options_.rolling_friction,
                                 options_.rolling_friction};
      std::copy_n(friction, 5, pair->friction);
    }
  }
}

}  // namespace kinegraph
