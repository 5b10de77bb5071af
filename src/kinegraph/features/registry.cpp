#include "kinegraph/features/feature_source.h"

#include <numeric>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/box.h"
#include "kinegraph/features/collisions.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/features/feature.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/features/joints.h"
#include "kinegraph/features/masses.h"
#include "kinegraph/features/orientation.h"
#include "kinegraph/features/position.h"
#include "kinegraph/features/stacked.h"
#include "kinegraph/features/velocity.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph {

namespace {

using S = FeatureSymbol;
using Ids = std::vector<int>;
using Made = std::unique_ptr<Feature>;

template <class... Parts>
Made stack(std::unique_ptr<Parts>... parts) {
  std::vector<std::unique_ptr<Feature>> list;
  (list.push_back(std::move(parts)), ...);
  return std::make_unique<Stacked>(std::move(list));
}

/// The dofs of the joints of these frames; all dofs if there are no frames.
Ids dofsOf(const Ids& frames, const KinematicModel& model, const FeatureInfo& info) {
  Ids dofs;
  if (frames.empty()) {
    dofs.resize(model.dofs);
    std::iota(dofs.begin(), dofs.end(), 0);
  }
  for (int frame : frames) {
    const KinematicModel::DofRange range = model.frame_dofs[frame];
    if (range.count == 0)
      throw ValueError(cat(info.name, ": frame '", model.frame_name[frame], "' has no active joint of its own"));
    for (int i = 0; i < range.count; ++i) dofs.push_back(range.first + i);
  }
  return dofs;
}

const Geometry& boxOf(int frame, const KinematicModel& model, const FeatureInfo& info) {
  const auto& geometry = model.geometry[frame];
  if (!geometry || shapeKind(geometry->type).body != ShapeKind::Body::box) {
    throw ValueError(cat(info.name, ": frame '", model.frame_name[frame], "' must have a shape of type ssBox or box"));
  }
  return *geometry;
}

/// Returns the extent of a shape along its own z axis, m.
double heightOf(int frame, const KinematicModel& model) {
  const auto& geometry = model.geometry[frame];
  return geometry ? shapeHeight(geometry->type, geometry->size) : 0.;
}

// Makers of families of features.

template <Position::Kind kind>
Made position(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  if constexpr (kind == Position::Kind::world) return std::make_unique<Position>(kind, f[0]);
  return std::make_unique<Position>(kind, f[0], f.back());
}

template <Orientation::Kind kind>
Made orientation(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  if constexpr (kind == Orientation::Kind::world) return std::make_unique<Orientation>(kind, f[0]);
  return std::make_unique<Orientation>(kind, f[0], f.back());
}

template <Position::Kind of_position, Orientation::Kind of_orientation>
Made pose(const FeatureInfo& info, const Ids& f, const KinematicModel& model) {
  return stack(position<of_position>(info, f, model), orientation<of_orientation>(info, f, model));
}

template <Axis::Kind kind, int which>
Made axis(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  if constexpr (kind == Axis::Kind::world) return std::make_unique<Axis>(kind, which, f[0]);
  return std::make_unique<Axis>(kind, which, f[0], f.back());
}

template <int of_a, int of_b>
Made axisProduct(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  return std::make_unique<AxisProduct>(of_a, of_b, f[0], f[1]);
}

template <Witness::Kind kind>
Made witness(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  return std::make_unique<Witness>(kind, f[0], f[1]);
}

template <class T>
Made oneFrame(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  return std::make_unique<T>(f[0]);
}

template <class T>
Made twoFrames(const FeatureInfo&, const Ids& f, const KinematicModel&) {
  return std::make_unique<T>(f[0], f[1]);
}

std::vector<FeatureInfo> makeRegistry() {
  using U = FeatureUnit;
  constexpr U none = U::none, m = U::meter, joint = U::joint, quat = U::quaternion, unit = U::direction,
              cos = U::cosine, m_s = U::meter_per_second, rad_s = U::radian_per_second, newton = U::newton,
              newton_m = U::newton_meter, joule = U::joule;
  constexpr FeatureDofs ofFrames = FeatureDofs::of_frames, ofJoints = FeatureDofs::of_joints,
                        ofScene = FeatureDofs::of_scene;
  // symbol, name, alias, frames (roles, min, max), rows, units, order, second derivatives, dofs, report, value, maker
  return {
      {S::position, "position", nullptr, "a", 1, 1, "3", m, m, 0, true, ofFrames, "F_Position", "p_a",
       position<Position::Kind::world>},
      {S::positionDiff, "positionDiff", nullptr, "a b", 2, 2, "3", m, m, 0, true, ofFrames, "F_PositionDiff",
       "p_a - p_b", position<Position::Kind::difference>},
      {S::positionRel, "positionRel", nullptr, "a b", 2, 2, "3", m, m, 0, true, ofFrames, "F_PositionRel",
       "p_a in the coordinates of b", position<Position::Kind::relative>},
      {S::quaternion, "quaternion", nullptr, "a", 1, 1, "4", quat, quat, 0, false, ofFrames, "F_Quaternion",
       "the quaternion of a", orientation<Orientation::Kind::world>},
      {S::quaternionDiff, "quaternionDiff", nullptr, "a b", 2, 2, "4", quat, quat, 0, false, ofFrames,
       "F_QuaternionDiff", "q_a - q_b, with the nearer sign", orientation<Orientation::Kind::difference>},
      {S::quaternionRel, "quaternionRel", nullptr, "a b", 2, 2, "4", quat, quat, 0, false, ofFrames, "F_QuaternionRel",
       "the quaternion of a relative to b", orientation<Orientation::Kind::relative>},
      {S::pose, "pose", nullptr, "a", 1, 1, "7", m, quat, 0, false, ofFrames, "F_Pose", "position, then quaternion",
       pose<Position::Kind::world, Orientation::Kind::world>},
      {S::poseDiff, "poseDiff", nullptr, "a b", 2, 2, "7", m, quat, 0, false, ofFrames, "F_PoseDiff",
       "positionDiff, then quaternionDiff", pose<Position::Kind::difference, Orientation::Kind::difference>},
      {S::poseRel, "poseRel", nullptr, "a b", 2, 2, "7", m, quat, 0, false, ofFrames, "F_PoseRel",
       "positionRel, then quaternionRel", pose<Position::Kind::relative, Orientation::Kind::relative>},
      {S::vectorX, "vectorX", nullptr, "a", 1, 1, "3", unit, unit, 0, true, ofFrames, "F_Vector", "the x axis of a",
       axis<Axis::Kind::world, 0>},
      {S::vectorXDiff, "vectorXDiff", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorDiff",
       "the x axis of a minus that of b", axis<Axis::Kind::difference, 0>},
      {S::vectorXRel, "vectorXRel", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorRel",
       "the x axis of a in the coordinates of b", axis<Axis::Kind::relative, 0>},
      {S::vectorY, "vectorY", nullptr, "a", 1, 1, "3", unit, unit, 0, true, ofFrames, "F_Vector", "the y axis of a",
       axis<Axis::Kind::world, 1>},
      {S::vectorYDiff, "vectorYDiff", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorDiff",
       "the y axis of a minus that of b", axis<Axis::Kind::difference, 1>},
      {S::vectorYRel, "vectorYRel", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorRel",
       "the y axis of a in the coordinates of b", axis<Axis::Kind::relative, 1>},
      {S::vectorZ, "vectorZ", nullptr, "a", 1, 1, "3", unit, unit, 0, true, ofFrames, "F_Vector", "the z axis of a",
       axis<Axis::Kind::world, 2>},
      {S::vectorZDiff, "vectorZDiff", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorDiff",
       "the z axis of a minus that of b", axis<Axis::Kind::difference, 2>},
      {S::vectorZRel, "vectorZRel", nullptr, "a b", 2, 2, "3", unit, unit, 0, true, ofFrames, "F_VectorRel",
       "the z axis of a in the coordinates of b", axis<Axis::Kind::relative, 2>},
      {S::scalarProductXX, "scalarProductXX", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "x axis of a times x axis of b", axisProduct<0, 0>},
      {S::scalarProductXY, "scalarProductXY", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "x axis of a times y axis of b", axisProduct<0, 1>},
      {S::scalarProductXZ, "scalarProductXZ", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "x axis of a times z axis of b", axisProduct<0, 2>},
      {S::scalarProductYX, "scalarProductYX", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "y axis of a times x axis of b", axisProduct<1, 0>},
      {S::scalarProductYY, "scalarProductYY", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "y axis of a times y axis of b", axisProduct<1, 1>},
      {S::scalarProductYZ, "scalarProductYZ", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "y axis of a times z axis of b", axisProduct<1, 2>},
      {S::scalarProductZX, "scalarProductZX", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "z axis of a times x axis of b", axisProduct<2, 0>},
      {S::scalarProductZY, "scalarProductZY", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "z axis of a times y axis of b", axisProduct<2, 1>},
      {S::scalarProductZZ, "scalarProductZZ", nullptr, "a b", 2, 2, "1", cos, cos, 0, true, ofFrames, "F_ScalarProduct",
       "z axis of a times z axis of b", axisProduct<2, 2>},
      {S::gazeAt, "gazeAt", nullptr, "object camera", 2, 2, "2", m, m, 0, true, ofFrames, "F_GazeAt",
       "x and y of the object in the coordinates of the camera",
       [](auto&, const Ids& f, auto&) -> Made {
         return std::make_unique<Position>(Position::Kind::relative, f[0], f[1], 2);
       }},
      {S::qItself, "qItself", "jointState", "joints", 0, -1, "1 per dof", joint, joint, 0, false, ofJoints, "F_qItself",
       "q, or the dofs of some joints",
       [](auto& info, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<JointState>(dofsOf(f, model, info));
       }},
      {S::jointLimits, "jointLimits", nullptr, "joints", 0, -1, "2 per dof", joint, joint, 0, false, ofJoints,
       "F_qLimits", "lower - q, then q - upper; all at most 0 within the limits",
       [](auto& info, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<JointLimits>(dofsOf(f, model, info), model);
       }},
      {S::qQuaternionNorms, "qQuaternionNorms", nullptr, "", 0, 0, "1 per quaternion", none, none, 0, false, ofScene,
       "F_qQuaternionNorms", "square of its norm, minus 1",
       [](auto&, const Ids&, const KinematicModel& model) -> Made {
         return std::make_unique<QuaternionNorms>(model.unit_norms);
       }},
      {S::distance, "distance", "negDistance", "a b", 2, 2, "1", m, m, 0, false, ofFrames, "F_PairCollision",
       "**minus** the signed distance: positive is the penetration depth", twoFrames<NegDistance>},
      {S::pairCollision_negScalar, "pairCollision_negScalar", nullptr, "a b", 2, 2, "1", m, m, 0, false, ofFrames,
       "F_PairCollision", "the same as distance", twoFrames<NegDistance>},
      {S::pairCollision_vector, "pairCollision_vector", nullptr, "a b", 2, 2, "3", m, m, 0, false, ofFrames,
       "F_PairCollision", "from the nearest point of b to that of a", witness<Witness::Kind::vector>},
      {S::pairCollision_normal, "pairCollision_normal", nullptr, "a b", 2, 2, "3", unit, unit, 0, false, ofFrames,
       "F_PairCollision", "the unit normal from b to a", witness<Witness::Kind::normal>},
      {S::pairCollision_p1, "pairCollision_p1", nullptr, "a b", 2, 2, "3", m, m, 0, false, ofFrames, "F_PairCollision",
       "the nearest point of a", witness<Witness::Kind::point_a>},
      {S::pairCollision_p2, "pairCollision_p2", nullptr, "a b", 2, 2, "3", m, m, 0, false, ofFrames, "F_PairCollision",
       "the nearest point of b", witness<Witness::Kind::point_b>},
      {S::accumulatedCollisions, "accumulatedCollisions", nullptr, "bodies", 0, -1, "1", m, m, 0, false, ofScene,
       "F_AccumulatedCollisions", "sum of all overlaps (of these frames)",
       [](auto&, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<AccumulatedCollisions>(f, model, PairChoice::scene);
       }},
      {S::pairCollisions, "pairCollisions", nullptr, "bodies", 0, -1, "1 per pair", m, m, 0, false, ofScene,
       "F_PairCollisions", "penetration depth of each pair that may collide",
       [](auto&, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<PairCollisions>(f, model, PairChoice::scene);
       }},
      {S::oppose, "oppose", nullptr, "finger finger object", 3, 3, "3", m, m, 0, false, ofFrames, "F_Oppose",
       "zero if the fingers face each other across the object",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<Oppose>(f[0], f[1], f[2], false); }},
      {S::opposeCentral, "opposeCentral", nullptr, "finger finger object", 3, 3, "6", m, unit, 0, false, ofFrames,
       "F_OpposeCentral", "as oppose; also zero if their normals are collinear",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<Oppose>(f[0], f[1], f[2], true); }},
      {S::aboveBox, "aboveBox", nullptr, "object box", 2, 2, "4", m, m, 0, false, ofFrames, "F_AboveBox",
       "all at most 0 if the object is above the box",
       [](auto& info, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<BoxRegion>(BoxRegion::Kind::above, f[0], f[1], boxOf(f[1], model, info));
       }},
      {S::insideBox, "insideBox", nullptr, "object box", 2, 2, "6", m, m, 0, false, ofFrames, "F_InsideBox",
       "all at most 0 if the object is inside of the box",
       [](auto& info, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<BoxRegion>(BoxRegion::Kind::inside, f[0], f[1], boxOf(f[1], model, info));
       }},
      {S::standingAbove, "standingAbove", nullptr, "object box", 2, 2, "1", m, m, 0, false, ofFrames, "F_StandingAbove",
       "zero if the object stands on the box",
       [](auto&, const Ids& f, const KinematicModel& model) -> Made {
         return std::make_unique<StandingAbove>(f[0], f[1], .5 * (heightOf(f[0], model) + heightOf(f[1], model)));
       }},
      {S::angularVel, "angularVel", nullptr, "a", 1, 1, "3", rad_s, rad_s, 1, false, ofFrames, "F_AngVel",
       "angular velocity, from two slices", oneFrame<AngularVelocity>},
      {S::linangVel, "linangVel", nullptr, "a", 1, 1, "6", m_s, rad_s, 1, false, ofFrames, "F_LinAngVel",
       "velocity and angular velocity, from two slices",
       [](auto&, const Ids& f, auto&) -> Made {
         return stack(std::make_unique<LinearVelocity>(f[0]), std::make_unique<AngularVelocity>(f[0]));
       }},
      {S::AlignXWithDiff, "AlignXWithDiff", nullptr, "a b", 2, 2, "3", unit, unit, 1, false, ofFrames,
       "F_AlignXWithDiff", "zero if b moves along the x axis of a",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<AlignWithMotion>(0, f[0], f[1]); }},
      {S::AlignYWithDiff, "AlignYWithDiff", nullptr, "a b", 2, 2, "3", unit, unit, 1, false, ofFrames,
       "F_AlignYWithDiff", "zero if b moves along the y axis of a",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<AlignWithMotion>(1, f[0], f[1]); }},
      {S::energy, "energy", nullptr, "masses", 1, -1, "1", joule, joule, 1, false, ofFrames, "F_Energy",
       "kinetic energy of the centers of mass, and potential energy",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<Energy>(f); }},
      {S::EqCenterOfMass, "EqCenterOfMass", nullptr, "a masses", 1, -1, "3", m, m, 0, false, ofScene,
       "F_EqCenterOfMass", "p_a minus the center of the masses",
       [](auto&, const Ids& f, auto&) -> Made {
         return std::make_unique<CenterOfMassOffset>(f[0], Ids(f.begin() + 1, f.end()));
       }},
      {S::physics, "physics", nullptr, "mass", 1, 1, "6", m_s, rad_s, 2, false, ofFrames, "F_NewtonEuler",
       "Newton and Euler with contact forces: zero in free fall; with gyroscopic torques in a KOMO",
       [](auto&, const Ids& f, auto&) -> Made { return std::make_unique<FreeFlight>(f[0], -kGravity.z()); }},
      {S::totalForce, "totalForce", nullptr, "mass", 1, 1, "6", newton, newton_m, 0, false, ofFrames, "F_TotalForce",
       "weight and contact forces, then their torques: zero at rest",
       [](auto&, const Ids& f, auto&) -> Made {
         return std::make_unique<TotalForce>(f[0], std::vector<ContactForce>());
       }},
      {S::contactConstraints, "contactConstraints", nullptr, "a b", 2, 2, "3", newton, newton, 0, false, ofFrames,
       "F_ContactConstraints", "tangential part of the contact force",
       [](auto&, const Ids& f, auto&) -> Made {
         return std::make_unique<TangentialForce>(f[0], f[1], std::vector<ContactForce>());
       }},
      {S::transAccelerations, "transAccelerations", nullptr, "", 0, -1, "", none, none, 0, false, ofFrames,
       "F_TransAccelerations", "obsolete; use position with order 1 or 2", nullptr},
      {S::transVelocities, "transVelocities", nullptr, "", 0, -1, "", none, none, 0, false, ofFrames,
       "F_TransVelocities", "obsolete; use position with order 1 or 2", nullptr},
  };
  // clang-format on
}
std::string expectedFrames(const FeatureInfo& info) {
  if (info.max_frames < 0) return cat(info.min_frames, " or more frames");
  return cat(info.min_frames, info.min_frames == 1 ? " frame" : " frames");
}

}  // namespace

const char* unitName(FeatureUnit unit) {
  switch (unit) {
    case FeatureUnit::none:
      return "-";
    case FeatureUnit::meter:
      return "m";
    case FeatureUnit::radian:
      return "rad";
    case FeatureUnit::joint:
      return "m or rad";
    case FeatureUnit::quaternion:
      return "quaternion";
    case FeatureUnit::direction:
      return "unit vector";
    case FeatureUnit::cosine:
      return "cosine";
    case FeatureUnit::meter_per_second:
      return "m/s";
    case FeatureUnit::radian_per_second:
      return "rad/s";
    case FeatureUnit::newton:
      return "N";
    case FeatureUnit::newton_meter:
      return "N m";
    case FeatureUnit::joule:
      return "J";
  }
  return "-";
}

const std::vector<FeatureInfo>& featureRegistry() {
  static const std::vector<FeatureInfo> registry = makeRegistry();
  return registry;
}

const FeatureInfo& featureInfo(FeatureSymbol symbol) {
  static const std::vector<const FeatureInfo*> by_number = [] {
    std::vector<const FeatureInfo*> list;
    for (const FeatureInfo& info : featureRegistry()) {
      const auto number = std::size_t(info.symbol);
      list.resize(std::max(list.size(), number + 1));
      list[number] = &info;
    }
    return list;
  }();
  const auto number = std::size_t(symbol);
  if (number < by_number.size() && by_number[number]) return *by_number[number];
  throw NameError(cat("feature symbol ", int(symbol), " does not exist"));
}

const std::vector<std::pair<std::string, FeatureSymbol>>& featureNames() {
  static const std::vector<std::pair<std::string, FeatureSymbol>> names = [] {
    std::vector<std::pair<std::string, FeatureSymbol>> list;
    for (const FeatureInfo& info : featureRegistry()) {
      list.emplace_back(info.name, info.symbol);
      if (info.alias) list.emplace_back(info.alias, info.symbol);
    }
    return list;
  }();
  return names;
}

FeatureSymbol featureSymbolFromName(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& [known, symbol] : featureNames()) {
    if (known == name) return symbol;
    names.push_back(known);
  }
  throw NameError(cat("there is no feature '", name, "'", similarHint(name, names)));
}

std::string featureTable() {
  std::string text = "| feature | frames | rows | unit | order | value |\n|---|---|---|---|---|---|\n";
  for (const FeatureInfo& info : featureRegistry()) {
    const std::string unit = unitName(info.unit), later = unitName(info.later_unit);
    const std::string name = info.alias ? cat("`", info.name, "` = `", info.alias, "`") : cat("`", info.name, "`");
    const std::string frames =
        cat(info.min_frames == 0 ? "none" : "", info.min_frames == 0 && info.max_frames ? ", or " : "", info.frames);
    text += info.available()
                ? cat("| ", name, " | ", frames, " | ", info.rows, " | ", unit == later ? unit : cat(unit, "; ", later),
                      " | ", info.order, " | ", info.value, " |\n")
                : cat("| ", name, " | | | | | ", info.value, " |\n");
  }
  return text;
}

Made makeFeature(FeatureSymbol symbol, const Ids& frames, const KinematicModel& model) {
  const FeatureInfo& info = featureInfo(symbol);
  const int count = int(frames.size());
  if (count < info.min_frames || (info.max_frames >= 0 && count > info.max_frames)) {
    throw ValueError(cat(info.name, " takes ", expectedFrames(info), ", got ", count));
  }
  if (!info.available()) throw ValueError(cat(info.name, " is ", info.value));
  return info.make(info, frames, model);
}

}  // namespace kinegraph
