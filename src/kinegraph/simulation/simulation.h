#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/depth_image.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/simulation/contact.h"
#include "kinegraph/simulation/recording.h"
#include "kinegraph/simulation/simulation_options.h"
#include "kinegraph/simulation/simulation_state.h"
#include "kinegraph/simulation/simulation_watcher.h"

namespace kinegraph {

/// A point of a frame's link that is pulled.
struct Perturbation {
  Vector3d position, target;  ///< world, m
  Vector3d force;             ///< of the last inner step, world, N
};

/// A configuration in time. It works directly on the Config: joints and free bodies there follow every step. Same calls, same
/// numbers, bit for bit. What the scene has decides what moves, see docs/simulation.md: joints have motors, frames without
/// parent (or with a rigid joint) that have a mass move freely, all else stays.
///
/// Frames that are added to the Config later, or changed in structure, take part from the next call on. Poses and joints that
/// are set there do not, before pushConfigToSim.
class Simulation {
 public:
  /// Throws ValueError, which names the frame, for what cannot be simulated, for options that make no sense and for the engine
  /// bullet; FileError if MuJoCo is missing.
  explicit Simulation(const Config& config, SimulationEngine engine = SimulationEngine::physx,
                      const SimulationOptions& options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // --- time --------------------------------------------------------------------------------------------------------

  /// Goes on by `tau` s. `u` has an entry per dof of the Config's q (2n for positionVelocity, none for none and spline).
  /// Throws ValueError for a vector that does not fit, or is not finite: nothing has changed then. Throws Error if numbers
  /// leave all bounds; the state is that before the call.
  void step(const VectorXd& u = {}, double tau = .01, ControlMode mode = ControlMode::none);

  /// The same in three parts, for those who hold a lock on the Config: the second does not touch it. `cancellation`, where
  /// given, is called between inner steps and may throw to stop: the state is then that before the call.
  void update();  ///< takes in frames that are new in the Config
  void advance(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation = {});
  void publish();  ///< sets joints and free bodies in the Config

  double get_t() const;              ///< s
  void resetTime(double time = 0.);  ///< and resetSplineRef

  // --- what is ---------------------------------------------------------------------------------------------------

  const Config& config() const;
  SimulationEngine engine() const;
  const SimulationOptions& options() const;
  VectorXd get_q() const;
  VectorXd get_qDot() const;
  std::vector<Frame> getFreeFrames() const;
  MatrixXd get_frameVelocities() const;  ///< of the free frames, F x 6: linear (m/s) and angular (rad/s), world
  VectorXd getReference() const;         ///< the q that motors want to have

  SimulationState getState() const;

  /// Restores it: what follows is the same, bit for bit. Fields that were changed count; then velocities and poses are those.
  /// Throws ValueError for the state of another scene.
  void setState(const SimulationState& state);

  /// Everything goes to where it is in the Config, at rest or with these velocities (F x 6 as get_frameVelocities; n).
  /// References are there, too. Throws ValueError for wrong sizes.
  void pushConfigToSim(const MatrixXd& frame_velocities = {}, const VectorXd& joint_velocities = {});

  // --- splines ---------------------------------------------------------------------------------------------------

  /// A motion for ControlMode::spline through control points `path` (K x n) at `times` (K, s), or one number, the time of all,
  /// in equal parts. Appended at the end of the present one, at rest; else from the present reference on, smoothly.
  void setSplineRef(const MatrixXd& path, const VectorXd& times, bool append = true);
  double getTimeToSplineEnd() const;            ///< s; negative after it
  void resetSplineRef(double ctrl_time = -1.);  ///< a spline that stays at the present q; from that time on, or now

  /// round(tau_step / tau_sim) steps in spline mode; `cancellation`, where given, as in advance, which undoes one of them.
  void multi_step(double tau_step, double tau_sim, const CancellationToken& cancellation = {});

  // --- grippers and things that are attached -------------------------------------------------------------------------

  /// Opens or closes the fingers below a frame's link to a width between them (m), each at `speed` (m/s) with at most 20 N.
  /// Returns at once; the following steps move them. Throws FrameNotFound, and ValueError for a frame without gripper.
  void moveGripper(const std::string& gripper, double width, double speed = .3);

  /// Closes to a width (m) with a force per finger (N), or until something is in between.
  void closeGripper(const std::string& gripper, double width = 0., double speed = .3, double force = 20.);
  bool gripperIsDone(const std::string& gripper) const;      ///< at its target, to .1 mm, or stopped by something
  double getGripperWidth(const std::string& gripper) const;  ///< m between the fingers

  /// Holds the link of frame `to` to that of `from` as they are. Throws FrameNotFound, and ValueError for more than 32.
  void attach(const std::string& from, const std::string& to);
  void detach(const std::string& from, const std::string& to);  ///< throws ValueError if they are not attached

  // --- cameras ---------------------------------------------------------------------------------------------------

  /// A camera under a name, at a frame whose attributes say what it is like (see cameraOf); without one, at the frame of that
  /// name. It is selected. Throws FrameNotFound, and ValueError for attributes that no camera can have.
  void addSensor(const std::string& name, const std::string& frame = {});
  void selectSensor(const std::string& name);  ///< throws NameError
  void setCamera(const std::string& frame);    ///< the same as addSensor(frame)
  Camera camera() const;                       ///< the selected one, or one that overlooks the scene

  /// What the selected camera sees: colors and depth; with errors of a stereo camera after setSimulateDepthNoise, the same at
  /// the same time. Throws FileError where nothing can be drawn.
  CameraImage getImageAndDepth(const DepthNoise& noise = {});
  void setSimulateDepthNoise(bool noisy);

  // --- measuring -------------------------------------------------------------------------------------------------

  std::vector<Contact> getContacts() const;  ///< of the last inner step
  VectorXd getJointTorques() const;          ///< of the motors, n: N m or N
  VectorXd getExternalTorques() const;       ///< what contacts, limits, welds and perturbations add, n

  /// A sensor where a frame is fixed to its link: what is below the frame pulls at it.
  void addForceTorqueSensor(const std::string& frame);
  Vector6d getForceTorque(const std::string& frame) const;  ///< force (N) and torque (N m), in the frame's axes

  void addAccelerometer(const std::string& frame);
  Vector3d getAcceleration(const std::string& frame) const;  ///< with gravity, in the frame's axes, m/s^2

  /// A force (N) and a torque (N m) on a frame's link, world, at a point (world; else the frame's origin), that lasts until
  /// clearPerturbations. Several add up.
  void perturb(const std::string& frame, const Vector3d& force, const Vector3d& torque = Vector3d::Zero(),
               const std::optional<Vector3d>& point = std::nullopt);
  void clearPerturbations();

  /// Pulls a point (in the frame's axes, m) to a place (world, m) by a damped spring, as a hand would, until endPerturbation:
  /// f = m (w^2 (target - p) - 2 w dp/dt) with w = 10 rad/s and m the mass of the frame's link with all that hangs on its
  /// joints. One point at a time. Throws FrameNotFound, and ValueError for what is fixed to the world.
  void pull(const std::string& frame, const Vector3d& point, const Vector3d& target);
  void endPerturbation();
  std::optional<Perturbation> getPerturbation() const;

  // --- on the page -----------------------------------------------------------------------------------------------

  /// Shows it live in the browser, from now on with each step: also time, real-time factor, contacts and their forces. There
  /// people pause it, let it go on by one step, reset it to where it was at this call, and pull bodies with the mouse; `step`
  /// does what they ask before it steps. Who asks for nothing changes nothing. Returns the key pressed since the last call, or
  /// 0; with `pause`, waits for one as Config::view.
  int view(bool pause = false, const std::string& message = {});

  /// Steps of `tau` s along the spline for so many seconds: as fast as it can be computed or, while a browser shows it, as fast
  /// as the clock on the wall times `speed` (<= 0: as fast as possible). Ends early if somebody presses q or Escape there.
  /// Returns the last key pressed there, or 0. `cancellation`, where given and nothing is shown, as in advance.
  int run(double seconds, double tau = .01, double speed = 1., const CancellationToken& cancellation = {});

  /// Who looks on, or null.
  void setWatcher(std::shared_ptr<SimulationWatcher> watcher);
  const std::shared_ptr<SimulationWatcher>& watcher() const;

  // --- recording -------------------------------------------------------------------------------------------------

  /// From now on everything that is asked of the simulation is kept, so that it can be repeated bit for bit.
  void startRecording();
  bool isRecording() const;

  /// Throws ValueError without startRecording. Frames that are added meanwhile end a recording: what was before is returned.
  Recording stopRecording();

  /// What was odd but not wrong since the last call.
  std::vector<std::string> takeWarnings();

  /// setState without the Config, which stays as it is.
  void restore(const SimulationState& state);

  /// Another one at the same time, of the same model and the same Config, which only one of them should follow.
  struct SameModel {};
  Simulation(const Simulation& other, SameModel);

 private:
  friend class SimulationBatch;
  friend struct Recording;
  void show(const VectorXd& motions);  ///< sets the Config to where a recording was
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace kinegraph
