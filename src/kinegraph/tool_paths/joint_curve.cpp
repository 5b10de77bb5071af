#include "kinegraph/tool_paths/joint_curve.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr int kMaxRefineRounds = 16;
constexpr int kMaxLimitRounds = 8;  // a spline that leaves the limits of joints gets more knots there
constexpr int kMaxKnots = 40000;
constexpr double kLargestNodeProduct = .003547;  // of (u)(u - 1/4)(u - 1/2)(u - 3/4)(u - 1) on [0, 1]
constexpr double kConeShare = .93;
constexpr int kProjectionSteps = 8;

using Columns = Eigen::Matrix<double, 9, 5>;

/// Maps the values of a quartic at 0, 1/4, ..., 1 to its Bernstein coefficients.
const Eigen::Matrix<double, 5, 5>& bernsteinOfValues() {
  static const Eigen::Matrix<double, 5, 5> inverse = [] {
    Eigen::Matrix<double, 5, 5> values;
    const std::array<double, 5> binomial = {1., 4., 6., 4., 1.};
    for (int i = 0; i < 5; ++i)
      for (int k = 0; k < 5; ++k) {
        const double u = i / 4.;
        values(i, k) = binomial[std::size_t(k)] * std::pow(u, k) * std::pow(1. - u, 4 - k);
      }
    return Eigen::Matrix<double, 5, 5>(values.inverse().transpose());
  }();
  return inverse;
}

struct PieceBound {
  double position = 0., rotation = 0.;  ///< m; rad, or the lean beyond the cone
  double twist = 0.;                    ///< beyond the range of the free rotation, rad
};

/// Bounds the deviation of the tool on pieces of a joint curve.
class DeviationProof {
 public:
  DeviationProof(ToolKinematics& tool, const ToolCurve& curve) : tool_(tool), curve_(curve) {}

  PieceBound of(const CubicPieces& joints, int piece) {
    const double begin = joints.begin[std::size_t(piece)], end = joints.end(piece), h = end - begin;
    const MatrixXd& c = joints.coefficient[std::size_t(piece)];
    MatrixXd taylor(c.rows(), 3);
    taylor.col(2) = c.col(3).cwiseAbs();
    taylor.col(1) = c.col(2).cwiseAbs() + 3. * h * taylor.col(2);
    taylor.col(0) = c.col(1).cwiseAbs() + 2. * h * c.col(2).cwiseAbs() + 3. * h * h * taylor.col(2);
    const VectorXd largest = c.col(0).cwiseAbs() + h * taylor.col(0);
    const ToolKinematics::Remainder rest = tool_.fifthCoefficient(taylor, largest);
    PieceBound bound;
    rates_ = taylor.col(0);
    const CubicPieces& targets = curve_.pieces();
    double from = begin;
    for (int target = targets.pieceAt(begin + 1e-9 * h); from < end - 1e-9 * h; ++target) {
      const double to = std::min(end, targets.end(target));
      add(joints, piece, target, from, to, rest, bound);
      from = to;
    }
    return bound;
  }

 private:
  void add(const CubicPieces& joints, int piece, int target, double from, double to,
           const ToolKinematics::Remainder& rest, PieceBound& bound) {
    const double width = to - from;
    Columns miss;
    double twist = -1e9;
    for (int k = 0; k < 5; ++k) {
      const double s = from + .25 * k * width;
      const ToolTarget wanted(curve_.pieces().eval(target, s));
      const RigidTransform X = tool_.pose(joints.eval(piece, s));
      miss.col(k) << X.p - wanted.p, X.R.col(0) - wanted.x, X.R.col(2) - wanted.z;
      if (tool_.hasRange()) twist = std::max(twist, tool_.beyondRange(tool_.twist(X, wanted)));
      if (tool_.freeAxis() == 1) miss.col(k).tail<3>() = X.R.col(1) - wanted.axis(1);
    }
    const Columns hull = miss * bernsteinOfValues();
    const double node = kLargestNodeProduct * std::pow(width, 5);
    const auto largest = [&](int row) { return std::sqrt(hull.middleRows(row, 3).colwise().squaredNorm().maxCoeff()); };
    bound.position = std::max(bound.position, largest(0) + node * rest.position);
    double chord = 0.;  // largest |axis - target|
    if (tool_.freeAxis() < 0) {
      // The rotation between two frames is at most sqrt(1.5) of the larger of the angles of two axes, nearly: for axes
      // that miss by a and b, its vector w has |w|^2 <= a^2 + b^2.
      chord = std::hypot(largest(3), largest(6)) + 2. * node * rest.direction;
    } else {
      chord = largest(tool_.freeAxis() == 0 ? 3 : 6) + node * rest.direction;
    }
    const double angle = 2. * std::asin(std::min(1., .5 * chord));
    bound.rotation = std::max(bound.rotation, tool_.cone() > 0. ? std::max(0., angle - tool_.cone()) : angle);
    if (tool_.hasRange()) {
      // The slopes of a cubic lie in the hull of three Bernstein coefficients.
      const VectorXd first = curve_.pieces().eval(target, from, 1), last = curve_.pieces().eval(target, to, 1);
      const VectorXd inner = 2. * curve_.pieces().eval(target, .5 * (from + to), 1) - .5 * (first + last);
      double turn = 0.;
      for (const VectorXd* slope : {&first, &inner, &last}) turn = std::max(turn, slope->tail<6>().norm());
      bound.twist = std::max(bound.twist, twist + width / 8. * tool_.twistRate(rates_, turn, angle));
    }
  }

  ToolKinematics& tool_;
  const ToolCurve& curve_;
  VectorXd rates_;  ///< bound of |dq/ds| on the piece
};

/// A dof that leaves its limits by more than kLimitTolerance somewhere on a piece, or -1.
int dofBeyondLimits(const KinematicModel& model, const CubicPieces& pieces, int piece) {
  const CubicPieces::Range range = pieces.range(piece);
  for (int j = 0; j < model.dofs; ++j)
    if (range.largest[j] > model.upper[j] + kLimitTolerance || range.least[j] < model.lower[j] - kLimitTolerance)
      return j;
  return -1;
}

/// The spline through knots, split at corners.
CubicPieces splineBetweenCorners(const std::vector<double>& s, const std::vector<VectorXd>& q,
                                 const std::vector<double>& corners) {
  CubicPieces pieces;
  std::size_t first = 0;
  for (std::size_t k = 1; k < s.size(); ++k) {
    const bool corner = std::binary_search(corners.begin(), corners.end(), s[k]);
    if (!corner && k + 1 < s.size()) continue;
    MatrixXd y(q[0].size(), Eigen::Index(k - first + 1));
    for (std::size_t j = first; j <= k; ++j) y.col(Eigen::Index(j - first)) = q[j];
    pieces.addSpline({s.begin() + std::ptrdiff_t(first), s.begin() + std::ptrdiff_t(k) + 1}, y, first > 0);
    first = k;
  }
  return pieces;
}

}  // namespace

JointCurve jointCurveAlong(ToolKinematics& tool, const ToolCurve& curve, std::vector<double> s, std::vector<VectorXd> q,
                           const ToolTolerance& tolerance, const CancellationToken& cancellation) {
  JointCurve result;
  const std::vector<double> corners = curve.corners();
  DeviationProof proof(tool, curve);
  const auto fails = [&](double place, int blocked, const char* what) {
    result.message = cat("at ", place, " m ", what);
    result.place = place, result.blocked = blocked;
    return result;
  };
  const double position = tolerance.position - curve.fitError().position;
  const double rotation = tolerance.rotation - (tool.cone() > 0. ? 0. : curve.fitError().rotation);
  std::vector<char> stale(s.size(), 1);  // per piece: it has no bound yet, or the spline changed nearby
  std::vector<PieceBound> bounds(s.size());
  for (std::size_t k = 0; k < s.size(); ++k) {
    const ToolKinematics::Projection to =
        tool.project(q[k], curve.at(s[k]), tool.rows(), kProjectionSteps, {}, kConeShare);
    if (!to.met) return fails(s[k], to.blocked, "the configuration does not reach the curve");
  }
  for (int round = 0;; ++round) {
    if (cancellation) cancellation.check();
    result.pieces = splineBetweenCorners(s, q, corners);
    std::vector<double> more_s;
    std::vector<VectorXd> more_q;
    std::vector<std::size_t> after;
    result.position_deviation = result.rotation_deviation = 0.;
    for (int piece = 0; piece < result.pieces.pieces(); ++piece) {
      PieceBound& bound = bounds[std::size_t(piece)];
      if (stale[std::size_t(piece)]) bound = proof.of(result.pieces, piece);
      stale[std::size_t(piece)] = 0;
      result.position_deviation = std::max(result.position_deviation, bound.position);
      result.rotation_deviation = std::max(result.rotation_deviation, bound.rotation);
      const double cone_excess = tool.cone() > 0. ? 1e-12 : rotation;
      const int beyond = dofBeyondLimits(tool.model(), result.pieces, piece);
      if (beyond >= 0 && round >= kMaxLimitRounds)
        return fails(result.pieces.begin[std::size_t(piece)], beyond, "a joint leaves its limits");
      if (bound.position <= position && bound.rotation <= cone_excess && bound.twist <= 0. && beyond < 0) continue;
      const double middle = .5 * (result.pieces.begin[std::size_t(piece)] + result.pieces.end(piece));
      VectorXd there = result.pieces.eval(piece, middle);
      const bool leaves = (bound.rotation > cone_excess && tool.cone() > 0.) || bound.twist > 0.;
      const double share = leaves ? kConeShare * .97 : kConeShare;
      const ToolKinematics::Projection to =
          tool.project(there, curve.at(middle), tool.rows(), kProjectionSteps, {}, share);
      if (!to.met) return fails(middle, to.blocked, "no configuration continues the motion");
      more_s.push_back(middle), more_q.push_back(std::move(there)), after.push_back(std::size_t(piece));
    }
    if (more_s.empty()) break;
    if (round >= kMaxRefineRounds || int(s.size() + more_s.size()) > kMaxKnots)
      return fails(more_s[0], -1, "the motion bends too sharply to keep the tolerance");
    // New knots; bounds of pieces near them are computed again; others hardly change.
    std::vector<double> all_s;
    std::vector<VectorXd> all_q;
    std::vector<char> all_stale;
    std::vector<PieceBound> all_bounds;
    std::size_t next = 0;
    constexpr int kAffected = 8;
    for (std::size_t k = 0; k < s.size(); ++k) {
      all_s.push_back(s[k]), all_q.push_back(std::move(q[k]));
      all_stale.push_back(0), all_bounds.push_back(bounds[k]);
      if (next < after.size() && after[next] == k) {
        all_stale.back() = 1;
        all_s.push_back(more_s[next]), all_q.push_back(std::move(more_q[next]));
        all_stale.push_back(1), all_bounds.push_back({});
        ++next;
      }
    }
    std::vector<char> wide = all_stale;
    for (int k = 0; k < int(all_stale.size()); ++k)
      if (all_stale[std::size_t(k)])
        for (int j = std::max(0, k - kAffected); j <= std::min(int(wide.size()) - 1, k + kAffected); ++j)
          wide[std::size_t(j)] = 1;
    s = std::move(all_s), q = std::move(all_q), stale = std::move(wide), bounds = std::move(all_bounds);
  }
  // All bounds again, of the final spline.
  result.position_deviation = result.rotation_deviation = 0.;
  for (int piece = 0; piece < result.pieces.pieces(); ++piece) {
    const PieceBound bound = proof.of(result.pieces, piece);
    result.position_deviation = std::max(result.position_deviation, bound.position);
    result.rotation_deviation = std::max(result.rotation_deviation, bound.rotation);
  }
  result.position_deviation += curve.fitError().position;
  result.rotation_deviation += curve.fitError().rotation;
  return result;
}

namespace {

constexpr double kSpeedError = 2e-4;  // relative, of a quadratic between two places
constexpr int kMaxSpeedDivisions = 5;

/// Pieces of a joint curve with the tool's way as one more dof.
class ToolWay {
 public:
  ToolWay(ToolKinematics& tool, const ToolCurve& curve, const CubicPieces& joints)
      : tool_(tool), curve_(curve), joints_(joints) {
    parts.dofs = tool.dofs() + 1, parts.degree = 3, parts.length = joints.length;
  }

  /// Appends [from, to] of a piece. Its speed is a quadratic through three values; it is divided if two more miss it.
  void add(int piece, double from, double to, bool stops, int divisions) {
    const double h = to - from;
    double v[5];
    for (int k = 0; k < 5; ++k) v[k] = speed(piece, from + .25 * k * h);
    const double a = (4. * v[2] - 3. * v[0] - v[4]) / h, b = 2. * (v[0] - 2. * v[2] + v[4]) / (h * h);
    double miss = 0.;
    for (const int k : {1, 3}) {
      const double x = .25 * k * h;
      miss = std::max(miss, std::abs(v[0] + x * (a + x * b) - v[k]) / std::max(v[k], 1e-3));
    }
    if (miss > kSpeedError && divisions > 0) {
      add(piece, from, from + .5 * h, stops, divisions - 1);
      add(piece, from + .5 * h, to, false, divisions - 1);
      return;
    }
    const double factorial[] = {1., 1., 2., 6.}, own[] = {way_, v[0], a / 2., b / 3.};
    for (int power = 0; power < 4; ++power) {
      const VectorXd c = joints_.eval(piece, from, power) / factorial[power];
      parts.coefficients.insert(parts.coefficients.end(), c.data(), c.data() + c.size());
      parts.coefficients.push_back(own[power]);
    }
    way_ += h * (v[0] + h * (a / 2. + h * b / 3.));
    parts.begin.push_back(from);
    parts.marks.push_back(from);
    parts.is_line.push_back(false);
    parts.stops.push_back(stops);
  }

  PathCurve::Parts parts;

 private:
  /// |d p / ds| of the tool; 1 where it rotates on the spot.
  double speed(int piece, double s) {
    const double begin = joints_.begin[std::size_t(piece)], end = joints_.end(piece);
    const int target = curve_.pieces().pieceAt(std::min(s, end - 1e-6 * (end - begin)));
    if (curve_.pieces().eval(target, s, 1).head<3>().norm() < kOnTheSpotSpeed) return 1.;
    return tool_.velocity(joints_.eval(piece, s), joints_.eval(piece, s, 1)).norm();
  }

  static constexpr double kOnTheSpotSpeed = .5;
  ToolKinematics& tool_;
  const ToolCurve& curve_;
  const CubicPieces& joints_;
  double way_ = 0.;
};

}  // namespace

PathCurve withToolWay(ToolKinematics& tool, const ToolCurve& curve, const CubicPieces& joints) {
  ToolWay way(tool, curve, joints);
  for (int piece = 0; piece < joints.pieces(); ++piece)
    way.add(piece, joints.begin[std::size_t(piece)], joints.end(piece),
            piece > 0 && joints.is_corner[std::size_t(piece)], kMaxSpeedDivisions);
  way.parts.marks.push_back(joints.length);
  return PathCurve::fromParts(way.parts);
}

PathCurve withSpeedShare(const PathCurve& path, const std::function<double(double)>& speed_of) {
  PathCurve::Parts parts = path.parts();
  const int n = path.dofs();
  parts.dofs = n + 1;
  parts.coefficients.clear();
  double reached = 0.;
  for (int piece = 0; piece < path.pieces(); ++piece) {
    const double h = path.end(piece) - path.begin(piece);
    const double speed = speed_of(path.begin(piece) + .5 * h), start = reached;
    double power_of_h = 1.;
    for (int power = 0; power <= path.degree(); ++power, power_of_h *= h) {
      const double* c = path.coefficient(piece, power);
      parts.coefficients.insert(parts.coefficients.end(), c, c + n);
      parts.coefficients.push_back(power == 0 ? start : c[n - 1] / speed);
      if (power > 0) reached += power_of_h * c[n - 1] / speed;
    }
  }
  return PathCurve::fromParts(parts);
}

}  // namespace kinegraph::inline tool_paths_internal
