#include "kinegraph/komo/contact_forces.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/mode_switches.h"

namespace kinegraph {

namespace {

constexpr double kLeastForce = 1e-3, kLargestForce = 10.;  ///< in weights of the object

/// Where two bodies are nearest: the point on the first, and the direction to it from the second.
std::pair<Vector3d, Vector3d> nearestPoint(const State& state, int object, int from) {
  const State* states[] = {&state};
  Vector3d point, normal;
  Witness(Witness::Kind::point_a, object, from).eval(states, 1., point, nullptr);
  Witness(Witness::Kind::normal, object, from).eval(states, 1., normal, nullptr);
  return {point, normal};
}

/// The force that is demanded, on a path that does not have it yet. Throws for what does not fit.
ContactForce readDemand(const Path& path, const ContactSpec& demand) {
  path.requireBuilt("addContactForceFrame");
  const KinematicModel& before = path.state(-path.grid().order()).model();
  ContactForce contact;
  contact.object = frameId(before, demand.object, "addContactForceFrame");
  contact.from = frameId(before, demand.from, "addContactForceFrame");
  if (contact.object == contact.from)
    throw ValueError(cat("addContactForceFrame: '", demand.object, "' cannot push itself"));
  if (!(demand.friction > 0.)) {
    throw ValueError(
        cat("addContactForceFrame: the coefficient of friction is ", demand.friction, "; expected a positive number"));
  }
  if (!(demand.mass > 0.))
    throw ValueError(cat("addContactForceFrame: the mass is ", demand.mass, " kg; expected a positive number"));
  contact.unit = -kGravity.z() * demand.mass;
  contact.is_free = demand.is_free;
  return contact;
}

/// A joint whose dofs are a force.
Attachment forceDofs(bool is_free) {
  Attachment attachment;
  attachment.type = is_free ? JointType::trans3 : JointType::transZ;
  attachment.stable = false;
  attachment.uniform = true;
  attachment.lower = VectorXd::Constant(is_free ? 3 : 1, is_free ? -kLargestForce : kLeastForce);
  attachment.upper = VectorXd::Constant(is_free ? 3 : 1, kLargestForce);
  return attachment;
}

/// Starts with the point at X_WP in the world, and the weight of the object as force.
void startContact(Path& path, const ContactForce& contact, const Pose& X_WP, const Vector3d& normal) {
  const int start = -path.grid().order();
  for (int t = start; t < path.grid().slices(); ++t) {
    const KinematicModel& model = path.state(t).model();
    VectorXd q = path.state(t).q();
    q.segment<7>(model.frame_dofs[contact.point].first) =
        (Pose(path.state(start).pose(contact.object)).inverse() * X_WP).numbers();
    if (const auto [first, count] = model.frame_dofs[contact.dofs]; count > 0) {
      if (contact.is_free) q.segment<3>(first) = normal;
      if (!contact.is_free) q[first] = 1.;
    }
    path.setSlice(t, q.data());
  }
}

/// The bodies touch at the point, its z axis is along their normals, and the force is within the cone of friction.
void requireContact(MotionProblem& motion, const ContactSpec& demand, const ContactForce& contact,
                    const std::string& name) {
  const std::string &object = demand.object, &from = demand.from;
  const auto require = [&](const FeatureSource& feature, std::vector<std::string> frames, ObjectiveType type,
                           double scale) {
    motion.require({.feature = feature,
                    .frames = std::move(frames),
                    .type = type,
                    .scale = MatrixXd::Constant(1, 1, scale),
                    .order = 0,
                    .times = demand.times});
  };
  const auto align = [&](const std::string& body, double sign) {
    require(FeatureRecipe{"pairNormalAlign", {}, sign}, {name, body}, ObjectiveType::sos, .1);
  };
  require(FeatureSymbol::distance, {from, object}, ObjectiveType::ineq, 1e1);
  require(FeatureSymbol::distance, {object, name}, ObjectiveType::eq, 1e1);
  require(FeatureSymbol::distance, {from, name}, ObjectiveType::eq, 1e1);
  require(FeatureRecipe{"pairNormalsOppose"}, {object, from, name}, ObjectiveType::sos, 1e1);
  align(object, 1.);
  align(from, -1.);
  require(FeatureRecipe{"frictionCone", contact, demand.friction}, {object, from, name}, ObjectiveType::ineq, 1.);
}

}  // namespace

std::string addContactForce(MotionProblem& motion, const ContactSpec& demand) {
  Path& path = motion.path;
  ContactForce contact = readDemand(path, demand);
  const auto [from, to] = path.grid().select(demand.times);
  if (from > to) {
    throw ValueError(
        cat("addContactForceFrame between '", demand.object, "' and '", demand.from, "': its times select no slice"));
  }
  const int start = -path.grid().order();
  const double time = demand.times.empty() ? path.grid().timeOf(from) : demand.times[0];
  const std::string name = cat("poa_", demand.object, "_", demand.from, "_", time);
  const auto [point, normal] = nearestPoint(path.state(start), contact.object, contact.from);
  addFrameDof(path, {.name = name, .parent = demand.object, .type = JointType::free, .stable = true});
  contact.point = frameId(path.state(start).model(), name, "addContactForceFrame");
  contact.dofs = path.addDofs(name + "_force", from, to, forceDofs(demand.is_free));
  Pose X_WP;
  X_WP.p = point + demand.distance * normal;
  X_WP.q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  startContact(path, contact, X_WP, normal);
  requireContact(motion, demand, contact, name);
  motion.contacts.add(contact);
  return name;
}

}  // namespace kinegraph
