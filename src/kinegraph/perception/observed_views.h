#pragma once

#include <set>
#include <vector>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/perception/depth_view.h"

namespace kinegraph {

/// A shape of the scene with a known pose: of the robot, or of any frame not looked for.
struct KnownShape {
  std::shared_ptr<const CollisionBody> body;
  RigidTransform X_WB;
  int frame = -1;
  bool moves = false;    ///< a joint moves it: things behind it may be anywhere
  bool supports = true;  ///< things may rest on it: at most one joint moves it, as that of a drawer
};

/// Whether a joint with dofs moves the frame in the world.
bool isMoved(const Frame& frame);

/// The shapes of a scene except for those of the frames `looked_for`, simple ones first. Point clouds are left out.
std::vector<KnownShape> knownShapes(const Config& config, const std::set<int>& looked_for);

/// A depth image at half resolution, compared with the known shapes.
struct ObservedView {
  enum class Pixel : std::uint8_t { none, background, known, other };

  RigidTransform X_WC;
  double fx, fy, cx, cy, noise, bias;
  int width, height;
  std::vector<float> depth;           ///< m, 0: not measured
  std::vector<Pixel> pixels;          ///< known: on a moving shape; background: on the support or a fixed shape
  std::vector<std::int32_t> nearest;  ///< index of the nearest pixel that is not background; -1 without any

  std::size_t index(int row, int column) const { return std::size_t(row) * std::size_t(width) + std::size_t(column); }
  Vector3d point(int row, int column) const;  ///< in the world
};

/// A measured point not explained by a known shape.
struct ObservedPoint {
  Vector3d p;
  double sigma;  ///< standard deviation of its depth, m
  int view;
};

/// A ball around the expected place of a thing.
struct SearchBall {
  Vector3d center;
  double radius;
};

/// Compares a depth image, given at half resolution, with the known shapes and a support at a height (m; null: none).
/// Leaves out `nearest`.
ObservedView compareWithKnown(const DepthView& half, const Pose& camera, const std::vector<KnownShape>& known,
                              const double* support_height);

/// Compares every second pixel of a depth image with the known shapes and a support. Appends the unexplained
/// points in the balls.
ObservedView observe(const DepthView& view, const Pose& camera, const std::vector<KnownShape>& known,
                     const double* support_height, const std::vector<SearchBall>& balls,
                     std::vector<ObservedPoint>& points, int view_index);

}  // namespace kinegraph
