#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

namespace {

constexpr double kLeastForce = 1e-3, kLargestForce = 10.;  ///< in weights of the object

/// Where two bodies are nearest: the point on the first, and the direction to it from the second.
std::pair<Vector3d, Vector3d> nearestPoint(const State& state, int object, int onto) {
  const State* states[] = {&state};
  Vector3d point, normal;
  Witness(Witness::Kind::point_a, object, onto).eval(states, 1., point, nullptr);
  Witness(Witness::Kind::normal, object, onto).eval(states, 1., normal, nullptr);
  return {point, normal};
}

}  // namespace

/// A hidden frame with a joint in the slices [from, to], whose dofs are a force. Returns its id.
int Komo::addForceDofs(const std::string& name, int from, int to, bool is_free) {
  Attachment attachment;
  attachment.type = is_free ? JointType::trans3 : JointType::transZ;
  attachment.stable = false;
  attachment.uniform = true;
  attachment.lower = VectorXd::Constant(is_free ? 3 : 1, is_free ? -kLargestForce : kLeastForce);
  attachment.upper = VectorXd::Constant(is_free ? 3 : 1, kLargestForce);
  return addDofs(name, from, to, attachment);
}

/// A hidden frame with a joint to the world in the slices [from, to]. Returns its id.
int Komo::addDofs(const std::string& name, int from, int to, const Attachment& attachment) {
  const int id = addHiddenFrame(name), joint = next_joint_++;
  std::map<int, int> changed;  // old mode -> the mode that takes its place
  for (int t = from; t <= to; ++t) {
    int& mode_of_slice = mode_of_[std::size_t(t + order_)];
    const auto [place, is_new] = changed.try_emplace(mode_of_slice, int(modes_.size()));
    if (is_new) {
      auto mode = std::make_shared<Mode>(*modes_[mode_of_slice]);
      SceneTree& scene = *mode->config.scene();
      FrameData& frame = *scene.frames()[id];
      scene.link(frame, *scene.frames().front());
      addJoint(frame, attachment, Pose());
      mode->added[id] = {joint, false, scene.frames().front()->name};
      scene.structureChanged();
      modes_.push_back(std::move(mode));
    }
    mode_of_slice = place->second;
  }
  rebuildStates();
  return id;
}

std::string Komo::addContact(const std::vector<double>& times, const std::string& object, const std::string& onto,
                             double friction, double mass, double distance, bool is_free) {
  requireBuilt("addContactForceFrame");
  const Program& before = state(-order_).program();
  ContactForce contact;
  contact.object = frameId(before, object, "addContactForceFrame");
  contact.onto = frameId(before, onto, "addContactForceFrame");
  if (contact.object == contact.onto) throw ValueError(cat("addContactForceFrame: '", object, "' cannot push itself"));
  if (!(friction > 0.))
    throw ValueError(
        cat("addContactForceFrame: the coefficient of friction is ", friction, "; expected a positive number"));
  if (!(mass > 0.))
    throw ValueError(cat("addContactForceFrame: the mass is ", mass, " kg; expected a positive number"));
  const auto [from, to] = selectSlices(times);
  if (from > to)
    throw ValueError(cat("addContactForceFrame between '", object, "' and '", onto, "': its times select no slice"));
  const std::string name =
      cat("poa_", object, "_", onto, "_", times.empty() ? double(from + 1) / slices_per_phase_ : times[0]);
  const auto [point, normal] = nearestPoint(state(-order_), contact.object, contact.onto);
  addFrameDof(name, object, JointType::free, true);
  contact.point = frameId(state(-order_).program(), name, "addContactForceFrame");
  contact.dofs = addForceDofs(name + "_force", from, to, is_free);
  contact.unit = -kGravity.z() * mass;
  contact.is_free = is_free;

  Pose X_WP;
  X_WP.p = point + distance * normal;
  X_WP.q = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), normal);
  for (int t = -order_; t < slices_; ++t) {
    VectorXd q = state(t).q();
    q.segment<7>(state(t).program().frame_dofs[contact.point].first) =
        (Pose(state(-order_).pose(contact.object)).inverse() * X_WP).numbers();
    if (const auto [first, count] = state(t).program().frame_dofs[contact.dofs]; count > 0) {
      if (is_free) q.segment<3>(first) = normal;
      if (!is_free) q[first] = 1.;
    }
    setSlice(t, q.data());
  }

  const auto require = [&](const FeatureSource& feature, std::vector<std::string> frames, ObjectiveType type,
                           double scale) {
    add({feature.name(), feature, std::move(frames), type, MatrixXd::Constant(1, 1, scale), {}, 0, times, 0, 0}, 0, 0);
  };
  const auto align = [&](const std::string& body, double sign) {
    require(FeatureRecipe{"pairNormalAlign", {}, sign}, {name, body}, ObjectiveType::sos, .1);
  };
  require(FeatureSymbol::distance, {onto, object}, ObjectiveType::ineq, 1e1);
  require(FeatureSymbol::distance, {object, name}, ObjectiveType::eq, 1e1);
  require(FeatureSymbol::distance, {onto, name}, ObjectiveType::eq, 1e1);
  require(FeatureRecipe{"pairNormalsOppose"}, {object, onto, name}, ObjectiveType::sos, 1e1);
  align(object, 1.);
  align(onto, -1.);
  require(FeatureRecipe{"frictionCone", contact, friction}, {object, onto, name}, ObjectiveType::ineq, 1.);
  contacts_.push_back(contact);
  return name;
}

std::string Komo::addContactForce(const std::vector<double>& times, const std::string& object, const std::string& onto,
                                  double friction, double mass) {
  return addContact(times, object, onto, friction, mass, 0., false);
}

std::string Komo::addFreeContactForce(const std::vector<double>& times, const std::string& object,
                                      const std::string& onto, double friction, double mass, double distance) {
  return addContact(times, object, onto, friction, mass, distance, true);
}

std::unique_ptr<Feature> Komo::physicsOf(int frame, const Objective& objective) const {
  const double gravity = objective.without_gravity ? 0. : -kGravity.z();
  const bool given = frame < int(base_->frames().size()) && base_->frames()[frame]->inertia;
  if (contacts_.empty() && !given && !objective.damped) return std::make_unique<FreeFlight>(frame, gravity);
  const Matrix3d inertia = given ? base_->frames()[frame]->inertia->matrix : Matrix3d(Matrix3d::Zero());
  if (objective.damped) return std::make_unique<DampedMotion>(frame, gravity, inertia, contacts_);
  return std::make_unique<NewtonEuler>(frame, gravity, inertia, contacts_);
}

/// What a mode without a stable joint asks of the motion, in the slices [from, to].
void Komo::addPhysics(SwitchMode mode, const std::string& object, int from, int to) {
  const std::vector<double> times = {double(from + 1) / slices_per_phase_, double(to + 1) / slices_per_phase_};
  const bool damped = mode == SwitchMode::quasiStatic || mode == SwitchMode::quasiStaticOn;
  if (order_ < (damped ? 1 : 2) || from > to) return;
  const auto rows = [&](ObjectiveType type, double scale, const std::vector<int>& chosen) {
    MatrixXd S = MatrixXd::Zero(Eigen::Index(chosen.size()), 6);
    for (std::size_t i = 0; i < chosen.size(); ++i) S(Eigen::Index(i), chosen[i]) = scale;
    Objective objective{
        "physics", FeatureSymbol::physics, {object}, type, chosen.size() == 6 ? MatrixXd::Constant(1, 1, scale) : S,
        {},        damped ? 1 : 2,         times,    0,    0};
    objective.without_gravity = mode == SwitchMode::dynamicOn || mode == SwitchMode::quasiStaticOn;
    objective.damped = damped;
    add(std::move(objective), 0, 0);
  };
  const std::vector<int> all = {0, 1, 2, 3, 4, 5};
  switch (mode) {
    case SwitchMode::dynamicTrans:
      return rows(ObjectiveType::eq, 1e2, {0, 1, 2});
    case SwitchMode::quasiStatic:
      return rows(ObjectiveType::eq, 1e1, all);
    case SwitchMode::quasiStaticOn:
      rows(ObjectiveType::eq, 1e1, {0, 1, 5});
      return rows(ObjectiveType::sos, 1., {2, 3, 4});
    default:
      return rows(ObjectiveType::eq, 1e2, all);
  }
}

std::vector<Komo::Interaction> Komo::interactions() const {
  std::vector<Interaction> list;
  for (int t = 0; t < slices_; ++t) {
    for (const ContactForce& contact : contacts_) {
      if (!contact.isIn(state(t))) continue;
      const std::vector<std::string>& names = state(t).program().frame_name;
      list.push_back(
          {t, names[contact.object], names[contact.onto], state(t).position(contact.point), contact.value(state(t))});
    }
  }
  return list;
}

}  // namespace kinegraph
