#include "kinegraph/planning/smooth_motion.h"

#include <cmath>

#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/solvers/nlp_solver.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kGuard = 1e-3;        // m, beyond the margin: the spline leaves the edges between slices
constexpr double kCost = .1;           // scale of accelerations
constexpr int kMostEvaluations = 120;  // of the solver
constexpr int kParts = 8;              // of a spline piece, in the collision check
constexpr double kFaster = 1e-3;       // least relative gain of the duration
constexpr double kRounding = 1e-9;     // by which a joint may exceed its limits

/// Returns the slices that KOMO finds, the start included; empty if it finds no collision-free path.
MatrixXd solvedPath(const Config& config, const TimedPath& motion, double margin, int slices,
                    const CancellationToken& cancellation) {
  Config scene(config);
  const VectorXd start = motion.eval(0.).q, goal = motion.eval(motion.duration()).q;
  scene.setJointState(start);
  const auto komo = std::make_shared<Komo>();
  komo->setConfig(scene);
  komo->setTiming(1., slices, motion.duration(), 2);
  komo->addControlObjective({}, 2, kCost);
  komo->addFreeMotion({}, margin + kGuard);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, Scale(10.), goal);
  komo->addObjective({1.}, FeatureSymbol::jointState, {}, ObjectiveType::eq, Scale(1.), {}, 1);
  MatrixXd path(slices + 1, start.size());
  for (int i = 0; i <= slices; ++i) path.row(i) = motion.eval(motion.duration() * i / slices).q.transpose();
  komo->setPath(path.bottomRows(slices));
  NlpSolver solver(makeNlp(komo), 0);
  solver.options.verbose = 0;
  solver.options.stopEvals = kMostEvaluations;
  Rng rng(0);
  solver.setInitialization(komo->path().variables());
  const SolverResult result =
      solver.solve(false, rng, [&](const VectorXd&, const VectorXd&) { return !(cancellation && cancellation()); });
  if (!result.feasible) return {};
  path.bottomRows(slices) = komo->getPath();
  path.bottomRows(1) = goal.transpose();
  return path;
}

/// Whether a cubic curve keeps the joint limits: its Bernstein coefficients do.
bool keepsLimits(const PathCurve& curve, const MatrixXd& limits) {
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double h = curve.end(piece) - curve.begin(piece);
    const auto power = [&](int k) -> VectorXd {
      if (k > curve.degree()) return VectorXd::Zero(curve.dofs());
      return std::pow(h, k) * Eigen::Map<const VectorXd>(curve.coefficient(piece, k), curve.dofs());
    };
    const VectorXd first = power(0), slope = power(1), square = power(2);
    for (const VectorXd& q : {first, VectorXd(first + slope / 3.), VectorXd(first + (2. * slope + square) / 3.),
                              VectorXd(first + slope + square + power(3))}) {
      if ((q.array() < limits.row(0).transpose().array() - kRounding).any()) return false;
      if ((q.array() > limits.row(1).transpose().array() + kRounding).any()) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<SmoothedMotion> smoothMotion(const Config& config, Steering& steering, const TimedPath& motion,
                                           const MotionLimits& limits, double margin, int slices,
                                           const CancellationToken& cancellation) {
  if (!motion.feasible() || motion.duration() == 0. || margin < 0.) return std::nullopt;
  const MatrixXd path = solvedPath(config, motion, margin, slices, cancellation);
  if (path.rows() == 0) return std::nullopt;
  const PathCurve curve = cubicSpline(path);
  if (curve.degree() > 3 || !keepsLimits(curve, config.getJointLimits())) return std::nullopt;
  TimedPath timed = retime(path, curve, limits);
  if (!timed.feasible() || timed.duration() > (1. - kFaster) * motion.duration()) return std::nullopt;
  if (!isFree(steering, curve, kParts)) return std::nullopt;
  for (Eigen::Index k = 1; k < path.rows(); ++k)
    if (!steering.isFree(path.row(k - 1).transpose(), path.row(k).transpose())) return std::nullopt;
  return SmoothedMotion{path, std::move(timed)};
}

}  // namespace kinegraph::inline planning_internal
