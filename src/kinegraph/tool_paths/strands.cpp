#include "kinegraph/tool_paths/strands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/ik/low_discrepancy.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr double kTurnOfJoint = 2. * std::numbers::pi;
constexpr double kRotationOfStep = .15;  // rad between places
constexpr int kLeastIntervals = 4;       // between corners
constexpr int kSeedSteps = 30, kFollowSteps = 6;
constexpr double kSameStrand = .03;       // rad or m
constexpr double kLargestSurprise = .12;  // rad or m, between the extrapolation and the configuration
constexpr double kLargestAdvance = .5;    // rad or m per step
constexpr int kDivisionsOfStep = 7;
constexpr double kCenteringGain = .02;  // per place
constexpr double kAtLimit = 1e-4;       // rad or m
constexpr double kPreferringGain = .1;  // per place, of the angle from the preferred one
constexpr double kPreferringCost = .5;  // of the duration, per rad from the preferred angle

/// A target rotated about one of its axes.
ToolTarget turnedAbout(ToolTarget target, int axis, double angle) {
  const Eigen::AngleAxisd turn(angle, target.axis(axis));
  target.x = turn * target.x, target.z = turn * target.z;
  return target;
}

}  // namespace

std::vector<double> searchPlaces(const ToolCurve& curve, double spacing) {
  std::vector<double> ends = {0.};
  for (const double corner : curve.corners()) ends.push_back(corner);
  for (const double change : curve.speedChanges()) ends.push_back(change);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  ends.push_back(curve.length());
  std::vector<double> places = {0.};
  const CubicPieces& pieces = curve.pieces();
  for (std::size_t k = 1; k < ends.size(); ++k) {
    // The weight of a way counts its rotation, too.
    std::vector<double> s = {ends[k - 1]}, weight = {0.};
    for (int piece = pieces.pieceAt(ends[k - 1]); piece < pieces.pieces(); ++piece) {
      const double begin = std::max(pieces.begin[std::size_t(piece)], ends[k - 1]),
                   end = std::min(pieces.end(piece), ends[k]);
      if (begin >= end) break;
      const VectorXd slope = pieces.eval(piece, .5 * (begin + end), 1);
      const double rate = std::max(slope.segment<3>(3).norm(), slope.tail<3>().norm());
      s.push_back(end);
      weight.push_back(weight.back() + (end - begin) * std::max(1. / spacing, rate / kRotationOfStep));
    }
    const int count = std::max(kLeastIntervals, int(std::ceil(weight.back())));
    std::size_t piece = 1;
    for (int i = 1; i < count; ++i) {
      const double w = weight.back() * i / count;
      while (weight[piece] < w) ++piece;
      places.push_back(s[piece - 1] +
                       (s[piece] - s[piece - 1]) * (w - weight[piece - 1]) / (weight[piece] - weight[piece - 1]));
    }
    places.push_back(ends[k]);
  }
  return places;
}

StrandTracker::StrandTracker(ToolKinematics& tool, const ToolCurve& curve, std::vector<double> places,
                             StrandLimits limits)
    : tool_(tool),
      curve_(curve),
      places_(std::move(places)),
      limits_(std::move(limits)),
      rows_(tool.rows() == ToolRows::position ? ToolRows::axis : tool.rows()) {}

void StrandTracker::holdPreferred(bool holds) {
  held_ = holds ? tool_.preferred().value() : 0.;
  rows_ = holds ? ToolRows::pose : ToolRows::axis;
}

ToolTarget StrandTracker::targetAt(double s, const Vector3d& tilt) const {
  ToolTarget target = curve_.at(s);
  if (held_ != 0.) target = turnedAbout(target, tool_.freeAxis(), held_);
  if (tilt.isZero(0.)) return target;
  // The axis leans by |tilt| in a direction that is fixed in the target's coordinates.
  Matrix3d R;
  R << target.x, target.z.cross(target.x), target.z;
  const Vector3d w = R * tilt;
  const Eigen::AngleAxisd turn(w.norm(), w.normalized());
  target.x = turn * target.x, target.z = turn * target.z;
  return target;
}

std::vector<StrandTracker::Seed> StrandTracker::seeds(int index, const std::vector<VectorXd>& first, int starts,
                                                      std::uint64_t seed) {
  const KinematicModel& model = tool_.model();
  const int n = tool_.dofs();
  const LowDiscrepancy sequence(n + 2, seed);
  const double s = places_[std::size_t(index)];
  std::vector<Seed> found;
  const VectorXd present = tool_.state().q();
  for (int k = 0; k < int(first.size()) + starts; ++k) {
    Seed candidate;
    const int number = k - int(first.size());
    if (number < 0) {
      candidate.q = first[std::size_t(k)];
    } else {
      candidate.q = present;
      for (int j = 0; j < n; ++j) {
        if (!tool_.moving()[std::size_t(j)]) continue;
        double low = std::max(model.lower[j], -10.), high = std::min(model.upper[j], 10.);
        if (tool_.isWide(j)) low = -std::numbers::pi, high = std::numbers::pi;
        candidate.q[j] = low + (high - low) * sequence.at(number, j);
      }
      if (tool_.cone() > 0. && number % 3 != 0 && rows_ != ToolRows::pose) {
        const double angle = kTurnOfJoint * sequence.at(number, n),
                     lean = tool_.cone() * .9 * std::sqrt(sequence.at(number, n + 1));
        const int a = (tool_.freeAxis() + 1) % 3, b = (tool_.freeAxis() + 2) % 3;
        candidate.tilt = lean * (std::cos(angle) * Vector3d::Unit(a) + std::sin(angle) * Vector3d::Unit(b));
      }
    }
    const ToolTarget target = targetAt(s, candidate.tilt);
    if (!tool_.project(candidate.q, target, rows_, kSeedSteps).met) continue;
    for (int j = 0; j < n; ++j)
      if (tool_.isWide(j) && number >= 0) candidate.q[j] -= kTurnOfJoint * std::round(candidate.q[j] / kTurnOfJoint);
    const auto add = [&](const Seed& one) {
      const bool known = std::any_of(found.begin(), found.end(), [&](const Seed& other) {
        return tool_.difference(other.q, one.q).cwiseAbs().maxCoeff() < kSameStrand;
      });
      if (!known) found.push_back(one);
    };
    if (tool_.preferred() && starts > 0 &&
        rows_ != ToolRows::pose) {  // the same branch at the preferred angle comes first
      Seed preferred = candidate;
      const ToolTarget there = turnedAbout(target, tool_.freeAxis(), *tool_.preferred());
      if (tool_.project(preferred.q, there, ToolRows::pose, kSeedSteps).met) add(preferred);
    }
    add(candidate);
  }
  return found;
}

bool StrandTracker::withinTurns(const VectorXd& q, Strand& strand) {
  for (int j = 0; j < tool_.dofs(); ++j) {
    if (!tool_.isWide(j) || !tool_.hasLimits(j)) continue;
    const double low = std::min(least_[j], q[j]), high = std::max(most_[j], q[j]);
    const double room = tool_.model().upper[j] - tool_.model().lower[j];
    // A shift by whole turns has to bring [low, high] within the limits.
    const double shift = std::ceil((tool_.model().lower[j] - low - 1e-9) / kTurnOfJoint) * kTurnOfJoint;
    if (high - low <= room && high + shift <= tool_.model().upper[j] + 1e-9) continue;
    strand.blocked = j;
    return false;
  }
  return true;
}

bool StrandTracker::advance(VectorXd& q, VectorXd& slope, double from, double to, const Vector3d& tilt, int divisions,
                            Strand& strand) {
  VectorXd next = q + (to - from) * slope;
  const VectorXd guess = next;
  VectorXd pull = tool_.centering(q, kCenteringGain);
  if (tool_.preferred() && rows_ != ToolRows::pose) pull += tool_.preferring(q, targetAt(to, tilt), kPreferringGain);
  const ToolKinematics::Projection projection =
      tool_.project(next, targetAt(to, tilt), rows_, kFollowSteps, divisions == kDivisionsOfStep ? pull : VectorXd());
  const double surprise = (next - guess).cwiseAbs().maxCoeff();
  if (projection.met && surprise <= kLargestSurprise && (next - q).cwiseAbs().maxCoeff() <= kLargestAdvance) {
    if (!withinTurns(next, strand)) return false;
    slope = (next - q) / (to - from);
    q = next;
    least_ = least_.cwiseMin(q), most_ = most_.cwiseMax(q);
    strand.reached = to;
    return true;
  }
  if (divisions == 0) {
    for (int j = 0; j < tool_.dofs(); ++j)
      if (tool_.moving()[std::size_t(j)] && !tool_.isWide(j) && tool_.hasLimits(j) &&
          (q[j] > tool_.model().upper[j] - kAtLimit || q[j] < tool_.model().lower[j] + kAtLimit))
        strand.blocked = j;
    return false;
  }
  const double middle = .5 * (from + to);
  return advance(q, slope, from, middle, tilt, divisions - 1, strand) &&
         advance(q, slope, middle, to, tilt, divisions - 1, strand);
}

Strand StrandTracker::follow(const Seed& seed, int first, int direction) {
  Strand strand;
  strand.first = first, strand.direction = direction;
  strand.reached = places_[std::size_t(first)];
  VectorXd q = seed.q, slope = VectorXd::Zero(q.size());
  strand.q.push_back(q);
  least_ = most_ = q;
  for (int k = first + direction; k >= 0 && k < int(places_.size()); k += direction) {
    const double from = places_[std::size_t(k - direction)], to = places_[std::size_t(k)];
    if (strand.q.size() == 1) {  // a short step gives the first direction
      const double little = 1e-3 * (to - from);
      VectorXd there = q;
      if (tool_.project(there, targetAt(from + little, seed.tilt), rows_, kFollowSteps).met)
        slope = (there - q) / little;
    }
    if (!advance(q, slope, from, to, seed.tilt, kDivisionsOfStep, strand)) break;
    strand.q.push_back(q);
  }
  if (first == 0) estimate(strand);
  return strand;
}

void StrandTracker::estimate(Strand& strand) {
  strand.cost = 0.;
  double away = 0.;  // from the preferred angle, rad m
  VectorXd before;
  for (std::size_t k = 1; k < strand.q.size(); ++k) {
    const double h = places_[k] - places_[k - 1];
    const VectorXd rate = (strand.q[k] - strand.q[k - 1]) / h;
    double speed = limits_.speed;
    for (int j = 0; j < tool_.dofs(); ++j) {
      if (rate[j] != 0.) speed = std::min(speed, limits_.velocity[j] / std::abs(rate[j]));
      if (before.size() == 0) continue;
      const double bend = std::abs(rate[j] - before[j]) / h;
      if (bend > 0.) speed = std::min(speed, std::sqrt(limits_.acceleration[j] / bend));
    }
    before = rate;
    strand.cost += h / std::max(speed, 1e-6);
    if (tool_.preferred()) {
      const double twist = tool_.twist(tool_.pose(strand.q[k]), curve_.at(places_[k]));
      away += h * std::abs(std::remainder(twist - *tool_.preferred(), kTurnOfJoint));
    }
  }
  strand.cost *= 1. + kPreferringCost * away / places_.back();
}

void checkStrand(EdgeChecker& checker, Strand& strand) {
  if (strand.is_checked) return;
  strand.is_checked = true;
  std::vector<const double*> rows;
  bool free[EdgeChecker::kLanes];
  for (std::size_t k = 0; k < strand.q.size(); k += EdgeChecker::kLanes) {
    rows.clear();
    for (std::size_t i = k; i < std::min(strand.q.size(), k + EdgeChecker::kLanes); ++i)
      rows.push_back(strand.q[i].data());
    if (checker.areAllFree(rows)) continue;
    checker.areFree(rows, free);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (!free[i]) {
        strand.collides = int(k + i);
        return;
      }
  }
}

bool fitTurns(const ToolKinematics& tool, std::vector<VectorXd>& q, const VectorXd& preferred, int& dof) {
  for (int j = 0; j < tool.dofs(); ++j) {
    if (!tool.isWide(j)) continue;
    double low = q[0][j], high = q[0][j];
    for (const VectorXd& row : q) low = std::min(low, row[j]), high = std::max(high, row[j]);
    double best = 0., least = 1e300;
    const int nearest = int(std::round((preferred[j] - q[0][j]) / kTurnOfJoint));
    for (int turns = nearest - 3; turns <= nearest + 3; ++turns) {
      const double shift = turns * kTurnOfJoint;
      if (low + shift < tool.model().lower[j] - 1e-9 || high + shift > tool.model().upper[j] + 1e-9) continue;
      const double far = std::abs(q[0][j] + shift - preferred[j]);
      if (far < least) least = far, best = shift;
    }
    if (least == 1e300) {
      dof = j;
      return false;
    }
    if (best != 0.)
      for (VectorXd& row : q) row[j] += best;
  }
  return true;
}

std::vector<VectorXd> cheapestChain(const ToolKinematics& tool, const std::vector<std::vector<VectorXd>>& nodes,
                                    const std::vector<std::vector<std::pair<int, int>>>& barred, double step,
                                    std::vector<int>& chosen, int& stuck) {
  constexpr double kNone = 1e300;
  std::vector<std::vector<int>> before(nodes.size());
  std::vector<double> cost(nodes[0].size(), 0.), next;
  stuck = 0;
  if (nodes[0].empty()) return {};
  const int n = tool.dofs();
  for (std::size_t k = 1; k < nodes.size(); ++k) {
    next.assign(nodes[k].size(), kNone);
    before[k].assign(nodes[k].size(), -1);
    for (std::size_t b = 0; b < nodes[k].size(); ++b)
      for (std::size_t a = 0; a < nodes[k - 1].size(); ++a) {
        if (cost[a] == kNone) continue;
        double square = 0.;
        bool fits = true;
        for (int j = 0; j < n && fits; ++j) {
          double d = nodes[k][b][j] - nodes[k - 1][a][j];
          if (tool.isWide(j)) d -= kTurnOfJoint * std::round(d / kTurnOfJoint);
          fits = std::abs(d) <= step;
          square += d * d;
        }
        if (!fits || cost[a] + square >= next[b]) continue;
        if (std::find(barred[k].begin(), barred[k].end(), std::pair(int(a), int(b))) != barred[k].end()) continue;
        next[b] = cost[a] + square;
        before[k][b] = int(a);
      }
    if (std::all_of(next.begin(), next.end(), [](double c) { return c == kNone; })) {
      stuck = int(k);
      return {};
    }
    cost = next;
  }
  int at = int(std::min_element(cost.begin(), cost.end()) - cost.begin());
  chosen.assign(nodes.size(), 0);
  for (std::size_t k = nodes.size(); k-- > 0; at = k > 0 ? before[k][std::size_t(at)] : at) chosen[k] = at;
  std::vector<VectorXd> chain = {nodes[0][std::size_t(chosen[0])]};
  for (std::size_t k = 1; k < nodes.size(); ++k)
    chain.push_back(chain.back() +
                    tool.difference(nodes[k - 1][std::size_t(chosen[k - 1])], nodes[k][std::size_t(chosen[k])]));
  return chain;
}

namespace {

constexpr int kSmoothingRounds = 25;
constexpr double kSmoothEnough = 1e-3;     // rad or m, of the last round
constexpr double kSmoothingMargin = 5e-4;  // m, of configurations between which edges are free
constexpr double kStiffness = 400.;        // of the second differences, per unit of the distance from the chain
constexpr int kSmoothProjectionSteps = 6;

/// Solves (1 + stiffness D2' D2) x = y in place, with x fixed at both ends if `ends` is set, one column per dof.
class SmoothingSystem {
 public:
  explicit SmoothingSystem(int count) : n_(count), d_(count), e_(count, 0.), f_(count, 0.) {
    std::vector<double> diagonal(std::size_t(count), 1.), one(std::size_t(count), 0.), two(std::size_t(count), 0.);
    for (int k = 0; k + 2 < count; ++k) {
      const double w[3] = {1., -2., 1.};
      for (int a = 0; a < 3; ++a) diagonal[std::size_t(k + a)] += kStiffness * w[a] * w[a];
      one[std::size_t(k)] += kStiffness * w[0] * w[1], one[std::size_t(k + 1)] += kStiffness * w[1] * w[2];
      two[std::size_t(k)] += kStiffness * w[0] * w[2];
    }
    for (int k = 0; k < count; ++k) {  // L D L'
      const std::size_t i = std::size_t(k);
      d_[i] = diagonal[i];
      if (k > 0) d_[i] -= d_[i - 1] * e_[i - 1] * e_[i - 1];
      if (k > 1) d_[i] -= d_[i - 2] * f_[i - 2] * f_[i - 2];
      e_[i] = one[i];
      if (k > 0) e_[i] -= d_[i - 1] * e_[i - 1] * f_[i - 1];
      e_[i] /= d_[i];
      f_[i] = two[i] / d_[i];
    }
  }

  void solve(std::vector<VectorXd>& y) const {
    for (int k = 0; k < n_; ++k) {
      if (k > 0) y[std::size_t(k)] -= e_[std::size_t(k) - 1] * y[std::size_t(k) - 1];
      if (k > 1) y[std::size_t(k)] -= f_[std::size_t(k) - 2] * y[std::size_t(k) - 2];
    }
    for (int k = n_; k-- > 0;) {
      y[std::size_t(k)] /= d_[std::size_t(k)];
      if (k + 1 < n_) y[std::size_t(k)] -= e_[std::size_t(k)] * y[std::size_t(k) + 1];
      if (k + 2 < n_) y[std::size_t(k)] -= f_[std::size_t(k)] * y[std::size_t(k) + 2];
    }
  }

 private:
  int n_;
  std::vector<double> d_, e_, f_;
};

}  // namespace

void smoothChain(ToolKinematics& tool, const ToolCurve& curve, const std::vector<double>& places, EdgeChecker& checker,
                 std::vector<VectorXd>& q) {
  const int count = int(q.size());
  if (count < 5) return;
  const SmoothingSystem system(count);
  const double margin = checker.margin();
  checker.setMargin(margin + kSmoothingMargin);
  for (int round = 0; round < kSmoothingRounds; ++round) {
    std::vector<VectorXd> smooth = q;
    system.solve(smooth);
    double moved = 0.;
    std::vector<int> usable;
    for (int k = 0; k < count; ++k) {
      const std::size_t i = std::size_t(k);
      if (tool.project(smooth[i], curve.at(places[i]), tool.rows(), kSmoothProjectionSteps).met &&
          (smooth[i] - q[i]).cwiseAbs().maxCoeff() < kLargestAdvance)
        usable.push_back(k);
    }
    std::vector<const double*> rows;
    bool free[EdgeChecker::kLanes];
    for (std::size_t k = 0; k < usable.size(); k += EdgeChecker::kLanes) {
      rows.clear();
      for (std::size_t i = k; i < std::min(usable.size(), k + EdgeChecker::kLanes); ++i)
        rows.push_back(smooth[std::size_t(usable[i])].data());
      checker.areFree(rows, free);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!free[i]) continue;
        const std::size_t at = std::size_t(usable[k + i]);
        moved = std::max(moved, (smooth[at] - q[at]).cwiseAbs().maxCoeff());
        q[at] = smooth[at];
      }
    }
    if (moved < kSmoothEnough) break;
  }
  checker.setMargin(margin);
}

}  // namespace kinegraph::inline tool_paths_internal
