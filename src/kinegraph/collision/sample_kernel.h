#pragma once

#include <cstdint>

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph {

// What PlacedSamples computes of eight configurations side by side. Numbers are in rows of lanes, one per
// configuration; rows are in groups of `width` lanes, so that a number is at [lane / width][row][lane % width]. `groups`
// says for how many of these groups it is asked. Nothing in this file owns memory or has inline functions, because it
// is shared with code for other instruction sets.

struct SampleKernel {
  static constexpr int kLanes = 8;
  static constexpr int kPerBody = 15;  ///< rows of a body: the columns of R, p, and the center of its box

  /// Something fixed to a link.
  struct Offset {
    ConstantRotation rotation;
    double R[9], p[3];  ///< in the link
    double center[3];   ///< of its box, in itself
  };
  /// A body where its box is told: rows, and half of the box's extent, m.
  struct Box {
    const double* rows;
    double half[3];
    double inner;   ///< a ball of this radius about the box's center is within the body; -infinity: not known
    bool is_whole;  ///< is the box the body itself?
    bool is_point;
  };

  /// Boxes swept by balls that do not move, a lane each, `width` of them after another in rows: the columns of R, the
  /// middle, half of the extent, the radius of the ball, and that of a sphere around the middle.
  struct FixedBoxes {
    static constexpr int kRows = 17;
    const double* rows;
    int count;
  };
  /// A convex core: the sum of a box and an ellipsoid, each of which may have no extent, or the hull of points. Local
  /// coordinates, m; rows of three numbers.
  struct Convex {
    double half[3], radii[3];
    bool is_round;                        ///< is there a radius?
    const double* points;                 ///< null: no hull
    int count;                            ///< of the points
    const std::uint32_t* neighbors;       ///< those of point i: [first_neighbor[i], first_neighbor[i + 1])
    const std::uint32_t* first_neighbor;  ///< null: not known
  };
  /// One that is placed: rows of its body, and a corner from which the farthest one is looked for.
  struct PlacedConvex {
    const Convex* core;
    const double* rows;
    std::uint32_t corner;
  };

  int width;

  /// Poses of all links of a model, 12 rows each: the columns of R, then p. `Q` has `count` rows of joints, one after the
  /// other; further lanes have those of the last. Of `memory`, x and motion are scratch for `width` lanes, pose has the
  /// world's pose in it, in every group.
  void (*placeLinks)(const LaneModel& model, const double* Q, int count, int groups, const LaneMemory& memory);

  /// The rows of a body. `link_row` is the first row of its link's pose, of `link_rows` rows in all.
  void (*placeBody)(const double* poses, int link_rows, int link_row, const Offset& offset, int groups, double* rows);

  /// Of a point fixed to a link: a sphere around where it is in all lanes, its center (3 numbers) and its radius.
  void (*boundPoint)(const double* poses, int link_rows, int link_row, const double* point, int groups, double* sphere);

  /// Per box: may it come within `margin` (m) of a sphere (center and radius)? Zero is certain. `near` has room for whole
  /// groups of boxes.
  void (*nearBoxes)(const FixedBoxes& boxes, const double* sphere, double margin, std::int64_t* near);

  /// How far two bodies are apart, per lane. `gaps`, at least: as far as their boxes are along the direction from one's to
  /// the other's middle, and the other way around; -infinity where that says nothing. Lanes whose gap is `enough` or more
  /// need not have the best one. `tops`, at most: the ball within one and the box of the other, infinity where not known.
  void (*boxGaps)(const Box& a, const Box& b, int groups, double enough, double* gaps, double* tops);

  /// How far two cores are apart along a direction n from b to a (3 numbers), per lane: a lower bound of their distance.
  /// n is fixed in a link, whose pose has its first row at `link_row` of `link_rows`, or in the world: `poses` is null.
  void (*gaps)(PlacedConvex& a, PlacedConvex& b, const double* n, const double* poses, int link_rows, int link_row,
               int groups, double* gaps);
};

/// That for `width` of laneWidths(), 0 for the widest.
const SampleKernel& sampleKernel(int width = 0);

namespace lanes {
/// One per instruction set.
extern const SampleKernel kSampleKernelBase, kSampleKernelAvx2, kSampleKernelAvx512;
}  // namespace lanes

}  // namespace kinegraph
