#include "kinegraph/motion/motion_ends.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

namespace {

constexpr double kBeyondLimit = 1e-5;             // rad, m: rounding of files, which counts as at the limit
constexpr std::size_t kNamed = 3;                 // pairs and obstacles
constexpr double kRoom = 2. * Clearance::kGuard;  // m, that an end keeps above the margin around it

void requireState(const VectorXd& q, int dofs, const std::string& what, const char* who) {
  if (q.size() != dofs) throw ValueError(cat(who, ": the ", what, " has ", q.size(), " numbers; expected ", dofs));
  if (!q.allFinite()) throw ValueError(cat(who, ": the ", what, " has numbers that are not finite"));
}

std::string percent(long part, long all) { return cat(int(std::lround(100. * double(part) / double(all))), " %"); }

}  // namespace

std::string lengthInWords(double length) {
  const double size = std::abs(length);
  char text[32];
  if (size < 1e-3) {
    std::snprintf(text, sizeof text, "%.3g um", 1e6 * length);
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

MotionEnd checkEnd(Steering& steering, const Program& program, const VectorXd& q, double margin,
                   const std::string& what, const char* who) {
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

std::string obstaclesInWords(const Program& program, const PairCounts& hits) {
  struct Met {
    long times = 0;
    std::vector<std::string> by;
  };
  std::map<int, Met> obstacles;  // by frame
  long all = 0;
  for (const auto& [pair, times] : hits) {
    // The one that moves less is the obstacle: links are numbered from the world on.
    const auto [a, b] = pair;
    const bool a_moves_less = program.frame_link[std::size_t(a)] <= program.frame_link[std::size_t(b)];
    Met& met = obstacles[a_moves_less ? a : b];
    met.times += times;
    all += times;
    if (met.by.size() < kNamed) met.by.push_back(cat("'", program.frame_name[std::size_t(a_moves_less ? b : a)], "'"));
  }
  std::vector<std::pair<long, int>> order;
  for (const auto& [frame, met] : obstacles) order.emplace_back(-met.times, frame);
  std::sort(order.begin(), order.end());
  std::vector<std::string> words;
  for (std::size_t i = 0; i < std::min(order.size(), kNamed); ++i) {
    const Met& met = obstacles[order[i].second];
    words.push_back(cat("'", program.frame_name[std::size_t(order[i].second)], "' (", percent(met.times, all), ", by ",
                        join(met.by), ")"));
  }
  return join(words);
}

}  // namespace kinegraph
