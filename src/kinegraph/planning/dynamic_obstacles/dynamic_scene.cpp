#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr int kPose = 7;
constexpr const char* kCarrier = "dynamic obstacles of a plan";

void requireTrack(const ObstacleTrajectory& obstacle, const std::string& what) {
  const Eigen::Index count = obstacle.times.size();
  if (count == 0) throw ValueError(cat(what, " has no times"));
  if (obstacle.values.rows() != count)
    throw ValueError(
        cat(what, " has ", count, " times and ", obstacle.values.rows(), " rows of values; expected as many"));
  if (!obstacle.times.allFinite() || !obstacle.values.allFinite())
    throw ValueError(cat(what, " has numbers that are not finite"));
  for (Eigen::Index i = 1; i < count; ++i)
    if (!(obstacle.times[i] > obstacle.times[i - 1]))
      throw ValueError(cat(what, ": time ", i, " is ", obstacle.times[i], ", after ", obstacle.times[i - 1],
                           "; expected increasing times"));
}

/// Normalizes quaternions and flips signs so that each is closer to the one before than its negative.
void alignQuaternions(MatrixXd& poses, const std::string& what) {
  for (Eigen::Index i = 0; i < poses.rows(); ++i) {
    auto q = poses.row(i).tail<4>();
    if (q.norm() < 1e-9) throw ValueError(cat(what, ": the quaternion of pose ", i, " is zero"));
    q.normalize();
    if (i > 0 && q.dot(poses.row(i - 1).tail<4>()) < 0.) q = -q;
  }
}

void makeInvisible(FrameData& frame) {
  if (!frame.shape || frame.shape->contact == 0) return;
  frame.shape = std::make_shared<Shape>(*frame.shape);  // other frames may share the shape
  frame.shape->contact = 0;
}

}  // namespace

DynamicScene::DynamicScene(const Config& config, std::vector<ObstacleTrajectory> obstacles, const char* who)
    : obstacles_(std::move(obstacles)), config_(config), moving_(config), belongs_(config.getFrames().size(), 0) {
  for (ObstacleTrajectory& obstacle : obstacles_) addTrack(obstacle, who);
  moving_.scene()->structureChanged();
  keepPairsWithObstacles();
  mapDofs();
  std::sort(breaks_.begin(), breaks_.end());
  breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
}

void DynamicScene::addTrack(ObstacleTrajectory& obstacle, const char* who) {
  const std::string what = cat(who, ": the dynamic obstacle '", obstacle.frame, "'");
  const Frame frame = config_.getFrame(obstacle.frame);
  requireTrack(obstacle, what);
  std::vector<Frame> parts = frame.getSubtree();
  parts.push_back(frame);
  const KinematicModel& model = *config_.model();
  bool collides = false;
  for (const Frame& part : parts) {
    const auto id = std::size_t(part.id());
    if (model.frame_link[id] != 0)
      throw ValueError(
          cat(what,
              part == frame ? std::string(" moves with q") : cat(" carries '", part.getName(), "', which moves with q"),
              "; leave its joint out of q with selectJoints"));
    belongs_[id] = 1;
    collides |= part.data().shape && part.data().shape->contact != 0;
  }
  if (!collides) throw ValueError(cat(what, " has no shape that takes part in collisions; call setContact(1) on one"));
  Frame moving = moving_.getFrame(frame.id());
  const auto columns = int(obstacle.values.cols());
  Track track{.rows = obstacle.values};
  track.is_pose = columns == kPose;
  if (track.is_pose) {
    alignQuaternions(track.rows, what);
    Frame root = moving_.findFrame(kCarrier) ? moving_.getFrame(kCarrier) : moving_.addFrame(kCarrier);
    Frame carrier = moving_.addFrame(cat(kCarrier, " ", tracks_.size()), root);
    carrier.setJoint(JointType::free);
    if (moving.getParent()) moving.unLink();
    moving.setParent(carrier).setRelativePose(Pose());
    carrier_.push_back(carrier.id());
  } else {
    const FrameData& data = moving.data();
    const int dofs = data.moves() ? dofSource(data).joint->dofs() : 0;
    if (dofs != columns)
      throw ValueError(cat(what, " has rows of ", columns, " values; expected 7 (a pose in the world)",
                           dofs ? cat(", or ", dofs, " (positions of its joint)") : ""));
    FrameData& source = dofSource(moving.data());
    source.joint->active = true;
    carrier_.push_back(source.id);
  }
  for (const double time : obstacle.times)
    if (time > 0.) breaks_.push_back(time);
  tracks_.push_back(std::move(track));
}

/// Excludes static frames, pairs of two parts of the robot, and pairs of two obstacles.
void DynamicScene::keepPairsWithObstacles() {
  std::vector<FrameData*> robot, moving;
  const KinematicModel& model = *config_.model();
  for (std::size_t id = 0; id < belongs_.size(); ++id) {
    FrameData& frame = moving_.getFrame(int(id)).data();
    if (!frame.shape || frame.shape->contact == 0) continue;
    if (belongs_[id]) {
      moving.push_back(&frame);
    } else if (model.frame_link[id] != 0) {
      robot.push_back(&frame);
    } else {
      makeInvisible(frame);
    }
  }
  for (const std::vector<FrameData*>* group : {&robot, &moving})
    for (std::size_t i = 0; i < group->size(); ++i)
      (*group)[i]->no_contact.insert((*group)[i]->no_contact.end(), group->begin() + std::ptrdiff_t(i) + 1,
                                     group->end());
  moving_.scene()->structureChanged();
}

void DynamicScene::mapDofs() {
  const KinematicModel &before = *config_.model(), &after = *moving_.model();
  dof_.assign(std::size_t(before.dofs), 0);
  for (std::size_t id = 0; id < before.frame_dofs.size(); ++id)
    for (int i = 0; i < before.frame_dofs[id].count; ++i)
      dof_[std::size_t(before.frame_dofs[id].first + i)] = after.frame_dofs[id].first + i;
  for (std::size_t k = 0; k < tracks_.size(); ++k)
    tracks_[k].first_dof = after.frame_dofs[std::size_t(carrier_[k])].first;
}

VectorXd DynamicScene::rowAt(int obstacle, double t) const {
  const VectorXd& times = obstacles_[std::size_t(obstacle)].times;
  const MatrixXd& rows = tracks_[std::size_t(obstacle)].rows;
  const auto after = std::upper_bound(times.begin(), times.end(), t) - times.begin();
  if (after == 0) return rows.row(0).transpose();
  if (after == times.size()) return rows.row(after - 1).transpose();
  const double share = (t - times[after - 1]) / (times[after] - times[after - 1]);
  return ((1. - share) * rows.row(after - 1) + share * rows.row(after)).transpose();
}

VectorXd DynamicScene::valuesAt(int obstacle, double t) const {
  VectorXd values = rowAt(obstacle, t);
  if (tracks_[std::size_t(obstacle)].is_pose) values.tail<4>().normalize();
  return values;
}

VectorXd DynamicScene::at(const VectorXd& q, double t) const {
  VectorXd all = moving_.model()->home;
  for (std::size_t i = 0; i < dof_.size(); ++i) all[dof_[i]] = q[Eigen::Index(i)];
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const VectorXd row = rowAt(int(k), t);
    all.segment(tracks_[k].first_dof, row.size()) = row;
  }
  return all;
}

VectorXd DynamicScene::changeOf(const VectorXd& change) const {
  VectorXd all = VectorXd::Zero(moving_.model()->dofs);
  for (std::size_t i = 0; i < dof_.size(); ++i) all[dof_[i]] = change[Eigen::Index(i)];
  return all;
}

Config DynamicScene::staticScene(const std::vector<double>& times) const {
  Config scene(config_);
  for (std::size_t id = 0; id < belongs_.size(); ++id)
    if (belongs_[id]) makeInvisible(scene.getFrame(int(id)).data());
  scene.scene()->structureChanged();
  State state(moving_.state());
  for (const double time : times) {
    const VectorXd all = at(config_.getJointState(), time);
    state.setJoints(all.data());
    for (std::size_t id = 0; id < belongs_.size(); ++id) {
      const FrameData& original = config_.getFrame(int(id)).data();
      if (!belongs_[id] || !original.shape || original.shape->contact == 0) continue;
      const RigidTransform X = state.pose(int(id));
      Frame copy(scene.scene(), scene.scene()->add(cat(original.name, " at ", time, " s"), nullptr));
      copy.data().shape = original.shape;
      copy.setPose(Pose{X.p, Quaterniond(X.R)});
    }
  }
  if (!times.empty()) scene.scene()->structureChanged();
  return scene;
}

}  // namespace kinegraph::inline planning_internal
