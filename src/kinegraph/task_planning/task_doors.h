#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

/// A door or a drawer: a frame labeled is_door or is_drawer, with a joint of one dof with limits.
struct TaskDoor {
  std::string name;
  Eigen::Index dof = 0;           ///< in q
  double closed = 0., open = 0.;  ///< rad or m: its limits; `closed` is closer to zero

  /// The share of the range: 0 is closed, 1 is open.
  double share(double q) const { return (q - closed) / (open - closed); }
  double at(double share) const { return closed + share * (open - closed); }

  /// "opened" from .8 of its range on, "closed" up to .05, else "ajar".
  std::string stateAt(double q) const;
};

/// Shares of a door's range: it is open from kOpened on, and closed up to kClosed. An action leaves an opened door
/// between kOpenLeast and kOpenMost, and a closed one at kClose.
inline constexpr double kOpened = .8, kClosed = .05, kOpenLeast = .85, kOpenMost = .98, kClose = .005;

/// Returns the doors of a scene with active joints.
std::vector<TaskDoor> doorsOf(const Config& C);

/// A hand takes the handle of a door: hold (door handle hand).
bool isHold(const TaskAction& action);

/// A door is moved by the hand that holds its handle: open, close (door handle hand).
bool isGuided(const TaskAction& action);

/// The rotation that a handle allows the hand: about a contact point or the center of a ball; about the axis of a
/// cylinder or capsule; none.
enum class Grip { point, axis, rigid };
Grip gripOf(const Config& C, const std::string& hand, const std::string& handle);

/// Returns the waypoints, (K, n), with doors fixed except in actions that move them, and within their limits.
MatrixXd withSettledDoors(const Config& C, const std::vector<TaskAction>& actions, MatrixXd waypoints);

/// A scene with inactive doors, and the indices of its dofs in the original scene.
struct StillDoors {
  Config scene;
  std::vector<Eigen::Index> dofs;
};
StillDoors withStillDoors(const Config& C, const std::vector<TaskDoor>& doors);

/// Returns the frames of a door or drawer: those below it without joints.
std::vector<std::string> partsOf(const Config& C, const std::string& door);

/// Returns the objects that a door or drawer moves along: those below it.
std::vector<std::string> movedBy(const Config& C, const std::string& door, const std::vector<std::string>& objects);

}  // namespace kinegraph::inline task_planning_internal
