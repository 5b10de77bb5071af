#pragma once

#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "kinegraph/simulation/physics.h"
#include "kinegraph/simulation/scene_bodies.h"
#include "kinegraph/simulation/simulation_options.h"

namespace kinegraph {

/// A step of a joint as the model has it: one of its joints, or none for MotionKind::time.
struct ModelStep {
  MotionKind kind;
  int qpos = -1, dof = -1;
};

/// A joint of the scene in the model. What the model counts is the motion: scale * q, in the source's units for mimics.
struct ModelJoint {
  int frame = -1;
  int first_q = -1;  ///< in the scene's q; -1 for inactive joints
  int dofs = 0;      ///< numbers of q
  double scale = 1.;
  std::vector<ModelStep> steps;
};

/// A dof of the model with a motor, or three for a ball.
struct Servo {
  int joint = 0;  ///< in SceneModel::joints
  int qpos = 0, dof = 0;
  int q = -1;  ///< first of its numbers in the scene's q, -1: none
  MotionKind kind = MotionKind::rotate;
  double scale = 1.;
  double effort, velocity;                         ///< limits of the motion, infinite where there is none
  std::optional<std::pair<double, double>> gains;  ///< stiffness and damping of the motion, instead of the servo's
};

/// A gripper joint with those that follow it.
struct GripperJoint {
  int joint = 0;
  int actuator = 0;
  int followers = 0;
  double coefficient = 1.;     ///< of the motion in the actuator's length, each
  std::vector<int> qpos, dof;  ///< of all of them, itself first
  std::vector<double> ratio;   ///< of their motions to its own
  double lower = 0., upper = 0.;
  double stiffness = 0.;
};

/// What is read from a sensor of a frame: numbers in the frame's axes.
struct ModelSensor {
  int frame = 0;
  int address = 0;  ///< in the data's sensordata
  int size = 0;
};

using PhysicsModel = std::unique_ptr<mjModel, decltype(&::mj_deleteModel)>;

/// A scene as a model of MuJoCo, with the way back from its numbers to frames and joints.
struct SceneModel {
  PhysicsModel model{nullptr, nullptr};
  SceneBodies scene;
  std::vector<int> body_id;     ///< per body of the scene: the model's
  std::vector<int> body_of_id;  ///< and back
  std::vector<int> geom_frame;  ///< per geom: the frame's id; -1 for the ground
  std::vector<ModelJoint> joints;
  std::vector<int> free_frames;  ///< ids of the frames of free bodies
  std::vector<int> free_qpos, free_dof;
  struct Follower {
    int qpos, dof, source_qpos, source_dof;
    double ratio;  ///< its motion per that of the source
  };
  std::vector<Follower> followers;
  std::vector<Servo> drives;
  std::vector<GripperJoint> grippers;
  int first_weld = 0, welds = 0;  ///< equalities kept for attach
  std::vector<ModelSensor> force_sensors, accelerometers;
  int dofs = 0;  ///< of the scene's q
};

/// What a model has beyond the scene.
struct ModelExtras {
  std::set<int> forces, accelerations;  ///< ids of frames where these are measured
  bool can_change_frictions = false;    ///< of frames with the attribute `friction`: all their pairs are listed
};

/// Makes the model of a scene at its present state. Throws ValueError for what cannot be simulated, with the frame.
SceneModel makeSceneModel(SceneTree& scene, const SimulationOptions& options, const ModelExtras& extras = {});

/// The numbers of q of a joint from the model's positions, or the other way round.
void readJoint(const ModelJoint& joint, const mjtNum* qpos, double* q);
void writeJoint(const ModelJoint& joint, const double* q, mjtNum* qpos);

/// dq/dt of a joint from the model's velocities, or the other way round.
void readJointVelocity(const ModelJoint& joint, const mjtNum* qpos, const mjtNum* qvel, double* velocity);
void writeJointVelocity(const ModelJoint& joint, const double* q, const double* velocity, mjtNum* qvel);

/// Pose and velocity (linear, angular, world) of a free body.
Pose readFreePose(const mjtNum* qpos);
void writeFreePose(const Pose& pose, mjtNum* qpos);

}  // namespace kinegraph
