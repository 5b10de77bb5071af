#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/simulation/contact_search.h"
#include "kinegraph/simulation/gyroscopic_forces.h"
#include "kinegraph/simulation/reference.h"
#include "kinegraph/simulation/scene_model.h"

namespace kinegraph::inline simulation_internal {

/// The present command of a gripper.
struct GripperTask {
  double target = 0.;     ///< of its joint, m or rad
  double reference = 0.;  ///< moves to the target at `speed`
  double speed = .3;
  double force = 20.;  ///< of each finger, N
  double still = 0.;   ///< s without motion although the force is at its limit
  bool operator==(const GripperTask&) const = default;
};

/// Two bodies that are fixed to each other.
struct WeldedPair {
  int body_a = 0, body_b = 0;  ///< as in SceneBodies
  Pose X_AB;
  bool active = false;
};

/// A spring that moves a point of a body to a target.
struct PerturbationSpring {
  int body = 0;              ///< as in SceneBodies; 0: no perturbation
  Vector3d point{0, 0, 0};   ///< in the body's axes, m
  Vector3d target{0, 0, 0};  ///< world, m
  bool operator==(const PerturbationSpring&) const = default;
};

/// A contact point between two geoms of the model.
struct GeomContact {
  int geom_a = 0, geom_b = 0;
  Vector3d position;     ///< world, m
  Vector3d normal;       ///< unit, from a to b
  double distance = 0.;  ///< m
  Vector3d force;        ///< exerted by a on b, world, N
};

/// The complete state of a world: two worlds of one model with equal states evolve equally, bit for bit.
struct WorldState {
  std::vector<mjtNum> physics;
  std::vector<int> sleep;  ///< mjData::tree_asleep: the next tree of a sleeping island; negative: awake
  Reference reference;
  std::vector<GripperTask> grippers;
  std::vector<WeldedPair> welds;
  PerturbationSpring perturbation;
};

/// A model in time: MuJoCo's data, motors, grippers and welds. Does not know the scene.
class World {
 public:
  /// `model` is shared and not changed: a world copies the parts that welds and randomization change. A kinematic world
  /// moves joints exactly along their references, and nothing else.
  World(std::shared_ptr<const SceneModel> model, const SimulationOptions& options, bool is_kinematic = false);

  const SceneModel& scene() const { return *model_; }
  const std::shared_ptr<const SceneModel>& sharedScene() const { return model_; }
  const mjModel& model() const { return *physics_; }
  const mjData& data() const { return *data_; }

  /// For changes of masses; call constantsChanged afterwards.
  mjModel& editModel() { return *physics_; }
  void constantsChanged();

  /// Sets the friction of a frame's geoms, and of the pairs that contain them.
  void setFriction(int frame, double friction);
  double time() const { return data_->time; }

  /// Positions and velocities of the model's joints; dependent quantities are computed in the next step.
  mjtNum* positions() { return data_->qpos; }
  mjtNum* velocities() { return data_->qvel; }
  const mjtNum* positions() const { return data_->qpos; }
  void setTime(double time) { data_->time = time; }

  /// Wakes all bodies, or a body and those that sleep in contact with it. Changes of the model, of positions or
  /// velocities require it; bodies that meet moving ones wake by themselves, as do bodies with applied forces.
  void wake();
  void wake(int body);

  /// Moves followers to their sources' positions, and sets the motors' references to the present positions.
  void settle();

  /// Steps for `tau` seconds. Throws ValueError for a control vector that does not fit the mode, before any change.
  /// Throws Error if the simulation diverges, and restores the state before the call.
  void checkCommand(const VectorXd& u, double tau, ControlMode mode) const;
  void step(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation = {});

  WorldState state() const;
  void saveState(WorldState& state) const;  ///< the same, into memory of an earlier state
  void setState(const WorldState& state);

  /// Copies the state of all frames that another world has, too. `old_frame` maps a frame's id to its id there, or to
  /// -1.
  void transferState(const World& old, const std::function<int(int frame)>& old_frame);

  /// The contacts that transmit forces, those of sleeping bodies last.
  std::vector<GeomContact> contacts() const;

  /// Clears the warm start: forces of the last step do not predict those of the next.
  void forgetForces();

  Reference& reference() { return reference_; }
  const Reference& reference() const { return reference_; }
  std::vector<GripperTask>& grippers() { return grippers_; }
  const std::vector<GripperTask>& grippers() const { return grippers_; }
  bool isGripperDone(int gripper) const;

  /// Fixes body b to body a at their relative pose. Throws ValueError if all welds of the model are in use.
  void weld(int body_a, int body_b);
  bool unweld(int body_a, int body_b);
  const std::vector<WeldedPair>& welds() const { return welds_; }

  /// Applies a force (world, N) and a torque (N m) at a point of a body until they are set again.
  void applyForce(int body, const Vector3d& force, const Vector3d& torque, const Vector3d& point);
  void clearForces();

  /// Bodies, as in SceneBodies, that rotated by more than .5 rad in an inner step of the last step.
  const std::set<int>& tooFast() const { return too_fast_; }

  /// Moves a point of a body to a target by a spring, from now on. The spring has a frequency of 10 rad/s with the mass
  /// of the body and all bodies below it, and is critically damped.
  void perturb(const PerturbationSpring& spring);
  const PerturbationSpring& perturbation() const { return perturbation_; }
  Vector3d perturbedPoint() const;                                           ///< world, m
  const Vector3d& perturbationForce() const { return perturbation_force_; }  ///< of the last inner step, N
  bool canMove(int body) const;                                              ///< false: fixed to the world

  /// The torques of the motors in the last inner step; and those of contacts, limits, welds and applied forces.
  VectorXd motorTorques() const;
  VectorXd externalTorques() const;

  /// The present pose of a body, world.
  Pose bodyPose(int body) const;

  /// Data with all quantities computed at the present positions: the world's own after a step, else those of a copy.
  const mjData& computed() const;

 private:
  using Data = std::unique_ptr<mjData, decltype(&::mj_deleteData)>;
  void transferWelds(const World& old, const std::function<int(int frame)>& old_frame);
  void weld(int body_a, int body_b, const Pose& X_AB);
  void innerStep(double h);
  void restoreSleep(const std::vector<int>& sleep);
  void keepUnsupportedAwake();
  void wakeTree(int tree);
  bool isGeomAsleep(int geom) const;
  GeomContact contactOf(const mjData& d, int i) const;
  void keepRestingContacts();
  void forgetWokenContacts();
  void correctContacts(double h);
  void addBounces(double h);
  void driveMotors(double h);
  double inertiaAt(const Vector3d& point, int body);
  void addPerturbation();
  void removePerturbation();
  void moveGrippers(double h);
  void activate(std::size_t slot);
  void followReferences(double h);
  bool diverges() const;
  void checkNumbers(double time);

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
  PerturbationSpring perturbation_;
  Vector3d perturbation_force_{0, 0, 0};
  Vector6d force_before_perturbation_ = Vector6d::Zero();  ///< applied force without the spring's
  std::vector<mjtNum> point_jacobian_, point_response_;    ///< of the perturbed point, 3 x nv: J and J M^-1
  std::vector<mjtNum> bias_, desired_acceleration_, torque_;
  GyroscopicForces gyroscopic_forces_;
  ContactSearch contact_search_;
  std::vector<GeomContact> resting_contacts_;  ///< of sleeping bodies, from the step in which they fell asleep
  std::vector<char> is_supported_;             ///< per tree
  WorldState before_;                          ///< at the begin of the last step
  std::set<int> too_fast_;
};

}  // namespace kinegraph::inline simulation_internal
