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

constexpr double kThinnest = 1e-5;  ///< m: half the least thickness of a core
/// m: points are looked for at this distance already. MuJoCo asks whether shapes touch by their least distance, and then
/// measures between faces, which gives up to 1e-5 less: without this, contacts of small forces would come and go.
constexpr double kLooksAhead = 5e-4;
constexpr int kThing = 1;        ///< contact bit of what is no robot
constexpr int kMostRobots = 30;  ///< each has a bit of its own

int contactBit(int robot) { return robot < 0 ? kThing : 1 << (1 + robot % kMostRobots); }

/// What collides with what: all with all, but a robot with itself.
bool mayTouch(int robot_a, int robot_b) {
  return contactBit(robot_a) == kThing || contactBit(robot_a) != contactBit(robot_b);
}

void setContactNumbers(mjsGeom* geom, const SimulationOptions& options, double friction) {
  const double solref[] = {.005, 1.}, solimp[] = {.98, .99, .001, .5, 2.};
  std::copy_n(solref, 2, geom->solref);
  std::copy_n(solimp, 5, geom->solimp);
  geom->condim = 6;
  geom->gap = kLooksAhead;
  geom->friction[0] = friction;
  geom->friction[1] = options.torsional_friction;
  geom->friction[2] = options.rolling_friction;
  geom->mass = 0.;
}

/// Points in a plane or on a line, made a little thicker, because a mesh must have a volume.
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
  geom->contype = kThing;
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
  geom->margin = core.radius();  // inflates
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
    default:  // a grid, or a box and an ellipsoid: the hull of the surface
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

void ModelShapes::addFrictionPairs(const std::set<std::pair<int, int>>& excluded, bool all_given) {
  const Physics& mj = physics();
  for (std::size_t i = 0; i < geoms.size(); ++i) {
    for (std::size_t j = i + 1; j < geoms.size(); ++j) {
      const Geom &a = geoms[i], &b = geoms[j];
      const bool differ = a.friction != b.friction || (all_given && (a.is_given || b.is_given));
      if (!differ || a.body == b.body || !(a.moves || b.moves) || !mayTouch(a.robot, b.robot)) continue;
      if (excluded.contains(std::minmax(a.body, b.body))) continue;
      mjsPair* pair = mj.mjs_addPair(spec_, nullptr);
      mj.mjs_setString(pair->geomname1, a.name.c_str());
      mj.mjs_setString(pair->geomname2, b.name.c_str());
      pair->condim = 6;
      pair->margin = a.spec->margin + b.spec->margin;
      pair->gap = kLooksAhead;
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
