#pragma once

#include <string>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/dynamic_obstacles/obstacle_trajectory.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline planning_internal {

/// A scene with dynamic obstacles.
///
/// Its joint vector consists of the robot's q and the values of the obstacles. If the robot and the obstacles move
/// along straight lines during an interval, so does this vector. Only pairs of the robot and an obstacle count.
class DynamicScene {
 public:
  /// Throws FrameNotFound, and ValueError for invalid trajectories; `who` names the caller.
  DynamicScene(const Config& config, std::vector<ObstacleTrajectory> obstacles, const char* who);

  const std::vector<ObstacleTrajectory>& obstacles() const { return obstacles_; }
  const State& state() const { return moving_.state(); }

  /// Times at which an obstacle has a waypoint, increasing from 0, which is the first of them, s.
  const std::vector<double>& breaks() const { return breaks_; }
  double end() const { return breaks_.back(); }  ///< from then on all obstacles are static, s

  /// Whether a frame is part of an obstacle.
  bool isObstacle(int frame) const { return belongs_[std::size_t(frame)]; }

  /// The joint vector of `state()` for the robot's q at time t (s).
  VectorXd at(const VectorXd& q, double t) const;

  /// The change of that joint vector for a change of q.
  VectorXd changeOf(const VectorXd& change) const;

  /// The values of an obstacle at time t (s); quaternions have length 1.
  VectorXd valuesAt(int obstacle, double t) const;

  /// Returns the scene without the obstacles, and with static copies of them at their poses at `times`.
  Config staticScene(const std::vector<double>& times = {}) const;

 private:
  struct Track {
    int first_dof = 0;  ///< in the joint vector of the scene
    bool is_pose = true;
    MatrixXd rows;  ///< values; consecutive quaternions have one sign
  };

  void addTrack(ObstacleTrajectory& obstacle, const char* who);
  void keepPairsWithObstacles();
  void mapDofs();
  VectorXd rowAt(int obstacle, double t) const;

  std::vector<ObstacleTrajectory> obstacles_;
  std::vector<Track> tracks_;
  Config config_, moving_;
  std::vector<char> belongs_;  ///< per frame of config_: it is part of an obstacle
  std::vector<int> carrier_;   ///< frame of moving_ that carries the dofs of an obstacle
  std::vector<int> dof_;       ///< index of each entry of q in the joint vector
  std::vector<double> breaks_ = {0.};
};

}  // namespace kinegraph::inline planning_internal
