#include "kinegraph/komo/komo.h"

#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/joints.h"
#include "kinegraph/komo/path_features.h"

namespace kinegraph {

Komo::Komo(const Config& config, double phases, int slices_per_phase, int order) {
  setConfig(config);
  setTiming(phases, slices_per_phase, 1., order);
}

void Komo::setConfig(const Config& config) {
  if (!objectives_.empty() || !modes_.empty())
    throw Error("KOMO: the configuration is set before the first objective or switch");
  base_ = config.scene()->snapshot();
  source_ = config.scene();
  program_ = config.program();
  parameters_ = config.parameters();
  start_ = config.getJointState();
  stable_.clear();
  joint_frames_.clear();
  shown_frames_.clear();
  for (const auto& frame : config.scene()->frames()) {
    shown_frames_.push_back(frame->id);
    if (!frame->moves() || !frame->joint->active || frame->joint->mimic) continue;
    joint_frames_.push_back(frame->id);
    if (frame->joint->stable) stable_.insert(frame->id);
  }
  build();
}

void Komo::setTiming(double phases, int slices_per_phase, double duration_per_phase, int order) {
  if (!objectives_.empty() || !modes_.empty())
    throw Error("KOMO: the timing is set before the first objective or switch");
  if (!(phases > 0.) || !std::isfinite(phases))
    throw ValueError(cat("KOMO: phases is ", phases, "; expected a positive number"));
  if (slices_per_phase < 1)
    throw ValueError(cat("KOMO: slicesPerPhase is ", slices_per_phase, "; expected at least 1"));
  if (order < 0 || order > 10)
    throw ValueError(cat("KOMO: kOrder is ", order, "; expected 0 (poses) to 2 (accelerations), at most 10"));
  if (!(duration_per_phase > 0.))
    throw ValueError(cat("KOMO: durationPerPhase is ", duration_per_phase, " s; expected a positive number"));
  phases_ = phases;
  slices_ = int(std::ceil(phases * slices_per_phase - 1e-9));
  slices_per_phase_ = slices_per_phase;
  tau_ = duration_per_phase / slices_per_phase;
  order_ = order;
  build();
}

void Komo::build() {
  if (!program_ || slices_per_phase_ == 0) return;
  states_.clear();
  states_.reserve(std::size_t(slices_ + order_));
  State first(program_, parameters_);
  first.setJoints(start_.data());
  for (int i = 1; i < slices_ + order_; ++i) states_.push_back(first);
  states_.push_back(std::move(first));
  mode_of_.assign(states_.size(), 0);
  layout_ = makeLayout(states_, order_, stable_, modes_, mode_of_);
  ++structure_revision_;
}

void Komo::requireBuilt(const char* call) const {
  if (states_.empty())
    throw Error(cat("KOMO: ", call, " needs a configuration and a timing; call setConfig and setTiming first"));
}

int Komo::sliceAt(double time) const { return int(std::floor(time * slices_per_phase_ + .500001)) - 1; }

std::pair<int, int> Komo::selectSlices(const std::vector<double>& times) const {
  if (times.size() > 2)
    throw ValueError(cat("KOMO: times has ", times.size(), " entries; expected [] (all), [time] or [from, to]"));
  for (double time : times) {
    if (!std::isfinite(time))
      throw ValueError(cat("KOMO: times has the entry ", time, "; expected phase times, or -1 for the end"));
  }
  const auto slice = [&](double time) { return time < 0. ? slices_ - 1 : sliceAt(time); };
  if (times.empty()) return {0, slices_ - 1};
  const int from = slice(times.front()), to = slice(times.back());
  return {std::max(from, 0), std::min(to, slices_ - 1)};
}

void Komo::addObjective(const std::vector<double>& times, const FeatureSource& feature,
                        const std::vector<std::string>& frames, ObjectiveType type, const MatrixXd& scale,
                        const VectorXd& target, int order) {
  requireBuilt("addObjective");
  add({feature.name(), feature, frames, type, scale, target, order, times, 0, 0}, 0, 0);
}

void Komo::addControlObjective(const std::vector<double>& times, int order, double scale, const VectorXd& target,
                               int delta_from, int delta_to) {
  requireBuilt("addControlObjective");
  if (order < 0) throw ValueError(cat("addControlObjective: order is ", order, "; expected 0, 1 or 2"));
  std::vector<std::string> frames;
  std::vector<double> weights, home;
  for (int frame : joint_frames_) {
    const auto [first, count] = program_->frame_dofs[frame];
    if (stable_.contains(frame) || !(program_->control_weight[first] > 0.)) continue;
    frames.push_back(program_->frame_name[frame]);
    for (int i = first; i < first + count; ++i) {
      weights.push_back(scale * program_->control_weight[i]);
      home.push_back(program_->home[i]);
    }
  }
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::Map<const VectorXd>(v.data(), Eigen::Index(v.size()));
  };
  if (frames.size() == joint_frames_.size()) frames.clear();
  VectorXd to = target;
  if (order == 0 && target.size() == 0) to = vector(home);
  add({"qItself", FeatureSymbol::qItself, frames, ObjectiveType::sos, vector(weights), to, order, times, 0, 0,
       order > 0},
      delta_from, delta_to);
}

void Komo::addQuaternionNorms(const std::vector<double>& times, double scale, bool hard) {
  requireBuilt("addQuaternionNorms");
  add({"qQuaternionNorms",
       FeatureSymbol::qQuaternionNorms,
       {},
       hard ? ObjectiveType::eq : ObjectiveType::sos,
       MatrixXd::Constant(1, 1, scale),
       {},
       0,
       times,
       0,
       0},
      0, 0);
}

std::unique_ptr<Feature> Komo::featureIn(const Objective& objective, int slice) const {
  const Program& program = state(slice).program();
  std::vector<int> ids;
  for (const std::string& name : objective.frames) ids.push_back(frameId(program, name, objective.name));
  if (!objective.feature.symbol()) return objective.feature.make(ids, state(slice));
  switch (*objective.feature.symbol()) {
    case FeatureSymbol::qItself: {
      const std::vector<int>& frames = ids.empty() ? joint_frames_ : ids;
      std::vector<JointsOfFrames::Part> parts;
      parts.reserve(frames.size());
      for (int frame : frames) {
        const int count = program.frame_dofs[frame].count;
        const bool original = frame < int(program_->frame_dofs.size());
        if (count == 0 || (ids.empty() && original && count != program_->frame_dofs[frame].count)) {
          throw ValueError(cat(objective.name, ": the joint of frame '", program.frame_name[frame], "' ",
                               ids.empty() ? "was replaced by a mode switch" : "is not there, or not active,",
                               " in slice ", slice));
        }
        parts.push_back({frame, 0, count});
      }
      if (!layout_.plain) return std::make_unique<JointsOfFrames>(std::move(parts));
      std::vector<int> dofs;
      dofs.reserve(std::size_t(program.dofs));
      for (const JointsOfFrames::Part& part : parts) {
        for (int i = 0; i < part.count; ++i) dofs.push_back(program.frame_dofs[part.frame].first + i);
      }
      return std::make_unique<JointState>(std::move(dofs));
    }
    case FeatureSymbol::jointLimits: {
      if (!ids.empty() || layout_.plain) break;
      std::set<int> dofs;  // of the frames as given, not of those that were added: bounds limit these
      const auto insert = [&](const Program::DofRange& range) {
        for (int i = range.first; i < range.first + range.count; ++i) dofs.insert(i);
      };
      std::set<int> owned;
      for (const Program::DofRange& range : layout_.owned[slice + order_]) owned.insert(range.first);
      for (std::size_t frame = 0; frame < base_->frames().size(); ++frame) {
        const Program::DofRange& range = program.frame_dofs[frame];
        if (range.count > 0 && owned.contains(range.first)) insert(range);
      }
      for (int frame : stable_) insert(program.frame_dofs[frame]);
      return std::make_unique<JointLimits>(std::vector<int>(dofs.begin(), dofs.end()), program);
    }
    case FeatureSymbol::physics:
      if (ids.size() == 1) return physicsOf(ids[0], objective);
      break;
    case FeatureSymbol::totalForce:
      if (ids.size() == 1) return std::make_unique<TotalForce>(ids[0], contacts_);
      break;
    case FeatureSymbol::contactConstraints:
      if (ids.size() == 2) return std::make_unique<TangentialForce>(ids[0], ids[1], contacts_);
      break;
    default:
      break;
  }
  return objective.feature.make(ids, state(slice));
}

Residual Komo::residualIn(const Objective& objective, int slice) const {
  Residual residual(featureIn(objective, slice), objective.scale, objective.target, objective.order, objective.name);
  residual.setTimeIntegral(objective.time_integral);
  return residual;
}

void Komo::add(Objective objective, int delta_from, int delta_to) {
  std::tie(objective.from, objective.to) = selectSlices(objective.times);
  objective.from = std::max(objective.from + delta_from, 0);
  objective.to = std::min(objective.to + delta_to, slices_ - 1);
  const bool empty = objective.from > objective.to;
  objective.order = residualIn(objective, empty ? 0 : objective.from).order();
  if (objective.order > order_) {
    throw ValueError(cat(objective.name, " of order ", objective.order, " needs a KOMO with kOrder ", objective.order,
                         " or more; this one has ", order_));
  }
  if (empty) {
    std::vector<std::string> words;
    for (double time : objective.times) words.push_back(cat(time));
    warnings_.push_back(cat("objective ", objective.name, " with times [", join(words), "] selects no slice; the ",
                            slices_, slices_ == 1 ? " slice is" : " slices are", " at phase times ",
                            1. / slices_per_phase_, " to ", double(slices_) / slices_per_phase_));
  }
  objectives_.push_back(std::move(objective));
}

}  // namespace kinegraph
