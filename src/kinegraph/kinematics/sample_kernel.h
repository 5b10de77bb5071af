#pragma once

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
    ConstantTurn turn;
    double R[9], p[3];  ///< in the link
    double center[3];   ///< of its box, in itself
  };
  /// A body where its box is told: rows, and half of the box's extent, m.
  struct Box {
    const double* rows;
    double half[3];
    bool is_point;
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

  /// How far two boxes are apart, per lane, at least: along the direction from one's to the other's middle, and the other
  /// way around. -infinity where that says nothing. Lanes whose gap is `enough` or more need not have the best one.
  void (*boxGaps)(const Box& a, const Box& b, int groups, double enough, double* gaps);
};

/// That for `width` of laneWidths(), 0 for the widest.
const SampleKernel& sampleKernel(int width = 0);

namespace lanes {
/// One per instruction set.
extern const SampleKernel kSampleKernelBase, kSampleKernelAvx2, kSampleKernelAvx512;
}  // namespace lanes

}  // namespace kinegraph
