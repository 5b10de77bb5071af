#pragma once

#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph {

/// Targets, and the links that move them, as flat numbers, for several attempts of inverse kinematics side by side, one
/// per lane of a wide register. Nothing in here owns memory, so that code for wide registers shares no inline functions
/// with the rest of the library.
struct IkKernelModel {
  struct Task {
    bool placed, turned, directed;  ///< has rows for its position; its rotation; its axis
    int first_column, columns;
    LaneRows::Frame frame;
    double axis[3];  ///< of a direction, in the frame
  };
  struct Column {
    int column, variable;
    bool turns;
  };

  LaneModel links;
  int tasks, rows;
  const Task* task;
  const Column* column;  ///< of the tasks
  const double *lower, *upper, *longest;

  int variables() const { return links.variables; }
};

/// One row of lanes per number, aligned for the widest register.
struct IkKernelMemory {
  static constexpr int kPerGoal = 18;

  double* x;         ///< (variables): where the lanes are
  double* next;      ///< (variables): where a damped step leads
  double* goal;      ///< (tasks, 18): R, p (or the unit direction), and two unit vectors across a direction
  double* square;    ///< (1): sum of squares of all rows
  double* distance;  ///< (1): squared, of the worst target, m^2
  double* angle;     ///< (1): of the worst target, rad
  double* pose;      ///< scratch (links, 12); that of the world is the identity
  double* motion;    ///< scratch (columns, 6): as in LaneMemory
  double* jacobian;  ///< scratch (variables, rows)
  double* error;     ///< scratch (rows)
  double* keep;      ///< scratch (variables): 0 where a bound holds
};

struct IkKernel {
  int lanes;

  /// Errors at x, and the step from there, in all lanes.
  void (*run)(const IkKernelModel& model, const IkKernelMemory& memory);
};

constexpr int kMostIkRows = 12;

/// For `width` lanes, one of laneWidths().
IkKernel ikKernel(int width);

namespace lanes {
/// One per instruction set.
void runIkBase(const IkKernelModel& model, const IkKernelMemory& memory);
void runIkAvx2(const IkKernelModel& model, const IkKernelMemory& memory);
void runIkAvx512(const IkKernelModel& model, const IkKernelMemory& memory);
}  // namespace lanes

}  // namespace kinegraph
