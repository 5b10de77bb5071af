#pragma once

#include <array>
#include <chrono>
#include <functional>
#include <iosfwd>
#include <mutex>
#include <thread>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/robot/robot_loop.h"

namespace kinegraph {

struct CameraImage;
class BotCameras;
class BotOp;

/// Settings of a BotOp.
struct BotOpOptions {
  double period = .01;      ///< of control, s
  bool realtime = false;    ///< a thread moves the robot by the clock on the wall; of a robot that is there, always
  double hyper_speed = 1.;  ///< seconds of control per second on the wall, where these have to do with each other
  GuardLimits guards;

  /// Shows a scene, which is where robot and world are; returns the key pressed since the last time, or 0.
  std::function<int(const BotOp&, Config&, const std::string& message)> show;
  std::function<bool()> watched;   ///< does somebody look at what is shown?
  CancellationToken cancellation;  ///< called now and then while a call waits; what it throws ends the call

  /// Where time is real, asked before each period, by the thread that moves the robot: true holds the robot, whatever
  /// the rest of the program does meanwhile.
  std::function<bool()> interrupted;
};

/// What a robot says and was told at one time, for `stepAction`.
struct StepObservation {
  double ctrl_time = 0.;    ///< s
  VectorXd qpos, qvel;      ///< as read
  VectorXd qref, qvel_ref;  ///< as told
};

/// Moves a robot, simulated or there, along motions; opens and closes its grippers; shows how it goes.
///
/// Time is *virtual* unless a robot is there or `realtime` is set: it goes on in calls that wait (`sync`, `wait`, `home`,
/// `stop`) by exactly what they say, as fast as it can be computed, or as fast as time on the wall while somebody watches.
/// Whoever asks the same question again at the same time is answered one period later, so that loops that ask until a
/// motion is over come to an end. The same calls give the same motion, to the bit.
///
/// A Config that is given to a call is the user's: it is set to where robot and world are, and never looked at for where
/// they should be; but what it has that the simulated world has not, is added there.
///
/// Calls throw ValueError for arguments that make no sense and for motions beyond limits of the robot, and RobotFault if
/// it was stopped. Where `cancellation` throws, as Ctrl-C does in Python, the robot is held first.
class BotOp {
 public:
  /// A simulated robot in a copy of `config`, shown by its viewer; `use_real_robot` is refused, as that takes a driver.
  explicit BotOp(Config& config, bool use_real_robot = false);

  /// A robot behind a driver. Its joints are those of `config`, in that order.
  BotOp(const Config& config, std::shared_ptr<RobotDriver> driver, BotOpOptions options = {});
  ~BotOp();
  BotOp(const BotOp&) = delete;

  // --- state -----------------------------------------------------------------------------------------------------------

  double get_t();              ///< control time, s
  VectorXd get_q();            ///< (n,)
  VectorXd get_qDot();         ///< (n,)
  VectorXd get_qHome() const;  ///< q of the configuration that it was made from
  VectorXd get_tauExternal();  ///< (n,) N m or N; mean since the last call. NaN if the robot does not know
  double getTimeToEnd();       ///< s until the motion ends; not positive: it has, or there is none
  int getKeyPressed() const { return key_; }  ///< the one of the last sync
  const RobotInfo& getInfo() const { return loop_->info(); }
  LoopMode getMode() const;
  std::string getFault() const;  ///< why it was stopped; empty if it was not

  // --- motions ---------------------------------------------------------------------------------------------------------

  /// Goes to q, after what it does now, or instead with `overwrite` (from where it is, if something holds it back). It
  /// takes T = (sqrt(6 c d + v^2) - v) / c of the distance d, the velocity v towards it and the cost of time c; at least
  /// .1 s and as long as limits ask for.
  void moveTo(const VectorXd& q, double time_cost = 1., bool overwrite = false);

  /// Goes along a spline of degree 3 of these points (K x n), which it comes near and ends at, at these times (K,) after
  /// the end of what it does now; a single time is that of the last point, the others share it evenly. With `overwrite`,
  /// what it does ends at `overwrite_time`, or now if that is negative, and times count from there. Until a time to come
  /// it goes on with what it does, and then with the velocity that it has there. From a time that is over, it takes up
  /// the motion where that would be now.
  void move(const MatrixXd& path, const VectorXd& times, bool overwrite = false, double overwrite_time = -1.);

  /// The same with the shortest time for which no joint is faster than max_velocity and max_acceleration, nor than its
  /// limits.
  void moveAutoTimed(const MatrixXd& path, double max_velocity = 1., double max_acceleration = 1.);

  /// Follows any motion, in control time. It must begin where the robot is.
  void follow(const BSpline& motion);

  void hold();                         ///< comes to rest at once and stays, stiff
  void floating(double damping = 0.);  ///< no stiffness; damping 0 .. 1 of the robot's

  /// Gives way in the directions of the rows of J (k x n), which must be independent: by `compliance` 0 (not) .. 1 (fully).
  void setCompliance(const MatrixXd& J, double compliance = .5);

  StepObservation stepObservation();

  /// Accelerates constantly for lambda s from the observation's reference, with (delta - 2 xi lambda qvel) / lambda^2,
  /// scaled down to max_acceleration; comes to rest in the next lambda s unless another step follows.
  void stepAction(const VectorXd& delta, const StepObservation& observation, double lambda,
                  double max_acceleration = 5., double xi = 1.);

  void home(Config& C);  ///< moves to qHome, waits
  void stop(Config& C);  ///< holds, waits until it is at rest
  void recover();        ///< after a fault: clears it, holds where it is

  /// Limits in place of the robot's own, (n,) or one number for all; empty: as they are. Throws ValueError if negative.
  void setLimits(const VectorXd& velocity, const VectorXd& acceleration, const VectorXd& effort);

  // --- time ------------------------------------------------------------------------------------------------------------

  /// Time goes on by `wait_time` s; then C is where robot and world are, and is shown. Returns the key pressed since the
  /// last time, or 0; where time is real, a key ends the waiting.
  int sync(Config& C, double wait_time = .1, const std::string& message = {});

  /// Syncs until a key is pressed, the motion is over, or grippers are done; whichever are asked for. Returns the key, 'g'
  /// for grippers, else 0. For keys alone it does not wait if nobody watches.
  int wait(Config& C, bool for_key = true, bool for_end = true, bool for_gripper = false, double sync_period = .05);

  // --- grippers --------------------------------------------------------------------------------------------------------

  void gripperMove(int gripper, double width = .075, double speed = .2);
  /// Closes until something is between the fingers, and holds it.
  void gripperClose(int gripper, double force = 10., double width = .05, double speed = .1);
  void gripperCloseGrasp(int gripper, const std::string& object, double force = 10., double width = .05,
                         double speed = .1);
  double getGripperPos(int gripper);  ///< the opening, m
  bool gripperDone(int gripper);

  // --- the simulated world ---------------------------------------------------------------------------------------------

  void attach(const std::string& from, const std::string& to);
  void detach(const std::string& from, const std::string& to);
  void setFramePose(const std::string& frame, const Pose& pose);

  Config getWorld() const;  ///< a copy of the simulated world as it is now

  /// What touches in the simulated world now; nothing without forces, and of a robot that is there.
  std::vector<Contact> getContacts() const;

  /// Brings `config`, a copy of an earlier time or another configuration, to the present.
  void update(Config& config) const;

  /// What a camera of the world sees, by the name of its frame; see CameraRenderer::render. Throws FrameNotFound, ValueError.
  CameraImage getImageAndDepth(const std::string& camera);
  Vector4d getCameraFxycxy(const std::string& camera);  ///< fx, fy, cx, cy in pixels

  /// Image, depth, and the points of the depth image (height x width x 3), in the camera's axes or in those of the world.
  std::pair<CameraImage, std::vector<double>> getImageDepthPcl(const std::string& camera,
                                                               bool global_coordinates = false);

  // --- records ---------------------------------------------------------------------------------------------------------

  CommandLog getLog() const;  ///< all that the robot was told so far

  /// Does again what a log says, on a robot that was not told anything yet. Throws ValueError otherwise, and for a log of
  /// another period.
  void replay(const CommandLog& log);

  /// Writes a row for each period into a file from now on: t, q, velocity, reference. None if the path is empty. Throws
  /// FileError.
  void recordTo(const std::string& path);

 private:
  enum Question : int {
    askTime,
    askQ,
    askVelocity,
    askExternal,
    askEnd,
    askGripper,
    askDone,
    askObservation,
    askCount
  };
  using Clock = std::chrono::steady_clock;
  using Lock = std::unique_lock<std::mutex>;

  void ask(Question question);
  void stepOnce(const Lock& lock);
  void advance(double seconds, bool keys_end_it);
  void advanceVirtually(double seconds);
  void waitRealtime(double seconds, bool keys_end_it);
  void pace();
  void look();  ///< calls `cancellation`, holds the robot if that throws
  void runThread(const std::stop_token& stop);
  void requireRunning(const char* call) const;
  int show(Config& C, const std::string& message);
  void takeUp(const Config& C);
  bool isWatched() const { return options_.watched && options_.watched(); }

  BSpline doneUntil(double time) const;
  BSpline continued(const MatrixXd& path, const VectorXd& times, bool overwrite, double cut) const;
  void engage(const char* call, const BSpline& motion, double from);
  double nextStart() const;
  void holdNow();
  void giveWay();
  void gripper(const char* call, GripperCommand command);
  void requireGripper(const char* call, int gripper) const;
  BotCameras& cameras();
  double timeToEnd() const;

  BotOpOptions options_;
  Config model_;  ///< for efforts
  VectorXd home_;
  std::unique_ptr<RobotLoop> loop_;
  mutable std::mutex mutex_;          ///< of the loop and all that it changes
  std::array<long, askCount> asked_;  ///< the period at which each question was answered last
  double owed_ = 0.;                  ///< virtual time that is less than a period
  int key_ = 0;
  std::uint64_t seen_structure_ = 0;  ///< of the configuration that was synced last
  VectorXd external_sum_;
  long external_count_ = 0;
  std::unique_ptr<std::ofstream> record_;
  std::shared_ptr<BotCameras> cameras_;  ///< made for the first picture
  Clock::time_point started_ = Clock::now(), next_ = started_, looked_ = started_;
  std::jthread thread_;  ///< the last member: it ends first
};

}  // namespace kinegraph
