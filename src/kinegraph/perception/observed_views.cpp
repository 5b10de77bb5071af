#include "kinegraph/perception/occupancy_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/perception/known_points.h"
#include "kinegraph/perception/measured_depth.h"

namespace kinegraph {

namespace {

constexpr int kStride = 2;             // of the pixels of an image
constexpr double kNearSurface = .004;  // m, points closer to a known fixed surface belong to it
constexpr double kNearRobot = .012;    // m, the same for what joints move: they and the camera are known less exactly

using Pixel = ObservedView::Pixel;

/// The rows and columns of a ball's image.
struct Window {
  int top = 0, bottom = 0, left = 0, right = 0;  ///< half open
};

Window windowOf(const ObservedView& view, const Vector3d& center, double radius) {
  const Vector3d c = view.X_WC.inverse() * center;
  if (c.z() + radius <= 0.) return {};
  if (c.z() - radius < .02) return {0, view.height, 0, view.width};
  const double scale = 1. / (c.z() - radius);
  const auto range = [&](double f, double middle, double x, int size, int& from, int& to) {
    const double a = f * std::min((x - radius) * scale, (x - radius) / (c.z() + radius)) + middle;
    const double b = f * std::max((x + radius) * scale, (x + radius) / (c.z() + radius)) + middle;
    from = int(std::clamp(std::floor(a), 0., double(size)));
    to = int(std::clamp(std::ceil(b) + 1., 0., double(size)));
  };
  Window window;
  range(view.fx, view.cx, c.x(), view.width, window.left, window.right);
  range(view.fy, view.cy, c.y(), view.height, window.top, window.bottom);
  return window;
}

void markKnown(ObservedView& view, const std::vector<KnownShape>& known, const std::vector<Vector3d>& points) {
  for (const KnownShape& shape : known) {
    const double reach = shape.moves ? kNearRobot : kNearSurface;
    const bool endless = shape.body->core() == CollisionBody::Core::half_space;
    const Vector3d center = shape.X_WB * shape.body->boundCenter();
    const double radius = shape.body->boundRadius() + reach;
    const Window window = endless ? Window{0, view.height, 0, view.width} : windowOf(view, center, radius);
    for (int row = window.top; row < window.bottom; ++row) {
      for (int column = window.left; column < window.right; ++column) {
        const std::size_t i = view.index(row, column);
        if (view.pixels[i] != Pixel::other) continue;
        if (!endless && (points[i] - center).squaredNorm() > radius * radius) continue;
        const double sigma = 3. * view.noise * view.depth[i] * view.depth[i];
        const double near = std::max(reach, sigma);
        if (!isWithin(shape, points[i], near)) continue;
        view.pixels[i] = shape.moves ? Pixel::known : Pixel::background;
      }
    }
  }
}

/// Nearest pixel outside of the background, by two sweeps that pass on the offsets of neighbors (Danielsson, 1980).
void findNearest(ObservedView& view) {
  struct Offset {
    std::int32_t y, x;
    std::int32_t squared() const { return y * y + x * x; }
  };
  constexpr std::int32_t kFar = 20000, kFound = 10000;  // pixels, more than any image has
  std::vector<Offset> offsets(view.pixels.size(), {kFar, kFar});
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (view.pixels[i] != Pixel::background) offsets[i] = {0, 0};
  }
  const auto sweep = [&](int step) {
    for (int n = 0; n < view.height; ++n) {
      const int row = step > 0 ? n : view.height - 1 - n;
      Offset* own = offsets.data() + view.index(row, 0);
      const bool has_neighbor = row - step >= 0 && row - step < view.height;
      const Offset* other = has_neighbor ? offsets.data() + view.index(row - step, 0) : nullptr;
      const auto pass = [&](const Offset* from, int column, int dy, int dx) {
        if (column + dx < 0 || column + dx >= view.width) return;
        const Offset at = {from[column + dx].y + dy, from[column + dx].x + dx};
        if (at.squared() < own[column].squared()) own[column] = at;
      };
      for (int column = 0; column < view.width; ++column) {
        for (int side = -1; side <= 1 && other; ++side) pass(other, column, -step, side);
        pass(own, column, 0, -1);
      }
      for (int column = view.width - 1; column >= 0; --column) pass(own, column, 0, 1);
    }
  };
  sweep(1);
  sweep(-1);
  view.nearest.resize(view.pixels.size());
  for (std::size_t i = 0; i < offsets.size(); ++i)
    view.nearest[i] = offsets[i].y > kFound ? -1 : std::int32_t(i) + offsets[i].y * view.width + offsets[i].x;
}

/// The number of joints that move a frame in the world.
int jointsOf(const Frame& frame) {
  int joints = 0;
  for (std::optional<Frame> at = frame; at; at = at->getParent()) {
    if (at->data().joint && at->data().joint->dofs() > 0) ++joints;
  }
  return joints;
}

/// Every second pixel in both directions: those of even rows and columns, or if an interlaced image has twice as many
/// measurements elsewhere, others.
DepthView everySecondPixel(const DepthView& view) {
  constexpr int kSparse = 7 * kStride;  // pixels: enough of them tell
  std::array<int, kStride * kStride> measured{};
  for (int row = 0; row + 1 < view.height; row += kSparse) {
    for (int column = 0; column + 1 < view.width; column += kSparse) {
      for (int i = 0; i < kStride * kStride; ++i)
        measured[std::size_t(i)] += isMeasured(
            view.depth[std::size_t(row + i / kStride) * std::size_t(view.width) + std::size_t(column + i % kStride)]);
    }
  }
  const auto best = std::max_element(measured.begin(), measured.end());
  const int phase = *best > 2 * measured[0] ? int(best - measured.begin()) : 0;
  const int first_row = phase / kStride, first_column = phase % kStride;
  DepthView half = view;
  half.width = (view.width - first_column + kStride - 1) / kStride;
  half.height = (view.height - first_row + kStride - 1) / kStride;
  half.fxycxy -= Eigen::Vector4d(0., 0., first_column, first_row);
  half.fxycxy /= kStride;
  half.depth.resize(std::size_t(half.width) * std::size_t(half.height));
  for (int row = 0; row < half.height; ++row) {
    for (int column = 0; column < half.width; ++column)
      half.depth[std::size_t(row) * std::size_t(half.width) + std::size_t(column)] =
          view.depth[std::size_t(first_row + kStride * row) * std::size_t(view.width) +
                     std::size_t(first_column + kStride * column)];
  }
  return half;
}

}  // namespace

Vector3d ObservedView::point(int row, int column) const {
  const double d = depth[index(row, column)];
  return X_WC * Vector3d((column + .5 / kStride - cx) * d / fx, (row + .5 / kStride - cy) * d / fy, d);
}

bool isMoved(const Frame& frame) { return jointsOf(frame) > 0; }

std::vector<KnownShape> knownShapes(const Config& config, const std::set<int>& looked_for) {
  std::vector<KnownShape> known;
  for (const Frame& frame : config.getFrames()) {
    const auto& shape = frame.data().shape;
    if (!shape || looked_for.count(frame.id()) || shapeKind(shape->geometry->type).is_symbol) continue;
    if (shape->geometry->type == kCells || shape->geometry->type == ShapeType::pointCloud ||
        shape->geometry->type == ShapeType::none)
      continue;
    if (shape->contact == 0 && shape->color && (*shape->color)[3] < 1.) continue;
    const int joints = jointsOf(frame);
    known.push_back({shape->body(), frame.getPose().transform(), frame.id(), joints > 0, joints <= 1});
  }
  std::stable_sort(known.begin(), known.end(), [](const KnownShape& a, const KnownShape& b) {
    return a.body->core() < CollisionBody::Core::hull && b.body->core() >= CollisionBody::Core::hull;
  });
  return known;
}

ObservedView compareWithKnown(const DepthView& given, const Pose& camera, const std::vector<KnownShape>& known,
                              const double* support_height) {
  ObservedView view;
  view.X_WC = camera.transform();
  view.width = given.width;
  view.height = given.height;
  view.fx = given.fxycxy[0];
  view.fy = given.fxycxy[1];
  view.cx = given.fxycxy[2];
  view.cy = given.fxycxy[3];
  view.noise = given.noise;
  view.bias = given.bias;
  const std::size_t count = std::size_t(view.width) * std::size_t(view.height);
  view.depth.assign(count, 0.f);
  view.pixels.assign(count, Pixel::none);
  std::vector<Vector3d> world(count);
  for (int row = 0; row < view.height; ++row) {
    for (int column = 0; column < view.width; ++column) {
      const std::size_t i = view.index(row, column);
      const float d = given.depth[i];
      if (!isMeasured(d)) continue;
      view.depth[i] = d;
      world[i] = view.point(row, column);
      const double near = std::max(kNearSurface, 3. * view.noise * d * d);
      const bool on_support = support_height && world[i].z() < *support_height + near;
      view.pixels[i] = on_support ? Pixel::background : Pixel::other;
    }
  }
  markKnown(view, known, world);
  return view;
}

ObservedView observe(const DepthView& given, const Pose& camera, const std::vector<KnownShape>& known,
                     const double* support_height, const std::vector<SearchBall>& balls,
                     std::vector<ObservedPoint>& points, int view_index) {
  ObservedView view = compareWithKnown(everySecondPixel(given), camera, known, support_height);
  findNearest(view);
  for (std::size_t i = 0; i < view.pixels.size(); ++i) {
    if (view.pixels[i] != Pixel::other) continue;
    const Vector3d point = view.point(int(i) / view.width, int(i) % view.width);
    const bool wanted = std::any_of(balls.begin(), balls.end(), [&](const SearchBall& ball) {
      return (point - ball.center).squaredNorm() < ball.radius * ball.radius;
    });
    if (wanted) points.push_back({point, view.noise * view.depth[i] * view.depth[i], view_index});
  }
  return view;
}

}  // namespace kinegraph
