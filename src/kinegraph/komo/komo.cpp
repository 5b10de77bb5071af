#include "kinegraph/komo/komo.h"

#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

Komo::Komo(const Config& config, double phases, int slices_per_phase, int order) {
  setConfig(config);
  setTiming(phases, slices_per_phase, 1., order);
}

void Komo::setConfig(const Config& config) {
  if (!objectives_.empty()) throw Error("KOMO: the configuration is set before the first objective");
  program_ = config.program();
  parameters_ = config.parameters();
  start_ = config.getJointState();
  build();
}

void Komo::setTiming(double phases, int slices_per_phase, double duration_per_phase, int order) {
  if (!objectives_.empty()) throw Error("KOMO: the timing is set before the first objective");
  if (!(phases > 0.) || !std::isfinite(phases)) throw ValueError(cat("KOMO: phases is ", phases, "; expected a positive number"));
  if (slices_per_phase < 1) throw ValueError(cat("KOMO: slicesPerPhase is ", slices_per_phase, "; expected at least 1"));
  if (order < 0 || order > 10) throw ValueError(cat("KOMO: kOrder is ", order, "; expected 0 (poses) to 2 (accelerations), at most 10"));
  if (!(duration_per_phase > 0.)) throw ValueError(cat("KOMO: durationPerPhase is ", duration_per_phase, " s; expected a positive number"));
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
  for (int i = 0; i < slices_ + order_; ++i) states_.push_back(first);
  window_.resize(std::size_t(order_) + 1);
}

void Komo::requireBuilt(const char* call) const {
  if (states_.empty()) throw Error(cat("KOMO: ", call, " needs a configuration and a timing; call setConfig and setTiming first"));
}

std::pair<int, int> Komo::selectSlices(const std::vector<double>& times) const {
  if (times.size() > 2) throw ValueError(cat("KOMO: times has ", times.size(), " entries; expected [] (all), [time] or [from, to]"));
  const auto slice = [&](double time) {
    return time < 0. ? slices_ - 1 : int(std::floor(time * slices_per_phase_ + .500001)) - 1;
  };
  if (times.empty()) return {0, slices_ - 1};
  const int from = slice(times.front()), to = slice(times.back());
  return {std::max(from, 0), std::min(to, slices_ - 1)};
}

void Komo::addObjective(const std::vector<double>& times, FeatureSymbol feature, const std::vector<std::string>& frames,
                        ObjectiveType type, const MatrixXd& scale, const VectorXd& target, int order) {
  requireBuilt("addObjective");
  add(makeResidual(*program_, feature, frames, scale, target, order), times, frames, type, 0, 0);
}

void Komo::addControlObjective(const std::vector<double>& times, int order, double scale, const VectorXd& target, int delta_from,
                               int delta_to) {
  requireBuilt("addControlObjective");
  if (order < 0) throw ValueError(cat("addControlObjective: order is ", order, "; expected 0, 1 or 2"));
  const VectorXd home = order == 0 && target.size() == 0 ? program_->home : target;
  Residual residual = makeResidual(*program_, FeatureSymbol::qItself, {}, scale * program_->control_weight.transpose(), home, order);
  residual.setTimeIntegral(order > 0);
  add(std::move(residual), times, {}, ObjectiveType::sos, delta_from, delta_to);
}

void Komo::addQuaternionNorms(const std::vector<double>& times, double scale, bool hard) {
  requireBuilt("addQuaternionNorms");
  if (program_->unit_norms.empty()) return;
  add(makeResidual(*program_, FeatureSymbol::qQuaternionNorms, {}, MatrixXd::Constant(1, 1, scale)), times, {},
      hard ? ObjectiveType::eq : ObjectiveType::sos, 0, 0);
}

void Komo::add(Residual residual, const std::vector<double>& times, std::vector<std::string> frames, ObjectiveType type,
               int delta_from, int delta_to) {
  if (residual.order() > order_) {
    throw ValueError(cat(residual.name(), " of order ", residual.order(), " needs a KOMO with kOrder ", residual.order(), " or more; this one has ", order_));
  }
  auto [from, to] = selectSlices(times);
  from = std::max(from + delta_from, 0);
  to = std::min(to + delta_to, slices_ - 1);
  if (from > to) {
    std::vector<std::string> words;
    for (double time : times) words.push_back(cat(time));
    warnings_.push_back(cat("objective ", residual.name(), " with times [", join(words), "] selects no slice; the ", slices_,
                            slices_ == 1 ? " slice is" : " slices are", " at phase times ", 1. / slices_per_phase_, " to ", double(slices_) / slices_per_phase_));
  }
  objectives_.push_back({std::move(residual), type, std::move(frames), times, from, to});
}

MatrixXd Komo::getPath() const {
  requireBuilt("getPath");
  MatrixXd path(slices_, dofs());
  for (int t = 0; t < slices_; ++t) path.row(t) = state(t).q();
  return path;
}

void Komo::setPath(const MatrixXd& path) {
  requireBuilt("initWithPath");
  if (path.rows() != slices_ || path.cols() != dofs()) {
    throw ValueError(cat("KOMO: the path is ", path.rows(), " x ", path.cols(), "; expected ", slices_, " slices x ", dofs(), " dofs"));
  }
  for (int t = 0; t < slices_; ++t) {
    const VectorXd q = path.row(t);
    setSlice(t, q.data());
  }
}

void Komo::setConstantPath(const VectorXd& q) {
  requireBuilt("initWithConstant");
  if (q.size() != dofs()) throw ValueError(cat("KOMO: got ", q.size(), " joint values; expected ", dofs()));
  for (int t = 0; t < slices_; ++t) setSlice(t, q.data());
}

MatrixXd Komo::getFrameState(int slice) const {
  requireBuilt("getFrameState");
  if (slice < -order_ || slice >= slices_) throw ValueError(cat("KOMO: slice ", slice, " is not in ", -order_, " .. ", slices_ - 1));
  const int frames = int(program_->frame_link.size());
  MatrixXd poses(frames, 7);
  for (int i = 0; i < frames; ++i) {
    Pose X(state(slice).pose(i));
    if (X.q.w() < 0.) X.q.coeffs() *= -1.;
    poses.row(i) = X.numbers();
  }
  return poses;
}

void Komo::updateRootObjects(const Config& config) {
  requireBuilt("updateRootObjects");
  if (config.program() != program_) {
    throw ValueError("KOMO: updateRootObjects needs the configuration that the KOMO was made from, with the same frames, joints and shapes");
  }
  parameters_ = config.parameters();
  for (State& state : states_) state.setParameters(parameters_);
}

void Komo::evaluate(Objective& objective, int slice, Eigen::Ref<VectorXd> y, JacobianRows* J) {
  const int order = objective.residual.order();
  for (int i = 0; i <= order; ++i) window_[i] = &state(slice - order + i);
  objective.residual.eval({window_.data(), std::size_t(order) + 1}, tau_, y, J);
}

}  // namespace kinegraph
