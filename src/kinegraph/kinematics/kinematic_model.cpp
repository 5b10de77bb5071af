#include "kinegraph/kinematics/kinematic_model.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline kinematics_internal {

void nameFrames(KinematicModel& model, std::vector<std::string> names) {
  model.frame_name = std::move(names);
  for (std::size_t i = 0; i < model.frame_name.size(); ++i) model.frame_index.try_emplace(model.frame_name[i], int(i));
}

int frameId(const KinematicModel& model, std::string_view name, std::string_view caller) {
  const auto place = model.frame_index.find(name);
  if (place != model.frame_index.end()) return place->second;
  throw FrameNotFound(cat(caller, ": frame name '", name, "' doesn't exist", similarHint(name, model.frame_name)));
}

const std::vector<std::pair<int, int>>& KinematicModel::collidable() const {
  std::call_once(listed_, [this] {
    for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < contacts.bodies.size(); ++j) {
        if (contacts.allow(i, j)) collidable_.emplace_back(contacts.bodies[i].frame, contacts.bodies[j].frame);
      }
    }
  });
  return collidable_;
}

std::vector<std::pair<int, int>> KinematicModel::movingPairs() const {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
    if (frame_link[std::size_t(contacts.bodies[i].frame)] != 0) moving.push_back(i);
  }
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
    const int frame = contacts.bodies[i].frame, link = frame_link[std::size_t(frame)];
    const auto add = [&](std::size_t j) {
      const int other = contacts.bodies[j].frame;
      if (j > i && frame_link[std::size_t(other)] != link && contacts.allow(i, j)) pairs.emplace_back(frame, other);
    };
    if (link != 0) {
      for (std::size_t j = i + 1; j < contacts.bodies.size(); ++j) add(j);
    } else {
      for (const std::size_t j : moving) add(j);
    }
  }
  return pairs;
}

void connectChains(KinematicModel& model) {
  model.column_dof.clear();
  model.column_before.clear();
  model.last_column = {-1};  // nothing moves the world
  model.fixed_axes = {true};
  model.angle_dof.clear();
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    KinematicModel::Link& link = model.links[l];
    link.first_column = int(model.column_dof.size());
    link.first_angle = int(model.angle_dof.size());
    int dof = link.dof, last = model.last_column[link.parent];
    bool fixed_axes = model.fixed_axes[std::size_t(link.parent)];
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = model.steps[s];
      if (step.rotates()) model.angle_dof.push_back(dof);
      fixed_axes = fixed_axes && !step.orients();
      for (int i = 0; i < step.dofs(); ++i) {
        model.column_before.push_back(last);
        last = int(model.column_dof.size());
        model.column_dof.push_back(dof++);
      }
    }
    model.last_column.push_back(last);
    model.fixed_axes.push_back(fixed_axes);
  }
  if (model.angle_dof.size() % 2 != 0) model.angle_dof.push_back(model.angle_dof.back());
}

Parameters emptyParameters(const KinematicModel& model) {
  Parameters parameters;
  parameters.link.resize(model.links.size());
  parameters.step.resize(model.steps.size());
  parameters.angle_factor.resize(model.angle_dof.size());
  parameters.frame_offset.resize(model.frame_link.size());
  parameters.frame_mass.resize(model.frame_link.size());
  return parameters;
}

RigidTransform placeJoint(const KinematicModel& model, int index, const RigidTransform& X_PJ, Parameters& parameters) {
  const KinematicModel::Link& link = model.links[index];
  const MotionStep* const steps = model.steps.data() + link.first_step;
  const ConstantRotation rotation = classifyRotation(X_PJ.R.data());
  const bool along_axes =
      std::all_of(steps, steps + link.steps, [](const MotionStep& step) { return !step.orients(); });
  const bool rotates_axes = along_axes && rotation.kind == ConstantRotation::quarters;
  RigidTransform X_LJ;
  if (rotates_axes) {
    X_LJ.R.setZero();
    for (int k = 0; k < 3; ++k) X_LJ.R(rotation.column[k], k) = rotation.sign[k];
  }
  LaneModel::Link& placed = parameters.link[index];
  placed = {link.parent, link.first_step, link.steps, rotates_axes ? ConstantRotation{} : rotation, {}, {}};
  Eigen::Map<Matrix3d>(placed.R) = rotates_axes ? Matrix3d(Matrix3d::Identity()) : X_PJ.R;
  Eigen::Map<Vector3d>(placed.p) = X_PJ.p;
  const Vector3d about = X_LJ.R * link.axis;
  int dof = link.dof, column = link.first_column, angle = link.first_angle;
  for (int s = 0; s < link.steps; ++s) {
    const MotionStep& step = steps[s];
    LaneModel::Step& moves = parameters.step[link.first_step + s];
    moves = {step.kind, step.axis, dof, column, step.sign * link.scale, {about[0], about[1], about[2]}};
    if (rotates_axes && step.kind != MotionKind::rotateAbout) {
      moves.axis = rotation.column[step.axis];
      moves.factor *= rotation.sign[step.axis];
    }
    if (step.rotates()) parameters.angle_factor[angle++] = moves.factor;
    dof += step.dofs();
    column += step.dofs();
  }
  return X_LJ;
}

}  // namespace kinegraph::inline kinematics_internal
