#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/perception/register_scene.h"

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

/// What an occupancy map knows of a cell.
enum class CellState : std::uint8_t {
  unseen,     ///< it was in no image
  hidden,     ///< it was only ever behind something
  free,       ///< a camera looked through it, or a known shape was there
  occupied,   ///< something unknown was measured in it
  undecided,  ///< images show it, but only in part, as at the edges of things
};

/// Which unseen cells block motions.
enum class Unseen {
  blocked,  ///< all that were not seen free
  shadows,  ///< those behind something that was measured
  free,     ///< none
};

/// Reads "blocked", "shadows" or "free". Throws ValueError for another name.
Unseen unseenFromName(const std::string& name);

/// A map of the space that depth images show: cubes of equal size in a box of the world.
///
///     OccupancyMap map(C, {-.5, -.1, .65}, {.5, .8, 1.25}, .01);
///     map.update(C, views);
///     map.attach(C);           // now planMotion(C, ...) avoids what was measured and what was not seen
///
/// Points of the robot and of all shapes of the scene are left out: the shapes themselves are the obstacles. A cell is
/// free if a camera looked through the whole of it, occupied if points were measured in it. The last such image counts:
/// cells of a thing that moved away become free once a camera sees the background. Deterministic.
class OccupancyMap {
 public:
  /// Makes cubes of side `cell` (m) in the box from `lower` to `upper` (m, world), enlarged to whole cells. Cells in
  /// the shapes of the frames `free` and within 5 mm of the robot are free at first. Throws ValueError for an empty
  /// box, or more than 50 million cells, and FrameNotFound.
  OccupancyMap(const Config& config, const Vector3d& lower, const Vector3d& upper, double cell,
               const std::vector<std::string>& free = {});

  /// Adds depth images. The scene must have the joint angles and the poses of things at which they were taken. Frames
  /// of `known` that were not seen count as unknown: their points occupy cells. Returns warnings: sentences about
  /// images without depth, images that show nothing of the box, and doubtful poses of cameras. Throws ValueError for
  /// invalid views; the map is then unchanged.
  std::vector<std::string> update(const Config& config, std::span<const DepthView> views, const SeenScene& known = {});

  /// Gives the frame `name` the shape of the cells that block: occupied ones, and the unseen ones. Nothing floats:
  /// groups of hidden cells do not block if they touch no occupied cell, no shape on which things can rest, and
  /// no other cell that blocks. The frame is added if it does not exist. Call it again after an update; the scene keeps
  /// the cells of the last call. Throws ValueError if the frame exists with another shape.
  void attach(Config& config, Unseen unseen = Unseen::blocked, const std::string& name = "map") const;

  /// The state of the cell at a point (world); `free` outside of the box.
  CellState state(const Vector3d& point) const;

  const std::array<int, 3>& counts() const { return count_; }       ///< cells per axis
  const Vector3d& lower() const { return lower_; }                  ///< corner of the box, m
  double cell() const { return cell_; }                             ///< m
  Vector3d middle(std::size_t index) const;                         ///< of a cell, m
  const std::vector<CellState>& states() const { return states_; }  ///< the last index (z) is fastest
  void setStates(std::vector<CellState> states);                    ///< throws ValueError for another number

  std::string str() const;

 private:
  void clearKnown(const std::vector<KnownShape>& known);
  std::vector<bool> grounded(const Config& config, Unseen unseen) const;
  void addView(const DepthView& view, const Pose& camera, const std::vector<KnownShape>& known,
               std::vector<std::string>& warnings, const std::string& name);

  std::array<int, 3> count_;
  Vector3d lower_;
  double cell_;
  std::vector<CellState> states_;
};

}  // namespace kinegraph
