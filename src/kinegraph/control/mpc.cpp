#include "kinegraph/control/mpc.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/control/horizon_nlp.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/komo/path/contacts.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/komo/path_components.h"
#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

namespace kinegraph {

namespace {

constexpr double kSameTime = 1e-6;            // smaller parts of a slice count as rounding
constexpr double kFeasible = 1e-3;            // largest violation of a scaled constraint
constexpr int kMaxEvalsWithoutFeasible = 40;  // then multipliers and penalty are forgotten
constexpr double kLargestPenalty = 1e4;       // of a warm start, in units of the initial penalty

void requireJoints(const char* name, const VectorXd& given, int dofs) {
  if (given.size() != dofs)
    throw ValueError(cat("Mpc: ", name, " has ", given.size(), " entries; the problem has ", dofs, " dofs"));
  if (!given.allFinite()) throw ValueError(cat("Mpc: ", name, " has entries that are not finite"));
}

}  // namespace

void MpcOptions::validate() const {
  const auto check = [](const char* name, double value, bool holds, const char* expected) {
    if (!holds) throw ValueError(cat("Mpc: ", name, " is ", value, "; expected ", expected));
  };
  check("evaluations", evaluations, evaluations >= 2, "at least 2, which is one step");
  check("first_evaluations", first_evaluations, first_evaluations >= 2, "at least 2");
  check("microseconds", microseconds, microseconds >= 0., "a number >= 0 (0: no limit)");
  check("tolerance", tolerance, tolerance > 0., "a number > 0 (rad or m)");
  check("violation", violation, violation > 0., "a number > 0");
  check("penalty", penalty, penalty > 0., "a number > 0");
}

Mpc::Mpc(const Komo& komo, const MpcOptions& given) : options(given), komo_(std::make_shared<Komo>(komo.clone())) {
  options.validate();
  requireProblem();
  const auto nlp = makeNlp(komo_);
  separate_ = nlp->separation().problem;
  if (!separate_) separate_ = nlp;
  problem_ = std::make_unique<HorizonNlp>(separate_);
  residuals_ = pathComponents(*separate_);
  findLaterResiduals();
  Path& path = komo_->path();
  for (int t = -path.grid().order(); t < path.grid().slices(); ++t) {
    parameters_.push_back(std::make_shared<Parameters>(path.state(t).parameters()));
    path.setParameters(t, parameters_.back());
  }
  x_ = path.variables();
  dual_ = VectorXd::Zero(Eigen::Index(residuals_.size()));
  shifted_x_ = feasible_x_ = x_, shifted_dual_ = dual_;
  q_ = path.initial().q, velocity_ = VectorXd::Zero(q_.size()), measured_ = q_;
  solver_.verbose = 0;
  updateMotion();
}

Mpc::~Mpc() = default;

void Mpc::requireProblem() const {
  const Path& path = komo_->path();
  path.requireBuilt("Mpc");
  if (path.grid().order() == 0)
    throw ValueError(
        "Mpc: the KOMO has order 0, so that its slices do not depend on the start of the motion; make it with order 1 "
        "or "
        "2");
  for (const Objective& objective : komo_->objectives()) {
    if (objective.between_slices)
      throw ValueError(
          "Mpc: the KOMO has addFreeMotion, which Mpc does not support; use accumulatedCollisions with a margin");
  }
  if (options.receding && !path.layout().plain)
    throw ValueError(
        "Mpc: the KOMO has mode switches or dofs that slices share, which a receding horizon cannot shift; pass "
        "receding=false");
}

void Mpc::findLaterResiduals() {
  std::map<std::tuple<int, int, int>, int> indices;
  for (std::size_t i = 0; i < residuals_.size(); ++i)
    indices[{residuals_[i].objective, residuals_[i].slice, residuals_[i].row}] = int(i);
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const auto found = indices.find({residuals_[i].objective, residuals_[i].slice + 1, residuals_[i].row});
    later_.push_back(found == indices.end() ? int(i) : found->second);
  }
}

/// Returns the frames below one that are fixed to it, with their relative poses at the time of the first call.
const std::vector<Mpc::Carried>& Mpc::carriedBy(int frame) {
  const auto [place, is_new] = carried_.try_emplace(frame);
  if (!is_new) return place->second;
  const Path& path = komo_->path();
  const KinematicModel& model = *path.initial().model;
  const auto& offsets = parameters_.front()->frame_offset;
  const RigidTransform from = offsets[std::size_t(frame)].inverse();
  for (const auto& below : path.initial().tree->frames()) {
    const FrameData* parent = below->parent;
    while (parent && parent->id != frame) parent = parent->parent;
    if (!parent) continue;
    if (model.frame_link[std::size_t(below->id)] != 0) {
      carried_.erase(frame);
      throw ValueError(cat("Mpc: setPoses got '", model.frame_name[std::size_t(frame)],
                           "', which carries the joint of '", below->name,
                           "'; expected a frame without joints below it"));
    }
    place->second.push_back({below->id, Pose(from * offsets[std::size_t(below->id)])});
  }
  return place->second;
}

void Mpc::setPoses(const std::string& name, const MatrixXd& poses) {
  Path& path = komo_->path();
  const int frame = frameId(*path.initial().model, name, "Mpc"), order = path.grid().order(), T = path.grid().slices();
  const int link = path.initial().model->frame_link[std::size_t(frame)];
  if (link != 0)
    throw ValueError(cat("Mpc: setPoses got '", name, "', which joints move; expected a frame that no joint moves"));
  if ((poses.rows() != T && poses.rows() != 1) || (poses.cols() != 7 && poses.cols() != 3) || !poses.allFinite())
    throw ValueError(cat("Mpc: setPoses got poses of '", name, "' with shape (", poses.rows(), ", ", poses.cols(),
                         "); expected (", T, ", 7) or (", T, ", 3), or one row for all slices, of finite numbers"));
  for (int t = 0; t < poses.rows() && poses.cols() == 7; ++t)
    unitQuaternion(poses.row(t).tail<4>().transpose(), "Mpc: the quaternion of a pose");
  const std::vector<Carried>& carried = carriedBy(frame);
  for (int t = -order; t < T; ++t) {
    const auto row = poses.row(poses.rows() == 1 ? 0 : std::max(t, 0));
    auto& offsets = parameters_[std::size_t(t + order)]->frame_offset;
    RigidTransform& X = offsets[std::size_t(frame)];
    X.p = row.head<3>().transpose();
    if (poses.cols() == 7) X.R = unitQuaternion(row.tail<4>().transpose()).toRotationMatrix();
    for (const Carried& below : carried) offsets[std::size_t(below.frame)] = X * below.pose.transform();
  }
}

void Mpc::updateRootObjects(const Config& config) {
  const KinematicModel& given = *komo_->path().initial().model;
  const auto model = config.model();
  if (model->frame_name != given.frame_name || model->dofs != given.dofs)
    throw ValueError(
        "Mpc: updateRootObjects needs the configuration that the KOMO was made from, with the same frames and joints");
  const auto poses = config.parameters();
  for (const auto& parameters : parameters_) {
    for (std::size_t frame = 0; frame < given.frame_link.size(); ++frame) {
      if (given.frame_link[frame] == 0 && model->frame_link[frame] == 0)
        parameters->frame_offset[frame] = poses->frame_offset[frame];
    }
  }
}

void Mpc::setTarget(int number, const MatrixXd& targets) {
  const ObjectiveList& objectives = komo_->objectives();
  if (number < 0 || number >= int(objectives.size()))
    throw ValueError(cat("Mpc: there is no objective ", number, "; the KOMO has ", objectives.size(), " objectives"));
  const Objective& objective = objectives[std::size_t(number)];
  const int slices = std::max(objective.to - objective.from + 1, 0);
  if (slices == 0) return;
  const Residual residual = residualIn(objective, komo_->path(), komo_->contacts().forces(), objective.from);
  const int rows = residual.feature().rows();
  if (residual.feature().quaternionRow() >= 0)
    throw ValueError(cat("Mpc: setTarget got ", objective.name(),
                         ", which is an orientation; call setPoses for its target frame instead"));
  if ((targets.rows() != slices && targets.rows() != 1) || targets.cols() != rows || !targets.allFinite())
    throw ValueError(cat("Mpc: setTarget got targets of objective ", number, " (", objective.name(), ") with shape (",
                         targets.rows(), ", ", targets.cols(), "); expected (", slices, ", ", rows,
                         "), or one row for all slices"));
  const MatrixXd& scale = residual.scale();
  VectorXd change(rows);
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    const PathComponent& row = residuals_[i];
    if (row.objective != number) continue;
    change = -targets.row(targets.rows() == 1 ? 0 : row.slice - objective.from).transpose();
    if (residual.target().size() == 1) change.array() += residual.target()[0];
    if (residual.target().size() == rows) change += residual.target();
    const double offset = residual.mixesRows() ? scale.row(row.row).dot(change)
                          : scale.size() == 0  ? change[row.row]
                                               : scale(scale.size() == 1 ? 0 : row.row) * change[row.row];
    problem_->setOffset(int(i), offset);
  }
}

const MpcResult& Mpc::step(const VectorXd& q, const VectorXd& velocity, std::optional<double> dt) {
  const Stopwatch stopwatch;
  const TimeGrid& grid = komo_->path().grid();
  options.validate();
  requireProblem();  // `receding` may have been changed
  requireJoints("q", q, komo_->dofs());
  requireJoints("velocity", velocity, komo_->dofs());
  if (dt && !(*dt >= 0. && std::isfinite(*dt)))
    throw ValueError(cat("Mpc: dt is ", *dt, "; expected a finite number >= 0 (s)"));
  const double slices = !has_path_ ? 0. : dt ? *dt / grid.tau() : 1.;
  elapsed_ += slices * grid.tau();
  q_ = q, velocity_ = velocity;
  result_.was_cold = !has_path_;
  if (options.receding && slices > 0.) {
    const double shift = std::min(slices, double(grid.slices()));
    shiftPath(shift, x_);
    shiftPath(shift, feasible_x_);
    shiftMultipliers(shift);
  }
  if (restores_feasible_) x_ = feasible_x_;
  restores_feasible_ = false;
  setPresent(q, velocity);
  has_path_ = true;
  search();
  updateMotion();
  result_.time = stopwatch.seconds();
  return result_;
}

/// Shifts a path in time. Beyond its end the motion continues with constant velocity, or rests if the order is 1.
void Mpc::shiftPath(double slices, VectorXd& x) {
  const TimeGrid& grid = komo_->path().grid();
  const int T = grid.slices(), n = komo_->path().dofs();
  const bool continues = grid.order() >= 2 && T >= 2;
  for (int t = 0; t < T; ++t) {
    const double at = t + slices;
    const int before = std::min(int(at + kSameTime), T - 1);
    const double part = at - before;
    auto shifted = shifted_x_.segment(t * n, n);
    shifted = x.segment(before * n, n);
    if (part < kSameTime) continue;
    if (before < T - 1)
      shifted += part * (x.segment((before + 1) * n, n) - x.segment(before * n, n));
    else if (continues)
      shifted += part * (x.segment((T - 1) * n, n) - x.segment((T - 2) * n, n));
  }
  x.swap(shifted_x_);
}

void Mpc::shiftMultipliers(double slices) {
  const int whole = int(slices + kSameTime);
  const double part = std::max(0., slices - whole) < kSameTime ? 0. : std::min(slices - whole, 1.);
  for (std::size_t i = 0; i < residuals_.size(); ++i) {
    int from = int(i);
    for (int k = 0; k < whole; ++k) from = later_[std::size_t(from)];
    shifted_dual_[Eigen::Index(i)] = (1. - part) * dual_[from] + part * dual_[later_[std::size_t(from)]];
  }
  dual_.swap(shifted_dual_);
}

/// Fixes the slices up to now: slices before the start by their states, others by bounds.
void Mpc::setPresent(const VectorXd& q, const VectorXd& velocity) {
  Path& path = komo_->path();
  const int order = path.grid().order(), T = path.grid().slices();
  const double tau = path.grid().tau();
  const int past = options.receding ? 0 : int(std::min(elapsed_ / tau + kSameTime, double(T)));
  for (std::size_t i = 0; i < residuals_.size() && past > past_; ++i)
    if (residuals_[i].slice < past) problem_->setPast(int(i));
  const auto fix = [&](int variable, double value) { problem_->fix(variable, x_[variable] = value); };
  for (int t = past_; t < past; ++t) {  // slices that were not measured stay as planned
    if (path.layout().plain) {
      for (int d = 0; d < path.dofs(); ++d) fix(t * path.dofs() + d, x_[t * path.dofs() + d]);
      continue;
    }
    for (const auto& [first, count] : path.layout().owned[std::size_t(t + order)]) {
      for (int d = first; d < first + count; ++d) {
        const int variable = path.layout().column[std::size_t(t + order)][std::size_t(d)];
        fix(variable, x_[variable]);
      }
    }
  }
  past_ = past;
  const double lag = options.receding ? 0. : elapsed_ - past_ * tau;
  for (int back = 0; back < order; ++back) {
    const int t = past_ - 1 - back;
    measured_ = q - (lag + back * tau) * velocity;
    if (path.layout().plain) {
      if (t < 0) path.setSlice(t, measured_.data());
      for (int d = 0; t >= 0 && d < path.dofs(); ++d) fix(t * path.dofs() + d, measured_[d]);
      continue;
    }
    if (t < 0) {
      path.setJoints(t, measured_);
      continue;
    }
    const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, t);
    for (std::size_t d = 0; d < dofs.size(); ++d) {
      const int variable = path.layout().column[std::size_t(t + order)][std::size_t(dofs[d])];
      if (variable >= 0) fix(variable, measured_[Eigen::Index(d)]);
    }
  }
}

/// Runs the solver with the state of the last call. If that finds no feasible motion for long, the multipliers, the
/// penalty and the path of least violation say little about the next problem and could delay its solution, so they are
/// dropped.
void Mpc::search() {
  std::unique_ptr<Memory::Parts>& parts = memory_.parts;
  if (!parts) parts = std::make_unique<Memory::Parts>(*problem_);
  solver_.stopTolerance = options.tolerance;
  solver_.stopGTolerance = options.violation;
  solver_.stopEvals = result_.was_cold ? options.first_evaluations : options.evaluations;
  solver_.muInit = std::clamp(parts->penalty, options.penalty, kLargestPenalty * options.penalty);
  int evals = 0;
  const Stopwatch stopwatch;
  double before = 0.;
  EvaluationCallback callback;
  if (options.microseconds > 0. && !result_.was_cold) {
    callback = [&](const VectorXd&, const VectorXd&) {  // makes no step that would exceed the budget
      const double now = stopwatch.seconds();
      if (++evals > 1) step_seconds_ = now - before;
      before = now;
      if (evals > 1 && now + step_seconds_ > 1e-6 * options.microseconds)
        solver_.stopEvals = std::min(solver_.stopEvals, evals);
      return true;
    };
  }
  try {
    parts->function.begin(x_, solver_, callback);
    AugmentedLagrangian method(*problem_, *parts, x_, solver_);
    method.search(dual_);
    result_.status = method.status();
    result_.message = method.message();
  } catch (...) {
    forget();
    restAt(q_);
    updateMotion();
    throw;
  }
  const EvaluatedPoint& here = parts->here;
  x_ = here.x;
  const std::vector<int>& constraints = parts->function.constraints();
  for (std::size_t j = 0; j < constraints.size(); ++j) dual_[constraints[j]] = parts->lambda[Eigen::Index(j)];
  result_.violation = here.violation;
  result_.cost = here.cost;
  result_.evals = parts->function.evals();
  result_.feasible = here.violation <= std::max(kFeasible, 10. * options.violation);
  evals_without_feasible_ = result_.feasible ? 0 : evals_without_feasible_ + result_.evals;
  if (result_.feasible) feasible_x_ = x_;
  if (evals_without_feasible_ >= kMaxEvalsWithoutFeasible ||
      (!result_.feasible && result_.status != SolverStatus::limit)) {
    forget();
    restores_feasible_ = true;
  }
  problem_->leaveAt(x_);
}

void Mpc::restAt(const VectorXd& q) {
  Path& path = komo_->path();
  for (int t = past_; t < path.grid().slices(); ++t) path.setJoints(t, q);
  x_ = feasible_x_ = path.variables();
}

void Mpc::forget() {
  dual_.setZero();
  evals_without_feasible_ = 0;
  if (memory_.parts) memory_.parts->damping = memory_.parts->penalty = 0.;
}

void Mpc::reset() {
  forget();
  restAt(q_);
  problem_->free();
  elapsed_ = 0.;
  past_ = 0;
  has_path_ = false;
  updateMotion();
}

/// Returns the time of slice t after the last call; all past slices lie at the time of the call.
double Mpc::sliceTime(int t) const {
  const double now = options.receding ? 0. : elapsed_;
  return t < past_ ? 0. : (t + 1) * komo_->path().grid().tau() - now;
}

void Mpc::sliceJoints(int t, Eigen::Ref<VectorXd> q) const {
  const Path& path = komo_->path();
  if (t < past_) {
    q = q_;
  } else if (path.layout().plain) {
    q = path.state(t).q();
  } else {
    const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, t);
    for (std::size_t d = 0; d < dofs.size(); ++d) q[Eigen::Index(d)] = path.state(t).q()[dofs[d]];
  }
}

void Mpc::updateMotion() {
  const int T = komo_->path().grid().slices(), points = T - past_ + 1;
  times_.assign(1, 0.);
  points_.resize(q_.size(), points);
  points_.col(0) = q_;
  for (int t = past_; t < T; ++t) {
    times_.push_back(sliceTime(t));
    sliceJoints(t, points_.col(t - past_ + 1));
  }
  if (points == 1)
    motion_.assign(times_, points_, VectorXd::Zero(q_.size()));
  else
    motion_.assign(times_, points_, velocity_);
}

MotionPoint Mpc::at(double time) const {
  MotionPoint point;
  at(time, point);
  return point;
}

void Mpc::at(double time, MotionPoint& point) const {
  if (std::isnan(time)) throw ValueError("Mpc: time is NaN; expected a number of seconds after the last call");
  thread_local std::vector<double> acceleration;  // not wanted here
  acceleration.resize(std::size_t(q_.size()));
  point.q.resize(q_.size());
  point.velocity.resize(q_.size());
  motion_.evalTo(time, point.q.data(), point.velocity.data(), acceleration.data());
  if (time > motion_.duration()) point.velocity.setZero();
}

}  // namespace kinegraph
