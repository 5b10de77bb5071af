#include "kinegraph/planning/retreat_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "kinegraph/collision/motion_check.h"
#include "kinegraph/planning/pair_choice.h"
#include "kinegraph/planning/steering/pair_gradient.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kAway = 2e-3;        // m, beyond the margin: target of the pushes
constexpr double kWatched = 2e-2;     // m, beyond that: pairs that must not come closer meanwhile
constexpr double kLongestPush = .05;  // of a dof, rad or m
constexpr double kFarthest = .5;      // from the endpoint, in joint space
constexpr int kPushes = 50;
constexpr double kDeeper = 1e-6;  // m, of rounding

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Shortfalls of the distances of near pairs, and the gradients of these distances.
struct Shortfalls {
  VectorXd values;  ///< m, positive if a pair is too close
  Rows J;
};

Shortfalls shortfallsAt(const State& state, const std::vector<ClearanceCheck::Nearest>& near, double wanted) {
  Shortfalls shortfalls{VectorXd::Zero(Eigen::Index(near.size())), Rows::Zero(Eigen::Index(near.size()), state.dofs())};
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto row = Eigen::Index(i);
    shortfalls.values[row] = std::max(0., wanted - near[i].distance);
    shortfalls.J.row(row) = pairGradient(state, near[i].a, near[i].b).gradient.transpose();
  }
  return shortfalls;
}

/// Pushes near pairs apart until all keep the distance `wanted`.
std::optional<VectorXd> push(State state, Steering& steering, const VectorXd& from, double wanted) {
  VectorXd q = from;
  for (int step = 0; step < kPushes; ++step) {
    const std::vector<ClearanceCheck::Nearest> near = steering.check().nearerThan(q, wanted + kWatched);
    if (near.empty() || near.front().distance >= wanted) return q;
    state.setJoints(q.data());
    const Shortfalls shortfalls = shortfallsAt(state, near, wanted + .25 * kAway);
    MatrixXd A = shortfalls.J * shortfalls.J.transpose();
    A.diagonal().array() += 1e-4 * std::max(A.diagonal().maxCoeff(), 1e-9);
    VectorXd change = shortfalls.J.transpose() * A.ldlt().solve(shortfalls.values);
    const double longest = change.cwiseAbs().maxCoeff();
    if (!(longest > 1e-9)) return std::nullopt;
    if (longest > kLongestPush) change *= kLongestPush / longest;
    q += change;
    steering.space().clamp(q);
    steering.space().normalize(q);
    if (steering.isConstrained() && !steering.manifold().project(q)) return std::nullopt;
    if (steering.space().distance(from, q) > kFarthest) return std::nullopt;
  }
  return std::nullopt;
}

/// Whether, on the edge to q, the pairs in contact never penetrate more than at the endpoint, and all others stay free.
bool isValidRetreat(const Config& config, Steering& steering, const Endpoint& end, const VectorXd& q, double deepest) {
  const KinematicModel& model = *config.model();
  std::vector<std::pair<int, int>> ids;
  std::vector<std::pair<std::string, std::string>> names;
  for (const ClearanceCheck::Nearest& pair : end.near) {
    if (pair.distance > 2. * Clearance::kGuard) continue;
    ids.emplace_back(pair.a, pair.b);
    names.emplace_back(model.frame_name[std::size_t(pair.a)], model.frame_name[std::size_t(pair.b)]);
  }
  const VectorXd to = end.q + steering.space().difference(end.q, q);
  MotionChecker others(withoutPairs(config, ids).state()), these(onlyPairs(config, names, "planMotion").state());
  return !others.firstContact(end.q.data(), to.data(), 0., Clearance::kTolerance) &&
         !these.firstContact(end.q.data(), to.data(), deepest - Clearance::kTolerance - kDeeper, kDeeper);
}

}  // namespace

std::optional<VectorXd> retreatFromContact(const Config& config, Steering& steering, const Endpoint& end,
                                           double margin) {
  if (end.near.empty()) return std::nullopt;
  const double deepest = std::min(0., end.near.front().distance);
  for (const double wanted : {margin + kAway, .5 * kAway}) {
    const std::optional<VectorXd> q = push(config.state(), steering, end.q, wanted);
    if (q && isValidRetreat(config, steering, end, *q, deepest)) return q;
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline planning_internal
