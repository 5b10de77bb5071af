#include "kinegraph/komo/collision/alternative_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinegraph/komo/collision/rrt_path.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr int kGrowths = 1500;                              // samples of the trees
constexpr std::array<double, 4> kRoom = {16., 8., 4., 2.};  // clearances to try first, relative to the required one
constexpr int kGrowthsWithRoom = 200;
constexpr int kArcs = 50, kMoves = 120;
constexpr double kShrinking = .98;     // factor on the step size from one random move to the next
constexpr int kMaxSamples = 32;        // per path
constexpr double kLengthWeight = .02;  // m, weight of |d| relative to the length of the path
constexpr std::array<double, 6> kKnots = {0., .1, .35, .65, .9, 1.};
constexpr int kFree = int(kKnots.size()) - 2;

/// Returns the dofs of the initial configuration that may be varied: no quaternions, and none that all slices share.
std::vector<int> variableDofs(const Path& path) {
  const KinematicModel& model = *path.initial().model;
  std::vector<char> may(std::size_t(model.dofs), false);
  for (const int frame : path.initial().joint_frames) {
    if (path.initial().isShared(frame)) continue;
    const auto [first, count] = model.frame_dofs[std::size_t(frame)];
    std::fill_n(may.begin() + first, count, true);
  }
  for (const auto& [first, count] : model.unit_norms) std::fill_n(may.begin() + first, count, false);
  std::vector<int> dofs;
  for (int dof = 0; dof < model.dofs; ++dof)
    if (may[std::size_t(dof)]) dofs.push_back(dof);
  return dofs;
}

/// Deformations of a path by an offset d, given by one column per knot between the ends.
class DeformedPaths {
 public:
  DeformedPaths(Path& path, double apart, MotionProbe& probe)
      : path_(path), apart_(apart), probe_(probe), dofs_(variableDofs(path)), initial_(path.joints()) {
    const KinematicModel& model = *path.initial().model;
    VectorXd begin = initial_.row(0).transpose();
    if (firstMotion(path) == 0) begin = path.state(-1).q()(path.dofsOf(path.initial().joint_frames, -1));
    const VectorXd offset = initial_.row(initial_.rows() - 1).transpose() - begin;
    length_ = std::max(offset(dofs_).norm(), .1);
    lower_ = model.lower(dofs_), upper_ = model.upper(dofs_);
  }

  int dofs() const { return int(dofs_.size()); }
  double length() const { return length_; }

  void deform(const MatrixXd& d) {
    const int count = int(initial_.rows()), before = firstMotion(path_) == 0 ? 1 : 0;
    for (int slice = 0; slice + 1 < count; ++slice) {
      const double s = double(slice + before) / (count - 1 + before);
      VectorXd q = initial_.row(slice).transpose();
      const VectorXd deformed = q(dofs_) + at(s, d);
      q(dofs_) = deformed.cwiseMax(lower_).cwiseMin(upper_);
      path_.setJoints(slice, q);
    }
    path_.setVariables(path_.variables());  // copies shared dofs
  }

  /// Returns the violation of the distance `apart` (m), summed over samples, plus a small cost for the length of d.
  double violation(const MatrixXd& d) {
    deform(d);
    const int first = firstMotion(path_), count = path_.grid().slices() - first;
    const int stride = std::max(1, count / kMaxSamples);
    double sum = kLengthWeight * d.norm() / length_;
    for (int slice = first; slice < first + count; slice += stride)
      sum += apart_ - probe_.clearance(motionInto(path_, slice), .5, apart_);
    return sum;
  }

 private:
  static VectorXd at(double s, const MatrixXd& d) {
    VectorXd sum = VectorXd::Zero(d.rows());
    for (int i = 0; i <= kFree; ++i) {
      const double share = (s - kKnots[std::size_t(i)]) / (kKnots[std::size_t(i) + 1] - kKnots[std::size_t(i)]);
      if (share < 0. || share > 1.) continue;
      if (i > 0) sum += (1. - share) * d.col(i - 1);
      if (i < kFree) sum += share * d.col(i);
      break;
    }
    return sum;
  }

  Path& path_;
  double apart_;
  MotionProbe& probe_;
  std::vector<int> dofs_;
  MatrixXd initial_;
  VectorXd lower_, upper_;
  double length_ = 0.;
};

/// Returns true if all slices have the model of the initial configuration and the same parameters.
bool showsOneScene(const Path& path) {
  for (int slice = firstMotion(path) - 1; slice < path.grid().slices(); ++slice) {
    const State& state = path.state(slice);
    if (state.sharedModel() != path.initial().model || state.sharedParameters() != path.state(0).sharedParameters())
      return false;
  }
  return true;
}

/// Returns `count` configurations along a path, including its corners and its end, with motions of similar length.
/// Empty if the path has too many corners.
std::vector<VectorXd> subdivide(const std::vector<VectorXd>& corners, int count) {
  const int pieces = int(corners.size()) - 1;
  if (pieces > count) return {};
  std::vector<int> parts(std::size_t(pieces), 1);
  const auto lengthOf = [&](int i) {
    return (corners[std::size_t(i) + 1] - corners[std::size_t(i)]).norm() / parts[std::size_t(i)];
  };
  for (int total = pieces; total < count; ++total) {
    int longest = 0;
    for (int i = 1; i < pieces; ++i)
      if (lengthOf(i) > lengthOf(longest)) longest = i;
    ++parts[std::size_t(longest)];
  }
  std::vector<VectorXd> points;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    for (int k = 1; k < parts[i]; ++k)
      points.push_back(corners[i] + double(k) / parts[i] * (corners[i + 1] - corners[i]));
    points.push_back(corners[i + 1]);
  }
  return points;
}

/// Returns the bounds between which configurations are sampled.
SampleBounds boundsAround(const KinematicModel& model, std::vector<int> dofs, const VectorXd& from,
                          const VectorXd& to) {
  SampleBounds bounds{std::move(dofs), {}, {}};
  bounds.lower = model.lower(bounds.dofs), bounds.upper = model.upper(bounds.dofs);
  const double around = std::max((to - from).norm(), .1);
  for (std::size_t i = 0; i < bounds.dofs.size(); ++i) {
    double &lower = bounds.lower[Eigen::Index(i)], &upper = bounds.upper[Eigen::Index(i)];
    const auto [least, most] = std::minmax(from[bounds.dofs[i]], to[bounds.dofs[i]]);
    if (!std::isfinite(lower)) lower = least - around;
    if (!std::isfinite(upper)) upper = most + around;
  }
  return bounds;
}

/// Returns the configurations of the slices from `begin` to the end of a phase, on a path that trees find.
std::vector<VectorXd> freeLeg(const Path& path, EdgeChecker& checker, double apart, int begin, int end, Rng& rng) {
  const VectorXd &from = path.state(begin - 1).q(), &to = path.state(end - 1).q();
  const double most = 20. * apart,
               kept = std::min(checker.clearance(from.data(), most), checker.clearance(to.data(), most));
  if (kept <= 0.) return {};
  const SampleBounds bounds = boundsAround(*path.initial().model, variableDofs(path), from, to);
  const auto keeping = [&](double margin, int growths) {
    checker.setMargin(margin);
    const std::vector<VectorXd> way = rrtPath(checker, bounds, from, to, rng, growths);
    return way.empty() ? way : subdivide(way, end - begin);
  };
  for (const double more : kRoom) {
    if (more * apart > .9 * kept) continue;
    std::vector<VectorXd> leg = keeping(more * apart, kGrowthsWithRoom);
    if (!leg.empty()) return leg;
  }
  return keeping(kept > 1.01 * apart ? apart : .5 * kept, kGrowths);
}

/// Returns the variables of a continuously collision-free path; nothing if the trees find none, or if nothing moves.
std::optional<VectorXd> freeAlternativePath(Path& path, double apart, MotionProbe& probe, int number) {
  if (!showsOneScene(path)) return std::nullopt;
  const int first = firstMotion(path), count = path.grid().slices(), of_phase = path.grid().slicesPerPhase();
  EdgeChecker& checker = probe.checkerOf(motionInto(path, first));
  Rng rng{std::uint64_t(number)};
  std::vector<VectorXd> points;
  for (int begin = first; begin < count;) {
    const int end = std::min((begin / of_phase + 1) * of_phase, count);
    const std::vector<VectorXd> leg = freeLeg(path, checker, apart, begin, end, rng);
    if (leg.empty()) return std::nullopt;
    points.insert(points.end(), leg.begin(), leg.end());
    begin = end;
  }
  const VectorXd& start = path.state(first - 1).q();
  if (std::ranges::all_of(points, [&](const VectorXd& q) { return q == start; })) return std::nullopt;
  const VectorXd original = path.variables();
  for (std::size_t i = 0; i < points.size(); ++i) path.setJoints(first + int(i), points[i]);
  const VectorXd found = path.variables();
  path.setVariables(original);
  return found;
}

}  // namespace

std::optional<VectorXd> alternativePath(Path& path, double apart, MotionProbe& probe, int number) {
  if (path.grid().slices() < 3) return std::nullopt;
  const VectorXd original = path.variables();
  DeformedPaths paths(path, apart, probe);
  if (paths.dofs() == 0) return std::nullopt;
  if (const auto free = freeAlternativePath(path, apart, probe, number)) return free;
  Rng rng{std::uint64_t(number)};
  const auto sample = [&](double size) {
    VectorXd noise(paths.dofs());
    for (double& value : noise) value = size * rng.normal();
    return noise;
  };
  const double unit = paths.length() / std::sqrt(double(paths.dofs()));
  MatrixXd best;
  double least = std::numeric_limits<double>::infinity();
  const auto offer = [&](const MatrixXd& candidate) {
    const double violation = paths.violation(candidate);
    if (violation < least) least = violation, best = candidate;
  };
  for (int i = 0; i < kArcs; ++i) {  // arcs, to one side or to both
    const double size = unit * (.2 + .8 * (i + 1) / kArcs);
    const VectorXd a = sample(size), b = sample(.5 * size);
    MatrixXd arc(paths.dofs(), kFree);
    for (int k = 0; k < kFree; ++k) {
      const double angle = std::numbers::pi * kKnots[std::size_t(k) + 1];
      arc.col(k) = std::sin(angle) * a + std::sin(2. * angle) * b + sample(.1 * size);
    }
    offer(arc);
  }
  double size = .3 * unit;
  for (int i = 0; i < kMoves; ++i, size *= kShrinking) {  // of one configuration, or of all
    MatrixXd moved = best;
    const int one = int(rng.uniform(0., kFree + 1.));
    for (int k = 0; k < kFree; ++k)
      if (one == k || one == kFree) moved.col(k) += sample(size);
    offer(moved);
  }
  paths.deform(best);
  const VectorXd found = path.variables();
  path.setVariables(original);
  return found;
}

}  // namespace kinegraph::inline komo_internal
