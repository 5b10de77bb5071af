#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

/// A door or a drawer: a frame that is called is_door or is_drawer, with a joint of one dof that has limits.
struct TaskDoor {
  std::string name;
  Eigen::Index dof = 0;           ///< in q
  double closed = 0., open = 0.;  ///< rad or m: its limits, of which `closed` is nearer to zero

  /// Of its range, 0 where it is closed, 1 where it is open.
  double share(double q) const { return (q - closed) / (open - closed); }
  double at(double share) const { return closed + share * (open - closed); }

  /// "opened" from .8 of its range on, "closed" up to .05, else "ajar".
  std::string stateAt(double q) const;
};

/// Of a door's range: from where on it is open, and up to where closed; where one is left that is opened, between two
/// values, or closed.
inline constexpr double kOpened = .8, kClosed = .05, kOpenLeast = .85, kOpenMost = .98, kClose = .005;

/// All of a scene whose joints are active.
std::vector<TaskDoor> doorsOf(const Config& C);

/// A hand takes the handle of a door: hold (door handle hand).
bool isHold(const TaskAction& action);

/// A door is moved by the hand that holds its handle: open, close (door handle hand).
bool isGuided(const TaskAction& action);

/// How a hand that holds a handle can still turn: about the point that it touches, or the middle of a ball; about the axis
/// of a cylinder or capsule; not at all.
enum class Grip { point, axis, rigid };
Grip gripOf(const Config& C, const std::string& hand, const std::string& handle);

/// Postures after each action, K x n: doors stay where they are but where an action moves them, and then within limits.
MatrixXd withSettledDoors(const Config& C, const std::vector<TaskAction>& actions, MatrixXd waypoints);

/// A scene whose doors cannot move, and its dofs among those of the scene with doors.
struct StillDoors {
  Config scene;
  std::vector<Eigen::Index> dofs;
};
StillDoors withStillDoors(const Config& C, const std::vector<TaskDoor>& doors);

/// The frames of a door or drawer: those below it but for objects, and what moves by itself.
std::vector<std::string> partsOf(const Config& C, const std::string& door);

/// Objects that a door or drawer takes along: those below it.
std::vector<std::string> movedBy(const Config& C, const std::string& door, const std::vector<std::string>& objects);

}  // namespace kinegraph
