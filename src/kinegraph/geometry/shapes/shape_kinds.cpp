#include "kinegraph/geometry/shapes/shape_kinds.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/geometry/shapes/convex_hull.h"
#include "kinegraph/geometry/shapes/isosurface.h"
#include "kinegraph/geometry/shapes/swept_surfaces.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Sizes = std::vector<double>;
using Form = ShapeCore::Form;
using Data = ShapeKind::Data;
using Body = ShapeKind::Body;

Vector3d sides(const Sizes& s) { return {s[0], s[1], s[2]}; }
Vector3d halfSides(const Geometry& g) { return .5 * sides(g.size); }

ShapeCore boxCore(const Geometry& g) { return {.form = Form::box, .half_sides = halfSides(g)}; }

ShapeCore cylinderCore(double length, double core_radius, double rounding) {
  return {.form = Form::cylinder,
          .radius = rounding,
          .half_length = .5 * length - rounding,
          .core_radius = core_radius - rounding};
}

Mesh boxSurface(const Geometry& g) { return roundedBox(halfSides(g), 0.); }

Mesh convexCoreSurface(const Geometry& g) {
  if (!g.mesh) return {};
  const double radius = g.size[0];
  if (radius == 0.) return convexHull(g.mesh->vertices);
  return sweptHull(g.mesh->vertices, [&](const Vector3d& n) { return Vector3d(radius * n); });
}

Vector3d boxWithoutRounding(const Geometry& g) { return (halfSides(g).array() - g.size[6]).max(0.); }

Mesh boxEllipsoidSurface(const Geometry& g) {
  const Vector3d radii(g.size[3], g.size[4], g.size[5]);
  return sweptHull(boxCorners(boxWithoutRounding(g)), [&](const Vector3d& n) {
    const Vector3d scaled = radii.cwiseProduct(n);
    const double norm = scaled.norm();
    return Vector3d((norm > 0. ? Vector3d(radii.cwiseProduct(scaled) / norm) : Vector3d::Zero().eval()) +
                    g.size[6] * n);
  });
}

Mesh rectangle(const Geometry& g) {
  const double x = .5 * g.size[0], y = .5 * g.size[1];
  Mesh mesh;
  mesh.vertices = {{-x, -y, 0.}, {x, -y, 0.}, {x, y, 0.}, {-x, y, 0.}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// Sizes in files of 2018 to 2023: [0 0 length radius] for round shapes.

void modernizeRound(Sizes& s) {
  if (s.size() == 4) s.erase(s.begin(), s.begin() + 2);
}

void modernizeSphere(Sizes& s) {
  modernizeRound(s);
  if (s.size() == 2) s.erase(s.begin());
  if (s.empty()) s = {1.};
}

void modernizeBox(Sizes& s) {
  if (s.size() == 4) s.pop_back();
}

void modernizeMarker(Sizes& s) {
  if (s.size() > 1) s = {*std::max_element(s.begin(), s.end())};
  if (s.empty()) s = {.1};
}

std::string requireRadius(const char* name, double radius) {
  if (radius < 1e-10) throw ValueError(cat("radius of a ", name, " is ", radius, "; expected a positive number"));
  return "";
}

std::string repairRoundedBox(Sizes& s) {
  std::string warning;
  for (int i = 0; i < 3; ++i) {
    if (s[i] >= 2. * s[3]) continue;
    warning =
        cat("ssBox with a side of ", s[i], " is thinner than twice its radius ", s[3], "; enlarged to ", 2. * s[3]);
    s[i] = 2. * s[3];
  }
  return warning;
}

std::string repairRoundedCylinder(Sizes& s) {
  s[0] = std::max(s[0], 2. * s[2]);
  s[1] = std::max(s[1], s[2]);
  return "";
}

// clang-format off
const ShapeKind kKinds[] = {
    {.type = ShapeType::box, .name = "box", .size_names = "x y z", .body = Body::box,
     .has_inertia = true, .is_drawn_by_page = true,
     .core = boxCore,
     .surface = boxSurface,
     .shell = [](const Sizes& s) { return boxShell(s[0], s[1], s[2]); },
     .extent = sides,
     .modernize = modernizeBox},
    {.type = ShapeType::sphere, .name = "sphere", .size_names = "radius", .body = Body::ball,
     .has_inertia = true, .is_round = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) { return ShapeCore{.radius = g.size[0]}; },
     .surface = [](const Geometry& g) { return roundedBox(Vector3d::Zero(), g.size[0]); },
     .shell = [](const Sizes& s) { return sphereShell(s[0]); },
     .extent = [](const Sizes& s) -> Vector3d { return Vector3d::Constant(2. * s[0]); },
     .modernize = modernizeSphere},
    {.type = ShapeType::capsule, .name = "capsule", .size_names = "length radius", .body = Body::capsule,
     .has_inertia = true, .is_round = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) {
       return ShapeCore{.form = Form::segment, .radius = g.size[1], .half_length = .5 * g.size[0]};
     },
     .surface = [](const Geometry& g) { return roundedBox({0., 0., .5 * g.size[0]}, g.size[1]); },
     .extent = [](const Sizes& s) { return Vector3d(2. * s[1], 2. * s[1], s[0] + 2. * s[1]); },
     .modernize = modernizeRound,
     .repair = [](Sizes& s) { return requireRadius("capsule", s[1]); }},
    {.type = ShapeType::mesh, .name = "mesh", .data = Data::mesh,
     .has_inertia = true,
     .core = [](const Geometry&) { return ShapeCore{.form = Form::hulls_of_parts}; },
     .surface = [](const Geometry& g) { return g.mesh ? *g.mesh : Mesh{}; }},
    {.type = ShapeType::cylinder, .name = "cylinder", .size_names = "length radius", .body = Body::cylinder,
     .has_inertia = true, .is_round = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) { return cylinderCore(g.size[0], g.size[1], 0.); },
     .surface = [](const Geometry& g) { return roundedCylinder(g.size[0], g.size[1], 0.); },
     .extent = [](const Sizes& s) { return Vector3d(2. * s[1], 2. * s[1], s[0]); },
     .modernize = modernizeRound,
     .repair = [](Sizes& s) { return requireRadius("cylinder", s[1]); }},
    {.type = ShapeType::marker, .name = "marker", .size_names = "length",
     .is_symbol = true, .is_drawn_by_page = true,
     .modernize = modernizeMarker},
    {.type = ShapeType::pointCloud, .name = "pointCloud", .data = Data::mesh,
     .core = [](const Geometry&) { return ShapeCore{.form = Form::points}; }},
    {.type = ShapeType::ssCvx, .name = "ssCvx", .size_names = "radius", .data = Data::core_points,
     .has_inertia = true,
     .core = [](const Geometry& g) { return ShapeCore{.form = Form::hull, .radius = g.size[0]}; },
     .surface = convexCoreSurface},
    {.type = ShapeType::ssBox, .name = "ssBox", .size_names = "x y z radius", .body = Body::box,
     .has_inertia = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) {
       return ShapeCore{.form = Form::box, .radius = g.size[3], .half_sides = halfSides(g) - Vector3d::Constant(g.size[3])};
     },
     .surface = [](const Geometry& g) { return roundedBox(halfSides(g) - Vector3d::Constant(g.size[3]), g.size[3]); },
     .extent = sides,
     .repair = repairRoundedBox},
    {.type = ShapeType::ssCylinder, .name = "ssCylinder", .size_names = "length radius rounding", .body = Body::cylinder,
     .has_inertia = true, .is_round = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) { return cylinderCore(g.size[0], g.size[1], g.size[2]); },
     .surface = [](const Geometry& g) { return roundedCylinder(g.size[0], g.size[1], g.size[2]); },
     .extent = [](const Sizes& s) { return Vector3d(2. * s[1], 2. * s[1], s[0]); },
     .repair = repairRoundedCylinder},
    {.type = ShapeType::ssBoxElip, .name = "ssBoxElip", .size_names = "x y z ex ey ez radius",
     .has_inertia = true,
     .core = [](const Geometry& g) {
       return ShapeCore{.form = Form::box_ellipsoid, .radius = g.size[6], .half_sides = boxWithoutRounding(g),
                        .radii = {g.size[3], g.size[4], g.size[5]}};
     },
     .surface = boxEllipsoidSurface},
    {.type = ShapeType::quad, .name = "quad", .size_names = "x y",
     .is_drawn_by_page = true,
     .core = [](const Geometry& g) {
       return ShapeCore{.form = Form::box, .half_sides = {.5 * g.size[0], .5 * g.size[1], 0.}};
     },
     .surface = rectangle},
    {.type = ShapeType::camera, .name = "camera", .optional_sizes = 1,
     .is_symbol = true, .is_drawn_by_page = true},
    {.type = ShapeType::sdf, .name = "sdf", .size_names = "x y z", .data = Data::grid,
     .has_inertia = true, .is_drawn_by_page = true,
     .core = [](const Geometry& g) {
       return g.grid && !g.grid->values.empty() ? ShapeCore{.form = Form::grid} : boxCore(g);
     },
     .surface = [](const Geometry& g) { return g.grid ? isosurface(*g.grid, sides(g.size)) : boxSurface(g); }},
    {.type = ShapeType::tensor, .name = "tensor", .size_names = "x y z", .data = Data::grid,
     .has_inertia = true, .is_drawn_by_page = true,
     .core = boxCore},
    {.type = ShapeType::lines, .name = "lines", .data = Data::mesh,
     .core = [](const Geometry&) { return ShapeCore{.form = Form::segments}; }},
    {.type = ShapeType::plane, .name = "plane", .size_names = "x y",
     .core = [](const Geometry&) { return ShapeCore{.form = Form::half_space}; },
     .surface = rectangle},
    {.type = kCells, .name = "cells", .size_names = "x y z", .data = Data::grid,
     .core = [](const Geometry& g) {
       return g.grid && !g.grid->values.empty() ? ShapeCore{.form = Form::grid} : boxCore(g);
     },
     .surface = [](const Geometry& g) { return g.grid ? cellsSurface(*g.grid, sides(g.size)) : boxSurface(g); }},
};
// clang-format on

}  // namespace

std::size_t ShapeKind::sizes() const {
  return size_names.empty() ? 0 : std::size_t(1 + std::count(size_names.begin(), size_names.end(), ' '));
}

std::span<const ShapeKind> shapeKinds() { return kKinds; }

const ShapeKind& shapeKind(ShapeType type) {
  static const ShapeKind kNone{.name = "none"};
  if (type == ShapeType::none) return kNone;
  const auto index = std::size_t(int(type));
  if (int(type) < 0 || index >= std::size(kKinds)) throw ValueError(cat("shape type ", int(type), " does not exist"));
  return kKinds[index];
}

double shapeHeight(ShapeType type, const std::vector<double>& size) {
  const ShapeKind& kind = shapeKind(type);
  return kind.extent ? kind.extent(size).z() : 0.;
}

}  // namespace kinegraph::inline geometry_internal
