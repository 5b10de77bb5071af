#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph {

namespace {

constexpr std::size_t kUsualDofs = 256;

}  // namespace

std::vector<int> Komo::dofsOf(const std::vector<int>& frames, int slice) const {
  const Program& program = state(slice).program();
  std::vector<int> dofs;
  for (int frame : frames) {
    if (frame < 0 || frame >= int(program.frame_dofs.size()) || program.frame_dofs[frame].count == 0) {
      throw ValueError(cat("KOMO: frame ", frame, " has no active joint in slice ", slice));
    }
    const auto [first, count] = program.frame_dofs[frame];
    for (int i = first; i < first + count; ++i) dofs.push_back(i);
  }
  return dofs;
}

MatrixXd Komo::getPath(const std::vector<int>& frames) const {
  requireBuilt("getPath");
  MatrixXd path;
  if (layout_.plain && frames.empty()) {
    path.resize(slices_, state(0).dofs());
    for (int t = 0; t < slices_; ++t) path.row(t) = state(t).q();
    return path;
  }
  for (int t = 0; t < slices_; ++t) {
    const std::vector<int> dofs = dofsOf(frames.empty() ? joint_frames_ : frames, t);
    if (t == 0) path.resize(slices_, Eigen::Index(dofs.size()));
    for (std::size_t i = 0; i < dofs.size(); ++i) path(t, Eigen::Index(i)) = state(t).q()[dofs[i]];
  }
  return path;
}

VectorXd Komo::ownDofs(int slice) const {
  if (layout_.plain) return state(slice).q();
  std::vector<double> values;
  for (const auto& [first, count] : layout_.owned[slice + order_]) {
    for (int i = first; i < first + count; ++i) values.push_back(state(slice).q()[i]);
  }
  return Eigen::Map<VectorXd>(values.data(), Eigen::Index(values.size()));
}

VectorXd Komo::variables() const {
  VectorXd x(layout_.dimension);
  int first = 0;
  for (int t = layout_.plain ? 0 : -order_; t < slices_; ++t) {
    const VectorXd own = ownDofs(t);
    x.segment(first, own.size()) = own;
    first += int(own.size());
  }
  return x;
}

void Komo::setVariables(const VectorXd& x) {
  if (layout_.plain) {
    for (int t = 0; t < slices_; ++t) setSlice(t, x.data() + t * program_->dofs);
    return;
  }
  double usual[kUsualDofs];  // solvers call this in their loop, where no memory is requested
  std::vector<double> many;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const std::vector<int>& column = layout_.column[i];
    if (column.size() > kUsualDofs) many.resize(column.size());
    double* q = column.size() > kUsualDofs ? many.data() : usual;
    bool moves = false;
    for (std::size_t d = 0; d < column.size(); ++d) {
      q[d] = column[d] < 0 ? states_[i].q()[Eigen::Index(d)] : x[column[d]];
      moves = moves || column[d] >= 0;
    }
    if (moves) states_[i].setJoints(q);
  }
}

MatrixXd Komo::getFrameState(int slice) const {
  requireBuilt("getFrameState");
  if (slice < -order_ || slice >= slices_)
    throw ValueError(cat("KOMO: slice ", slice, " is not in ", -order_, " .. ", slices_ - 1));
  MatrixXd poses(Eigen::Index(shown_frames_.size()), 7);
  for (std::size_t i = 0; i < shown_frames_.size(); ++i) {
    Pose X(state(slice).pose(shown_frames_[i]));
    if (X.q.w() < 0.) X.q.coeffs() *= -1.;
    poses.row(Eigen::Index(i)) = X.numbers();
  }
  return poses;
}

Config Komo::configuration(int slice) const {
  requireBuilt("getConfiguration");
  if (slice < -order_ || slice >= slices_)
    throw ValueError(cat("KOMO: slice ", slice, " is not in ", -order_, " .. ", slices_ - 1));
  Config config = modes_.empty() ? Config(*base_) : modes_[mode_of_[slice + order_]]->config;
  config.setJointState(state(slice).q());
  const auto& frames = config.scene()->frames();
  for (const auto& source : source_->frames()) {
    if (source->id < int(frames.size()) && frames[source->id]->name == source->name)
      frames[source->id]->attributes = source->attributes;
  }
  return config;
}

Komo::SubProblem Komo::subProblem(int phase) const {
  if (slices_per_phase_ != 1)
    throw ValueError(cat("getSubProblem is for one slice per phase; this KOMO has ", slices_per_phase_));
  if (phase < 0 || phase >= slices_ || phase - 1 < -order_) {
    throw ValueError(cat("getSubProblem: phase ", phase, " is not in ", order_ > 0 ? 0 : 1, " .. ", slices_ - 1));
  }
  SubProblem out{configuration(phase - 1), {}, {}};
  if (!modes_.empty()) {
    for (const auto& [frame, added] : modes_[mode_of_[phase - 1 + order_]]->added) {
      if (FrameData& data = *out.config.scene()->frames()[frame]; data.moves()) data.joint->active = false;
    }
  }
  for (int frame : stable_) out.config.scene()->frames()[frame]->joint->active = false;
  out.config.scene()->structureChanged();
  std::vector<int> frames;
  for (int frame : joint_frames_) {
    if (!stable_.contains(frame)) frames.push_back(frame);
  }
  const auto read = [&](int slice) {
    const std::vector<int> dofs = dofsOf(frames, slice);
    return VectorXd(state(slice).q()(dofs));
  };
  out.start = read(phase - 1);
  out.end = read(phase);
  return out;
}

void Komo::updateRootObjects(const Config& config) {
  requireBuilt("updateRootObjects");
  const auto program = config.program();
  if (program != program_ && (program->frame_name != program_->frame_name || program->dofs != program_->dofs)) {
    throw ValueError(
        "KOMO: updateRootObjects needs the configuration that the KOMO was made from, with the same frames, joints and "
        "shapes");
  }
  if (program == program_ && modes_.empty()) {
    base_.reset();  // so that its memory can be used again
    base_ = config.scene()->snapshot();
    parameters_ = config.parameters();
    for (State& state : states_) state.setParameters(parameters_);
    return;
  }
  const auto takeOver = [&](SceneTree& target) {
    for (const auto& source : config.scene()->frames()) {
      FrameData& frame = *target.frames()[source->id];
      const int parent = source->parent ? source->parent->id : -1, parent_here = frame.parent ? frame.parent->id : -1;
      if (!source->moves() && !frame.moves() && parent == parent_here) frame.pose = source->pose;
    }
    target.posesChanged();
  };
  const auto base = std::make_shared<SceneTree>();
  base->append(*base_, {}, false);
  takeOver(*base);
  base_ = base;
  parameters_ = config.parameters();
  for (const auto& mode : modes_) takeOver(*mode->config.scene());
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].setParameters(modes_.empty() ? parameters_ : modes_[mode_of_[i]]->config.parameters());
  }
}

}  // namespace kinegraph
