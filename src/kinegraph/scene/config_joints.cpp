#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/named_states.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

VectorXd Config::getJointState(const std::vector<std::string>& names) const {
  std::vector<double> values;
  for (const std::string& name : names) {
    const FrameData& frame = scene_->get(name, "getJointState");
    if (!frame.moves()) continue;
    const VectorXd& q = dofSource(frame).joint->q;
    values.insert(values.end(), q.begin(), q.end());
  }
  return Eigen::Map<VectorXd>(values.data(), Eigen::Index(values.size()));
}

void Config::setJointState(const VectorXd& q) {
  const auto& model = scene_->model();
  if (q.size() != model->dofs) {
    throw ValueError(cat("setJointState: got ", q.size(), " numbers; the configuration has ", model->dofs,
                         " active dofs: ", join(getJointNames())));
  }
  if (!q.allFinite()) throw ValueError(cat("setJointState: q contains non-finite numbers: ", q.transpose()));
  scene_->setJointState(q.data());
}

void Config::setJointState(const VectorXd& q, const std::vector<std::string>& names) {
  std::vector<FrameData*> frames;
  int dofs = 0;
  for (const std::string& name : names) {
    FrameData& frame = scene_->get(name, "setJointState");
    if (!frame.moves() || frame.joint->mimic) continue;
    frames.push_back(&frame);
    dofs += frame.joint->dofs();
  }
  if (q.size() != dofs || !q.allFinite()) {
    throw ValueError(
        cat("setJointState: got ", q.size(), " numbers; the joints of ", join(names), " take ", dofs, " finite ones"));
  }
  int first = 0;
  for (FrameData* frame : frames) {
    Frame(scene_, *frame).setJointState(q.segment(first, frame->joint->dofs()));
    first += frame->joint->dofs();
  }
}

std::vector<std::string> Config::getJointNames() const {
  const auto model = scene_->model();
  std::vector<std::string> names(model->dofs);
  for (const auto& frame : scene_->frames()) {
    if (!frame->joint || frame->joint->mimic) continue;
    const KinematicModel::DofRange dofs = model->frame_dofs[frame->id];
    for (int i = 0; i < dofs.count; ++i) {
      names[dofs.first + i] = dofs.count == 1 ? frame->name : cat(frame->name, ":", i);
    }
  }
  return names;
}

std::vector<int> Config::getJointIDs() const {
  std::vector<int> ids;
  for (const Frame& frame : getJoints()) ids.push_back(frame.id());
  return ids;
}

std::vector<std::string> Config::getStateNames(const std::string& group) const { return stateNames(*scene_, group); }

VectorXd Config::getNamedState(const std::string& name, const std::string& group) const {
  return namedState(*scene_, name, group);
}

std::vector<std::pair<std::string, std::vector<std::string>>> Config::getJointGroups() const {
  return jointGroups(*scene_);
}

MatrixXd Config::getJointLimits() const {
  const auto model = scene_->model();
  MatrixXd limits(2, model->dofs);
  limits << model->lower.transpose(), model->upper.transpose();
  return limits;
}

namespace {

/// Whether the file of a frame leaves its joint out of q: fingers, and joints of a fixed variant.
bool isInactiveByFile(const FrameData& frame) {
  const Node* node = frame.attributes->find("joint_active");
  const bool* word = node ? node->value.as<bool>() : nullptr;
  const double* number = node ? node->value.as<double>() : nullptr;
  return (word && !*word) || (number && *number == 0.);
}

}  // namespace

void Config::selectJoints(const std::vector<std::string>& names, bool not_those) {
  std::vector<FrameData*> named;
  for (const std::string& name : names) {
    FrameData& given = scene_->get(name, "selectJoints");
    FrameData* frame = &given;
    while (frame && !frame->moves()) frame = frame->parent;
    if (!frame) throw ValueError(cat("selectJoints: neither '", given.name, "' nor any frame above it has a joint"));
    named.push_back(&dofSource(*frame));
  }
  for (const auto& frame : scene_->frames()) {
    if (!frame->moves() || frame->joint->mimic) continue;
    const bool is_named = std::find(named.begin(), named.end(), frame.get()) != named.end();
    frame->joint->active = not_those ? !is_named && !isInactiveByFile(*frame) : is_named;
  }
  scene_->structureChanged();
}

void Config::setRandom(Rng& rng) {
  for (const auto& frame : scene_->frames()) {
    if (!frame->moves() || !frame->joint->active || frame->joint->mimic) continue;
    Joint& joint = *frame->joint;
    const bool limited = joint.lower.size() > 0;
    const bool uniform = limited && joint.sample_uniform > 0. && rng.uniform() < joint.sample_uniform;
    for (int i = 0; i < joint.dofs(); ++i) {
      if (uniform) {
        joint.q[i] = rng.uniform(joint.lower[i], joint.upper[i]);
      } else {
        joint.q[i] = joint.home[i] + joint.sample_deviation * rng.normal();
        if (limited) joint.q[i] = std::clamp(joint.q[i], joint.lower[i], joint.upper[i]);
      }
    }
    if (!uniform) continue;
    int first = 0;
    for (const MotionStep& step : joint.steps) {  // a quaternion: uniform on the sphere
      if (step.kind == MotionStep::Kind::quaternion) {
        for (int i = 0; i < 4; ++i) joint.q[first + i] = rng.normal();
        joint.q.segment<4>(first).normalize();
      }
      first += step.dofs();
    }
  }
  scene_->jointsChanged();
}

}  // namespace kinegraph
