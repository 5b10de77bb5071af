#include "kinegraph/komo/objective.h"

#include <algorithm>
#include <iterator>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/collisions.h"
#include "kinegraph/features/joints.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/komo/collision/sampled_collisions.h"
#include "kinegraph/komo/continuous_collisions.h"
#include "kinegraph/komo/path/path_features.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph::inline komo_internal {

namespace {

using Ids = std::vector<int>;
using Made = std::unique_ptr<Feature>;

/// The joints of the initial configuration, or of the frames with these ids, as they are in a slice.
Made jointsIn(const Objective& objective, const Path& path, const Ids& ids, int slice) {
  const KinematicModel &model = path.state(slice).model(), &initial_model = *path.initial().model;
  std::vector<JointsOfFrames::Part> parts;
  const Ids& frames = ids.empty() ? path.initial().joint_frames : ids;
  parts.reserve(frames.size());
  for (int frame : frames) {
    const int count = model.frame_dofs[frame].count;
    const bool original = frame < int(initial_model.frame_dofs.size());
    if (count == 0 || (ids.empty() && original && count != initial_model.frame_dofs[frame].count)) {
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

/// The limits of the initial configuration's joints whose dofs a slice owns, and of the shared ones. Bounds limit added
/// joints.
Made limitsIn(const Path& path, int slice) {
  const KinematicModel& model = path.state(slice).model();
  std::set<int> owned, dofs;
  const auto insert = [&](const KinematicModel::DofRange& range) {
    for (int i = range.first; i < range.first + range.count; ++i) dofs.insert(i);
  };
  for (const KinematicModel::DofRange& range : path.layout().owned[std::size_t(slice + path.grid().order())])
    owned.insert(range.first);
  for (std::size_t frame = 0; frame < path.initial().tree->frames().size(); ++frame) {
    const KinematicModel::DofRange& range = model.frame_dofs[frame];
    if (range.count > 0 && owned.contains(range.first)) insert(range);
  }
  for (int frame : path.initial().shared_joints) insert(model.frame_dofs[frame]);
  return std::make_unique<JointLimits>(Ids(dofs.begin(), dofs.end()), model);
}

/// The quaternions among the dofs of a slice, except those of frames added after the objective: the quaternion of a
/// stable frame belongs to the slices before the start.
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

/// Free flight if there are neither forces nor an inertia.
Made physicsOf(int frame, const Objective& objective, const Path& path, const std::vector<ContactForce>& forces) {
  const double gravity = objective.without_gravity ? 0. : -kGravity.z();
  const auto& frames = path.initial().tree->frames();
  const bool has_inertia = frame < int(frames.size()) && frames[frame]->inertia;
  if (forces.empty() && !has_inertia && !objective.damped) return std::make_unique<FreeFlight>(frame, gravity);
  const Matrix3d inertia = has_inertia ? frames[frame]->inertia->matrix : Matrix3d(Matrix3d::Zero());
  if (objective.damped) return std::make_unique<DampedMotion>(frame, gravity, inertia, forces);
  return std::make_unique<NewtonEuler>(frame, gravity, inertia, forces);
}

/// The sum of overlaps, or the overlaps of all pairs, in a slice or in the motion to it. Pairs closer than the margin
/// count.
Made collisionsIn(const Objective& objective, const Path& path, const Ids& ids, int slice) {
  const bool is_sum = objective.feature == FeatureSymbol::accumulatedCollisions;
  const double far = cutoffDistance(objective);
  if (objective.between_slices) {
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

/// Joint and force features use those of the path, and collisions only count pairs that joints move relative to each
/// other. Other features are independent of the path.
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

}  // namespace kinegraph::inline komo_internal
