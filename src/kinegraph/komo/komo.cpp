#include "kinegraph/komo/komo.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/contact_forces.h"
#include "kinegraph/komo/force_exchange.h"
#include "kinegraph/komo/komo_parts.h"
#include "kinegraph/komo/mode_switches.h"
#include "kinegraph/komo/path/path_initialization.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph {

namespace {

/// Treats shapes as if they were larger by `margin` together.
void setMargin(Objective& objective, double margin) {
  using S = FeatureSymbol;
  if (!std::isfinite(margin)) throw ValueError(cat("addObjective: margin is ", margin, "; expected a length in m"));
  if (objective.feature == S::accumulatedCollisions) {
    if (margin < 0.) throw ValueError(cat("addObjective: margin is ", margin, "; expected 0 or more, m"));
    objective.margin = margin;
  } else if (objective.feature == S::pairCollisions || objective.feature == S::distance ||
             objective.feature == S::pairCollision_negScalar) {
    if (objective.target.size() == 0) objective.target = VectorXd::Zero(1);
    objective.target.array() -= margin;
  } else {
    throw ValueError(cat("addObjective: ", objective.name(),
                         " has no margin; accumulatedCollisions, pairCollisions and distance have one"));
  }
}

}  // namespace

Komo::Komo(const Config& config, double phases, int slices_per_phase, int order) : Komo() {
  setConfig(config);
  setTiming(phases, slices_per_phase, 1., order);
}

Komo::Komo() : Komo(std::make_shared<MotionProblem>()) {}

Komo::Komo(std::shared_ptr<MotionProblem> motion) : motion_("Komo", std::move(motion)) {}

const Path& Komo::path() const { return motion_->path; }
Path& Komo::path() { return motion_->path; }
const ObjectiveList& Komo::objectives() const { return motion_->objectives; }
const Contacts& Komo::contacts() const { return motion_->contacts; }

int Komo::slices() const { return path().grid().slices(); }
int Komo::order() const { return path().grid().order(); }
double Komo::tau() const { return path().grid().tau(); }
int Komo::dofs() const {
  if (!path().initial().model) throw ValueError("KOMO: there is no configuration yet; call setConfig first");
  return path().dofs();
}

void Komo::clearObjectives() { motion_->objectives.clear(); }
std::vector<Interaction> Komo::interactions() const { return motion_->contacts.interactions(motion_->path); }
std::vector<std::string> Komo::takeWarnings() { return motion_->objectives.takeWarnings(); }

void Komo::setPath(const MatrixXd& path) { initializePath(motion_->path, path); }
void Komo::setConstantPath(const VectorXd& q) { initializeConstant(motion_->path, q); }
void Komo::resetPath() { initializeFromStart(motion_->path); }
void Komo::setRandomPath(Rng& rng) { initializeRandom(motion_->path, rng); }
std::vector<int> Komo::setWaypoints(const std::vector<VectorXd>& waypoints, const WaypointOptions& options) {
  return initializeWaypoints(motion_->path, waypoints, options);
}
void Komo::setPhasePath(int phase, const std::vector<int>& frames, const MatrixXd& path, bool resample) {
  initializePhase(motion_->path, phase, frames, path, resample);
}

Komo Komo::clone() const {
  Komo copy(std::make_shared<MotionProblem>(*motion_));
  copy.motion_->path = path().clone();
  return copy;
}

Komo::Parts Komo::parts() const {
  Parts parts;
  if (!path().initial().empty()) parts.config = path().initial().config();
  Path::Content content = path().content();
  if (content.states.empty()) return parts;
  const TimeGrid& grid = path().grid();
  parts.phases = grid.phases();
  parts.duration_per_phase = grid.durationPerPhase();
  parts.slices_per_phase = grid.slicesPerPhase();
  parts.order = grid.order();
  parts.path = std::move(content);
  parts.objectives = objectives().all();
  parts.contacts = contacts().forces();
  return parts;
}

std::shared_ptr<Komo> Komo::sharing() const {
  const std::shared_ptr<Komo> other(new Komo(motion_.pointer()));
  other->viewer_ = viewer_;
  return other;
}

Komo::Komo(Parts parts) : Komo() {
  setConfig(parts.config);
  if (parts.path.states.empty()) return;
  setTiming(parts.phases, parts.slices_per_phase, parts.duration_per_phase, parts.order);
  motion_->path.setContent(std::move(parts.path));
  motion_->objectives = ObjectiveList(std::move(parts.objectives));
  motion_->contacts = Contacts(std::move(parts.contacts));
}

void Komo::requireUntouched(const char* what) const {
  if (!objectives().empty() || !path().modes().empty())
    throw Error(cat("KOMO: the ", what, " must be set before the first objective or switch"));
}

void Komo::setConfig(const Config& config) {
  requireUntouched("configuration");
  motion_->path.setScene(config);
}

void Komo::setTiming(double phases, int slices_per_phase, double duration_per_phase, int order) {
  requireUntouched("timing");
  motion_->path.setGrid(TimeGrid(phases, slices_per_phase, duration_per_phase, order));
}

void Komo::addObjective(const std::vector<double>& times, const FeatureSource& feature,
                        const std::vector<std::string>& frames, ObjectiveType type, const Scale& scale,
                        const Target& target, int order, double margin) {
  path().requireBuilt("addObjective");
  Objective objective{.feature = feature,
                      .frames = frames,
                      .type = type,
                      .scale = scale.matrix(),
                      .target = target.vector(),
                      .order = order,
                      .times = times};
  if (margin != 0.) setMargin(objective, margin);
  motion_->require(std::move(objective));
}

void Komo::addObjectivePerSlice(const std::vector<double>& times, const FeatureSource& feature,
                                const std::vector<std::string>& frames, ObjectiveType type, const MatrixXd& targets,
                                const Scale& scale, int order) {
  path().requireBuilt("addObjectivePerSlice");
  const auto [from, to] = path().grid().select(times);
  if (targets.rows() != to - from + 1)
    throw ValueError(cat("addObjectivePerSlice: targets have ", targets.rows(), " rows; expected ", to - from + 1,
                         ", one per slice"));
  for (int slice = from; slice <= to; ++slice)
    addObjective({path().grid().timeOf(slice)}, feature, frames, type, scale,
                 VectorXd(targets.row(slice - from).transpose()), order);
}

void Komo::addFreeMotion(const std::vector<double>& times, double margin, double scale) {
  constexpr double kSlack = 1e-3;  // m
  path().requireBuilt("addFreeMotion");
  if (!(margin >= 0.) || !std::isfinite(margin))
    throw ValueError(cat("addFreeMotion: margin is ", margin, "; expected 0 or more, m"));
  if (!(scale > 0.) || !std::isfinite(scale))
    throw ValueError(cat("addFreeMotion: scale is ", scale, "; expected a number > 0"));
  Objective objective{.feature = FeatureSymbol::accumulatedCollisions,
                      .type = ObjectiveType::ineq,
                      .scale = MatrixXd::Constant(1, 1, scale),
                      .times = times,
                      .margin = margin,
                      .slack = kSlack};
  motion_->require(objective);
  const auto [from, to] = path().grid().select(times);
  const int skipped =
      from == 0 && firstMotion(path()) == 0 ? 0 : 1;  // excludes motions that do not start in a constrained slice
  if (from + skipped > to) return;
  objective.between_slices = true;
  motion_->require(std::move(objective), skipped);
}

void Komo::addControlObjective(const std::vector<double>& times, int order, double scale, const Target& target,
                               int delta_from, int delta_to) {
  path().requireBuilt("addControlObjective");
  if (order < 0) throw ValueError(cat("addControlObjective: order is ", order, "; expected 0, 1 or 2"));
  const InitialConfiguration& initial = path().initial();
  const KinematicModel& model = *initial.model;
  std::vector<std::string> frames;
  std::vector<double> weights, home;
  for (int frame : initial.joint_frames) {
    const auto [first, count] = model.frame_dofs[frame];
    if (initial.isShared(frame) || !(model.control_weight[first] > 0.)) continue;
    frames.push_back(model.frame_name[frame]);
    for (int i = first; i < first + count; ++i) {
      weights.push_back(scale * model.control_weight[i]);
      home.push_back(model.home[i]);
    }
  }
  const auto vector = [](const std::vector<double>& v) {
    return Eigen::Map<const VectorXd>(v.data(), Eigen::Index(v.size()));
  };
  if (frames.size() == initial.joint_frames.size()) frames.clear();
  const bool from_home = order == 0 && target.vector().size() == 0;
  motion_->require({.feature = FeatureSymbol::qItself,
                    .frames = std::move(frames),
                    .type = ObjectiveType::sos,
                    .scale = vector(weights),
                    .target = from_home ? VectorXd(vector(home)) : target.vector(),
                    .order = order,
                    .times = times,
                    .time_integral = order > 0},
                   delta_from, delta_to);
}

void Komo::addQuaternionNorms(const std::vector<double>& times, double scale, bool hard) {
  path().requireBuilt("addQuaternionNorms");
  motion_->require({.feature = FeatureSymbol::qQuaternionNorms,
                    .type = hard ? ObjectiveType::eq : ObjectiveType::sos,
                    .scale = MatrixXd::Constant(1, 1, scale),
                    .order = 0,
                    .times = times,
                    .frames_known = int(path().state(0).model().frame_dofs.size())});
}

void Komo::addModeSwitch(const std::vector<double>& times, SwitchMode mode, const std::vector<std::string>& frames,
                         bool first) {
  kinegraph::addModeSwitch(*motion_, {times, mode, frames, first});
}

void Komo::addRigidSwitch(double time, const std::string& parent, const std::string& object, bool no_jump) {
  kinegraph::addRigidSwitch(*motion_, time, parent, object, no_jump);
}

void Komo::addFrameDof(const std::string& name, const std::string& parent, JointType type, bool stable,
                       const std::string& origin) {
  kinegraph::addFrameDof(motion_->path, {name, parent, type, stable, origin});
}

std::vector<PathContact> Komo::checkMotion(double margin, double tolerance,
                                           const CancellationToken& cancellation) const {
  path().requireBuilt("checkMotion");
  if (!std::isfinite(margin)) throw ValueError(cat("checkMotion: margin is ", margin, "; expected a distance in m"));
  if (!(tolerance > 0.) || !std::isfinite(tolerance))
    throw ValueError(cat("checkMotion: tolerance is ", tolerance, "; expected a distance > 0 in m"));
  return contactsOf(motionsOf(path()), margin, tolerance, cancellation);
}

std::string Komo::addContactForce(const std::vector<double>& times, const std::string& object, const std::string& from,
                                  double friction, double mass) {
  return kinegraph::addContactForce(*motion_, {times, object, from, friction, mass});
}

std::string Komo::addFreeContactForce(const std::vector<double>& times, const std::string& object,
                                      const std::string& from, double friction, double mass, double distance) {
  return kinegraph::addContactForce(*motion_, {times, object, from, friction, mass, true, distance});
}

std::string Komo::addForceExchange(const std::vector<double>& times, const std::string& object, const std::string& from,
                                   ForceExchange kind, double friction) {
  return kinegraph::addForceExchange(*motion_, {times, object, from, kind, friction});
}

MatrixXd Komo::getPath(const std::vector<int>& frames) const {
  path().requireBuilt("getPath");
  return path().joints(frames);
}

MatrixXd Komo::getFrameState(int slice) const {
  path().requireBuilt("getFrameState");
  return path().framePoses(slice);
}

Config Komo::configuration(int slice) const {
  path().requireBuilt("getConfiguration");
  return path().configuration(slice);
}

void Komo::updateRootObjects(const Config& config) {
  path().requireBuilt("updateRootObjects");
  motion_->path.updateRootObjects(config);
}

}  // namespace kinegraph
