#include "kinegraph/task_planning/lgp/lgp_tool.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "kinegraph/task_planning/lgp/lgp_waypoints.h"

namespace kinegraph {

namespace {

constexpr int kRounds = 3;         ///< of failed plans, from other guesses
constexpr int kMotionStarts = 3;   ///< guesses of the motion of all actions
constexpr double kNear = .02;      ///< standard deviation of the perturbation per further guess
constexpr double kCoarse = 1e-3;   ///< tolerance of the motion that starts at collision-free waypoints
constexpr double kOverlap = 1e-3;  ///< m: allowed depth of overlaps
constexpr std::size_t kReportedCauses = 5;

/// Whether nothing overlaps in any slice.
bool isFree(const Komo& komo) {
  for (int t = 0; t < komo.slices(); ++t)
    if (!sliceCollisions(komo, t, -kOverlap).empty()) return false;
  return true;
}

/// Initializes a motion with waypoints of the same plan; `x` are their variables.
void startAlong(Komo& motion, const Komo& waypoints, const VectorXd& x) {
  const MatrixXd rows = waypoints.getPath();
  std::vector<VectorXd> configurations;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) configurations.push_back(rows.row(i));
  motion.setWaypoints(configurations, {1, true, 0.});

  // Dofs shared by all slices are copied; they come first in both problems.
  const auto sharedIn = [](const Komo& komo, const VectorXd& all) {
    Eigen::Index count = all.size();
    for (int t = 0; t < komo.slices(); ++t) count -= komo.path().ownDofs(t).size();
    return count;
  };
  VectorXd start = motion.path().variables();
  const Eigen::Index shared = sharedIn(waypoints, x);
  if (sharedIn(motion, start) != shared) return;  // the motions of the abstraction have other frames
  start.head(shared) = x.head(shared);
  motion.path().setVariables(start);
}

}  // namespace

std::string lgpStatusName(LgpStatus status) {
  switch (status) {
    case LgpStatus::not_started:
      return "not_started";
    case LgpStatus::solved:
      return "solved";
    case LgpStatus::infeasible:
      return "infeasible";
    default:
      return "no_plan_found";
  }
}

LgpTool::LgpTool(const Config& scene, std::shared_ptr<LgpAbstraction> abstraction, LgpOptions given)
    : C(scene.scene()),
      tamp(std::move(abstraction)),
      options(std::move(given)),
      waypoints_(std::make_unique<LgpWaypoints>(C, *tamp, options)) {
  if (options.threads < 1) throw ValueError(cat("LGP_Tool: threads is ", options.threads, "; expected 1 or more"));
  options.solver.validate();
}

LgpTool::~LgpTool() = default;

int LgpTool::solves() const { return waypoints_->solves; }

long LgpTool::evaluations() const { return waypoints_->evaluations; }

bool LgpTool::solve(int verbose, int maxSolves) {
  const int most = solves() + maxSolves;
  const auto report = [&](const Plan& plan, bool is_feasible) {
    if (verbose > 0) options.printLine(cat("-- ", is_feasible ? "feasible" : "infeasible", ": ", planText(plan)));
    return is_feasible;
  };
  while (solves() < most) {
    const std::optional<Plan> plan = tamp->getNewActionSequence();
    if (!plan) break;
    has_plans_ = true;
    const std::optional<std::size_t> failing = waypoints_->failing(*plan);
    if (report(*plan, !failing)) return found(*plan);
    failed_.push_back(*plan);
    tamp->forbidBeginning({plan->begin(), plan->begin() + std::ptrdiff_t(*failing)});
  }
  for (; solves() < most && round_ <= kRounds; ++round_, next_ = 0) {
    while (solves() < most && next_ < failed_.size()) {
      const Plan plan = failed_[next_];
      if (report(plan, waypoints_->tryAgain(plan, round_))) {
        failed_.erase(failed_.begin() + std::ptrdiff_t(next_));
        return found(plan);
      }
      ++next_;
    }
    if (next_ < failed_.size()) break;
  }
  conclude(solves() >= most);
  return false;
}

bool LgpTool::found(const Plan& plan) {
  plan_ = plan;
  komo_ = waypoints_->komo;
  x_ = waypoints_->x;
  status = LgpStatus::solved;
  message.clear();
  return true;
}

void LgpTool::conclude(bool is_spent) {
  const bool is_proved = !is_spent && !has_plans_ && tamp->hasAllPlans();
  status = is_proved ? LgpStatus::infeasible : LgpStatus::no_plan_found;
  message.clear();
  const auto causes = waypoints_->causes();
  for (std::size_t i = 0; i < std::min(causes.size(), kReportedCauses); ++i)
    message += cat(i > 0 ? "; " : "", causes[i].first, " (", causes[i].second, " plans)");
  if (!message.empty()) return;
  message = !tamp->hasAllPlans() ? "the search in logic was given up"
            : has_plans_         ? "no further plan in logic"
                                 : "no plan in logic";
}

const LgpTool::Plan& LgpTool::getSolvedPlan() const {
  if (!hasPlan()) throw ValueError("LGP_Tool: no plan was found yet; call solve");
  return plan_;
}

const std::shared_ptr<Komo>& LgpTool::getSolvedKOMO() const {
  (void)getSolvedPlan();
  return komo_;
}

std::shared_ptr<Komo> LgpTool::get_piecewiseMotionProblem(int phase, bool fixEnd) const {
  const int count = int(getSolvedPlan().size());
  if (phase < 0 || phase >= count)
    throw ValueError(cat("get_piecewiseMotionProblem: phase is ", phase, "; the plan has ", count, " actions"));
  const SubProblem sub = subProblem(komo_->path(), phase);
  const auto helper = tamp->newHelper();
  helper->setup_motion(sub.config, 1., LgpAbstraction::kSteps, 1e-2);
  helper->komo->setWaypoints({sub.end}, {1, true, .5});
  if (fixEnd) helper->komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, 1., sub.end);
  return helper->komo;
}

std::shared_ptr<Komo> LgpTool::get_fullMotionProblem(bool initWithWaypoints) const {
  const Plan& plan = getSolvedPlan();
  const std::shared_ptr<Komo> problem = tamp->setup_motion(C, int(plan.size()));
  tamp->add_all(problem, plan, true);
  if (initWithWaypoints) startAlong(*problem, *komo_, x_);
  return problem;
}

/// Waypoints may overlap, except for named pairs. Then the motion starts at waypoints of the same plan that do not
/// overlap, and a coarse tolerance suffices, because the guess is close.
LgpSolve LgpTool::solveFromFreeWaypoints(const std::shared_ptr<Komo>& problem) {
  const Plan& plan = getSolvedPlan();
  const std::shared_ptr<Komo> waypoints = tamp->setup_sequence(C, int(plan.size()));
  tamp->add_all(waypoints, plan, false);
  waypoints->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, 1.);
  waypoints->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq, 1.);
  SolverOptions coarse = options.solver;
  coarse.stopTolerance = std::max(coarse.stopTolerance, kCoarse);
  for (int round = 0; round <= kRounds; ++round) {
    waypoints->path().setVariables(x_);
    if (round == 0 && isFree(*waypoints)) break;
    if (!solveFrom(waypoints, waypoints_->starts(waypoints, round), options).is_solved) continue;
    startAlong(*problem, *waypoints, waypoints->path().variables());
    const LgpSolve solved = solveFrom(problem, {problem->path().variables()}, options, coarse);
    if (solved.is_solved) return solved;
  }
  return {};
}

std::vector<SolverResult> LgpTool::solvePiecewiseMotions(int verbose) {
  const Plan& plan = getSolvedPlan();
  std::vector<std::shared_ptr<Komo>> pieces;
  for (int phase = 0; phase < int(plan.size()); ++phase) pieces.push_back(get_piecewiseMotionProblem(phase));
  paths.clear();
  std::vector<SolverResult> results;
  solveEach(pieces, options, [&](int i, SolverResult result) {
    paths.push_back(pieces[std::size_t(i)]->getPath());
    if (verbose > 0) options.printLine(cat("-- ", planText({plan[std::size_t(i)]}), ": ", options.describe(result)));
    results.push_back(std::move(result));
  });
  return results;
}

SolverResult LgpTool::solveFullMotion(int verbose) {
  const std::shared_ptr<Komo> problem = get_fullMotionProblem();
  const VectorXd given = problem->path().variables();
  LgpSolve solved = solveFromFreeWaypoints(problem);
  if (!solved.is_solved) {
    std::vector<VectorXd> starts;
    Rng rng(options.seed);
    for (int start = 0; start < kMotionStarts; ++start) {
      VectorXd& at = starts.emplace_back(given);
      for (double& value : at) value += kNear * start * rng.normal();
    }
    solved = solveFrom(problem, starts, options);
  }
  motion = problem;
  path = motion->getPath();
  if (verbose > 0) options.printLine(cat("-- full motion: ", options.describe(solved.result)));
  return solved.result;
}

}  // namespace kinegraph
