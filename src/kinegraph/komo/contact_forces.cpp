#include "kinegraph/komo/contact_forces.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/features/recipe.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/mode_switches.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr double kSmallestForce = 1e-3, kLargestForce = 10.;  ///< in units of the object's weight

/// Returns the point on `object` that is nearest to `from`, and the direction to it from there.
std::pair<Vector3d, Vector3d> nearestPoint(const State& state, int object, int from) {
  const State* states[] = {&state};
  Vector3d point, normal;
  Witness(Witness::Kind::point_a, object, from).eval(states, 1., point, nullptr);
  Witness(Witness::Kind::normal, object, from).eval(states, 1., normal, nullptr);
  return {point, normal};
}

/// Validates the specification and returns its force, whose dofs do not exist yet. Throws if the specification does not
/// fit the path.
ContactForce readSpec(const Path& path, const ContactSpec& spec) {
  path.requireBuilt("addContactForceFrame");
  const KinematicModel& before = path.state(-path.grid().order()).model();
  ContactForce contact;
  contact.object = frameId(before, spec.object, "addContactForceFrame");
  contact.from = frameId(before, spec.from, "addContactForceFrame");
  if (contact.object == contact.from)
    throw ValueError(cat("addContactForceFrame: '", spec.object, "' cannot push itself"));
  if (!(spec.friction > 0.)) {
    throw ValueError(
        cat("addContactForceFrame: the coefficient of friction is ", spec.friction, "; expected a positive number"));
  }
  if (!(spec.mass > 0.))
    throw ValueError(cat("addContactForceFrame: the mass is ", spec.mass, " kg; expected a positive number"));
  contact.unit = -kGravity.z() * spec.mass;
  contact.is_free = spec.is_free;
  return contact;
}

/// Returns a joint whose dofs are a force.
Attachment forceDofs(bool is_free) {
  Attachment attachment;
  attachment.type = is_free ? JointType::trans3 : JointType::transZ;
  attachment.stable = false;
  attachment.uniform = true;
  attachment.lower = VectorXd::Constant(is_free ? 3 : 1, is_free ? -kLargestForce : kSmallestForce);
  attachment.upper = VectorXd::Constant(is_free ? 3 : 1, kLargestForce);
  return attachment;
}

/// Initializes the point at X_WP in the world, and the force with the weight of the object.
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

/// Adds the constraints: the bodies touch at the point, its z axis is along their normals, and the force is within the
/// friction cone.
void requireContact(MotionProblem& motion, const ContactSpec& spec, const ContactForce& contact,
                    const std::string& name) {
  const std::string &object = spec.object, &from = spec.from;
  const auto require = [&](const FeatureSource& feature, std::vector<std::string> frames, ObjectiveType type,
                           double scale) {
    motion.require({.feature = feature,
                    .frames = std::move(frames),
                    .type = type,
                    .scale = MatrixXd::Constant(1, 1, scale),
                    .order = 0,
                    .times = spec.times});
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
  require(FeatureRecipe{"frictionCone", contact, spec.friction}, {object, from, name}, ObjectiveType::ineq, 1.);
}

}  // namespace

std::string addContactForce(MotionProblem& motion, const ContactSpec& spec) {
  Path& path = motion.path;
  ContactForce contact = readSpec(path, spec);
  const auto [from, to] = path.grid().select(spec.times);
  if (from > to) {
    throw ValueError(
        cat("addContactForceFrame between '", spec.object, "' and '", spec.from, "': its times select no slice"));
  }
  const int start = -path.grid().order();
  const double time = spec.times.empty() ? path.grid().timeOf(from) : spec.times[0];
  const std::string name = cat("poa_", spec.object, "_", spec.from, "_", time);
  const auto [point, normal] = nearestPoint(path.state(start), contact.object, contact.from);
  addFrameDof(path, {.name = name, .parent = spec.object, .type = JointType::free, .stable = true});
  contact.point = frameId(path.state(start).model(), name, "addContactForceFrame");
  contact.dofs = path.addDofs(name + "_force", from, to, forceDofs(spec.is_free));
  Pose X_WP;
  X_WP.p = point + spec.distance * normal;
  X_WP.q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  startContact(path, contact, X_WP, normal);
  requireContact(motion, spec, contact, name);
  motion.contacts.add(contact);
  return name;
}

}  // namespace kinegraph::inline komo_internal
