#include "kinegraph/control/mpc.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSameTime = 1e-6;    // part of a slice that counts as rounding
constexpr double kFeasible = 1e-3;    // of a scaled constraint
constexpr int kInVain = 40;           // evaluations without a feasible motion, after which it forgets
constexpr double kMostPenalty = 1e4;  // times the first one: what a warm start goes on with

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

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
  rows_ = pathComponents(*separate_);
  findLaterRows();
  Path& path = komo_->path();
  for (int t = -path.grid().order(); t < path.grid().slices(); ++t) {
    parameters_.push_back(std::make_shared<Parameters>(path.state(t).parameters()));
    path.setParameters(t, parameters_.back());
  }
  x_ = path.variables();
  dual_ = VectorXd::Zero(Eigen::Index(rows_.size()));
  shifted_x_ = feasible_x_ = x_, shifted_dual_ = dual_;
  q_ = path.initial().q, velocity_ = VectorXd::Zero(q_.size()), placed_ = q_;
  solver_.verbose = 0;
}

void Mpc::requireProblem() const {
  const Path& path = komo_->path();
  path.requireBuilt("Mpc");
  if (path.grid().order() == 0)
    throw ValueError(
        "Mpc: the KOMO has order 0, so that its slices do not know where the motion begins; make it with order 1 or 2");
  for (const Objective& objective : komo_->objectives()) {
    if (objective.between_slices)
      throw ValueError("Mpc: addFreeMotion has no place in a horizon; use accumulatedCollisions with a margin");
  }
  if (options.receding && !path.layout().plain)
    throw ValueError(
        "Mpc: slices with mode switches, or dofs that they share, cannot recede; with receding=false the switches come "
        "nearer");
}

void Mpc::findLaterRows() {
  std::map<std::tuple<int, int, int>, int> places;
  for (std::size_t i = 0; i < rows_.size(); ++i) places[{rows_[i].objective, rows_[i].slice, rows_[i].row}] = int(i);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto found = places.find({rows_[i].objective, rows_[i].slice + 1, rows_[i].row});
    later_.push_back(found == places.end() ? int(i) : found->second);
  }
}

/// The frames that hang below one, fixed to it, as they did when this was first asked.
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
      throw ValueError(cat("Mpc: setPoses of '", model.frame_name[std::size_t(frame)],
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
    throw ValueError(cat("Mpc: setPoses of '", name, "', which joints move; expected a frame of the world"));
  if ((poses.rows() != T && poses.rows() != 1) || (poses.cols() != 7 && poses.cols() != 3) || !poses.allFinite())
    throw ValueError(cat("Mpc: setPoses of '", name, "' with shape (", poses.rows(), ", ", poses.cols(),
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
    throw ValueError(cat("Mpc: there is no objective ", number, "; the KOMO has ", objectives.size()));
  const Objective& objective = objectives[std::size_t(number)];
  const int slices = std::max(objective.to - objective.from + 1, 0);
  if (slices == 0) return;
  const Residual residual = residualIn(objective, komo_->path(), komo_->contacts().forces(), objective.from);
  const int rows = residual.feature().rows();
  if (residual.feature().quaternionRow() >= 0)
    throw ValueError(
        cat("Mpc: setTarget of ", objective.name(), ", which is an orientation; give its frame poses instead"));
  if ((targets.rows() != slices && targets.rows() != 1) || targets.cols() != rows || !targets.allFinite())
    throw ValueError(cat("Mpc: setTarget of objective ", number, " (", objective.name(), ") with shape (",
                         targets.rows(), ", ", targets.cols(), "); expected (", slices, ", ", rows,
                         "), or one row for all slices"));
  const MatrixXd& scale = residual.scale();
  VectorXd change(rows);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const PathComponent& row = rows_[i];
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

const MpcResult& Mpc::step(const VectorXd& q, const VectorXd& velocity, double dt) {
  const auto start = Clock::now();
  const TimeGrid& grid = komo_->path().grid();
  options.validate();
  requireJoints("q", q, komo_->dofs());
  requireJoints("velocity", velocity, komo_->dofs());
  if (!std::isfinite(dt)) throw ValueError("Mpc: dt is not finite; expected a number of seconds, or < 0 for tau");
  const double slices = has_path_ ? (dt < 0. ? 1. : dt / grid.tau()) : 0.;
  elapsed_ += slices * grid.tau();
  q_ = q, velocity_ = velocity;
  result_.was_cold = !has_path_;
  if (options.receding && slices > 0.) {
    const double shift = std::min(slices, double(grid.slices()));
    shiftPath(shift, x_);
    shiftPath(shift, feasible_x_);
    shiftMultipliers(shift);
  }
  if (returns_) x_ = feasible_x_;
  returns_ = false;
  setPresent(q, velocity);
  has_path_ = true;
  search();
  result_.time = secondsSince(start);
  return result_;
}

/// The motion goes on from its end as it did before; without costs of accelerations it rests there.
void Mpc::shiftPath(double slices, VectorXd& x) {
  const TimeGrid& grid = komo_->path().grid();
  const int T = grid.slices(), n = komo_->path().dofs();
  const bool goes_on = grid.order() >= 2 && T >= 2;
  for (int t = 0; t < T; ++t) {
    const double at = t + slices;
    const int before = std::min(int(at + kSameTime), T - 1);
    const double part = at - before;
    auto shifted = shifted_x_.segment(t * n, n);
    shifted = x.segment(before * n, n);
    if (part < kSameTime) continue;
    if (before < T - 1)
      shifted += part * (x.segment((before + 1) * n, n) - x.segment(before * n, n));
    else if (goes_on)
      shifted += part * (x.segment((T - 1) * n, n) - x.segment((T - 2) * n, n));
  }
  x.swap(shifted_x_);
}

void Mpc::shiftMultipliers(double slices) {
  const int whole = int(slices + kSameTime);
  const double part = std::max(0., slices - whole) < kSameTime ? 0. : std::min(slices - whole, 1.);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    int row = int(i);
    for (int k = 0; k < whole; ++k) row = later_[std::size_t(row)];
    shifted_dual_[Eigen::Index(i)] = (1. - part) * dual_[row] + part * dual_[later_[std::size_t(row)]];
  }
  dual_.swap(shifted_dual_);
}

/// The slices up to now are given: those before the start by their states, others by bounds.
void Mpc::setPresent(const VectorXd& q, const VectorXd& velocity) {
  Path& path = komo_->path();
  const int order = path.grid().order(), T = path.grid().slices();
  const double tau = path.grid().tau();
  const int over = options.receding ? 0 : int(std::min(elapsed_ / tau + kSameTime, double(T)));
  for (std::size_t i = 0; i < rows_.size() && over > past_; ++i)
    if (rows_[i].slice < over) problem_->setPast(int(i));
  const auto fix = [&](int variable, double value) { problem_->fix(variable, x_[variable] = value); };
  for (int t = past_; t < over; ++t) {  // where they are not measured, as planned
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
  past_ = over;
  const double lag = options.receding ? 0. : elapsed_ - past_ * tau;
  for (int back = 0; back < order; ++back) {
    const int t = past_ - 1 - back;
    placed_ = q - (lag + back * tau) * velocity;
    if (path.layout().plain) {
      if (t < 0) path.setSlice(t, placed_.data());
      for (int d = 0; t >= 0 && d < path.dofs(); ++d) fix(t * path.dofs() + d, placed_[d]);
      continue;
    }
    if (t < 0) {
      path.setJoints(t, placed_);
      continue;
    }
    const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, t);
    for (std::size_t d = 0; d < dofs.size(); ++d) {
      const int variable = path.layout().column[std::size_t(t + order)][std::size_t(dofs[d])];
      if (variable >= 0) fix(variable, placed_[Eigen::Index(d)]);
    }
  }
}

/// The solver goes on with what it knows. Where that leads to no feasible motion, its multipliers and penalty say little
/// about the next problem, and could hold it back for long, as can a path of least violation.
void Mpc::search() {
  std::unique_ptr<Memory::Parts>& parts = memory_.parts;
  if (!parts) parts = std::make_unique<Memory::Parts>(*problem_);
  solver_.stopTolerance = options.tolerance;
  solver_.stopGTolerance = options.violation;
  solver_.stopEvals = result_.was_cold ? options.first_evaluations : options.evaluations;
  solver_.muInit = std::clamp(parts->penalty, options.penalty, kMostPenalty * options.penalty);
  int evals = 0;
  auto begun = Clock::now(), before = begun;
  EvaluationHook hook;
  if (options.microseconds > 0. && !result_.was_cold) {
    hook = [&](const VectorXd&, const VectorXd&) {  // no step that would take longer than is left
      const auto now = Clock::now();
      const double used = std::chrono::duration<double>(now - begun).count();
      if (++evals > 1) step_seconds_ = std::chrono::duration<double>(now - before).count();
      before = now;
      if (evals > 1 && used + step_seconds_ > 1e-6 * options.microseconds)
        solver_.stopEvals = std::min(solver_.stopEvals, evals);
      return true;
    };
  }
  try {
    parts->function.begin(x_, solver_, hook);
    AugmentedLagrangian method(*problem_, *parts, x_, solver_);
    method.search(dual_);
    result_.status = method.status();
    result_.message = method.message();
  } catch (...) {
    forget();
    restAt(q_);
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
  struggled_ = result_.feasible ? 0 : struggled_ + result_.evals;
  if (result_.feasible) feasible_x_ = x_;
  if (struggled_ >= kInVain || (!result_.feasible && result_.status != SolverStatus::limit)) {
    forget();
    returns_ = true;
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
  struggled_ = 0;
  if (memory_.parts) memory_.parts->damping = memory_.parts->penalty = 0.;
}

void Mpc::reset() {
  forget();
  restAt(q_);
  problem_->free();
  elapsed_ = 0.;
  past_ = 0;
  has_path_ = false;
}

MotionPoint Mpc::at(double time) const {
  const Path& path = komo_->path();
  const int T = path.grid().slices();
  const double tau = path.grid().tau(), now = options.receding ? 0. : elapsed_;
  const auto when = [&](int t) { return t < past_ ? 0. : (t + 1) * tau - now; };
  const auto where = [&](int t) -> VectorXd {
    if (t < past_) return q_;
    if (path.layout().plain) return path.state(t).q();
    const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, t);
    VectorXd q(dofs.size());
    for (std::size_t d = 0; d < dofs.size(); ++d) q[Eigen::Index(d)] = path.state(t).q()[dofs[d]];
    return q;
  };
  const auto speed = [&](int t) -> VectorXd {
    if (t < past_) return velocity_;
    const int next = std::min(t + 1, T - 1);
    return (where(next) - where(t - 1)) / (when(next) - when(t - 1));
  };
  if (past_ >= T) return {q_, VectorXd::Zero(q_.size())};
  if (time <= 0.) return {q_, velocity_};
  int t = past_;
  while (t < T && when(t) < time) ++t;
  if (t == T) return {where(T - 1), VectorXd::Zero(q_.size())};
  const double length = when(t) - when(t - 1), s = (time - when(t - 1)) / length;
  const VectorXd a = where(t - 1), b = where(t), va = length * speed(t - 1), vb = length * speed(t), way = b - a;
  const VectorXd q = a + s * (va + s * ((3. * way - 2. * va - vb) + s * (va + vb - 2. * way)));
  const VectorXd velocity = (va + s * (2. * (3. * way - 2. * va - vb) + s * 3. * (va + vb - 2. * way))) / length;
  return {q, velocity};
}

}  // namespace kinegraph
