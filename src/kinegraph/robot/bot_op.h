#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <thread>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/robot/command_log.h"

namespace kinegraph::inline api_internal {
class BotCameras;
}

namespace kinegraph::inline robot_internal {
struct SceneGripper;
class RobotLoop;
}

namespace kinegraph {

struct CameraImage;
class BotOp;
class ToolPath;
class ToolPathPlan;
struct ToolPathOptions;
struct ToolWaypoint;

/// Settings of a BotOp.
struct BotOpOptions {
  double period = .01;      ///< control period, s
  bool realtime = false;    ///< a thread moves the robot in wall-clock time
  double hyper_speed = 1.;  ///< control time per wall-clock time, with `realtime` or while a viewer is open
  SafetyLimits safety;

  /// Shows a scene in the state of robot and world; returns the key pressed since the last call, or 0.
  std::function<int(const BotOp&, Config&, const std::string& message)> show;
  std::function<bool()> watched;   ///< tells whether a viewer is open
  CancellationToken cancellation;  ///< called while a call waits; an exception of it ends the call

  /// Called before each period by the thread of `realtime`; true holds the robot, even while no call waits.
  std::function<bool()> interrupted;
};

/// Options of BotOp::follow.
struct FollowOptions {
  double tolerance = 1e-3;           ///< rad or m: largest distance of a joint from the trajectory's start
  double velocity_tolerance = 1e-2;  ///< rad/s or m/s: largest difference from the trajectory's velocity at its start
  bool overwrite = false;            ///< replace the present motion, instead of following it
  double start_time = -1.;           ///< control time of t = 0 with `overwrite`, s; negative: now

  void validate() const;  ///< throws ValueError
};

/// State and reference of a robot at one time, for `stepAction`.
struct StepObservation {
  double ctrl_time = 0.;    ///< control time, s
  VectorXd qpos, qvel;      ///< state of the robot, (n,) each
  VectorXd qref, qvel_ref;  ///< those of the last command, (n,) each
};

/// Moves a simulated or real robot along motions, operates its grippers, and shows both.
///
/// Time is *virtual* unless the robot is real or `realtime` is set. It advances in calls that wait (`sync`, `wait`,
/// `home`, `stop`), by exactly their duration, as fast as the computation allows, or at the pace of the wall clock
/// while a viewer is open. A repeated query at the same time advances the clock by one control period, so that polling
/// loops terminate. The same calls give the same motion, to the bit.
///
/// A Config argument belongs to the caller. A call sets it to the state of robot and world, and copies its new frames
/// into the simulated world; its q is never read.
///
/// Calls throw ValueError for invalid arguments and for motions beyond the robot's limits, and RobotFault if the robot
/// was stopped. If `cancellation` throws, as for Ctrl-C in Python, the robot is held first.
class BotOp {
 public:
  /// Simulates a robot in a copy of `config`, shown by its viewer. Throws ValueError for `use_real_robot`, which
  /// requires a driver.
  explicit BotOp(Config& config, bool use_real_robot = false);

  /// Moves a robot through its driver. Its joints are those of `config`, in that order.
  BotOp(const Config& config, std::shared_ptr<RobotDriver> driver, BotOpOptions options = {});
  ~BotOp();
  BotOp(const BotOp&) = delete;

  // --- state
  // -----------------------------------------------------------------------------------------------------------

  double get_t();              ///< control time, s
  VectorXd get_q();            ///< (n,)
  VectorXd get_qDot();         ///< (n,)
  VectorXd get_qHome() const;  ///< q of the configuration passed to the constructor
  VectorXd get_tauExternal();  ///< (n,) N m or N; mean since the last call. NaN if the robot does not measure it
  double getTimeToEnd();       ///< s until the motion ends; 0 or less if it has ended, or if there is none
  int getKeyPressed() const { return key_; }  ///< key of the last sync
  const RobotInfo& getInfo() const;
  LoopMode getMode() const;
  std::string getFault() const;  ///< cause of the fault; empty without one
  /// Returns and clears the warnings so far, joined by "; ": of a lag, without SafetyLimits::lag_stops, and of calls of
  /// grippers.
  std::string takeWarning();

  // --- motions
  // ---------------------------------------------------------------------------------------------------------

  /// Moves to q, after the present motion, or instead of it with `overwrite` (from the robot's q, if it is blocked).
  /// The duration is T = (sqrt(6 c d + v^2) - v) / c for the distance d, the velocity v towards q, and the time cost c;
  /// at least .1 s, and longer if the limits require it.
  void moveTo(const VectorXd& q, double time_cost = 1., bool overwrite = false);

  /// Moves along a spline of degree 3 with these control points (K x n) at these times (K,) after the end of the
  /// present motion. The motion comes near the inner points and ends at the last. A single time is that of the last
  /// point; the others share it evenly. With `overwrite`, the present motion ends at `overwrite_time`, or now if that
  /// is negative, and times count from there. If `overwrite_time` lies ahead, the new motion starts there with the
  /// present velocity; if it has passed, the new motion starts at the point that it would have reached by now.
  void move(const MatrixXd& path, const VectorXd& times, bool overwrite = false, double overwrite_time = -1.);

  /// Moves along the lines between the points, with corners that are rounded by .01 rad or m at most, in the shortest
  /// time within max_velocity, max_acceleration, and the joints' limits (`retime`). Starts after the present motion,
  /// and rests at the end.
  void moveAutoTimed(const MatrixXd& path, double max_velocity = 1., double max_acceleration = 1.);

  /// Executes a trajectory as it is: the reference of each control period is trajectory.eval(t), with velocity and
  /// acceleration. t = 0 is the end of the present motion, or now, or a later control time with `overwrite`. The robot
  /// rests at the end; a trajectory that ends with a velocity is followed by a stopping segment. The trajectory is
  /// evaluated in this call, and not needed later.
  ///
  /// Throws ValueError if the robot or its reference is not at the trajectory's start, within the tolerances, and if
  /// the trajectory exceeds a limit of position, velocity, acceleration or effort.
  void follow(const Trajectory& trajectory, const FollowOptions& options = {});

  /// Moves a frame, the tool, straight to a pose in the world, or to a position with its present rotation: planToolPath
  /// from the end of the present motion, then follow. With `overwrite`, the robot brakes first, and the line begins
  /// where it comes to rest.
  ///
  /// Limits of the robot count in addition to those of `options`, whose `start` and `transfer_from` are those of the
  /// robot. Without a motion, the robot gets no command beyond the braking, and the plan has status, place and message.
  /// Throws as planToolPath and follow do, and RobotFault if the robot was stopped.
  ToolPathPlan moveLinear(const std::string& frame, const ToolWaypoint& target, const ToolPathOptions& options,
                          bool overwrite = false);

  /// The same along a circular arc through `via` (m) to a pose.
  ToolPathPlan moveCircular(const std::string& frame, const Vector3d& via, const ToolWaypoint& target,
                            const ToolPathOptions& options, bool overwrite = false);

  /// The same along straight lines through several poses, with corners blended within a radius (m); 0 stops there.
  ToolPathPlan moveSequence(const std::string& frame, const std::vector<ToolWaypoint>& targets, double blend,
                            const ToolPathOptions& options, bool overwrite = false);

  /// The same along any path. If it has a start of its own, a collision-free motion leads there first.
  ToolPathPlan moveSequence(const ToolPath& path, const ToolPathOptions& options, bool overwrite = false);

  void hold();                         ///< stops at once, and stays there, at full stiffness
  void floating(double damping = 0.);  ///< sets the stiffness to zero; damping is a share of the robot's, 0 .. 1

  /// Makes the robot compliant in the directions of the rows of J (k x n), which must be linearly independent.
  /// `compliance` is 0 (stiff) .. 1 (no stiffness).
  void setCompliance(const MatrixXd& J, double compliance = .5);

  StepObservation stepObservation();

  /// Accelerates by (delta - 2 xi lambda qvel) / lambda^2 for lambda s, from the reference of the observation; the
  /// acceleration is scaled down to max_acceleration. Comes to rest in the next lambda s unless another step follows.
  void stepAction(const VectorXd& delta, const StepObservation& observation, double lambda,
                  double max_acceleration = 5., double xi = 1.);

  void home(Config& C);  ///< moves to qHome, and waits
  void stop(Config& C);  ///< holds, and waits until the robot rests
  void recover();        ///< clears a fault, and holds the robot at its present q

  /// Replaces limits of the robot; (n,) or one number for all joints, empty to keep them. Throws ValueError if one is
  /// not positive.
  void setLimits(const VectorXd& velocity, const VectorXd& acceleration, const VectorXd& effort);

  // --- time
  // ------------------------------------------------------------------------------------------------------------

  /// Advances time by `wait_time` s, sets C to the state of robot and world, and shows it. Returns the key pressed
  /// since the last call, or 0; in real time a key ends the wait.
  int sync(Config& C, double wait_time = .1, const std::string& message = {});

  /// Calls `function` with the control time (s) now and every `period` s of control time. The calls come from those
  /// that wait (`sync`, `wait`, `home`, `stop`, repeated queries, the execution of plans), in their thread. The first
  /// one comes with the next wait. It ends when the function returns false, or with an exception, which also holds the
  /// robot and is passed on. The state does not change during a call: queries do not advance the clock, and waiting
  /// is refused; motions, `hold` and grippers may be commanded. A call comes at the first control period that is not
  /// before its time. In real time a late call is skipped. `period` = 0: every control period. Throws ValueError.
  void watch(double period, std::function<bool(double)> function);

  /// Syncs until a key is pressed, the motion ends, or all grippers are done, as selected. Returns the key, 'g' for
  /// grippers, else 0. Without a viewer it does not wait for keys alone.
  int wait(Config& C, bool for_key = true, bool for_end = true, bool for_gripper = false, double sync_period = .05);

  // --- grippers
  // --------------------------------------------------------------------------------------------------------

  /// Moves the fingers to a width (m). A width beyond the gripper's opening is moved to the nearest one, and is told by
  /// `takeWarning`.
  void gripperMove(int gripper, double width = .075, double speed = .2);
  /// Closes until an object stops the fingers, and holds it.
  void gripperClose(int gripper, double force = 10., double width = .05, double speed = .1);
  /// Closes on a named object. One that is far from the gripper is told by `takeWarning`. Throws FrameNotFound.
  void gripperCloseGrasp(int gripper, const std::string& object, double force = 10., double width = .05,
                         double speed = .1);
  double getGripperPos(int gripper);  ///< width of the opening, m
  bool gripperDone(int gripper);

  /// Returns the width of the last command, m: the smallest one after a command to close, and the width at the
  /// construction before any command.
  double getGripperTarget(int gripper) const;

  // --- the simulated world
  // ---------------------------------------------------------------------------------------------

  void attach(const std::string& from, const std::string& to);
  void detach(const std::string& from, const std::string& to);
  /// Sets the pose of an object. Throws FrameNotFound, and ValueError for a joint of the robot or a frame that is fixed
  /// to one.
  void setFramePose(const std::string& frame, const Pose& pose);

  bool isSimulated() const;  ///< the robot moves in a simulated world

  /// Returns a copy of the simulated world in its present state. For a robot without one: the scene that was passed to
  /// the constructor, and the frames of later syncs, with the robot's q and the openings of its grippers.
  Config getWorld() const;

  /// Returns the present contacts in the simulated world; none without forces, and for a real robot.
  std::vector<Contact> getContacts() const;

  /// Sets `config`, which has frames of the same names, to the present state of robot and world. Without a simulated
  /// world these are q and the openings of grippers.
  void update(Config& config) const;

  /// Renders the view of a camera, given by its frame's name; see CameraRenderer::render. Throws FrameNotFound,
  /// ValueError.
  CameraImage getImageAndDepth(const std::string& camera);
  Vector4d getCameraFxycxy(const std::string& camera);  ///< fx, fy, cx, cy in pixels

  /// Renders image and depth, and computes the points of the depth image (height x width x 3), in the axes of the
  /// camera or of the world.
  std::pair<CameraImage, std::vector<double>> getImageDepthPcl(const std::string& camera,
                                                               bool global_coordinates = false);

  // --- records
  // ---------------------------------------------------------------------------------------------------------

  CommandLog getLog() const;  ///< all commands so far

  /// Executes a log on a robot without commands so far. Throws ValueError otherwise, and if the log has another period.
  void replay(const CommandLog& log);

  /// Writes a line per control period into a file from now on: t, q, velocity, and the references of both. An empty
  /// path ends it. Throws FileError.
  void recordTo(const std::string& path);

 private:
  enum Query : int {
    queryTime,
    queryQ,
    queryVelocity,
    queryExternal,
    queryEnd,
    queryGripper,
    queryDone,
    queryObservation,
    queryCount
  };
  using Clock = std::chrono::steady_clock;
  using Lock = std::unique_lock<std::mutex>;

  struct Watch {
    double begin = 0., period = 0.;  ///< s
    long count = 0;                  ///< the number of the next call
    std::function<bool(double)> function;
  };

  void countQuery(Query query);
  void callWatches();
  double nextWatch() const;
  void moveFingers(Config& config) const;
  void stepOnce(const Lock& lock);
  void advance(double seconds, bool keys_end_it);
  void advanceVirtually(double seconds);
  void waitRealtime(double seconds, bool keys_end_it);
  void pace();
  void checkCancellation();
  void runThread(const std::stop_token& stop);
  void requireRunning(const char* call) const;
  int show(Config& C, const std::string& message);
  void addNewFrames(const Config& C);
  bool isWatched() const { return options_.watched && options_.watched(); }

  FollowSpline continuation(const MatrixXd& path, const VectorXd& times, bool overwrite, double cut) const;
  void start(const char* call, const FollowSpline& motion, double from);
  void start(const char* call, const Trajectory& trajectory, const FollowOptions& options, double begin);
  void requireStart(const char* call, const Trajectory& trajectory, const FollowOptions& options, double begin) const;
  double nextStart() const;
  ToolPathPlan moveAlong(const char* call, const ToolPath& path, ToolPathOptions options, bool overwrite);
  void holdNow();
  void holdIfBlocked();
  double trackingError() const;
  void gripper(const char* call, GripperCommand command);
  void requireGripper(const char* call, int gripper) const;
  BotCameras& cameras();
  double timeToEnd() const;

  BotOpOptions options_;
  Config model_;  ///< for efforts
  Config scene_;  ///< of a robot without a simulated world
  VectorXd home_;
  std::unique_ptr<RobotLoop> loop_;
  mutable std::mutex mutex_;                 ///< guards the loop
  std::array<long, queryCount> last_query_;  ///< the control period of each query
  double pending_time_ = 0.;                 ///< virtual time that is less than a period, s
  int key_ = 0;
  std::uint64_t seen_structure_ = 0;  ///< structure revision of the configuration of the last sync
  VectorXd external_sum_;
  long external_count_ = 0;
  std::unique_ptr<std::ofstream> record_;
  std::shared_ptr<BotCameras> cameras_;  ///< created by the first image
  std::vector<std::shared_ptr<Watch>> watches_;
  std::vector<double> gripper_targets_;    ///< m
  std::vector<std::string> placed_;        ///< frames of setFramePose
  std::atomic<std::thread::id> watching_;  ///< the thread that calls a function of `watch`
  std::vector<SceneGripper> fingers_;      ///< of the robot's grippers, without a simulated world
  Clock::time_point started_ = Clock::now(), next_ = started_, checked_ = started_;
  std::jthread thread_;  ///< the last member, so that it ends first
};

}  // namespace kinegraph
