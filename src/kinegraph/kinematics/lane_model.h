#pragma once

#include "kinegraph/kinematics/constant_rotation.h"
#include "kinegraph/kinematics/motion_kind.h"

namespace kinegraph::inline kinematics_internal {

// Kinematics as plain arrays, for one configuration or several side by side, one per lane of a wide register. This file
// defines neither owning types nor inline functions, because code for other instruction sets includes it. Rotations are
// column-major.

/// The links that move some frames, in topological order; link 0 is the world.
struct LaneModel {
  struct Step {
    MotionKind kind;
    int axis;
    int variable;  ///< of its first dof
    int column;    ///< of its first dof
    double factor;
    double about[3];
  };
  struct Link {
    int parent;
    int first_step, steps;
    ConstantRotation rotation;
    double R[9], p[3];  ///< pose of the joint's base in the parent
  };

  int links, steps, columns, variables;
  const Link* link;
  const Step* step;
};

/// Rows of values of frames, and their dependence on the variables.
struct LaneRows {
  struct Frame {
    int link;
    ConstantRotation rotation;
    double R[9], p[3];  ///< pose in its link
  };
  /// The contribution of a twist column to the rows of a block.
  struct Entry {
    int column;
    int variable;
    bool is_rotation;  ///< otherwise a translation
    bool of_b;         ///< moves frame b instead of a
    bool adds;         ///< adds to an earlier entry of the same variable
  };
  struct Block {
    enum Kind : unsigned char {
      position,    ///< p_a (3 rows)
      offset,      ///< p_a - p_b
      relative,    ///< R_b^T (p_a - p_b), its first `rows` rows
      quaternion,  ///< of R_a (4)
      quaternion_offset,
      quaternion_relative,
      axis,  ///< R_a e (3)
      axis_offset,
      axis_relative,
      axis_product,  ///< (R_a e) . (R_b e') (1)
      twist,         ///< no values; Jacobian of p_a and of the angular velocity (6)
      joint,         ///< scale * x + shift (1)
    };
    Kind kind;
    bool canonical;  ///< for quaternions: the first nonzero component is positive
    int row, rows;
    int a, b;  ///< frames; for `joint`, a is the variable
    int axis_a, axis_b;
    int first_entry, entries;
    double scale, shift;
  };

  int frames, blocks, rows;
  const Frame* frame;
  const Block* block;
  const Entry* entry;
};

/// Scratch memory: one pack of lanes per number, aligned for the widest register.
struct LaneMemory {
  static constexpr int kPerPose = 12, kPerColumn = 6;

  double* x;         ///< (variables)
  double* pose;      ///< (links, 12); the world's is the identity
  double* motion;    ///< (columns, 6): angular velocity and a point on the axis, or 0 and the linear velocity
  double* frame;     ///< (frames, 12)
  double* y;         ///< (rows)
  double* jacobian;  ///< (rows, variables); comes filled with zeros
};

/// Input configurations, output values and Jacobians, one row each.
struct LaneBatch {
  const double* Q;
  long Q_stride;
  int count;
  double* y;  ///< null if not needed
  long y_stride;
  double* J;        ///< null if not needed
  long J_stride;    ///< between configurations
  long row_stride;  ///< between rows of one of them
};

using RunLanes = void (*)(const LaneModel& model, const LaneRows& rows, const LaneMemory& memory,
                          const LaneBatch& batch);

/// Returns the kernel for `width` lanes, one of laneWidths().
RunLanes laneKernel(int width);

}  // namespace kinegraph::inline kinematics_internal

namespace kinegraph::lanes {
/// One function per instruction set.
void runRowsBase(const LaneModel& model, const LaneRows& rows, const LaneMemory& memory, const LaneBatch& batch);
void runRowsAvx2(const LaneModel& model, const LaneRows& rows, const LaneMemory& memory, const LaneBatch& batch);
void runRowsAvx512(const LaneModel& model, const LaneRows& rows, const LaneMemory& memory, const LaneBatch& batch);
}  // namespace kinegraph::lanes
