#include "kinegraph/robot/bot_op.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/robot/robot_joint.h"
#include "kinegraph/robot/robot_loop.h"
#include "kinegraph/robot/scene_grippers.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

constexpr double kSameWidth = 1e-3;     ///< m: openings that differ by less are the same
constexpr double kDefaultWidth = .075;  ///< m: of gripperMove and gripperOpen, as far as a gripper opens
constexpr double kGraspReach = .05;     ///< m: beyond the opening of a gripper; farther objects are not between fingers

/// The distance of a gripper's frame from the shape, or else the origin, of an object, m.
double distanceFrom(const Frame& gripper, const Frame& object) {
  const FrameData& frame = object.data();
  return proximity(*pointBody(), gripper.getPose().transform(), frame.shape ? *frame.shape->body() : *pointBody(),
                   object.getPose().transform())
      .distance;
}

}  // namespace

BotOp::BotOp(const Config& config, std::shared_ptr<RobotDriver> driver, BotOpOptions options)
    : options_(std::move(options)), model_(config), home_(config.getJointState()) {
  last_query_.fill(-1);
  if (!driver) throw ValueError("BotOp: the driver is null");
  if (home_.size() == 0) throw ValueError("BotOp: the configuration has no active joints; expected a robot");
  const bool is_simulated = driver->world();
  loop_ = std::make_unique<RobotLoop>(std::move(driver), options_.period, options_.safety);
  const std::size_t joints = loop_->info().joints.size();
  if (joints != std::size_t(home_.size()))
    throw ValueError(cat("BotOp: robot '", loop_->info().name, "' has ", joints, " joints; the configuration has ",
                         home_.size(), ": ", join(config.getJointNames())));
  if (options_.realtime && !is_simulated) options_.hyper_speed = 1.;
  gripper_targets_.resize(loop_->info().grippers.size());
  for (std::size_t i = 0; i < std::min(gripper_targets_.size(), loop_->state().grippers.size()); ++i)
    gripper_targets_[i] = loop_->state().grippers[i].width;
  if (!is_simulated) {
    scene_ = config;
    fingers_ = findGrippers(config);
    if (fingers_.size() != loop_->info().grippers.size()) fingers_.clear();  // which is which?
  }
  if (options_.realtime && !(options_.hyper_speed > 0.))
    options_.realtime = false;  // as fast as the computation allows
  if (options_.realtime) thread_ = std::jthread([this](const std::stop_token& stop) { runThread(stop); });
}

BotOp::~BotOp() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

// --- state
// ---------------------------------------------------------------------------------------------------------------

double BotOp::get_t() {
  countQuery(queryTime);
  const Lock lock(mutex_);
  return loop_->time();
}

VectorXd BotOp::get_q() {
  countQuery(queryQ);
  const Lock lock(mutex_);
  return loop_->state().q;
}

VectorXd BotOp::get_qDot() {
  countQuery(queryVelocity);
  const Lock lock(mutex_);
  return loop_->state().velocity;
}

VectorXd BotOp::get_qHome() const { return home_; }

const RobotInfo& BotOp::getInfo() const { return loop_->info(); }

VectorXd BotOp::get_tauExternal() {
  countQuery(queryExternal);
  const Lock lock(mutex_);
  VectorXd mean = VectorXd::Constant(home_.size(), std::numeric_limits<double>::quiet_NaN());
  if (external_count_ > 0) {
    mean = external_sum_ / double(external_count_);
  } else if (loop_->state().external_effort.size() > 0) {
    mean = loop_->state().external_effort;
  }
  external_count_ = 0;
  return mean;
}

double BotOp::getTimeToEnd() {
  countQuery(queryEnd);
  const Lock lock(mutex_);
  return timeToEnd();
}

double BotOp::timeToEnd() const {
  return loop_->mode() == LoopMode::follow ? loop_->motion().end() - loop_->time() : 0.;
}

LoopMode BotOp::getMode() const {
  const Lock lock(mutex_);
  return loop_->mode();
}

std::string BotOp::takeWarning() {
  const Lock lock(mutex_);
  return loop_->takeWarning();
}

std::string BotOp::getFault() const {
  const Lock lock(mutex_);
  return loop_->fault();
}

// --- grippers
// ------------------------------------------------------------------------------------------------------------

void BotOp::requireGripper(const char* call, int gripper) const {
  const auto& grippers = loop_->info().grippers;
  if (gripper >= 0 && std::size_t(gripper) < grippers.size()) return;
  std::vector<std::string> names;
  for (const GripperInfo& info : grippers) names.push_back(info.name);
  throw ValueError(cat(call, ": there is no gripper ", gripper, "; the robot has ",
                       names.empty() ? std::string("none: a gripper is a joint that others mimic and that is not "
                                                   "active (see selectJoints)")
                                     : cat(names.size(), ": ", join(names))));
}

void BotOp::gripper(const char* call, GripperCommand command) {
  const Lock lock(mutex_);
  requireGripper(call, command.gripper);
  const GripperInfo& info = loop_->info().grippers[std::size_t(command.gripper)];
  if (!std::isfinite(command.width) || !(command.speed > 0.) || !(command.force > 0.))
    throw ValueError(cat(call, ": width is ", command.width, ", speed ", command.speed, ", force ", command.force,
                         "; expected a finite width, and speed and force above 0"));
  const double width = std::clamp(command.width, info.min_width, info.max_width);
  if (!command.grasp && command.width != kDefaultWidth && std::abs(width - command.width) > kSameWidth)
    loop_->warn(cat(call, ": a width of ", command.width, " m is beyond the opening of gripper '", info.name, "', ",
                    info.min_width, " to ", info.max_width, " m; it moves to ", width, " m"));
  command.width = width;
  command.speed = std::min(command.speed, info.max_speed);
  command.force = std::min(command.force, info.max_force);
  loop_->apply(command);
  gripper_targets_[std::size_t(command.gripper)] = command.grasp ? info.min_width : command.width;
}

double BotOp::getGripperTarget(int gripper) const {
  requireGripper("BotOp::getGripperTarget", gripper);
  const Lock lock(mutex_);
  return gripper_targets_[std::size_t(gripper)];
}

void BotOp::gripperMove(int gripper, double width, double speed) {
  this->gripper("BotOp::gripperMove", {gripper, false, width, speed, 1e9, {}});
}

void BotOp::gripperClose(int gripper, double force, double width, double speed) {
  this->gripper("BotOp::gripperClose", {gripper, true, width, speed, force, {}});
}

void BotOp::gripperCloseGrasp(int gripper, const std::string& object, double force, double width, double speed) {
  if (loop_->driver().world()) model_.getFrame(object);  // throws FrameNotFound
  this->gripper("BotOp::gripperCloseGrasp", {gripper, true, width, speed, force, object});
  const Lock lock(mutex_);
  const SimulatedWorld* world = loop_->driver().world();
  const GripperInfo& info = loop_->info().grippers[std::size_t(gripper)];
  const SceneTree* scene = world ? world->config().scene().get() : nullptr;
  if (!scene || !scene->find(info.name) || !scene->find(object)) return;
  const double distance = distanceFrom(world->config().getFrame(info.name), world->config().getFrame(object));
  if (distance > info.max_width + kGraspReach)
    loop_->warn(cat("BotOp::gripperCloseGrasp: '", object, "' is ", distance, " m from '", info.name,
                    "', not between its fingers; move there first"));
}

double BotOp::getGripperPos(int gripper) {
  requireGripper("BotOp::getGripperPos", gripper);
  countQuery(queryGripper);
  const Lock lock(mutex_);
  return loop_->state().grippers.at(std::size_t(gripper)).width;
}

bool BotOp::gripperDone(int gripper) {
  requireGripper("BotOp::gripperDone", gripper);
  countQuery(queryDone);
  const Lock lock(mutex_);
  return loop_->state().grippers.at(std::size_t(gripper)).is_done;
}

// --- the simulated world
// -------------------------------------------------------------------------------------------------

Config BotOp::getWorld() const {
  const Lock lock(mutex_);
  if (SimulatedWorld* world = loop_->driver().world()) return world->config();
  Config scene = scene_;
  scene.setJointState(loop_->state().q);
  moveFingers(scene);
  return scene;
}

bool BotOp::isSimulated() const {
  const Lock lock(mutex_);
  return loop_->driver().world() != nullptr;
}

/// Sets the fingers of a scene to the openings of the robot's grippers.
void BotOp::moveFingers(Config& config) const {
  const auto& states = loop_->state().grippers;
  for (std::size_t i = 0; i < std::min(fingers_.size(), states.size()); ++i) {
    if (config.scene()->find(fingers_[i].joint))
      config.setJointState(VectorXd::Constant(1, fingers_[i].opening.positionAt(states[i].width)), {fingers_[i].joint});
  }
}

std::vector<Contact> BotOp::getContacts() const {
  const Lock lock(mutex_);
  const SimulatedWorld* world = loop_->driver().world();
  return world ? world->contacts() : std::vector<Contact>{};
}

void BotOp::update(Config& config) const {
  const Lock lock(mutex_);
  if (SimulatedWorld* world = loop_->driver().world()) {
    world->updateConfig(config);
    copyRelativePoses(world->config(), config, placed_);
  } else {
    config.setJointState(loop_->state().q);
    moveFingers(config);
  }
}

void BotOp::attach(const std::string& from, const std::string& to) {
  const Lock lock(mutex_);
  loop_->apply(AttachFrames{from, to, true});
}

void BotOp::detach(const std::string& from, const std::string& to) {
  const Lock lock(mutex_);
  loop_->apply(AttachFrames{from, to, false});
}

void BotOp::setFramePose(const std::string& frame, const Pose& pose) {
  const FrameData* const moved = model_.scene()->find(frame);
  const FrameData* link = moved;
  if (link && !link->joint) {  // with a rigid joint it may be an object that is attached to the robot
    while (link && !link->moves()) link = link->parent;
  }
  if (link && isRobotJoint(*link))
    throw ValueError(cat("BotOp::setFramePose: '", frame, "' is ",
                         link == moved ? std::string("a joint of the robot, which moveTo moves")
                                       : cat("fixed to '", link->name, "', a joint of the robot"),
                         "; expected an object"));
  const Lock lock(mutex_);
  loop_->apply(PlaceFrame{frame, pose});
  if (!std::ranges::count(placed_, frame)) placed_.push_back(frame);
}

// --- records
// -------------------------------------------------------------------------------------------------------------

CommandLog BotOp::getLog() const {
  const Lock lock(mutex_);
  return loop_->log();
}

void BotOp::replay(const CommandLog& log) {
  constexpr const char* call = "BotOp::replay";
  Lock lock(mutex_);
  if (options_.realtime)
    throw ValueError(cat(call, ": the robot moves in real time; a log is replayed in virtual time"));
  if (loop_->tick() != 0 || !loop_->log().entries.empty())
    throw ValueError(cat(call, ": the robot has moved before; expected a new BotOp"));
  if (log.period != options_.period)
    throw ValueError(cat(call, ": the period of the log is ", log.period, " s; expected that of the BotOp, ",
                         options_.period, " s"));
  const auto advanceTo = [&](long tick) {
    while (loop_->tick() < tick) {
      lock.unlock();
      advanceVirtually(options_.period);
      lock.lock();
    }
  };
  for (const CommandLog::Entry& entry : log.entries) {
    advanceTo(entry.tick);
    loop_->apply(entry.command);
  }
  advanceTo(log.ticks);
}

void BotOp::recordTo(const std::string& path) {
  const Lock lock(mutex_);
  record_.reset();
  if (path.empty()) return;
  record_ = std::make_unique<std::ofstream>(path);
  if (!*record_) {
    record_.reset();
    throw FileError(cat("BotOp::recordTo: cannot write '", path, "'"));
  }
  record_->imbue(std::locale::classic());
  *record_ << "# t, q, velocity, reference of q, of velocity; joints: " << join(loop_->info().joints, " ") << '\n';
}

}  // namespace kinegraph
