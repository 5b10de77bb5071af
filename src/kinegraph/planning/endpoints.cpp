#include "kinegraph/planning/endpoints.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/unit_guesses.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr double kBeyondLimit = 1e-5;              // rad, m: rounding in files counts as at the limit
constexpr double kTouching = 1e-8;                 // m, in messages
constexpr std::size_t kNamed = 3;                  // pairs and obstacles, in messages
constexpr double kSlack = 2. * Clearance::kGuard;  // m, between the clearance of an endpoint and the margin around it

void requireState(const VectorXd& q, int dofs, const std::string& what, const char* who) {
  if (q.size() != dofs) throw ValueError(cat(who, ": the ", what, " has ", q.size(), " numbers; expected ", dofs));
  if (!q.allFinite()) throw ValueError(cat(who, ": the ", what, " has numbers that are not finite"));
}

/// Returns whether both frames are links of a robot, or its first link and the base.
bool areOwn(const KinematicModel& model, int a, int b) {
  const std::vector<ContactRules::Body>& bodies = model.contacts.bodies;
  const auto first = std::ranges::find(bodies, a, &ContactRules::Body::frame);
  const auto second = std::ranges::find(bodies, b, &ContactRules::Body::frame);
  if (first == bodies.end() || second == bodies.end()) return false;
  const auto isLink = [&](int frame) { return model.frame_link[std::size_t(frame)] != 0; };
  const auto parentOf = [&](int part) { return model.contacts.parts[std::size_t(part)].parent; };
  return (isLink(a) && isLink(b)) || parentOf(first->part) == second->part || parentOf(second->part) == first->part;
}

/// Advice for a start in which only parts of the robot collide: models often overlap there in every configuration.
std::string adviceOnOverlaps(const KinematicModel& model, const std::vector<ClearanceCheck::Nearest>& pairs) {
  const bool is_own = std::ranges::all_of(pairs, [&](const auto& pair) { return areOwn(model, pair.a, pair.b); });
  return is_own ? "; if these parts of the robot always touch, C.ignoreCollisionsNow() excludes them" : "";
}

}  // namespace

std::string formatLength(double length) {
  const double size = std::abs(length);
  if (size < 1e-3) return numberText(1e6 * length, 3) + " um";
  if (size < 1.) return numberText(1e3 * length, 3) + " mm";
  return numberText(length, 3) + " m";
}

std::string describePairs(const KinematicModel& model, const std::vector<ClearanceCheck::Nearest>& pairs) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(pairs.size(), kNamed); ++i) {
    const ClearanceCheck::Nearest& pair = pairs[i];
    parts.push_back(cat("'", model.frame_name[std::size_t(pair.a)], "' and '", model.frame_name[std::size_t(pair.b)],
                        "' ",
                        std::abs(pair.distance) < kTouching ? "touch"
                        : pair.distance < 0.                ? cat("overlap by ", formatLength(-pair.distance))
                                                            : cat("are ", formatLength(pair.distance), " apart")));
  }
  if (pairs.size() > kNamed) parts.push_back(cat("and ", pairs.size() - kNamed, " more pairs"));
  return join(parts);
}

Endpoint checkEndpoint(Steering& steering, const KinematicModel& model, const VectorXd& q, double margin,
                       const std::string& what, const char* who) {
  requireState(q, model.dofs, what, who);
  Endpoint end;
  end.q = q;
  end.clearance = margin;
  const std::string excess = steering.space().beyondLimits(q, kBeyondLimit);
  if (!excess.empty()) {
    end.problem =
        cat("the ", what, " is outside the limits: ", excess,
            looksLikeDegrees(model, q) ? "; did you mean radians? The values times pi/180 are within the limits" : "");
    return end;
  }
  steering.space().clamp(end.q);
  end.near = steering.check().nearerThan(end.q, margin + kSlack);
  if (!end.near.empty()) end.clearance = std::min(margin, end.near.front().distance);
  if (!end.near.empty() && end.near.front().distance < std::min(margin, 0.) + kSlack) {
    end.problem = cat("the ", what, " collides: ", describePairs(model, end.near),
                      what == "start" ? adviceOnOverlaps(model, end.near) : "");
  } else if (steering.isConstrained()) {
    const double violation = steering.manifold().violation(end.q);
    if (violation > steering.manifold().tolerance())
      end.problem = cat("the ", what, " violates the constraint ", steering.manifold().worst(end.q), " by ", violation);
  }
  return end;
}

Clearance clearanceAround(double margin, const std::vector<const Endpoint*>& ends) {
  Clearance clearance;
  clearance.margin = margin;
  for (const Endpoint* end : ends) {
    if (end->near.empty()) continue;
    const double around = std::max(std::min(margin, end->near.front().distance - kSlack), std::min(margin, 0.));
    if (around < margin) clearance.tight.push_back({end->q, around});
  }
  return clearance;
}

PlanningConstraints constraintsAround(const State& scene, const JointSpace& space, const PlanOptions& options,
                                      const std::vector<const Endpoint*>& ends) {
  return {.scene = &scene,
          .space = &space,
          .clearance = clearanceAround(options.margin, ends),
          .constraints = options.constraints,
          .constraint_tolerance = options.constraint_tolerance};
}

std::string marginWarning(const KinematicModel& model, const Endpoint& end, double margin, const std::string& what) {
  if (end.near.empty() || end.near.front().distance >= margin) return "";
  const double kept = std::max(0., end.near.front().distance);
  return cat("the ", what, " does not keep the margin of ", formatLength(margin), ": ", describePairs(model, end.near),
             "; around the ", what, ", ", formatLength(kept), " are kept");
}

std::vector<MetObstacle> obstaclesMet(const KinematicModel& model, const PairCounts& hits) {
  std::map<int, std::pair<long, MetObstacle>> obstacles;  // by frame
  long all = 0;
  for (const auto& [pair, times] : hits) {
    // Links are numbered from the world on.
    const auto [a, b] = pair;
    const bool a_is_obstacle = model.frame_link[std::size_t(a)] <= model.frame_link[std::size_t(b)];
    auto& [count, met] = obstacles[a_is_obstacle ? a : b];
    count += times;
    all += times;
    met.by.push_back(model.frame_name[std::size_t(a_is_obstacle ? b : a)]);
  }
  std::vector<MetObstacle> list;
  for (auto& [frame, entry] : obstacles) {
    auto& [count, met] = entry;
    list.push_back({frame, model.frame_name[std::size_t(frame)], double(count) / double(all), std::move(met.by)});
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const MetObstacle& x, const MetObstacle& y) { return x.share > y.share; });
  return list;
}

std::string describeObstacles(const std::vector<MetObstacle>& obstacles) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(obstacles.size(), kNamed); ++i) {
    const MetObstacle& met = obstacles[i];
    std::vector<std::string> by;
    for (std::size_t k = 0; k < std::min(met.by.size(), kNamed); ++k) by.push_back(cat("'", met.by[k], "'"));
    parts.push_back(cat("'", met.name, "' (", std::lround(100. * met.share), " %, by ", join(by), ")"));
  }
  return join(parts);
}

}  // namespace kinegraph::inline planning_internal
