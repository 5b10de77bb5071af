#include "kinegraph/motion/motion_ends.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

constexpr double kBeyondLimit = 1e-5;     // rad, m: rounding of files, which counts as at the limit
constexpr std::size_t kNamed = 3;         // pairs and obstacles
constexpr double kRoom = 2. * Clearance::kGuard;  // m, that an end keeps above the margin around it

void requireState(const VectorXd& q, int dofs, const std::string& what, const char* who) {
  if (q.size() != dofs) throw ValueError(cat(who, ": the ", what, " has ", q.size(), " numbers; expected ", dofs));
  if (!q.allFinite()) throw ValueError(cat(who, ": the ", what, " has numbers that are not finite"));
}

std::string percent(std::size_t part, std::size_t all) {
  return cat(int(std::lround(100. * double(part) / double(all))), " %");
}

}  // namespace

std::string lengthInWords(double length) {
  const double size = std::abs(length);
  char text[32];
  if (size < 1e-3) {
    std::snprintf(text, sizeof text, "%.2g um", 1e6 * length);
  } else if (size < 1.) {
    std::snprintf(text, sizeof text, "%.3g mm", 1e3 * length);
  } else {
    std::snprintf(text, sizeof text, "%.3g m", length);
  }
  return text;
}

std::string pairsInWords(const Program& program, const std::vector<ClearanceCheck::Nearest>& pairs) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(pairs.size(), kNamed); ++i) {
    const ClearanceCheck::Nearest& pair = pairs[i];
    words.push_back(cat("'", program.frame_name[std::size_t(pair.a)], "' and '",
                        program.frame_name[std::size_t(pair.b)], "' ",
                        pair.distance < 0. ? cat("overlap by ", lengthInWords(-pair.distance))
                                           : cat("are ", lengthInWords(pair.distance), " apart")));
  }
  if (pairs.size() > kNamed) words.push_back(cat("and ", pairs.size() - kNamed, " more pairs"));
  return join(words);
}

MotionEnd checkEnd(Steering& steering, const Program& program, const VectorXd& q, double margin, const std::string& what,
                   const char* who) {
  requireState(q, program.dofs, what, who);
  MotionEnd end;
  end.q = q;
  end.kept = margin;
  const std::string beyond = steering.space().beyondLimits(q, kBeyondLimit);
  if (!beyond.empty()) {
    end.problem = cat("the ", what, " is out of limits: ", beyond);
    return end;
  }
  steering.space().clamp(end.q);
  end.near = steering.check().nearerThan(end.q, margin + kRoom);
  if (!end.near.empty()) end.kept = std::min(margin, end.near.front().distance);
  if (!end.near.empty() && end.near.front().distance < std::min(margin, 0.) + kRoom) {
    end.problem = cat("the ", what, " collides: ", pairsInWords(program, end.near));
  } else if (steering.isConstrained()) {
    const double violation = steering.manifold().violation(end.q);
    if (violation > steering.manifold().tolerance())
      end.problem = cat("the ", what, " violates the constraint ", steering.manifold().worst(end.q), " by ", violation);
  }
  return end;
}

Clearance clearanceAround(double margin, const std::vector<const MotionEnd*>& ends) {
  Clearance clearance;
  clearance.margin = margin;
  for (const MotionEnd* end : ends) {
    if (end->near.empty()) continue;
    const double around = std::max(std::min(margin, end->near.front().distance - kRoom), std::min(margin, 0.));
    if (around < margin) clearance.tight.push_back({end->q, around});
  }
  return clearance;
}

std::string obstaclesInWords(ClearanceCheck& check, const Program& program, const std::vector<VectorXd>& blocked,
                             double margin) {
  struct Met {
    std::size_t times = 0;
    std::set<int> by;
  };
  std::map<int, Met> obstacles;  // by frame
  std::size_t all = 0;
  for (const VectorXd& q : blocked) {
    const std::optional<ClearanceCheck::Nearest> pair = check.nearest(q, margin + Clearance::kTolerance);
    if (!pair) continue;
    ++all;
    // The one that moves less is the obstacle: links are numbered from the world on.
    const bool a_is_fixed = program.frame_link[std::size_t(pair->a)] <= program.frame_link[std::size_t(pair->b)];
    Met& met = obstacles[a_is_fixed ? pair->a : pair->b];
    ++met.times;
    met.by.insert(a_is_fixed ? pair->b : pair->a);
  }
  std::vector<std::pair<std::size_t, int>> order;
  for (const auto& [frame, met] : obstacles) order.emplace_back(met.times, frame);
  std::sort(order.begin(), order.end(), [](const auto& x, const auto& y) {
    return x.first > y.first || (x.first == y.first && x.second < y.second);
  });
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(order.size(), kNamed); ++i) {
    std::vector<std::string> by;
    for (const int frame : obstacles[order[i].second].by)
      if (by.size() < kNamed) by.push_back(cat("'", program.frame_name[std::size_t(frame)], "'"));
    words.push_back(cat("'", program.frame_name[std::size_t(order[i].second)], "' (", percent(order[i].first, all),
                        ", by ", join(by), ")"));
  }
  return join(words);
}

}  // namespace kinegraph
