#pragma once

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph::inline ik_internal {

/// Targets, and the links that move them, as plain arrays, for several attempts of inverse kinematics side by side, one
/// per lane of a wide register. The struct owns no memory, so that code compiled for wide registers shares no inline
/// functions with the rest of the library.
struct IkKernelModel {
  struct Task {
    bool has_position, has_rotation, has_direction;  ///< rows that it has
    int first_column, columns;
    LaneRows::Frame frame;
    double axis[3];  ///< of a direction, in the frame
  };
  struct Column {
    int column, variable;
    bool is_rotation;
  };

  LaneModel links;
  int tasks, rows;
  const Task* task;
  const Column* column;  ///< of the tasks
  const double *lower, *upper, *longest;

  int variables() const { return links.variables; }
};

/// Arrays with one pack of lanes per number, aligned for the widest register.
struct IkKernelMemory {
  static constexpr int kPerGoal = 18;

  double* x;         ///< (variables): the present point of each lane
  double* next;      ///< (variables): the point that a damped step leads to
  double* goal;      ///< (tasks, 18): R, p (or the unit direction), and two unit vectors across a direction
  double* square;    ///< (1): sum of squares of all rows
  double* distance;  ///< (1): largest squared position error of the targets, m^2
  double* angle;     ///< (1): largest rotation error of the targets, rad
  double* pose;      ///< scratch (links, 12); the world's is the identity
  double* motion;    ///< scratch (columns, 6): as in LaneMemory
  double* jacobian;  ///< scratch (variables, rows)
  double* error;     ///< scratch (rows)
  double* keep;      ///< scratch (variables): 0 for variables that are held at a bound
};

struct IkKernel {
  int lanes;

  /// Computes the errors at x and the step from there, in all lanes.
  void (*run)(const IkKernelModel& model, const IkKernelMemory& memory);
};

constexpr int kMostIkRows = 12;

/// Returns the kernel for `width` lanes, one of laneWidths().
IkKernel ikKernel(int width);

}  // namespace kinegraph::inline ik_internal

namespace kinegraph::lanes {
/// One function per instruction set.
void runIkBase(const IkKernelModel& model, const IkKernelMemory& memory);
void runIkAvx2(const IkKernelModel& model, const IkKernelMemory& memory);
void runIkAvx512(const IkKernelModel& model, const IkKernelMemory& memory);
}  // namespace kinegraph::lanes
