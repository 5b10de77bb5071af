#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// What moves by itself while a robot moves: a frame of the scene, with all that hangs on it, and where it is at which
/// time. Between two times it goes straight (a quaternion the shorter way, and normalized); before the first and after
/// the last one it stands still. It is no part of q, and nothing of q moves it.
struct ObstacleTrajectory {
  std::string frame;
  VectorXd times;  ///< (K,), rising, s

  /// (K, 7): poses in the world, x y z qw qx qy qz, m; or (K, d): positions of the frame's joint of d dofs.
  MatrixXd values;
};

/// A scene in which obstacles move while time goes on.
///
/// Where they are is part of a longer joint vector, of which the robot's q is the other part, so that a straight motion
/// of q during a time in which each obstacle goes straight is one of that vector. The pairs that count are those of a
/// part of the robot and of an obstacle.
class DynamicScene {
 public:
  /// Throws FrameNotFound, and ValueError for what makes no sense, with `who` in front.
  DynamicScene(const Config& config, std::vector<ObstacleTrajectory> obstacles, const char* who);

  const std::vector<ObstacleTrajectory>& obstacles() const { return obstacles_; }
  const State& state() const { return moving_.state(); }

  /// When something begins, changes or ends its motion, ascending from 0 on; 0 is the first of them.
  const std::vector<double>& breaks() const { return breaks_; }
  double end() const { return breaks_.back(); }  ///< from when on everything stands still, s

  /// Is a frame part of an obstacle?
  bool isObstacle(int frame) const { return belongs_[std::size_t(frame)]; }

  /// The joint vector of `state()` for the robot's q at t s.
  VectorXd at(const VectorXd& q, double t) const;

  /// The change of that joint vector where q changes by so much.
  VectorXd changeOf(const VectorXd& change) const;

  /// The values of an obstacle at t s: of a pose with a quaternion of length 1.
  VectorXd valuesAt(int obstacle, double t) const;

  /// The scene without the obstacles; where `times` are given, with copies of them that stand where they are at these
  /// times.
  Config standing(const std::vector<double>& times = {}) const;

 private:
  struct Track {
    int first_dof = 0;  ///< of the longer joint vector
    bool is_pose = true;
    MatrixXd rows;  ///< values with quaternions of one sign from row to row
  };

  void addTrack(ObstacleTrajectory& obstacle, const char* who);
  void keepPairsWithObstacles();
  void mapDofs();
  VectorXd rowAt(int obstacle, double t) const;

  std::vector<ObstacleTrajectory> obstacles_;
  std::vector<Track> tracks_;
  Config config_, moving_;
  std::vector<char> belongs_;  ///< per frame of config_: whether it is part of an obstacle
  std::vector<int> carrier_;   ///< frame of moving_ that carries the dofs of an obstacle
  std::vector<int> dof_;       ///< place of each entry of q in the longer vector
  std::vector<double> breaks_ = {0.};
};

}  // namespace kinegraph
