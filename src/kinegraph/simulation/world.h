#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/simulation/gyroscopic_forces.h"
#include "kinegraph/simulation/reference.h"
#include "kinegraph/simulation/scene_model.h"

namespace kinegraph {

/// What a gripper is about to do.
struct GripperTask {
  double target = 0.;     ///< of its joint, m or rad
  double reference = 0.;  ///< moves to the target at `speed`
  double speed = .3;
  double force = 20.;  ///< of each finger, N
  double still = 0.;   ///< s for which it has not moved although its force is at the limit
  bool operator==(const GripperTask&) const = default;
};

/// A thing that is held to another.
struct WeldedPair {
  int body_a = 0, body_b = 0;  ///< as in SceneBodies
  Pose X_AB;
  bool active = false;
};

/// A point of a body that is drawn to a place by a spring.
struct Pull {
  int body = 0;              ///< as in SceneBodies; 0: nothing is pulled
  Vector3d point{0, 0, 0};   ///< in the body's axes, m
  Vector3d target{0, 0, 0};  ///< world, m
  bool operator==(const Pull&) const = default;
};

/// Everything that a world will do next depends on: two worlds of one model with the same do the same, bit for bit.
struct WorldState {
  std::vector<mjtNum> physics;
  Reference reference;
  std::vector<GripperTask> grippers;
  std::vector<WeldedPair> welds;
  Pull pull;
};

/// A model in time: MuJoCo's data, motors, grippers and welds. Knows no scene.
class World {
 public:
  /// `model` stays, and is not changed: a world has a copy of what welds and randomization change.
  /// A kinematic one moves joints exactly as their references, and nothing else.
  World(std::shared_ptr<const SceneModel> model, const SimulationOptions& options, bool is_kinematic = false);

  const SceneModel& scene() const { return *model_; }
  const std::shared_ptr<const SceneModel>& sharedScene() const { return model_; }
  const mjModel& model() const { return *physics_; }
  const mjData& data() const { return *data_; }

  /// For other masses; constantsChanged must follow.
  mjModel& editModel() { return *physics_; }
  void constantsChanged();

  /// Of the geoms of a frame, and of the pairs that they are in.
  void setFriction(int frame, double friction);
  double time() const { return data_->time; }

  /// Positions and velocities, as of the model's joints; what follows from them is computed in the next step.
  mjtNum* positions() { return data_->qpos; }
  mjtNum* velocities() { return data_->qvel; }
  const mjtNum* positions() const { return data_->qpos; }
  void setTime(double time) { data_->time = time; }

  /// Followers of joints go where their sources are, and motors want to stay where they are.
  void settle();

  /// Steps for tau seconds. Throws ValueError for a control vector that does not fit the mode; then nothing has changed.
  /// Throws Error where numbers leave all bounds; then the state is as before the call.
  void checkCommand(const VectorXd& u, double tau, ControlMode mode) const;
  void step(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation = {});

  WorldState state() const;
  void setState(const WorldState& state);

  /// Takes over what goes on in another world: the state of all frames that it had, `old_frame` being the id that a frame had
  /// there, or -1.
  void transferState(const World& old, const std::function<int(int frame)>& old_frame);

  /// Forces of the last step do not help to find those of the next.
  void forgetForces();

  Reference& reference() { return reference_; }
  const Reference& reference() const { return reference_; }
  std::vector<GripperTask>& grippers() { return grippers_; }
  const std::vector<GripperTask>& grippers() const { return grippers_; }
  bool isGripperDone(int gripper) const;

  /// Holds body b to body a where it is. Throws ValueError if all of the model's welds are in use.
  void weld(int body_a, int body_b);
  bool unweld(int body_a, int body_b);
  const std::vector<WeldedPair>& welds() const { return welds_; }

  /// A force and a torque (world, N and N m) at a point that act on a body until they are set again.
  void push(int body, const Vector3d& force, const Vector3d& torque, const Vector3d& point);
  void clearPushes();

  /// Bodies, as in SceneBodies, that turned by more than .5 rad in an inner step of the last step.
  const std::set<int>& tooFast() const { return too_fast_; }

  /// A spring of 10 rad/s with the mass of the body and all that it carries, damped so that it does not swing, draws a point
  /// of it to a place from now on.
  void pull(const Pull& pull);
  const Pull& pulled() const { return pull_; }
  Vector3d pulledPoint() const;                              ///< where the point is, world
  const Vector3d& pullForce() const { return pull_force_; }  ///< of the last inner step, N
  bool canMove(int body) const;                              ///< false: it is fixed to the world

  /// The torque of each drive in the last inner step, and what contacts, limits, welds and pushes add.
  VectorXd driveTorques() const;
  VectorXd externalTorques() const;

  /// Where a body is now, world.
  Pose bodyPose(int body) const;

  /// Data of which everything is computed at the present positions: the world's own after a step, else a copy's.
  const mjData& computed() const;

 private:
  using Data = std::unique_ptr<mjData, decltype(&::mj_deleteData)>;
  void transferWelds(const World& old, const std::function<int(int frame)>& old_frame);
  void weld(int body_a, int body_b, const Pose& X_AB);
  void innerStep(double h);
  void correctContacts(double h);
  void driveMotors(double h);
  void addPull();
  void removePull();
  void moveGrippers(double h);
  void activate(std::size_t slot);
  void followReferences(double h);
  void checkNumbers(const WorldState& before, double time);

  std::shared_ptr<const SceneModel> model_;
  SimulationOptions options_;
  bool is_kinematic_;
  PhysicsModel physics_;
  Data data_;
  mutable Data computed_;
  mutable bool is_computed_ = false, copy_is_computed_ = false;
  Reference reference_;
  std::vector<GripperTask> grippers_;
  std::vector<WeldedPair> welds_;
  Pull pull_;
  Vector3d pull_force_{0, 0, 0};
  Vector6d pushed_before_ = Vector6d::Zero();  ///< what acted on the pulled body before the spring did
  std::vector<mjtNum> bias_, wanted_, torque_;
  GyroscopicForces turning_;
  std::set<int> too_fast_;
};

}  // namespace kinegraph
