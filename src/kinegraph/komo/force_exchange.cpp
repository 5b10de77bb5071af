#include "kinegraph/komo/force_exchange.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/features/recipe.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

namespace {

constexpr double kElasticity = .9;
constexpr double kInitialForce = .1;  ///< in units of weight; nonzero because the friction cone has its tip at zero

using enum ObjectiveType;

Vector3d nearest(const State& state, Witness::Kind kind, const ContactForce& contact) {
  const State* states[] = {&state};
  Vector3d value;
  Witness(kind, contact.object, contact.from).eval(states, 1., value, nullptr);
  return value;
}

/// Adds a force exchange to a problem: first its dofs, then the constraints on them.
class ForceExchangeBuilder {
 public:
  ForceExchangeBuilder(MotionProblem& motion, const ForceExchangeSpec& spec)
      : motion_(motion), path_(motion.path), spec_(spec), pair_({spec.object, spec.from}) {
    path_.requireBuilt("addForceExchange");
    readFrames();
    readTimes();
    const auto& masses = path_.state(-path_.grid().order()).parameters().frame_mass;
    const double own = masses[contact_.object].mass, mass = own > 0. ? own : masses[contact_.from].mass;
    contact_.unit = -kGravity.z() * (mass > 0. ? mass : 1.);
    contact_.is_free = true;
  }

  std::string add() {
    addDofs();
    startBetweenBodies();
    requireKind();
    addCosts();
    motion_.contacts.add(contact_);
    return name_;
  }

 private:
  void readFrames() {
    const KinematicModel& model = path_.state(-path_.grid().order()).model();
    contact_.object = frameId(model, spec_.object, "contact");
    contact_.from = frameId(model, spec_.from, "contact");
    if (contact_.object == contact_.from) throw ValueError(cat("contact: '", spec_.object, "' cannot push itself"));
    if (!(spec_.friction > 0.)) {
      throw ValueError(cat("contact: the coefficient of friction is ", spec_.friction, "; expected a positive number"));
    }
  }

  void readTimes() {
    const TimeGrid& grid = path_.grid();
    const bool bounces = spec_.kind == ForceExchange::bounce;
    if (bounces && grid.order() < 2) {
      throw ValueError(cat("bounce of '", spec_.object, "' off '", spec_.from,
                           "': speeds before and after it need a KOMO with kOrder 2; this one has ", grid.order()));
    }
    std::tie(from_, to_) = grid.select(spec_.times);
    if (bounces) to_ = from_;
    if (from_ > to_ || from_ >= grid.slices()) {
      throw ValueError(cat("contact between '", spec_.object, "' and '", spec_.from, "': its times select no slice"));
    }
  }

  /// Adds the point and the force, along the axes of the world.
  void addDofs() {
    const KinematicModel& before = path_.state(-path_.grid().order()).model();
    const std::string wanted = cat("poa_", spec_.object, "_", spec_.from, "_", path_.grid().timeOf(from_));
    name_ = wanted;
    for (int count = 2; before.frame_index.contains(name_); ++count) name_ = cat(wanted, "_", count);
    path_.beginModes();
    Attachment three;
    three.type = JointType::trans3;
    three.stable = false;
    contact_.point = path_.addDofs(name_, from_, to_, three);
    contact_.dofs = path_.addDofs(name_ + "_force", from_, to_, three);
  }

  /// Initializes the point halfway between the bodies, and the force along the normal.
  void startBetweenBodies() {
    for (int t = from_; t <= to_; ++t) {
      const State& now = path_.state(t);
      VectorXd q = now.q();
      const auto& X_W0 = now.pose(0);  // pose of the parent frame of the dofs
      const Vector3d normal = nearest(now, Witness::Kind::normal, contact_);
      const Vector3d middle =
          .5 * (nearest(now, Witness::Kind::point_a, contact_) + nearest(now, Witness::Kind::point_b, contact_));
      q.segment<3>(now.model().frame_dofs[contact_.point].first) = X_W0.R.transpose() * (middle - X_W0.p);
      q.segment<3>(now.model().frame_dofs[contact_.dofs].first) = kInitialForce * normal;
      path_.setSlice(t, q.data());
    }
  }

  void requireKind() {
    switch (spec_.kind) {
      case ForceExchange::slide:
        return slide();
      case ForceExchange::stick:
        return stick();
      case ForceExchange::complementary:
        return makeComplementary();
      case ForceExchange::bounce:
        return bounce();
    }
  }

  void slide() {
    touch(1e1);
    require(recipe("pullingForce"), pair_, ineq, 1e2);
    require(recipe("forceAlongNormal"), pair_, eq, 1e1);
  }

  void stick() {
    touch(1e2);
    if (path_.grid().order() == 0)  // the cone's axis points away from the other body
      return require(recipe("frictionCone", spec_.friction), pair_, ineq, 1.);
    require(recipe("pullingForce"), pair_, ineq, 1e1);
    require(recipe("slidingVelocity"), pair_, eq, 1., 1, 1);
  }

  void makeComplementary() {
    require(recipe("forceAlongNormal"), pair_, eq, 1e2);
    require(recipe("pullingForce"), pair_, ineq, 1e2);
    require(recipe("forceTimesDistance"), pair_, eq, 1e2);
    if (path_.grid().order() >= 1) require(recipe("forceTimesVelocity"), pair_, eq, 1e2, 1);
    require(FeatureSymbol::distance, pair_, ineq, 1e1);
  }

  void bounce() {
    touch(1e1);
    require(recipe("forceAlongNormal"), pair_, eq, 1e1);
    require(recipe("pullingForce"), pair_, ineq, 1e1);
    if (to_ + 1 >= path_.grid().slices()) return;
    motion_.require({.feature = recipe("elasticBounce", kElasticity),
                     .frames = pair_,
                     .type = eq,
                     .scale = MatrixXd::Constant(1, 1, 1e1),
                     .order = 2,
                     .times = {path_.grid().timeOf(to_ + 1)}});
  }

  void touch(double scale) {
    require(FeatureSymbol::distance, {spec_.object, name_}, eq, scale);
    require(FeatureSymbol::distance, {spec_.from, name_}, eq, scale);
    require(FeatureSymbol::distance, pair_, eq, 1e1);
  }

  /// Adds costs on the force, and on changes of the force and the point.
  void addCosts() {
    const FeatureSource force = recipe("force");
    require(force, pair_, sos, 1e-4, 0);
    const int smooth = std::min(path_.grid().order(), 2);
    if (smooth == 0) return;
    if (spec_.kind != ForceExchange::bounce) require(force, pair_, sos, 1e-2, smooth, smooth);
    require(FeatureSymbol::position, {name_}, sos, 1e-2, smooth, smooth);
  }

  FeatureSource recipe(const char* quantity, double parameter = 0.) const {
    return FeatureRecipe{quantity, contact_, parameter};
  }

  /// Adds an objective in all slices of the contact except the first `skipped` ones.
  void require(const FeatureSource& feature, const std::vector<std::string>& frames, ObjectiveType type, double scale,
               int order = -1, int skipped = 0) {
    if (from_ + skipped > to_) return;
    motion_.require({.feature = feature,
                     .frames = frames,
                     .type = type,
                     .scale = MatrixXd::Constant(1, 1, scale),
                     .order = order,
                     .times = {path_.grid().timeOf(from_), path_.grid().timeOf(to_)}},
                    skipped);
  }

  MotionProblem& motion_;
  Path& path_;
  const ForceExchangeSpec& spec_;
  std::vector<std::string> pair_;
  ContactForce contact_;
  std::string name_;
  int from_ = 0, to_ = 0;
};

}  // namespace

ForceExchange forceExchangeFromName(const std::string& name) {
  static const std::vector<std::string> names = {"slide", "stick", "complementary", "bounce"};
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end())
    throw NameError(
        cat("there is no contact of kind '", name, "'", similarHint(name, names), "; there are ", join(names)));
  return ForceExchange(place - names.begin());
}

std::string komo_internal::addForceExchange(MotionProblem& motion, const ForceExchangeSpec& spec) {
  return ForceExchangeBuilder(motion, spec).add();
}

}  // namespace kinegraph
