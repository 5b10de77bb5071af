#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "kinegraph/scene/hand_fingers.h"
#include "kinegraph/simulation/physics.h"
#include "kinegraph/simulation/scene_bodies.h"
#include "kinegraph/simulation/simulation_data.h"

namespace kinegraph::inline simulation_internal {

/// One step of a joint in the model: one model joint, or none for MotionKind::time.
struct ModelStep {
  MotionKind kind;
  int qpos = -1, dof = -1;
};

/// A joint of the scene in the model. The model's coordinate is the motion scale * q, in the source's units for mimics.
struct ModelJoint {
  int frame = -1;
  int first_q = -1;  ///< index in the scene's q; -1 for inactive joints
  int dofs = 0;      ///< number of entries in q
  double scale = 1.;
  std::vector<ModelStep> steps;
};

/// A motorized dof of the model, or three for a ball joint.
struct Servo {
  int joint = 0;  ///< index in SceneModel::joints
  int qpos = 0, dof = 0;
  int q = -1;  ///< first of its entries in the scene's q; -1 for none
  MotionKind kind = MotionKind::rotate;
  double scale = 1.;
  double friction = 0.;                            ///< of the joint; the motor overcomes it, except in torque mode
  double effort, velocity;                         ///< limits of the motion, infinite without one
  std::optional<std::pair<double, double>> gains;  ///< stiffness and damping of the motion; they replace the servo's
};

/// A gripper joint with its followers.
struct GripperJoint {
  int joint = 0;
  int actuator = 0;
  int followers = 0;
  double coefficient = 1.;     ///< of each motion in the actuator's length
  std::vector<int> qpos, dof;  ///< of all joints, the gripper joint first
  std::vector<double> ratio;   ///< motion of each joint per motion of the gripper joint
  double lower = 0., upper = 0.;
  double stiffness = 0.;
  HandFingers opening;
};

/// Address of a sensor's values, in the frame's axes.
struct ModelSensor {
  int frame = 0;
  int address = 0;  ///< in mjData::sensordata
  int size = 0;
};

using PhysicsModel = std::unique_ptr<mjModel, decltype(&::mj_deleteModel)>;

/// A scene as a MuJoCo model, with the maps from its indices back to frames and joints.
struct SceneModel {
  PhysicsModel model{nullptr, nullptr};
  SceneBodies scene;
  std::vector<int> body_id;              ///< per body of the scene, the model's id
  std::vector<int> body_of_id;           ///< the inverse map
  std::vector<int> geom_frame;           ///< per geom, the frame's id; -1 for the ground
  std::vector<bool> geom_takes_largest;  ///< per geom: of two such geoms the larger friction counts
  std::vector<double> geom_restitution;  ///< per geom; in contacts the larger one counts
  std::vector<ModelJoint> joints;
  std::vector<int> free_frames;  ///< ids of the frames of free bodies
  std::vector<int> free_qpos, free_dof;
  struct Follower {
    int qpos, dof, source_qpos, source_dof;
    double ratio;  ///< motion per motion of the source
  };
  std::vector<Follower> followers;
  /// A spring of a joint without motor that is soft enough for an explicit step, which keeps its energy. MuJoCo's own
  /// implicit springs lose it.
  struct Spring {
    int qpos, dof;
    double stiffness, reference;
  };
  std::vector<Spring> springs;
  std::vector<Servo> servos;
  std::vector<GripperJoint> grippers;
  int first_weld = 0, welds = 0;  ///< equalities reserved for attach
  std::vector<ModelSensor> force_sensors, accelerometers;
  int dofs = 0;  ///< dimension of the scene's q
};

/// Parts of a model beyond the scene.
struct ModelExtras {
  std::set<int> forces, accelerations;  ///< ids of frames with these sensors
  bool can_change_frictions = false;    ///< of frames with the attribute `friction`: all their pairs are listed
};

/// Builds the model of a scene in its present state. Throws ValueError with the frame's name for unsupported scenes.
SceneModel makeSceneModel(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras = {});

/// Converts between the model's positions and a joint's entries of q.
void readJoint(const ModelJoint& joint, const mjtNum* qpos, double* q);
void writeJoint(const ModelJoint& joint, const double* q, mjtNum* qpos);

/// Converts between the model's velocities and a joint's entries of dq/dt.
void readJointVelocity(const ModelJoint& joint, const mjtNum* qpos, const mjtNum* qvel, double* velocity);
void writeJointVelocity(const ModelJoint& joint, const double* q, const double* velocity, mjtNum* qvel);

/// Reads or writes the pose of a free body.
Pose readFreePose(const mjtNum* qpos);
void writeFreePose(const Pose& pose, mjtNum* qpos);

}  // namespace kinegraph::inline simulation_internal
