#include "kinegraph/api/simulation_view.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

#include "kinegraph/api/bot_stage.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kRest = .02;                            ///< s
constexpr Seconds kPatience(5.);                         ///< without a browser; then a paused simulation continues
constexpr Seconds kMeasure(.25);                         ///< averaging window of the real-time factor
constexpr Seconds kMaxDelay(.05);                        ///< larger delays are not caught up
constexpr double kAftermath = 1.;                        ///< s after an edit or a pull in which its effects are bounded
constexpr double kBeyondLimits = .05;                    ///< rad or m by which they may move a joint beyond its limits
constexpr double kMostOfVelocity = 10., kFastest = 50.;  ///< times a joint's limit; rad/s or m/s
constexpr int kEscapeKey = 27;

bool endsRun(int key) { return key == kEscapeKey || key == 'q'; }

}  // namespace

SimulationView::SimulationView(const Simulation& simulation, std::shared_ptr<ConfigViewer> viewer, Check check)
    : viewer_(std::move(viewer)),
      check_(std::move(check)),
      start_(simulation.getState()),
      structure_(simulation.config().scene()->structureRevision()) {}

SimulationView::~SimulationView() {
  if (viewer_->isOpen()) viewer_->server().endRun();
}

std::shared_ptr<SimulationView> SimulationView::of(const Simulation& simulation,
                                                   const std::shared_ptr<ConfigViewer>& viewer) {
  const auto view = std::dynamic_pointer_cast<SimulationView>(simulation.observer());
  return view && view->viewer_ == viewer ? view : nullptr;
}

bool SimulationView::isWatched() {
  const Clock::time_point now = Clock::now();
  if (viewer_->clients() > 0) last_seen_ = now;
  return now - last_seen_ < kPatience;
}

bool SimulationView::mayStep(Simulation& simulation) {
  if (!viewer_->isOpen()) return true;
  const RunRequests requests = viewer_->server().takeRunRequests();
  bool changed = takeEdits(simulation);
  if (requests.reset) {
    simulation.setState(start_);
    changed = true;
  }
  changed = perturb(simulation, requests.perturbation) || changed;
  const double aftermath = simulation.get_t() + kAftermath;  // resetTime may have set back the time
  disturbed_until_ = changed || perturbation_ ? aftermath : std::min(disturbed_until_, aftermath);
  const bool pauses = requests.paused && viewer_->waits() && isWatched(), waits = pauses && requests.steps == 0;
  if (requests.paused && !pauses) viewer_->server().endRunRequests();
  if (std::exchange(is_paused_, pauses) != pauses) {
    measured_ = {};  // the pause is not part of the measurement
    changed = true;
  }
  if (waits && changed) show(simulation);
  if (!waits && simulation.get_t() <= disturbed_until_) before_ = simulation.getState();
  return !waits;
}

void SimulationView::rest() {
  viewer_->server().waitRunRequest(kRest);
  check_();
}

void SimulationView::afterStep(Simulation& simulation) {
  if (!viewer_->isOpen()) return;
  const std::uint64_t structure = simulation.config().scene()->structureRevision();
  if (std::exchange(structure_, structure) != structure) start_ = simulation.getState();  // of the changed scene
  measureSpeed(simulation.get_t());
  if (simulation.get_t() <= disturbed_until_ && isBeyondLimits(simulation)) standStill(simulation, simulation.get_t());
  show(simulation);
}

void SimulationView::measureSpeed(double time) {
  const Clock::time_point now = Clock::now();
  if (measured_ != Clock::time_point{}) {
    if (now - measured_ < kMeasure && time >= measured_time_) return;
    factor_ = std::max(time - measured_time_, 0.) / Seconds(now - measured_).count();
  }
  measured_ = now;
  measured_time_ = time;
}

/// Applies users' edits to the simulation, which keeps its velocities.
bool SimulationView::takeEdits(Simulation& simulation) {
  Config config(simulation.config().scene());
  if (!viewer_->takeEdits(config)) return false;
  const MatrixXd frames = simulation.get_frameVelocities();
  const VectorXd joints = simulation.get_qDot();
  simulation.pushConfigToSim(frames, joints);
  return true;
}

/// Joints are springs at their limits, and integration is unreliable at speeds far above those of robots.
bool SimulationView::isBeyondLimits(const Simulation& simulation) const {
  const Config config(simulation.config().scene());
  const MatrixXd limits = config.getJointLimits();
  const VectorXd q = simulation.get_q(), fastest = (kMostOfVelocity * getVelocityLimits(config)).cwiseMin(kFastest);
  return (q.array() < limits.row(0).transpose().array() - kBeyondLimits).any() ||
         (q.array() > limits.row(1).transpose().array() + kBeyondLimits).any() ||
         (simulation.get_qDot().array().abs() > fastest.array()).any();
}

/// Ends the pull and stops everything where it was before the step, with joints within their limits.
void SimulationView::standStill(Simulation& simulation, double time) {
  SimulationState state = before_;
  const MatrixXd limits = Config(simulation.config().scene()).getJointLimits();
  state.q = state.q.cwiseMax(limits.row(0).transpose()).cwiseMin(limits.row(1).transpose());
  state.qDot.setZero();
  state.freeVel.setZero();
  state.time = time;
  simulation.setState(state);
  simulation.endPerturbation();
  disturbed_until_ = time + kAftermath;
}

/// Edits of users, such as an obstacle that is moved into a robot, may leave no step that does not diverge.
bool SimulationView::replaceStep(Simulation& simulation, double tau) {
  if (simulation.get_t() > disturbed_until_) return false;
  standStill(simulation, simulation.get_t() + tau);
  return true;
}

bool SimulationView::perturb(Simulation& simulation, const std::optional<RunRequests::Perturbation>& request) {
  if (request == perturbation_) return false;
  perturbation_ = request;
  if (!request) {
    simulation.endPerturbation();
    return true;
  }
  const Config& config = simulation.config();
  if (request->structure != viewer_->structure() || request->frame < 0 || request->frame >= config.getFrameDimension())
    return false;
  try {
    simulation.perturb(config.getFrame(request->frame).getName(), request->point, request->target);
  } catch (const ValueError&) {  // the frame is fixed to the world
    return false;
  }
  return true;
}

void SimulationView::show(const Simulation& simulation) {
  viewer_->update(simulation.config());
  ShownRun run;
  run.time = simulation.get_t();
  run.factor = factor_;
  run.is_paused = is_paused_;
  run.contacts = shownContacts(simulation.getContacts());
  if (const auto spring = simulation.getPerturbation())
    run.perturbation = {spring->position, spring->target, spring->force.norm()};
  viewer_->server().showRun(run);
}

int SimulationView::view(Simulation& simulation, bool pause, const std::optional<std::string>& message) {
  show(simulation);
  return viewer_->wait(pause, message, [this] {
    check_();
    return false;
  });
}

int SimulationView::run(Simulation& simulation, double seconds, double tau, double speed) {
  int last = 0;
  due_ = {};
  for (double left = std::round(seconds / tau); left > 0.; --left) {
    check_();
    simulation.step({}, tau, ControlMode::spline);
    if (const int key = viewer_->takeKey()) last = key;
    if (endsRun(last)) break;
    if (speed > 0. && viewer_->clients() > 0) keepPace(tau, speed);
  }
  return last;
}

/// Waits until tau / speed of real time has passed since the last call.
void SimulationView::keepPace(double tau, double speed) {
  const Clock::time_point now = Clock::now();
  if (now - due_ > kMaxDelay + Seconds(tau / speed)) due_ = now;  // at the first call, or after a pause
  due_ += std::chrono::duration_cast<Clock::duration>(Seconds(tau / speed));
  while (Clock::now() < due_) {
    std::this_thread::sleep_until(
        std::min(due_, Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(kRest))));
    check_();
  }
}

int Simulation::view(bool pause, const std::string& message) {
  const std::optional<std::string> text = message.empty() ? std::nullopt : std::optional(message);
  impl_->config.viewer();  // creates the viewer of its scene
  const std::shared_ptr<ConfigViewer>& viewer = impl_->config.scene()->viewer;
  std::shared_ptr<SimulationView> view = SimulationView::of(*this, viewer);
  if (!view) view = SimulationView::begin(*this, viewer, [] {});
  return view->view(*this, pause, text);
}

int Simulation::run(double seconds, double tau, double speed, const CancellationToken& cancellation) {
  if (!(seconds >= 0.) || !(tau > 0.))
    throw ValueError(cat("Simulation.run: seconds ", seconds, ", tau ", tau, "; expected seconds >= 0 and tau > 0"));
  if (const auto view = std::dynamic_pointer_cast<SimulationView>(impl_->observer))
    return view->run(*this, seconds, tau, speed);
  if (seconds > 0.) multi_step(seconds, tau, cancellation);
  return 0;
}

}  // namespace kinegraph
