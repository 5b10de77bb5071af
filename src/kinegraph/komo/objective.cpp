#include "kinegraph/komo/objective.h"

#include <algorithm>
#include <iterator>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/collisions.h"
#include "kinegraph/features/joints.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/collision/sampled_collisions.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/komo/path/path_features.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph {

namespace {

using Ids = std::vector<int>;
using Made = std::unique_ptr<Feature>;

/// The joints of the given configuration, or of the frames with these ids, as they are in a slice.
Made jointsIn(const Objective& objective, const Path& path, const Ids& ids, int slice) {
  const KinematicModel &model = path.state(slice).model(), &given = *path.given().model;
  std::vector<JointsOfFrames::Part> parts;
  const Ids& frames = ids.empty() ? path.given().joint_frames : ids;
  parts.reserve(frames.size());
  for (int frame : frames) {
    const int count = model.frame_dofs[frame].count;
    const bool original = frame < int(given.frame_dofs.size());
    if (count == 0 || (ids.empty() && original && count != given.frame_dofs[frame].count)) {
      throw ValueError(cat(objective.name(), ": the joint of frame '", model.frame_name[frame], "' ",
                           ids.empty() ? "was replaced by a mode switch" : "is not there, or not active", " in slice ",
                           slice));
    }
    parts.push_back({frame, 0, count});
  }
  if (!path.layout().plain) return std::make_unique<JointsOfFrames>(std::move(parts));
  Ids dofs;
  dofs.reserve(std::size_t(model.dofs));
  for (const JointsOfFrames::Part& part : parts) {
    for (int i = 0; i < part.count; ++i) dofs.push_back(model.frame_dofs[part.frame].first + i);
  }
  return std::make_unique<JointState>(std::move(dofs));
}

/// The limits of the given configuration's joints whose dofs a slice owns, and of those that all share; joints that were
/// added are limited by bounds.
Made limitsIn(const Path& path, int slice) {
  const KinematicModel& model = path.state(slice).model();
  std::set<int> owned, dofs;
  const auto insert = [&](const KinematicModel::DofRange& range) {
    for (int i = range.first; i < range.first + range.count; ++i) dofs.insert(i);
  };
  for (const KinematicModel::DofRange& range : path.layout().owned[std::size_t(slice + path.grid().order())])
    owned.insert(range.first);
  for (std::size_t frame = 0; frame < path.given().tree->frames().size(); ++frame) {
    const KinematicModel::DofRange& range = model.frame_dofs[frame];
    if (range.count > 0 && owned.contains(range.first)) insert(range);
  }
  for (int frame : path.given().shared_joints) insert(model.frame_dofs[frame]);
  return std::make_unique<JointLimits>(Ids(dofs.begin(), dofs.end()), model);
}

/// The quaternions among the dofs of a slice, but for those of frames that were added after the objective: a stable
/// frame's quaternion belongs to the slices before the start.
Made normsIn(const Objective& objective, const Path& path, int slice) {
  const KinematicModel& model = path.state(slice).model();
  const auto isKnown = [&](const KinematicModel::DofRange& norm) {
    for (int frame = objective.frames_known; frame < int(model.frame_dofs.size()); ++frame) {
      const KinematicModel::DofRange& range = model.frame_dofs[frame];
      if (norm.first >= range.first && norm.first < range.first + range.count) return false;
    }
    return true;
  };
  std::vector<KinematicModel::DofRange> norms;
  std::ranges::copy_if(model.unit_norms, std::back_inserter(norms), isKnown);
  return std::make_unique<QuaternionNorms>(std::move(norms));
}

/// Free flight where no force and no inertia is known.
Made physicsOf(int frame, const Objective& objective, const Path& path, const std::vector<ContactForce>& forces) {
  const double gravity = objective.without_gravity ? 0. : -kGravity.z();
  const auto& frames = path.given().tree->frames();
  const bool is_given = frame < int(frames.size()) && frames[frame]->inertia;
  if (forces.empty() && !is_given && !objective.damped) return std::make_unique<FreeFlight>(frame, gravity);
  const Matrix3d inertia = is_given ? frames[frame]->inertia->matrix : Matrix3d(Matrix3d::Zero());
  if (objective.damped) return std::make_unique<DampedMotion>(frame, gravity, inertia, forces);
  return std::make_unique<NewtonEuler>(frame, gravity, inertia, forces);
}

/// The sum of overlaps or those of all pairs, of a slice or on the way to it. Pairs count up to the margin.
Made collisionsIn(const Objective& objective, const Path& path, const Ids& ids, int slice) {
  const bool is_sum = objective.feature == FeatureSymbol::accumulatedCollisions;
  const double far = farOf(objective);
  if (objective.on_the_way) {
    const SampledCollisions::Form form = is_sum ? SampledCollisions::Form::sum : SampledCollisions::Form::stacked;
    const auto place = std::size_t(slice - objective.from);
    const bool has_samples = place < objective.samples.size();
    return std::make_unique<SampledCollisions>(form, is_sum ? objective.margin : far,
                                               has_samples ? objective.samples[place] : std::vector<CollisionSample>(),
                                               sameDofs(path, slice), path.state(slice - 1));
  }
  const KinematicModel& model = path.state(slice).model();
  if (is_sum) return std::make_unique<AccumulatedCollisions>(ids, model, PairChoice::motion, objective.margin);
  return std::make_unique<PairCollisions>(ids, model, PairChoice::motion, far);
}

/// Joints and forces are those of the path, and of collisions only those count that joints part; other features are as
/// anywhere.
Made featureIn(const Objective& objective, const Path& path, const std::vector<ContactForce>& forces, int slice) {
  const State& state = path.state(slice);
  Ids ids;
  for (const std::string& name : objective.frames) ids.push_back(frameId(state.model(), name, objective.name()));
  using S = FeatureSymbol;
  const FeatureSource& feature = objective.feature;
  if (feature == S::qItself) return jointsIn(objective, path, ids, slice);
  if (feature == S::jointLimits && ids.empty() && !path.layout().plain) return limitsIn(path, slice);
  if (feature == S::qQuaternionNorms && objective.frames_known >= 0) return normsIn(objective, path, slice);
  if (feature == S::physics && ids.size() == 1) return physicsOf(ids[0], objective, path, forces);
  if (feature == S::totalForce && ids.size() == 1) return std::make_unique<TotalForce>(ids[0], forces);
  if (feature == S::contactConstraints && ids.size() == 2)
    return std::make_unique<TangentialForce>(ids[0], ids[1], forces);
  if (feature == S::accumulatedCollisions || feature == S::pairCollisions)
    return collisionsIn(objective, path, ids, slice);
  return feature.make(ids, state);
}

}  // namespace

Residual residualIn(const Objective& objective, const Path& path, const std::vector<ContactForce>& forces, int slice) {
  Residual residual(featureIn(objective, path, forces, slice), objective.scale, objective.target, objective.order,
                    objective.name());
  residual.setTimeIntegral(objective.time_integral);
  return residual;
}

}  // namespace kinegraph
