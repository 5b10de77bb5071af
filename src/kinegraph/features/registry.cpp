#include "kinegraph/features/registry.h"

#include <numeric>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/box.h"
#include "kinegraph/features/collisions.h"
#include "kinegraph/features/distance.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/features/joints.h"
#include "kinegraph/features/masses.h"
#include "kinegraph/features/orientation.h"
#include "kinegraph/features/position.h"
#include "kinegraph/features/stacked.h"
#include "kinegraph/features/velocity.h"
#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph {

namespace {

using S = FeatureSymbol;

template <class... Parts>
std::unique_ptr<Feature> stack(std::unique_ptr<Parts>... parts) {
  std::vector<std::unique_ptr<Feature>> list;
  (list.push_back(std::move(parts)), ...);
  return std::make_unique<Stacked>(std::move(list));
}

/// The dofs of the joints of these frames; all dofs if there are no frames.
std::vector<int> dofsOf(const std::vector<int>& frames, const Program& program, const FeatureInfo& info) {
  std::vector<int> dofs;
  if (frames.empty()) {
    dofs.resize(program.dofs);
    std::iota(dofs.begin(), dofs.end(), 0);
  }
  for (int frame : frames) {
    const Program::DofRange range = program.frame_dofs[frame];
    if (range.count == 0)
      throw ValueError(cat(info.name, ": frame '", program.frame_name[frame], "' has no active joint of its own"));
    for (int i = 0; i < range.count; ++i) dofs.push_back(range.first + i);
  }
  return dofs;
}

const Geometry& boxOf(int frame, const Program& program, const FeatureInfo& info) {
  const auto& geometry = program.geometry[frame];
  if (!geometry || (geometry->type != ShapeType::ssBox && geometry->type != ShapeType::box)) {
    throw ValueError(
        cat(info.name, ": frame '", program.frame_name[frame], "' must have a shape of type ssBox or box"));
  }
  return *geometry;
}

/// Extent of a shape along its own z axis, m.
double heightOf(int frame, const Program& program) {
  const auto& geometry = program.geometry[frame];
  if (!geometry) return 0.;
  const std::vector<double>& s = geometry->size;
  switch (geometry->type) {
    case ShapeType::box:
    case ShapeType::ssBox:
      return s[2];
    case ShapeType::sphere:
      return 2. * s[0];
    case ShapeType::capsule:
      return s[0] + 2. * s[1];
    case ShapeType::cylinder:
    case ShapeType::ssCylinder:
      return s[0];
    default:
      return 0.;
  }
}

std::vector<FeatureInfo> makeRegistry() {
  std::vector<FeatureInfo> list;
  const auto add = [&](S symbol, const char* name, int min_frames, int max_frames, bool available = true) {
    list.push_back({symbol, name, min_frames, max_frames, available});
  };
  add(S::position, "position", 1, 1);
  add(S::positionDiff, "positionDiff", 2, 2);
  add(S::positionRel, "positionRel", 2, 2);
  add(S::quaternion, "quaternion", 1, 1);
  add(S::quaternionDiff, "quaternionDiff", 2, 2);
  add(S::quaternionRel, "quaternionRel", 2, 2);
  add(S::pose, "pose", 1, 1);
  add(S::poseDiff, "poseDiff", 2, 2);
  add(S::poseRel, "poseRel", 2, 2);
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = cat("vector", "XYZ"[axis]);
    list.push_back({S(int(S::vectorX) + 3 * axis), name, 1, 1, true});
    list.push_back({S(int(S::vectorXDiff) + 3 * axis), name + "Diff", 2, 2, true});
    list.push_back({S(int(S::vectorXRel) + 3 * axis), name + "Rel", 2, 2, true});
  }
  add(S::scalarProductXX, "scalarProductXX", 2, 2);
  add(S::scalarProductXY, "scalarProductXY", 2, 2);
  add(S::scalarProductXZ, "scalarProductXZ", 2, 2);
  add(S::scalarProductYX, "scalarProductYX", 2, 2);
  add(S::scalarProductYY, "scalarProductYY", 2, 2);
  add(S::scalarProductYZ, "scalarProductYZ", 2, 2);
  add(S::scalarProductZX, "scalarProductZX", 2, 2);
  add(S::scalarProductZY, "scalarProductZY", 2, 2);
  add(S::scalarProductZZ, "scalarProductZZ", 2, 2);
  add(S::gazeAt, "gazeAt", 2, 2);
  add(S::angularVel, "angularVel", 1, 1);
  add(S::accumulatedCollisions, "accumulatedCollisions", 0, -1);
  add(S::pairCollisions, "pairCollisions", 0, -1);
  add(S::jointLimits, "jointLimits", 0, -1);
  add(S::distance, "distance", 2, 2);
  add(S::distance, "negDistance", 2, 2);
  add(S::oppose, "oppose", 3, 3);
  add(S::qItself, "qItself", 0, -1);
  add(S::qItself, "jointState", 0, -1);
  add(S::aboveBox, "aboveBox", 2, 2);
  add(S::insideBox, "insideBox", 2, 2);
  add(S::pairCollision_negScalar, "pairCollision_negScalar", 2, 2);
  add(S::pairCollision_vector, "pairCollision_vector", 2, 2);
  add(S::pairCollision_normal, "pairCollision_normal", 2, 2);
  add(S::pairCollision_p1, "pairCollision_p1", 2, 2);
  add(S::pairCollision_p2, "pairCollision_p2", 2, 2);
  add(S::standingAbove, "standingAbove", 2, 2);
  add(S::totalForce, "totalForce", 1, 1);
  add(S::physics, "physics", 1, 1);
  add(S::contactConstraints, "contactConstraints", 2, 2);
  add(S::energy, "energy", 1, -1);
  add(S::EqCenterOfMass, "EqCenterOfMass", 1, -1);
  add(S::transAccelerations, "transAccelerations", 0, -1, false);
  add(S::transVelocities, "transVelocities", 0, -1, false);
  add(S::qQuaternionNorms, "qQuaternionNorms", 0, 0);
  add(S::opposeCentral, "opposeCentral", 3, 3);
  add(S::linangVel, "linangVel", 1, 1);
  add(S::AlignXWithDiff, "AlignXWithDiff", 2, 2);
  add(S::AlignYWithDiff, "AlignYWithDiff", 2, 2);
  return list;
}

std::string framesWanted(const FeatureInfo& info) {
  if (info.max_frames < 0) return cat(info.min_frames, " or more frames");
  return cat(info.min_frames, info.min_frames == 1 ? " frame" : " frames");
}

}  // namespace

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
      if (!list[number]) list[number] = &info;  // before its aliases
    }
    return list;
  }();
  const auto number = std::size_t(symbol);
  if (number < by_number.size() && by_number[number]) return *by_number[number];
  throw NameError(cat("feature symbol ", int(symbol), " does not exist"));
}

FeatureSymbol featureSymbolFromName(std::string_view name) {
  std::vector<std::string> names;
  for (const FeatureInfo& info : featureRegistry()) {
    if (info.name == name) return info.symbol;
    names.push_back(info.name);
  }
  throw NameError(cat("there is no feature '", name, "'", similarHint(name, names)));
}

std::unique_ptr<Feature> makeFeature(FeatureSymbol symbol, const std::vector<int>& frames, const Program& program) {
  const FeatureInfo& info = featureInfo(symbol);
  const int count = int(frames.size());
  if (count < info.min_frames || (info.max_frames >= 0 && count > info.max_frames)) {
    throw ValueError(cat(info.name, " takes ", framesWanted(info), ", got ", count));
  }
  if (!info.available) {
    throw ValueError(cat(info.name, " is obsolete; use position with order 1 or 2"));
  }
  const int a = count > 0 ? frames[0] : -1, b = count > 1 ? frames[1] : -1, c = count > 2 ? frames[2] : -1;
  switch (symbol) {
    case S::position:
      return std::make_unique<Position>(Position::Kind::world, a);
    case S::positionDiff:
      return std::make_unique<Position>(Position::Kind::difference, a, b);
    case S::positionRel:
      return std::make_unique<Position>(Position::Kind::relative, a, b);
    case S::quaternion:
      return std::make_unique<Orientation>(Orientation::Kind::world, a);
    case S::quaternionDiff:
      return std::make_unique<Orientation>(Orientation::Kind::difference, a, b);
    case S::quaternionRel:
      return std::make_unique<Orientation>(Orientation::Kind::relative, a, b);
    case S::pose:
      return stack(std::make_unique<Position>(Position::Kind::world, a),
                   std::make_unique<Orientation>(Orientation::Kind::world, a));
    case S::poseDiff:
      return stack(std::make_unique<Position>(Position::Kind::difference, a, b),
                   std::make_unique<Orientation>(Orientation::Kind::difference, a, b));
    case S::poseRel:
      return stack(std::make_unique<Position>(Position::Kind::relative, a, b),
                   std::make_unique<Orientation>(Orientation::Kind::relative, a, b));
    case S::vectorX:
    case S::vectorY:
    case S::vectorZ:
      return std::make_unique<Axis>(Axis::Kind::world, (int(symbol) - int(S::vectorX)) / 3, a);
    case S::vectorXDiff:
    case S::vectorYDiff:
    case S::vectorZDiff:
      return std::make_unique<Axis>(Axis::Kind::difference, (int(symbol) - int(S::vectorXDiff)) / 3, a, b);
    case S::vectorXRel:
    case S::vectorYRel:
    case S::vectorZRel:
      return std::make_unique<Axis>(Axis::Kind::relative, (int(symbol) - int(S::vectorXRel)) / 3, a, b);
    case S::scalarProductXX:
      return std::make_unique<AxisProduct>(0, 0, a, b);
    case S::scalarProductXY:
      return std::make_unique<AxisProduct>(0, 1, a, b);
    case S::scalarProductXZ:
      return std::make_unique<AxisProduct>(0, 2, a, b);
    case S::scalarProductYX:
      return std::make_unique<AxisProduct>(1, 0, a, b);
    case S::scalarProductYY:
      return std::make_unique<AxisProduct>(1, 1, a, b);
    case S::scalarProductYZ:
      return std::make_unique<AxisProduct>(1, 2, a, b);
    case S::scalarProductZX:
      return std::make_unique<AxisProduct>(2, 0, a, b);
    case S::scalarProductZY:
      return std::make_unique<AxisProduct>(2, 1, a, b);
    case S::scalarProductZZ:
      return std::make_unique<AxisProduct>(2, 2, a, b);
    case S::gazeAt:
      return std::make_unique<Position>(Position::Kind::relative, a, b, 2);
    case S::angularVel:
      return std::make_unique<AngularVelocity>(a);
    case S::linangVel:
      return stack(std::make_unique<LinearVelocity>(a), std::make_unique<AngularVelocity>(a));
    case S::energy:
      return std::make_unique<Energy>(frames);
    case S::EqCenterOfMass:
      return std::make_unique<CenterOfMassOffset>(a, std::vector<int>(frames.begin() + 1, frames.end()));
    case S::physics:
      return std::make_unique<FreeFlight>(a, -kGravity.z());
    case S::totalForce:
      return std::make_unique<TotalForce>(a, std::vector<ContactForce>());
    case S::contactConstraints:
      return std::make_unique<TangentialForce>(a, b, std::vector<ContactForce>());
    case S::AlignXWithDiff:
      return std::make_unique<AlignWithMotion>(0, a, b);
    case S::AlignYWithDiff:
      return std::make_unique<AlignWithMotion>(1, a, b);
    case S::accumulatedCollisions:
      return std::make_unique<AccumulatedCollisions>(frames, program);
    case S::pairCollisions:
      return std::make_unique<PairCollisions>(frames, program);
    case S::jointLimits:
      return std::make_unique<JointLimits>(dofsOf(frames, program, info), program);
    case S::qItself:
      return std::make_unique<JointState>(dofsOf(frames, program, info));
    case S::qQuaternionNorms:
      return std::make_unique<QuaternionNorms>(program.unit_norms);
    case S::distance:
    case S::pairCollision_negScalar:
      return std::make_unique<NegDistance>(a, b);
    case S::pairCollision_vector:
      return std::make_unique<Witness>(Witness::Kind::vector, a, b);
    case S::pairCollision_normal:
      return std::make_unique<Witness>(Witness::Kind::normal, a, b);
    case S::pairCollision_p1:
      return std::make_unique<Witness>(Witness::Kind::point_a, a, b);
    case S::pairCollision_p2:
      return std::make_unique<Witness>(Witness::Kind::point_b, a, b);
    case S::oppose:
      return std::make_unique<Oppose>(a, b, c, false);
    case S::opposeCentral:
      return std::make_unique<Oppose>(a, b, c, true);
    case S::aboveBox:
      return std::make_unique<BoxRegion>(BoxRegion::Kind::above, a, b, boxOf(b, program, info));
    case S::insideBox:
      return std::make_unique<BoxRegion>(BoxRegion::Kind::inside, a, b, boxOf(b, program, info));
    case S::standingAbove:
      return std::make_unique<StandingAbove>(a, b, .5 * (heightOf(a, program) + heightOf(b, program)));
    default:
      throw ValueError(cat(info.name, " is not available"));
  }
}

}  // namespace kinegraph
