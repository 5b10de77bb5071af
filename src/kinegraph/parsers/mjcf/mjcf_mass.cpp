#include "kinegraph/parsers/mjcf/mjcf_mass.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/mass.h"

namespace kinegraph::inline parsers_internal {

namespace {

/// From the mean squares of the coordinates, centered at the origin.
UniformMass centered(double measure, const Vector3d& mean_squares) {
  return {measure, Vector3d::Zero(), (mean_squares.sum() * Vector3d::Ones() - mean_squares).asDiagonal()};
}

std::optional<UniformMass> solidOf(const std::string& shape, const std::vector<double>& s) {
  if (shape == "box") return centered(s[0] * s[1] * s[2], Vector3d(s[0] * s[0], s[1] * s[1], s[2] * s[2]) / 12.);
  if (shape == "sphere") return centered(4. / 3. * M_PI * std::pow(s[0], 3), Vector3d::Constant(s[0] * s[0] / 5.));
  if (shape == "ssBoxElip") {
    const Vector3d radii(s[3], s[4], s[5]);
    return centered(4. / 3. * M_PI * radii.prod(), radii.cwiseAbs2() / 5.);
  }
  if (shape != "cylinder" && shape != "capsule") return std::nullopt;
  const double length = s[0], r = s[1], tube = M_PI * r * r * length;
  const double across = r * r / 4., along = length * length / 12.;
  if (shape == "cylinder") return centered(tube, {across, across, along});
  const double ball = 4. / 3. * M_PI * r * r * r, volume = tube + ball;
  const double ball_along = r * r / 5. + length * length / 4. + 3. / 8. * length * r;  // its halves are at the two ends
  const double sideways = (tube * across + ball * r * r / 5.) / volume;
  return centered(volume, {sideways, sideways, (tube * along + ball * ball_along) / volume});
}

/// As in MuJoCo: the area by Thomsen's formula, within 1.1 %, and the inertia of a layer between two ellipsoids whose
/// radii differ by the same length.
UniformMass ellipsoidShell(const Vector3d& r) {
  constexpr double kPower = 1.6075;
  const Vector3d sides(r[1] * r[2], r[2] * r[0], r[0] * r[1]);
  const double area = 4. * M_PI * std::pow(sides.array().pow(kPower).mean(), 1. / kPower);
  return centered(area, r.cwiseAbs2() / 5. + .4 * r.prod() / sides.sum() * r);
}

std::optional<UniformMass> shellOf(const std::string& shape, const std::vector<double>& s) {
  if (shape == "cylinder" || shape == "capsule") {
    const double length = s[0], r = s[1], tube = 2. * M_PI * r * length;
    const double across = r * r / 2., along = length * length / 12.;
    const bool round = shape == "capsule";
    const double ends = (round ? 4. : 2.) * M_PI * r * r, half = .5 * length;
    const double end_across = round ? r * r / 3. : r * r / 4.;
    const double end_along = round ? half * half + half * r + r * r / 3. : half * half;
    const double area = tube + ends, sideways = (tube * across + ends * end_across) / area;
    return centered(area, {sideways, sideways, (tube * along + ends * end_along) / area});
  }
  if (shape == "ssBoxElip") return ellipsoidShell({s[3], s[4], s[5]});
  const ShapeType type = shape == "box" ? ShapeType::box : shape == "sphere" ? ShapeType::sphere : ShapeType::none;
  if (type == ShapeType::none) return std::nullopt;
  const ShellMass shell = shellMass({type, s, nullptr});
  return UniformMass{shell.area, shell.com, shell.inertia_per_mass};
}

/// The area-weighted mean of the triangles' centers: MuJoCo's apex of the pyramids.
Vector3d centerOfTriangles(const Mesh& mesh) {
  Vector3d sum = Vector3d::Zero();
  double area = 0.;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector3d &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const double twice = (b - a).cross(c - a).norm();
    sum += twice * (a + b + c) / 3.;
    area += twice;
  }
  return area > 0. ? Vector3d(sum / area) : sum;
}

/// Sums the pyramids from `apex` to the triangles: volume, its first moment, and its second moment about the apex.
struct Pyramids {
  double volume = 0.;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();

  Pyramids(const Mesh& mesh, const Vector3d& apex, bool is_signed) {
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vector3d a = mesh.vertices[i] - apex, b = mesh.vertices[j] - apex, c = mesh.vertices[k] - apex,
                     sum = a + b + c;
      const double v = a.dot(b.cross(c)) / 6., part = is_signed ? v : std::abs(v);
      volume += part;
      first += part * sum / 4.;
      second += part / 20. * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    }
  }
};

}  // namespace

std::optional<UniformMass> uniformMass(const std::string& shape, const std::vector<double>& size, bool is_shell) {
  return is_shell ? shellOf(shape, size) : solidOf(shape, size);
}

std::optional<UniformMass> uniformMass(const Mesh& mesh, MeshMassMode mode) {
  if (mesh.vertices.size() < 4) return std::nullopt;
  if (mode == MeshMassMode::shell) {
    Geometry geometry;
    geometry.type = ShapeType::mesh;
    geometry.mesh = std::make_shared<Mesh>(mesh);
    const ShellMass shell = shellMass(geometry);
    return UniformMass{shell.area, shell.com, shell.inertia_per_mass};
  }
  const bool fills_hull = mode == MeshMassMode::convex || mesh.triangles.empty();
  const Mesh solid = fills_hull ? convexHull(mesh.vertices) : mesh;
  const bool is_signed = mode != MeshMassMode::legacy;
  const Vector3d apex = centerOfTriangles(solid);
  const Pyramids outer(solid, apex, is_signed);
  if (!(outer.volume > 1e-15)) return std::nullopt;
  const Vector3d com = apex + outer.first / outer.volume;
  const Pyramids inner(solid, com, is_signed);
  const Matrix3d second = inner.second / inner.volume;
  return UniformMass{inner.volume, com, second.trace() * Matrix3d::Identity() - second};
}

FittedBox fitBox(const Mesh& mesh, const UniformMass& solid, bool to_bounds) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(solid.inertia_per_mass);
  Matrix3d R = axes.eigenvectors().rowwise().reverse();  // the largest inertia is about the shortest side
  if (R.determinant() < 0.) R.col(2) *= -1.;
  const Vector3d about = axes.eigenvalues().reverse();
  FittedBox box{Pose(solid.com, Quaterniond(R)), Vector3d::Zero()};
  if (!to_bounds) {
    box.half_sides = (1.5 * (about.sum() * Vector3d::Ones() - 2. * about)).cwiseMax(0.).cwiseSqrt();
    return box;
  }
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& vertex : mesh.vertices) bounds.extend(Vector3d(R.transpose() * vertex));
  box.pose.p = R * bounds.center();
  box.half_sides = .5 * bounds.sizes();
  return box;
}

void PartMass::add(const PartMass& part, const Pose& X) {
  if (part.mass <= 0.) return;
  const Matrix3d R = X.q.toRotationMatrix();
  const Vector3d at = X.p + R * part.com, sum = (mass * com + part.mass * at) / (mass + part.mass);
  const auto shifted = [](const Matrix3d& inertia, double m, const Vector3d& r) -> Matrix3d {
    return inertia + m * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  };
  matrix = shifted(matrix, mass, com - sum) + shifted(R * part.matrix * R.transpose(), part.mass, at - sum);
  com = sum;
  mass += part.mass;
}

}  // namespace kinegraph::inline parsers_internal
