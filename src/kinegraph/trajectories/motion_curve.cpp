#include "kinegraph/trajectories/motion_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/trajectories/curve_part.h"

namespace kinegraph::inline trajectories_internal {

namespace {

constexpr double kCurveTolerance = 1e-6;  // rad or m
constexpr double kSampleTime = .005;      // s
constexpr int kFewestSamples = 1000, kMostSamples = 200000;
constexpr double kRest = 1e-9;          // rad or m between samples at rest
constexpr double kCorner = .1;          // rad between the directions before and behind a sample
constexpr double kCornerWindow = 1e-7;  // rad or m around a corner whose place is known
constexpr int kCornerRounds = 40;       // each halves the time in which a corner is
constexpr int kFirstKnots = 8;          // intervals between knots of the first spline
constexpr int kProjections = 3;         // Newton steps to the nearest place of a curve

/// The samples of a motion that differ from the one before, and the places of corners among them.
class MotionSamples {
 public:
  MotionSamples(const Trajectory& motion, const CancellationToken& cancellation) : motion_(motion) {
    const double duration = motion.duration();
    const int count = int(std::clamp(duration / kSampleTime, double(kFewestSamples), double(kMostSamples)));
    for (int k = 0; k <= count; ++k) {
      if (k % 1000 == 0) cancellation.check();
      const double t = duration * k / count;
      const VectorXd now = q(t);
      if (!now.allFinite()) throw ValueError("retime: the motion has numbers that are not finite");
      if (!points.empty() && (now - points.back()).lpNorm<Eigen::Infinity>() <= kRest) {
        rests_.back() = true;
        continue;
      }
      points.push_back(now), times_.push_back(t), rests_.push_back(false);
    }
    sections_ = {0};
    bool is_there = true;  // still at the last corner: at a slow stop, several samples are as near to it
    for (std::size_t k = 1; k + 1 < points.size(); ++k) {
      is_there = is_there && (points[k] - points[sections_.back()]).norm() <= kCornerWindow;
      if (is_there || turn(points[k - 1], points[k], points[k + 1]) <= kCorner || !placeCorner(k)) continue;
      sections_.push_back(k);
      is_there = true;
    }
    sections_.push_back(points.size() - 1);
  }

  /// Indices of the points at which sections start and end, and corners are in between.
  const std::vector<std::size_t>& sections() const { return sections_; }

  std::vector<VectorXd> points;

 private:
  VectorXd q(double t) const { return motion_.eval(t).q; }

  static double turn(const VectorXd& a, const VectorXd& b, const VectorXd& c) {
    const VectorXd before = b - a, behind = c - b;
    const double lengths = before.norm() * behind.norm();
    return lengths <= kRest * kRest ? 0. : std::acos(std::clamp(before.dot(behind) / lengths, -1., 1.));
  }

  /// Whether the direction jumps next to sample k, which then moves to that place.
  bool placeCorner(std::size_t k) {
    if (rests_[k]) return true;
    double from = times_[k - 1], to = times_[k + 1];
    double angle = turn(points[k - 1], points[k], points[k + 1]);
    for (int round = 0; round < kCornerRounds; ++round) {
      std::array<VectorXd, 5> p;
      for (int j = 0; j < 5; ++j) p[std::size_t(j)] = q(from + (to - from) * j / 4.);
      if (std::max((p[2] - p[0]).norm(), (p[4] - p[2]).norm()) <= kCornerWindow) break;
      const double step = (to - from) / 4.;
      std::size_t sharpest = 1;
      double now = -1.;
      for (std::size_t j = 1; j < 4; ++j)
        if (const double here = turn(p[j - 1], p[j], p[j + 1]); here > now) now = here, sharpest = j;
      angle = now;
      if (angle < kCorner) return false;
      from += double(sharpest - 1) * step, to = from + 2. * step;
    }
    points[k] = q(.5 * (from + to));
    return angle >= kCorner;
  }

  const Trajectory& motion_;
  std::vector<double> times_;
  std::vector<char> rests_;
  std::vector<std::size_t> sections_;
};

/// Distance of a point from a curve next to s, in the dof where it is largest.
double missOf(const PathCurve& curve, double s, const VectorXd& point) {
  for (int k = 0; k < kProjections; ++k) {
    const VectorXd slope = curve.eval(s, 1);
    const double norm2 = slope.squaredNorm();
    if (norm2 > 0.) s = std::clamp(s + slope.dot(point - curve.eval(s)) / norm2, 0., curve.length());
  }
  return (curve.eval(s) - point).lpNorm<Eigen::Infinity>();
}

PathCurve splineThrough(const std::vector<VectorXd>& points, const std::vector<std::size_t>& knots) {
  MatrixXd rows(Eigen::Index(knots.size()), points[0].size());
  for (std::size_t k = 0; k < knots.size(); ++k) rows.row(Eigen::Index(k)) = points[knots[k]].transpose();
  return cubicSpline(rows);
}

/// The spline through so many of the points from `first` to `last` that it is near all of them.
PathCurve sectionThrough(const std::vector<VectorXd>& points, std::size_t first, std::size_t last,
                         const CancellationToken& cancellation) {
  std::vector<std::size_t> knots;
  const std::size_t intervals = std::min(std::size_t(kFirstKnots), std::max(last - first, std::size_t(1)));
  for (std::size_t k = 0; k <= intervals; ++k) knots.push_back(first + (last - first) * k / intervals);
  while (true) {
    cancellation.check();
    PathCurve curve = splineThrough(points, knots);
    std::vector<std::size_t> refined = {first};
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      const double from = curve.marks()[k], to = curve.marks()[k + 1];
      const std::size_t a = knots[k], b = knots[k + 1];
      bool is_near = true;
      for (std::size_t i = a + 1; i < b && is_near; ++i)
        is_near = missOf(curve, from + (to - from) * double(i - a) / double(b - a), points[i]) <= kCurveTolerance;
      if (!is_near) refined.push_back((a + b) / 2);
      refined.push_back(b);
    }
    if (refined.size() == knots.size()) return curve;
    knots = std::move(refined);
  }
}

/// Joins halves, because joining one curve after the other would copy the first ones again and again.
PathCurve joinedAll(const PathCurve* curves, std::size_t count) {
  if (count == 1) return curves[0];
  return joined(joinedAll(curves, count / 2), joinedAll(curves + count / 2, count - count / 2));
}

}  // namespace

PathCurve curveOf(const Trajectory& motion, const CancellationToken& cancellation) {
  if (const auto* timed = dynamic_cast<const TimedPath*>(&motion); timed && timed->feasible()) return timed->curve();
  const MotionSamples samples(motion, cancellation);
  const std::vector<std::size_t>& sections = samples.sections();
  std::vector<PathCurve> curves;
  for (std::size_t k = 0; k + 1 < sections.size(); ++k)
    curves.push_back(sectionThrough(samples.points, sections[k], sections[k + 1], cancellation));
  return joinedAll(curves.data(), curves.size());
}

}  // namespace kinegraph::inline trajectories_internal
