#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

namespace {

constexpr double kElasticity = .9;
constexpr double kFirstForce = .1;  ///< in weights; not zero, where a cone of friction has its tip

Vector3d nearest(const State& state, Witness::Kind kind, int object, int onto) {
  const State* states[] = {&state};
  Vector3d value;
  Witness(kind, object, onto).eval(states, 1., value, nullptr);
  return value;
}

}  // namespace

Komo::Exchange exchangeFromName(const std::string& name) {
  static const std::vector<std::string> names = {"slide", "stick", "complementary", "bounce"};
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end())
    throw NameError(
        cat("there is no contact of kind '", name, "'", similarHint(name, names), "; there are ", join(names)));
  return Komo::Exchange(place - names.begin());
}

std::string Komo::addExchange(const std::vector<double>& times, const std::string& object, const std::string& onto,
                              Exchange kind, double friction) {
  requireBuilt("addExchange");
  const Program& before = state(-order_).program();
  ContactForce contact;
  contact.object = frameId(before, object, "contact");
  contact.onto = frameId(before, onto, "contact");
  if (contact.object == contact.onto) throw ValueError(cat("contact: '", object, "' cannot push itself"));
  if (!(friction > 0.))
    throw ValueError(cat("contact: the coefficient of friction is ", friction, "; expected a positive number"));
  if (kind == Exchange::bounce && order_ < 2) {
    throw ValueError(cat("bounce of '", object, "' off '", onto,
                         "': speeds before and after it need a KOMO with kOrder 2; this one has ", order_));
  }
  auto [from, to] = selectSlices(times);
  if (kind == Exchange::bounce) to = from;
  if (from > to || from >= slices_)
    throw ValueError(cat("contact between '", object, "' and '", onto, "': its times select no slice"));
  const double start = double(from + 1) / slices_per_phase_, end = double(to + 1) / slices_per_phase_;
  const auto& masses = state(-order_).parameters().frame_mass;
  const double mass = masses[contact.object].mass > 0. ? masses[contact.object].mass : masses[contact.onto].mass;
  contact.unit = -kGravity.z() * (mass > 0. ? mass : 1.);
  contact.is_free = true;

  makeModes();
  std::string name = cat("poa_", object, "_", onto, "_", start);
  for (int count = 2; before.frame_index.contains(name); ++count)
    name = cat("poa_", object, "_", onto, "_", start, "_", count);
  Attachment three;  // along the axes of the world
  three.type = JointType::trans3;
  three.stable = false;
  contact.point = addDofs(name, from, to, three);
  contact.dofs = addDofs(name + "_force", from, to, three);
  for (int t = from; t <= to; ++t) {
    const State& now = state(t);
    VectorXd q = now.q();
    const auto& X_W0 = now.pose(0);  // of the frame that the dofs hang below
    const Vector3d normal = nearest(now, Witness::Kind::normal, contact.object, contact.onto);
    const Vector3d middle = .5 * (nearest(now, Witness::Kind::point_a, contact.object, contact.onto) +
                                  nearest(now, Witness::Kind::point_b, contact.object, contact.onto));
    q.segment<3>(now.program().frame_dofs[contact.point].first) = X_W0.R.transpose() * (middle - X_W0.p);
    q.segment<3>(now.program().frame_dofs[contact.dofs].first) = kFirstForce * normal;
    setSlice(t, q.data());
  }

  const auto require = [&](FeatureSource feature, std::vector<std::string> frames, ObjectiveType type, double scale,
                           int order = -1, int later = 0) {
    if (from + later > to) return;
    std::string what = feature.name();
    add({std::move(what),
         std::move(feature),
         std::move(frames),
         type,
         MatrixXd::Constant(1, 1, scale),
         {},
         order,
         {start, end},
         0,
         0},
        later, 0);
  };
  using enum ObjectiveType;
  const std::vector<std::string> pair = {object, onto};
  const auto touch = [&](double scale) {
    require(FeatureSymbol::distance, {object, name}, eq, scale);
    require(FeatureSymbol::distance, {onto, name}, eq, scale);
    require(FeatureSymbol::distance, pair, eq, 1e1);
  };
  const auto about = [&](const char* what, double parameter = 0.) {
    return FeatureSource(FeatureRecipe{what, contact, parameter});
  };
  const FeatureSource along_normal = about("forceAlongNormal"), pulling = about("pullingForce"), force = about("force");
  const int smooth = std::min(order_, 2);
  switch (kind) {
    case Exchange::slide:
      touch(1e1);
      require(pulling, pair, ineq, 1e2);
      require(along_normal, pair, eq, 1e1);
      break;
    case Exchange::stick:
      touch(1e2);
      if (order_ == 0) {  // the cone points away from the other body
        require(about("frictionCone", friction), pair, ineq, 1.);
      } else {
        require(pulling, pair, ineq, 1e1);
        require(about("slidingVelocity"), pair, eq, 1., 1, 1);
      }
      break;
    case Exchange::complementary:
      require(along_normal, pair, eq, 1e2);
      require(pulling, pair, ineq, 1e2);
      require(about("forceTimesDistance"), pair, eq, 1e2);
      if (order_ >= 1) require(about("forceTimesVelocity"), pair, eq, 1e2, 1);
      require(FeatureSymbol::distance, pair, ineq, 1e1);
      break;
    case Exchange::bounce:
      touch(1e1);
      require(along_normal, pair, eq, 1e1);
      require(pulling, pair, ineq, 1e1);
      if (to + 1 < slices_) {
        const double after = double(to + 2) / slices_per_phase_;
        add({"elasticBounce",
             about("elasticBounce", kElasticity),
             pair,
             eq,
             MatrixXd::Constant(1, 1, 1e1),
             {},
             2,
             {after},
             0,
             0},
            0, 0);
      }
      break;
  }
  require(force, pair, sos, 1e-4, 0);
  if (smooth > 0) {
    if (kind != Exchange::bounce) require(force, pair, sos, 1e-2, smooth, smooth);
    require(FeatureSymbol::position, {name}, sos, 1e-2, smooth, smooth);
  }
  contacts_.push_back(contact);
  return name;
}

}  // namespace kinegraph
