#include "kinegraph/planning/path_finder.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "kinegraph/kinematics/unit_norms.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/pair_choice.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/smoothing/shortcut.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

constexpr const char* kPathFinder = "PathFinder";
constexpr double kAroundEnds = 1.;  ///< m: samples of a dof without limits lie at least this far around its ends

double processorTime() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Gives dofs without limits a range for samples, around both ends. Returns a warning, empty without such dofs.
std::string sampleAroundEnds(JointSpace& space, const VectorXd& start, const VectorXd& goal) {
  const std::vector<std::string> dofs = space.dofsWithoutRange();
  if (dofs.empty()) return {};
  const VectorXd around = (goal - start).cwiseAbs().array() + kAroundEnds;
  space.sampleUnlimitedWithin(start.cwiseMin(goal) - around, start.cwiseMax(goal) + around);
  return cat(kPathFinder, ": no limits are known for ", join(dofs), "; samples lie around start and goal, up to ",
             kAroundEnds, " m and their distance beyond them; set limits, as in {limits: [-1, 1]}");
}

}  // namespace

const OptionTable<PathFinderOptions>& pathFinderOptionTable() {
  using O = PathFinderOptions;
  using Range = OptionRange;
  static const OptionTable<O> table(
      kPathFinder,
      {{"verbose", &O::verbose, "", "0: silent; 1: solve prints a line; 2 and more: it also shows the path."},
       {"stepsize", &O::stepsize, "rad or m", "Longest step between configurations of the path.", Range::positive()},
       {"subsamples", &O::subsamples, "", "Without effect, for older scripts: edges are checked continuously.",
        Range::notNegative()},
       {"maxIters", &O::maxIters, "", "Maximum number of iterations: samples towards which a tree grows.",
        Range::atLeastOne()},
       {"p_connect",
        &O::p_connect,
        "",
        "Without effect, for older scripts: extensions always continue towards the other tree.",
        {[](double v) { return v >= 0. && v <= 1.; }, "a number from 0 to 1"}},
       {"collisionTolerance", &O::collisionTolerance, "m", "Allowed penetration of each pair.", Range::notNegative()},
       {"useBroadCollisions", &O::useBroadCollisions, "", "Without effect, for older scripts."}});
  return table;
}

void PathFinderOptions::validate() const { pathFinderOptionTable().validate(*this); }

PathFinder& PathFinder::setOptions(const PathFinderOptions& options) {
  options.validate();
  options_ = options;
  return *this;
}

PathFinder& PathFinder::setProblem(const Config& config) {
  config_ = &config;
  path_.resize(0, 0);
  return *this;
}

PathFinder& PathFinder::setProblem(const Config& config, const VectorXd& start, const VectorXd& goal) {
  return setProblem(config).setStartGoal(start, goal);
}

PathFinder& PathFinder::setStartGoal(const VectorXd& start, const VectorXd& goal) {
  start_ = start;
  goal_ = goal;
  path_.resize(0, 0);
  return *this;
}

PathFinder& PathFinder::setExplicitCollisionPairs(std::vector<std::pair<std::string, std::string>> pairs) {
  if (config_) {
    for (const auto& [a, b] : pairs) {
      config_->scene()->get(a, "setExplicitCollisionPairs");
      config_->scene()->get(b, "setExplicitCollisionPairs");
    }
  }
  pairs_ = std::move(pairs);
  return *this;
}

SolverResult PathFinder::solve(std::uint64_t seed, const CancellationToken& cancellation) {
  if (!config_) throw ValueError("PathFinder.solve: there is no scene; call setProblem first");
  warning_.clear();
  if (start_.size() == 0) throw ValueError("PathFinder.solve: there are no start and goal; call setStartGoal first");
  const double began = processorTime();
  const State scene =
      pairs_.empty() ? config_->state() : onlyPairs(*config_, pairs_, "setExplicitCollisionPairs").state();
  SolverResult result;
  path_ = search(scene, seed, cancellation, result);
  result.done = true;
  result.feasible = path_.rows() > 0;
  result.status = result.feasible ? SolverStatus::converged : result.status;
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = path_;
  result.x = Eigen::Map<const VectorXd>(rows.data(), rows.size());
  result.time = processorTime() - began;
  return result;
}

/// Returns no rows if there is no path; the result then says why.
MatrixXd PathFinder::search(const State& scene, std::uint64_t seed, const CancellationToken& cancellation,
                            SolverResult& result) {
  JointSpace space(scene.model());
  const double margin = -options_.collisionTolerance;
  PathQuery query{.constraints = {&scene, &space, {.margin = margin}}, .starts = {}, .goals = {}};
  Steering steering(query.constraints);
  result.status = SolverStatus::infeasible;
  std::vector<Endpoint> ends;
  for (const auto& [q, what] : {std::pair(&start_, "start"), std::pair(&goal_, "goal")}) {
    ends.push_back(checkEndpoint(steering, scene.model(), *q, margin, what, kPathFinder));
    if (ends.back().isFree()) continue;
    result.message = ends.back().problem;
    return {};
  }
  warning_ = sampleAroundEnds(space, ends[0].q, ends[1].q);
  query.constraints.clearance = clearanceAround(margin, {&ends[0], &ends[1]});
  query.constraints.clearance.guard = Clearance::kGuard;
  query.starts = {ends[0].q};
  query.goals = {ends[1].q};
  query.seed = seed;
  query.max_samples = options_.maxIters;
  query.cancellation = cancellation;
  const PathSearchResult found = searchPath(query);
  for (const SearchReport& search : found.searches) result.evals += int(search.samples);
  result.totalEvals = result.evals;
  if (found.points.empty()) {
    result.status = found.was_stopped ? SolverStatus::cancelled : SolverStatus::limit;
    const std::string met = describeObstacles(obstaclesMet(scene.model(), found.hits));
    result.message = cat(found.was_stopped ? "stopped" : "no path found", " after ", result.evals, " samples",
                         met.empty() ? "" : cat("; most edges collided with ", met));
    return {};
  }
  Steering shortcuts(query.constraints);
  const std::vector<VectorXd> points =
      shortcutPath(shortcuts, found.points, {.seed = seed, .cancellation = cancellation});
  result.message = cat(found.is_line ? "the straight motion is collision-free" : "found by RRT-Connect");
  return resampleBySteps(space, space.unroll(points), options_.stepsize);
}

MatrixXd PathFinder::get_resampledPath(int T) const {
  if (path_.rows() == 0) throw ValueError("PathFinder.get_resampledPath: there is no path; call solve first");
  MatrixXd path = resampleByIndex(path_, T);
  VectorXd q(path.cols());
  for (Eigen::Index t = 0; t < path.rows(); ++t) {
    q = path.row(t);
    scaleToUnitNorms(config_->model()->unit_norms, q);
    path.row(t) = q;
  }
  return path;
}

MatrixXd resampleBySteps(const JointSpace& space, const MatrixXd& path, double step) {
  std::vector<VectorXd> points = {path.row(0).transpose()};
  for (Eigen::Index k = 1; k < path.rows(); ++k) {
    const VectorXd from = path.row(k - 1).transpose(), to = path.row(k).transpose();
    const int parts = std::max(1, int(std::ceil(space.distance(from, to) / step)));
    for (int i = 1; i < parts; ++i) {
      points.push_back(from + double(i) / parts * (to - from));
      scaleToUnitNorms(space.unitNorms(), points.back());
    }
    points.push_back(to);
  }
  MatrixXd rows(Eigen::Index(points.size()), path.cols());
  for (std::size_t i = 0; i < points.size(); ++i) rows.row(Eigen::Index(i)) = points[i].transpose();
  return rows;
}

MatrixXd resampleByIndex(const MatrixXd& path, int T) {
  if (T < 1) throw ValueError(cat("get_resampledPath: T is ", T, "; expected at least 1"));
  MatrixXd rows(T, path.cols());
  const Eigen::Index last = path.rows() - 1;
  for (int t = 0; t < T; ++t) {
    const double at = T > 1 ? double(last) * t / (T - 1) : 0.;
    const Eigen::Index k = std::min(Eigen::Index(at), std::max<Eigen::Index>(last - 1, 0));
    const double share = at - double(k);
    rows.row(t) = path.row(k);
    if (last > 0) rows.row(t) += share * (path.row(k + 1) - path.row(k));
  }
  return rows;
}

}  // namespace kinegraph
