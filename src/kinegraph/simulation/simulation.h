#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/simulation/simulation_data.h"

namespace kinegraph {

/// A point of a link that a spring moves to a target.
struct Perturbation {
  Vector3d position, target;  ///< world, m
  Vector3d force;             ///< of the last inner step, world, N
};

/// Simulates the dynamics of a configuration. It works directly on the Config: its joints and free bodies are updated
/// after every step. The same calls give the same numbers, bit for bit. Joints have motors; frames without a parent (or
/// with a rigid joint) that have a mass move freely; everything else is fixed. See docs/simulation.md.
///
/// Frames that are added to the Config later, or changed in structure, take part from the next call on. Poses and joint
/// values set there take effect with pushConfigToSim only.
class Simulation {
 public:
  /// Throws ValueError with the frame's name for scenes that cannot be simulated, for invalid options, and for the
  /// engine bullet. Throws FileError if MuJoCo is missing.
  explicit Simulation(Config& config, SimulationEngine engine = SimulationEngine::physx,
                      const SimulationOptions& options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // --- time --------------------------------------------------------------------------------------------------------

  /// Advances the simulation by `tau` seconds. `u` has an entry per dof of the Config's q (2n for positionVelocity,
  /// none for none and spline). Throws ValueError for a vector of wrong size or not finite, before any change. Throws
  /// DivergenceError if the simulation diverges, and restores the state before the call.
  void step(const VectorXd& u = {}, double tau = .01, ControlMode mode = ControlMode::none);

  /// The parts of `step`, for callers that lock the Config: `advance` does not touch it. `cancellation` is checked
  /// between inner steps and may throw, which restores the state before the call.
  void update();  ///< takes in new frames of the Config
  void renew();   ///< builds the model again from the Config, in the same state
  void advance(const VectorXd& u, double tau, ControlMode mode, const CancellationToken& cancellation = {});
  void publish();  ///< writes joints and free bodies to the Config

  double get_t() const;              ///< s
  void resetTime(double time = 0.);  ///< also calls resetSplineRef

  // --- state -----------------------------------------------------------------------------------------------------

  const Config& config() const;
  SimulationEngine engine() const;
  const SimulationOptions& options() const;
  VectorXd get_q() const;
  VectorXd get_qDot() const;
  void get_q(Eigen::Ref<VectorXd> q) const;  ///< writes into (n,); throws ValueError for another size
  void get_qDot(Eigen::Ref<VectorXd> velocity) const;
  std::vector<Frame> getFreeFrames() const;
  MatrixXd get_frameVelocities() const;  ///< of the free frames, F x 6: linear (m/s) and angular (rad/s), world
  VectorXd getReference() const;         ///< the q that the motors track

  SimulationState getState() const;

  /// Restores a state: subsequent steps repeat bit for bit. Changed fields are respected; poses and velocities follow
  /// from them. Throws ValueError for a state of another scene.
  void setState(const SimulationState& state);

  /// Sets poses and joints, and the motors' references, to those of the Config, at rest or with the given velocities (F
  /// x 6 as in get_frameVelocities; n). Throws ValueError for wrong sizes.
  void pushConfigToSim(const MatrixXd& frame_velocities = {}, const VectorXd& joint_velocities = {});

  // --- splines ---------------------------------------------------------------------------------------------------

  /// Sets the trajectory of ControlMode::spline: control points `path` (K x n) at `times` (K, s); a single time is the
  /// total duration. It is appended at the end of the present spline, at rest, or else blends smoothly from the present
  /// reference.
  void setSplineRef(const MatrixXd& path, const VectorXd& times, bool append = true);
  double getTimeToSplineEnd() const;            ///< s; negative after it
  void resetSplineRef(double ctrl_time = -1.);  ///< replaces the spline by the present q, at that time, or now

  /// Runs round(tau_step / tau_sim) steps in spline mode. `cancellation` as in advance: it undoes the interrupted step
  /// only.
  void multi_step(double tau_step, double tau_sim, const CancellationToken& cancellation = {});

  // --- grippers and attached objects ---------------------------------------------------------------------------------

  /// Moves the fingers below a frame's link to a width between them (m), each at `speed` (m/s) with at most 20 N.
  /// Returns at once; the following steps move them. Throws FrameNotFound, and ValueError for a frame without gripper.
  void moveGripper(const std::string& gripper, double width, double speed = .3);

  /// Closes to a width (m) with a force per finger (N), or until an object blocks the fingers.
  void closeGripper(const std::string& gripper, double width = 0., double speed = .3, double force = 20.);
  bool gripperIsDone(const std::string& gripper) const;      ///< at its target within .1 mm, or blocked
  double getGripperWidth(const std::string& gripper) const;  ///< between the fingers, m

  /// Fixes the link of frame `to` to that of `from` at their present relative pose. Throws FrameNotFound, and
  /// ValueError for more than 32 at once.
  void attach(const std::string& from, const std::string& to);
  void detach(const std::string& from, const std::string& to);  ///< throws ValueError if they are not attached

  // --- cameras ---------------------------------------------------------------------------------------------------

  /// Adds a named camera at a frame with camera attributes (see cameraOf), by default the frame of that name, and
  /// selects it. Throws FrameNotFound, and ValueError for invalid attributes.
  void addSensor(const std::string& name, const std::string& frame = {});
  void selectSensor(const std::string& name);  ///< throws NameError
  void setCamera(const std::string& frame);    ///< the same as addSensor(frame)
  Camera camera() const;                       ///< the selected one, or a default view of the scene

  /// Renders the image and depth of the selected camera, with stereo errors after setSimulateDepthNoise; the errors
  /// depend on the time only. Throws FileError if no renderer is available.
  CameraImage getImageAndDepth(const DepthNoise& noise = {});
  void setSimulateDepthNoise(bool noisy);

  // --- measuring -------------------------------------------------------------------------------------------------

  std::vector<Contact> getContacts() const;  ///< of the last inner step
  VectorXd getJointTorques() const;          ///< of the motors, n: N m or N
  VectorXd getExternalTorques() const;       ///< of contacts, limits, welds, forces and perturbations, n

  /// Adds a sensor between a frame and its link: it measures the force of everything below the frame.
  void addForceTorqueSensor(const std::string& frame);
  Vector6d getForceTorque(const std::string& frame) const;  ///< force (N) and torque (N m), in the frame's axes

  void addAccelerometer(const std::string& frame);
  Vector3d getAcceleration(const std::string& frame) const;  ///< including gravity, in the frame's axes, m/s^2

  /// Applies a constant force (N) and torque (N m), in world axes, to a frame's link until clearForces. `point` (world)
  /// is where the force acts, by default the frame's origin. Several calls add up.
  void applyForce(const std::string& frame, const Vector3d& force, const Vector3d& torque = Vector3d::Zero(),
                  const std::optional<Vector3d>& point = std::nullopt);
  void clearForces();

  /// Moves a point of a frame's link (in the frame's axes, m) to a target (world, m) by a damped spring until
  /// endPerturbation: f = m (w^2 (target - p) - 2 w dp/dt), with w = 10 rad/s. m is the mass of the link and all links
  /// below it, at most ten times the inertia that the point resists with. A target beyond .3 m pulls as from .3 m, and
  /// |f| is at most 60 m/s^2 m. At most one perturbation is active. Throws FrameNotFound, and ValueError for a frame
  /// fixed to the world.
  void perturb(const std::string& frame, const Vector3d& point, const Vector3d& target);
  void endPerturbation();
  std::optional<Perturbation> getPerturbation() const;

  // --- on the page -----------------------------------------------------------------------------------------------

  /// Shows the simulation live in the browser, from now on with each step: time, real-time factor, contacts and their
  /// forces. Users can pause it, step it, reset it to the state of this call, and perturb bodies with the mouse; `step`
  /// applies these requests first. Without requests, the simulation is unaffected. Returns the key pressed since the
  /// last call, or 0; with `pause`, waits for a key like Config::view.
  int view(bool pause = false, const std::string& message = {});

  /// Runs steps of `tau` s along the spline for the given duration (s). While a browser shows the simulation, it runs
  /// at `speed` times real time (<= 0: unlimited); otherwise as fast as possible. Ends early if a user presses q or
  /// Escape there. Returns the last key pressed there, or 0. `cancellation` as in advance; it counts only without a
  /// browser.
  int run(double seconds, double tau = .01, double speed = 1., const CancellationToken& cancellation = {});

  /// Sets the observer of all steps, or null.
  void setObserver(std::shared_ptr<SimulationObserver> observer);
  const std::shared_ptr<SimulationObserver>& observer() const;

  // --- recording -------------------------------------------------------------------------------------------------

  /// Starts to record all calls, so that the run can be repeated bit for bit.
  void startRecording();
  bool isRecording() const;

  /// Ends the recording and returns it. Throws ValueError without startRecording. Frames added during a recording end
  /// it: the part before is returned.
  Recording stopRecording();

  /// Returns the warnings since the last call.
  std::vector<std::string> takeWarnings();

  /// Like setState, without an update of the Config.
  void restore(const SimulationState& state);

  /// Creates a second simulation of the same model and Config at the same time. At most one of both may update the
  /// Config.
  struct SameModel {};
  Simulation(const Simulation& other, SameModel);

 private:
  friend class SimulationBatch;
  friend struct Recording;
  void show(const VectorXd& motions);  ///< sets the Config to recorded positions
  struct Impl;
  explicit Simulation(std::unique_ptr<Impl> impl);
  Held<std::unique_ptr<Impl>> impl_;
};

/// Steps many simulations of one scene in parallel threads. Environment i behaves like a Simulation with the same
/// calls, bit for bit, for any number of threads. The Config is copied: it is not changed, and later changes of it have
/// no effect.
class SimulationBatch {
 public:
  /// Throws the errors of Simulation, and ValueError for less than one environment or thread.
  SimulationBatch(const Config& config, int count, int threads = 1, SimulationEngine engine = SimulationEngine::physx,
                  const SimulationOptions& options = {});
  ~SimulationBatch();
  SimulationBatch(SimulationBatch&&) noexcept;
  SimulationBatch& operator=(SimulationBatch&&) noexcept;

  int size() const;
  int dofs() const;  ///< n, of q
  std::vector<std::string> freeFrames() const;

  /// Advances all environments by `repeat` steps of `tau` s; row i of `u` (size x n) controls environment i.
  /// `cancellation` is checked repeatedly on the calling thread and may throw. Throws ValueError for a matrix of wrong
  /// shape, before any change. An environment that diverges keeps its previous state; Error names it after all others
  /// have stepped.
  void step(const MatrixXd& u = {}, double tau = .01, ControlMode mode = ControlMode::none, int repeat = 1,
            const CancellationToken& cancellation = {});

  VectorXd times() const;           ///< s
  MatrixXd q() const;               ///< size x n
  MatrixXd qDot() const;            ///< size x n
  MatrixXd freePoses() const;       ///< size x 7F, concatenated free frames
  MatrixXd freeVelocities() const;  ///< size x 6F

  SimulationState getState(int environment) const;
  void setState(int environment, const SimulationState& state);

  /// Resets all environments, or some, to the initial Config. This and all calls below throw ValueError for unknown
  /// environments.
  void reset();
  void reset(const std::vector<int>& environments);

  /// Sets joints (a row of `q` each) and free frames (a row of `poses`, 7F; empty: unchanged) of all environments
  /// (std::nullopt), or of some, at rest.
  void place(std::nullopt_t all, const MatrixXd& q, const MatrixXd& poses = {});
  void place(const std::vector<int>& environments, const MatrixXd& q, const MatrixXd& poses = {});

  /// Like Simulation::closeGripper, with a width (m) per environment.
  void closeGrippers(const std::string& gripper, const VectorXd& widths, double speed = .3, double force = 20.);

  /// Sets the mass (kg, > 0) of a frame's free body or link per environment; its inertia scales with the mass.
  void setMasses(const std::string& frame, const VectorXd& masses);

  /// Sets the friction (>= 0) of the shape of a frame with the attribute `friction`, per environment.
  void setFrictions(const std::string& frame, const VectorXd& frictions);

 private:
  struct Impl;
  Held<std::unique_ptr<Impl>> impl_;
};

}  // namespace kinegraph
