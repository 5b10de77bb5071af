#pragma once

#include <cstdint>

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph::inline collision_internal {

// Computations of PlacedSamples for eight configurations side by side. Numbers are in rows of lanes, one lane per
// configuration. Lanes are in groups of `width`, so that a number is at [lane / width][row][lane % width]; `groups` is
// the number of groups to compute. This file owns no memory and has no inline functions, because code for other
// instruction sets shares it.

struct SampleKernel {
  static constexpr int kLanes = 8;
  static constexpr int kPerBody = 15;  ///< rows of a body: the columns of R, p, and the center of its box

  /// A body's pose in its link.
  struct Offset {
    ConstantRotation rotation;
    double R[9], p[3];  ///< in the link
    double center[3];   ///< of its box, in the body
  };
  /// A placed body with its box.
  struct Box {
    const double* rows;
    double half[3];  ///< half of the box's extent, m
    double inner;    ///< radius of a ball in the body about the box's center, m; -infinity: unknown
    bool is_whole;   ///< the box is the body itself
    bool is_point;
  };

  /// Static boxes swept by balls, one per lane, in rows of `width` lanes: the columns of R, the center, half of the
  /// extent, the radius of the ball, and that of a sphere around the center.
  struct FixedBoxes {
    static constexpr int kRows = 17;
    const double* rows;
    int count;
  };
  /// A convex core: the Minkowski sum of a box and an ellipsoid, either of which may be a point, or the hull of points.
  /// Local coordinates, m; rows of three numbers.
  struct Convex {
    double half[3], radii[3];
    bool is_round;                        ///< the ellipsoid has an extent
    const double* points;                 ///< null: no hull
    int count;                            ///< of the points
    const std::uint32_t* neighbors;       ///< those of point i: [first_neighbor[i], first_neighbor[i + 1])
    const std::uint32_t* first_neighbor;  ///< null: unknown
  };
  /// A placed core: the rows of its body, and the corner at which the search for the support corner begins.
  struct PlacedConvex {
    const Convex* core;
    const double* rows;
    std::uint32_t corner;
  };

  int width;

  /// Computes the poses of all links of a model, 12 rows each: the columns of R, then p. `Q` has `count` rows of
  /// joints; further lanes repeat the last one. In `memory`, x and motion are scratch for `width` lanes, and pose
  /// contains the world's pose in every group.
  void (*placeLinks)(const LaneModel& model, const double* Q, int count, int groups, const LaneMemory& memory);

  /// Computes the rows of a body. `link_row` is the first row of its link's pose, out of `link_rows` rows.
  void (*placeBody)(const double* poses, int link_rows, int link_row, const Offset& offset, int groups, double* rows);

  /// Computes a sphere around the places of a point of a link in all lanes: its center (3 numbers) and its radius.
  void (*boundPoint)(const double* poses, int link_rows, int link_row, const double* point, int groups, double* sphere);

  /// Tests per box whether it may come within `margin` (m) of a sphere (center and radius); zero: certainly not. `near`
  /// has space for whole groups of boxes.
  void (*nearBoxes)(const FixedBoxes& boxes, const double* sphere, double margin, std::int64_t* near);

  /// Bounds the distance of two bodies per lane. `gaps` are lower bounds: the gap of their boxes along the direction
  /// between their centers; -infinity: unknown. Gaps of `enough` or more may be smaller than the best ones. `tops` are
  /// upper bounds: the distance of a ball in one and the box of the other; infinity: unknown.
  void (*boxGaps)(const Box& a, const Box& b, int groups, double enough, double* gaps, double* tops);

  /// Computes the gap of two cores along a direction n from b to a (3 numbers), per lane: a lower bound of their
  /// distance. n is fixed in a link, whose pose begins at row `link_row` of `link_rows`, or in the world if `poses` is
  /// null.
  void (*gaps)(PlacedConvex& a, PlacedConvex& b, const double* n, const double* poses, int link_rows, int link_row,
               int groups, double* gaps);
};

/// Returns the kernel for a `width` of laneWidths(); 0: the widest.
const SampleKernel& sampleKernel(int width = 0);

}  // namespace kinegraph::inline collision_internal

namespace kinegraph::lanes {
// One per instruction set.
extern const SampleKernel kSampleKernelBase, kSampleKernelAvx2, kSampleKernelAvx512;
}  // namespace kinegraph::lanes
