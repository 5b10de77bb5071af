#include "kinegraph/ik/closed_form.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace kinegraph::inline ik_internal {

namespace {

using Complex = std::complex<double>;

constexpr double kParallel = 1e-7;   // sine of the angle between directions
constexpr double kMeets = 1e-7;      // m, between axes that intersect
constexpr double kOnCircle = 1e-3;   // | |z| - 1 | of a root that stands for an angle
constexpr double kSameAngle = 1e-6;  // rad, between two roots
constexpr double kOut = 1e-9;        // beyond reach by so much, relatively, counts as at its border

/// A function of an angle: c[0] + c[1] cos a + c[2] sin a.
using Harmonic = Eigen::Vector3d;

double valueOf(const Harmonic& f, double a) { return f[0] + f[1] * std::cos(a) + f[2] * std::sin(a); }

/// The angles at which a harmonic vanishes: two, or none.
std::vector<double> zerosOf(const Harmonic& f) {
  const double size = std::hypot(f[1], f[2]);
  if (size < 1e-12) return {};
  const double cosine = -f[0] / size;
  if (std::abs(cosine) > 1. + kOut) return {};
  const double middle = std::atan2(f[2], f[1]), half = std::acos(std::clamp(cosine, -1., 1.));
  if (half < kSameAngle) return {middle};
  return {middle - half, middle + half};
}

/// A polynomial in z = exp(i a) times a power of z, from the product of harmonics.
using Laurent = std::array<Complex, 5>;  // of z^-2, ..., z^2

void addProduct(Laurent& sum, const Harmonic& f, const Harmonic& g, double factor) {
  const Complex i(0., 1.);
  const Complex a[] = {.5 * (f[1] + i * f[2]), f[0], .5 * (f[1] - i * f[2])};
  const Complex b[] = {.5 * (g[1] + i * g[2]), g[0], .5 * (g[1] - i * g[2])};
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t k = 0; k < 3; ++k) sum[j + k] += factor * a[j] * b[k];
}

/// The angles at which a trigonometric polynomial of degree 2 vanishes, as eigenvalues of its companion matrix.
std::vector<double> zerosOf(const Laurent& p) {
  double size = 0.;
  for (const Complex& c : p) size = std::max(size, std::abs(c));
  int degree = 4;
  while (degree > 0 && std::abs(p[std::size_t(degree)]) < 1e-12 * size) --degree;
  int lowest = 0;
  while (lowest < degree && std::abs(p[std::size_t(lowest)]) < 1e-12 * size) ++lowest;
  degree -= lowest;
  if (degree == 0) return {};
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(degree, degree);
  for (int k = 0; k < degree; ++k) {
    companion(k, degree - 1) = -p[std::size_t(lowest + k)] / p[std::size_t(lowest + degree)];
    if (k > 0) companion(k, k - 1) = 1.;
  }
  const Eigen::VectorXcd roots = companion.eigenvalues();
  std::vector<double> zeros;
  for (const Complex& root : roots) {
    if (std::abs(std::abs(root) - 1.) > kOnCircle) continue;
    double a = std::arg(root);
    const auto evaluate = [&](double at, double& slope) {
      double value = 0.;
      slope = 0.;
      for (int k = -2; k <= 2; ++k) {
        const Complex term = p[std::size_t(k + 2)] * std::polar(1., k * at);
        value += term.real(), slope -= k * term.imag();
      }
      return value;
    };
    for (int step = 0; step < 4; ++step) {
      double slope = 0.;
      const double value = evaluate(a, slope);
      if (std::abs(slope) < 1e-9 * size) break;
      a -= std::clamp(value / slope, -.01, .01);
    }
    const bool known = std::any_of(zeros.begin(), zeros.end(), [a](double other) {
      return std::abs(std::remainder(a - other, 2. * std::numbers::pi)) < kSameAngle;
    });
    if (!known) zeros.push_back(a);
  }
  return zeros;
}

/// The angle about a unit direction that turns one vector to another, as far as the parts across it go.
double angleAbout(const Vector3d& k, const Vector3d& from, const Vector3d& to) {
  const Vector3d across = k.cross(from);
  return std::atan2(across.dot(to), across.cross(k).dot(to));
}

Vector3d turned(const Vector3d& k, double angle, const Vector3d& v) { return Eigen::AngleAxisd(angle, k) * v; }

/// The harmonic a -> w . R(k, a) v.
Harmonic harmonicOf(const Vector3d& w, const Vector3d& k, const Vector3d& v) {
  const double along = w.dot(k) * k.dot(v);
  return {along, w.dot(v) - along, w.dot(k.cross(v))};
}

bool areParallel(const HingeAxis& a, const HingeAxis& b) { return a.direction.cross(b.direction).norm() < kParallel; }

/// The points on two axes that are the nearest to each other. Parallel ones: at the point of the first.
std::pair<Vector3d, Vector3d> nearestPoints(const HingeAxis& a, const HingeAxis& b) {
  const Vector3d between = b.point - a.point;
  if (areParallel(a, b)) {
    const Vector3d on_b = b.point - b.direction.dot(between) * b.direction;
    return {a.point, on_b};
  }
  const double c = a.direction.dot(b.direction), along_a = a.direction.dot(between), along_b = b.direction.dot(between);
  const double s = (along_a - c * along_b) / (1. - c * c), t = (c * along_a - along_b) / (1. - c * c);
  return {a.point + s * a.direction, b.point + t * b.direction};
}

/// The point in which two axes intersect.
std::optional<Vector3d> intersection(const HingeAxis& a, const HingeAxis& b) {
  if (areParallel(a, b)) return std::nullopt;
  const auto [on_a, on_b] = nearestPoints(a, b);
  if ((on_a - on_b).norm() > kMeets) return std::nullopt;
  return .5 * (on_a + on_b);
}

bool contains(const HingeAxis& axis, const Vector3d& point) {
  return axis.direction.cross(point - axis.point).norm() < kMeets;
}

/// Angles with R(k_1, a_1) R(k_2, a_2) R(k_3, a_3) = R. The second direction is not parallel to the others.
std::vector<std::array<double, 3>> anglesOfRotation(const Vector3d& k1, const Vector3d& k2, const Vector3d& k3,
                                                    const Matrix3d& R) {
  std::vector<std::array<double, 3>> all;
  const Vector3d image = R * k3;
  Harmonic f = harmonicOf(k1, k2, k3);
  f[0] -= k1.dot(image);
  for (const double a2 : zerosOf(f)) {
    const Vector3d bent = turned(k2, a2, k3);
    // At a singularity, k_3 comes to lie on k_1, and only the sum of both angles counts.
    const double a1 = k1.cross(bent).norm() < 1e-9 ? 0. : angleAbout(k1, bent, image);
    const Matrix3d rest = (Eigen::AngleAxisd(-a2, k2) * Eigen::AngleAxisd(-a1, k1)).toRotationMatrix() * R;
    const Vector3d across = k3.unitOrthogonal();
    all.push_back({a1, a2, angleAbout(k3, across, rest * across)});
  }
  return all;
}

double wrapped(double angle) { return std::remainder(angle, 2. * std::numbers::pi); }

}  // namespace

RigidTransform HingeAxis::turn(double angle) const {
  RigidTransform X;
  X.R = Eigen::AngleAxisd(angle, direction).toRotationMatrix();
  X.p = point - X.R * point;
  return X;
}

std::vector<std::array<double, 3>> anglesToPoint(const HingeAxis& first, const HingeAxis& second,
                                                 const HingeAxis& third, const Vector3d& from, const Vector3d& to) {
  // Origins are the points of axes 1 and 2 that are the nearest to each other, d is the vector between them. v is the
  // point after hinge 3, from the second origin. R_2 v + d has the length and the height along axis 1 of `to`. Both are
  // linear in R_2 v.
  const auto [o1, o2] = nearestPoints(first, second);
  const Vector3d &k1 = first.direction, &k2 = second.direction, &k3 = third.direction;
  const Vector3d d = o2 - o1, target = to - o1, arm = from - third.point, elbow = third.point - o2;
  const auto along = [&](const Vector3d& w) {  // the harmonic w . v of a_3
    Harmonic f = harmonicOf(w, k3, arm);
    f[0] += w.dot(elbow);
    return f;
  };
  Harmonic length = 2. * harmonicOf(elbow, k3, arm);  // |v|^2
  length[0] += elbow.squaredNorm() + arm.squaredNorm();
  const Harmonic height = along(k2);
  // d . R_2 v = near, k_1 . R_2 v = high; d is perpendicular to both axes.
  Harmonic near = -.5 * length, high = -k1.dot(k2) * height;
  near[0] += .5 * (target.squaredNorm() - d.squaredNorm());
  high[0] += k1.dot(target);  // d . k_1 = 0
  const Vector3d across = k1 - k1.dot(k2) * k2;
  const double slant = across.norm(), distance = d.norm();
  const bool parallel = slant < kParallel, meets = distance < kMeets;
  std::vector<double> thirds;
  if (parallel && meets) return {};
  if (parallel) {
    thirds = zerosOf(high);
  } else if (meets) {
    thirds = zerosOf(near);
  } else {
    Laurent p{};
    const Harmonic u = near / distance, w = high / slant, one(1., 0., 0.);
    addProduct(p, u, u, 1.), addProduct(p, w, w, 1.), addProduct(p, height, height, 1.);
    addProduct(p, length, one, -1.);
    thirds = zerosOf(p);
  }
  std::vector<std::array<double, 3>> all;
  for (const double a3 : thirds) {
    const Vector3d v = elbow + turned(k3, a3, arm);
    std::vector<double> seconds;
    if (parallel || meets) {
      Harmonic f = harmonicOf(parallel ? d : k1, k2, v);
      f[0] -= parallel ? valueOf(near, a3) : k1.dot(target);
      seconds = zerosOf(f);
    } else {
      // The part of R_2 v across axis 2, in the basis of d and k_1.
      const Vector3d wanted =
          valueOf(near, a3) / (distance * distance) * d + valueOf(high, a3) / (slant * slant) * across;
      seconds = {angleAbout(k2, v, wanted)};
    }
    for (const double a2 : seconds) {
      const Vector3d reached = d + turned(k2, a2, v);
      all.push_back({angleAbout(k1, reached, target), a2, a3});
    }
  }
  return all;
}

ClosedFormArm::ClosedFormArm(const std::array<HingeAxis, 6>& axes) {
  for (const bool from_tool : {false, true}) {
    // Seen from the tool, X^-1 = turn_6(-a_6) ... turn_1(-a_1).
    for (std::size_t k = 0; k < 6; ++k) {
      axes_[k] = axes[from_tool ? 5 - k : k];
      if (from_tool) axes_[k].direction = -axes_[k].direction;
    }
    from_tool_ = from_tool;
    const std::optional<Vector3d> center = intersection(axes_[4], axes_[5]);
    if (!center) continue;
    center_ = *center;
    if (contains(axes_[3], center_) && !areParallel(axes_[3], axes_[4])) {
      kind_ = Kind::wrist;
      return;
    }
    const bool three = areParallel(axes_[1], axes_[2]) && areParallel(axes_[2], axes_[3]);
    if (three && contains(axes_[4], center_) && !areParallel(axes_[0], axes_[1]) && !areParallel(axes_[3], axes_[4])) {
      kind_ = Kind::parallel;
      return;
    }
  }
}

std::vector<SixAngles> ClosedFormArm::solve(const RigidTransform& X) const {
  std::vector<SixAngles> all;
  if (kind_ == Kind::none) return all;
  const RigidTransform seen = from_tool_ ? X.inverse() : X;
  all = kind_ == Kind::wrist ? solveWrist(seen) : solveParallel(seen);
  for (SixAngles& angles : all) {
    if (from_tool_) std::reverse(angles.begin(), angles.end());
    for (double& angle : angles) angle = wrapped(angle);
  }
  return all;
}

std::vector<SixAngles> ClosedFormArm::solveWrist(const RigidTransform& X) const {
  std::vector<SixAngles> all;
  for (const auto& [a1, a2, a3] : anglesToPoint(axes_[0], axes_[1], axes_[2], center_, X * center_)) {
    const Matrix3d before = axes_[0].turn(a1).R * axes_[1].turn(a2).R * axes_[2].turn(a3).R;
    for (const auto& [a4, a5, a6] :
         anglesOfRotation(axes_[3].direction, axes_[4].direction, axes_[5].direction, before.transpose() * X.R))
      all.push_back({a1, a2, a3, a4, a5, a6});
  }
  return all;
}

std::vector<SixAngles> ClosedFormArm::solveParallel(const RigidTransform& X) const {
  std::vector<SixAngles> all;
  const Vector3d& k = axes_[1].direction;  // of hinges 2 to 4, which keep the height along it
  const Vector3d goal = X * center_;
  Harmonic height = harmonicOf(k, -axes_[0].direction, goal - axes_[0].point);
  height[0] += k.dot(axes_[0].point - center_);
  for (const double a1 : zerosOf(height)) {
    const RigidTransform rest = axes_[0].turn(a1).inverse() * X;  // by hinges 2 to 6
    const Vector3d &k5 = axes_[4].direction, &k6 = axes_[5].direction;
    for (const auto& [sum, a5, a6] : anglesOfRotation(k, k5, k6, rest.R)) {
      // Hinges 2 and 3 move a point of axis 4, and hinge 4 turns by what is left of the sum.
      const HingeAxis& fourth = axes_[3];
      const Vector3d offset = turned(k, sum, center_ - fourth.point);
      const Vector3d wrist = rest * center_ - offset;
      // |p_2 + R_3 (p_4 - p_3)| fixes hinge 3.
      const Vector3d upper = axes_[2].point - axes_[1].point, lower = fourth.point - axes_[2].point;
      const Vector3d to = wrist - axes_[1].point;
      const auto flat = [&](const Vector3d& v) { return Vector3d(v - k.dot(v) * k); };
      const double s3 = axes_[2].direction.dot(k) > 0. ? 1. : -1., s4 = fourth.direction.dot(k) > 0. ? 1. : -1.;
      Harmonic bend = 2. * harmonicOf(flat(upper), k, flat(lower));
      bend[0] += flat(upper).squaredNorm() + flat(lower).squaredNorm() - flat(to).squaredNorm();
      for (const double a3 : zerosOf(bend)) {
        const double a2 = angleAbout(k, flat(upper) + turned(k, a3, flat(lower)), flat(to));
        all.push_back({a1, a2, s3 * a3, s4 * (sum - a2 - a3), a5, a6});
      }
    }
  }
  return all;
}

}  // namespace kinegraph::inline ik_internal
