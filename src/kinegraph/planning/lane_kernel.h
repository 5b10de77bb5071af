#pragma once

namespace kinegraph {

/// Kinematics between the world and the target frames as flat numbers, for several attempts of inverse kinematics side by
/// side, one per lane of a wide register. Rotations are column-major. Nothing in here owns memory, so that code for wide
/// registers shares no inline functions with the rest of the library.
struct LaneModel {
  struct Step {
    enum Kind { translate, rotate, rotateAbout };
    int kind;
    int axis;
    int variable;
    double factor;
    double about[3];
  };
  struct Link {
    int parent;  ///< -1: the world
    int first_step, steps;
    double R[9], p[3];  ///< the base of the joint in the parent
  };
  struct Task {
    bool placed, turned, directed;  ///< has rows for its position; its rotation; its axis
    int link;
    int first_column, columns;
    double R[9], p[3];  ///< the frame in its link
    double axis[3];     ///< of a direction, in the frame
  };

  int links, steps, tasks, variables, rows;
  const Link* link;
  const Step* step;
  const Task* task;
  const int* column;  ///< of the tasks: a step each
  const double *lower, *upper, *longest;
};

/// One row of lanes per number, aligned for the widest register.
struct LaneMemory {
  static constexpr int kPerPose = 12, kPerStep = 6, kPerGoal = 18;

  double* x;         ///< (variables): where the lanes are
  double* next;      ///< (variables): where a damped step leads
  double* goal;      ///< (tasks, 18): R, p (or the unit direction), and two unit vectors across a direction
  double* square;    ///< (1): sum of squares of all rows
  double* distance;  ///< (1): squared, of the worst target, m^2
  double* angle;     ///< (1): of the worst target, rad
  double* pose;      ///< scratch (links, 12)
  double* motion;    ///< scratch (steps, 6): angular velocity and a point of the axis, or 0 and the linear velocity
  double* jacobian;  ///< scratch (variables, rows)
  double* error;     ///< scratch (rows)
  double* keep;      ///< scratch (variables): 0 where a bound holds
};

struct LaneKernel {
  int lanes;

  /// Errors at x, and the step from there, in all lanes.
  void (*run)(const LaneModel& model, const LaneMemory& memory);
};

constexpr int kMostLaneRows = 12;
constexpr int kMostLanes = 8;

/// The widest one that this machine runs. All give the same bits.
LaneKernel chooseLaneKernel();

namespace lanes {
/// One per instruction set; see lane_kernel.cpp.
void runBase(const LaneModel& model, const LaneMemory& memory);
void runAvx2(const LaneModel& model, const LaneMemory& memory);
void runAvx512(const LaneModel& model, const LaneMemory& memory);
}  // namespace lanes

/// Damping of a step whose rows have that sum of squares: little near the targets, so that convergence is quadratic.
constexpr double kLeastDamping = 1e-9, kDampingPerSquare = 1e-2, kMostSquares = 10.;

}  // namespace kinegraph
