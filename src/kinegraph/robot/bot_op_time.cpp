// The clock of a BotOp: virtual time, and the thread of real time.
#include <algorithm>
#include <cmath>
#include <fstream>

#include "kinegraph/common/text.h"
#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/robot_loop.h"
#include "kinegraph/robot/scene_grippers.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

using std::chrono::duration;
using std::chrono::duration_cast;
using std::chrono::milliseconds;

constexpr milliseconds kCheck{20};    // between two checks for cancellation
constexpr milliseconds kCatchUp{50};  // larger delays are not caught up with

std::chrono::steady_clock::duration wallTime(double seconds, double speed) {
  return duration_cast<std::chrono::steady_clock::duration>(duration<double>(seconds / speed));
}

}  // namespace

void BotOp::stepOnce(const Lock&) {
  try {
    loop_->step();
  } catch (...) {  // an interrupt of the program; the loop itself catches the driver's errors
    holdNow();
    throw;
  }
  const RobotState& state = loop_->state();
  if (state.external_effort.size() > 0) {
    if (external_count_++ == 0) external_sum_ = VectorXd::Zero(home_.size());
    external_sum_ += state.external_effort;
  }
  if (!record_) return;
  const MatrixXd reference = loop_->reference(loop_->time());
  *record_ << exact(loop_->time());
  for (const double x : state.q) *record_ << ' ' << exact(x);
  for (const double x : state.velocity) *record_ << ' ' << exact(x);
  for (const double x : reference.topRows(2).reshaped<Eigen::RowMajor>()) *record_ << ' ' << exact(x);
  *record_ << '\n';
}

void BotOp::checkCancellation() {
  checked_ = Clock::now();
  if (!options_.cancellation) return;
  try {
    options_.cancellation.check();
  } catch (...) {
    const Lock lock(mutex_);
    holdNow();
    throw;
  }
}

/// A repeated query at the same virtual time advances it by one period.
void BotOp::countQuery(Query query) {
  if (options_.realtime || watching_ != std::thread::id()) return;
  long& last = last_query_[std::size_t(query)];
  if (last == loop_->tick()) advanceVirtually(options_.period);
  last = loop_->tick();
}

/// Delays virtual time to the pace of the wall clock.
void BotOp::pace() {
  const auto now = Clock::now();
  next_ += wallTime(options_.period, options_.hyper_speed);
  if (next_ + kCatchUp < now) next_ = now;
  while (Clock::now() < next_) {
    std::this_thread::sleep_until(std::min(next_, Clock::now() + kCheck));
    checkCancellation();
  }
}

void BotOp::advanceVirtually(double seconds) {
  pending_time_ += seconds;
  const bool paced = options_.hyper_speed > 0. && isWatched();
  callWatches();
  for (; pending_time_ >= options_.period * (1. - 1e-9); pending_time_ -= options_.period) {
    {
      const Lock lock(mutex_);
      stepOnce(lock);
    }
    callWatches();
    if (paced) pace();
    if (Clock::now() - checked_ > kCheck) checkCancellation();
  }
  if (pending_time_ < 1e-9 * options_.period) pending_time_ = 0.;
}

void BotOp::waitRealtime(double seconds, bool keys_end_it) {
  const auto end = Clock::now() + wallTime(seconds, options_.hyper_speed);
  for (auto now = Clock::now(); now < end && !(keys_end_it && key_); now = Clock::now()) {
    const auto due = now + wallTime(nextWatch(), options_.hyper_speed);
    std::this_thread::sleep_until(std::min({end, now + kCheck, due}));
    checkCancellation();
    callWatches();
  }
}

void BotOp::watch(double period, std::function<bool(double)> function) {
  if (!(period >= 0.) || !std::isfinite(period))
    throw ValueError(cat("BotOp::watch: the period is ", period, " s; expected 0 or more"));
  if (!function) throw ValueError("BotOp::watch: there is no function");
  const Lock lock(mutex_);
  watches_.push_back(std::make_shared<Watch>(loop_->time(), std::max(period, options_.period), 0, std::move(function)));
}

/// Returns the time until the next call of a watch, s; at most a second.
double BotOp::nextWatch() const {
  const Lock lock(mutex_);
  double due = 1.;
  for (const auto& watch : watches_)
    due = std::min(due, watch->begin + double(watch->count) * watch->period - loop_->time());
  return std::max(due, .2 * options_.period);
}

/// Calls the functions of `watch` that are due. Without the lock, so that they may call the robot.
void BotOp::callWatches() {
  if (watches_.empty() || watching_ == std::this_thread::get_id()) return;
  double now = 0.;
  {
    const Lock lock(mutex_);
    now = loop_->time();
  }
  for (std::size_t i = 0; i < watches_.size();) {  // a function may add others
    const std::shared_ptr<Watch> watch = watches_[i];
    const double rounding = 1e-6 * options_.period;
    bool goes_on = true;
    if (watch->begin + double(watch->count) * watch->period <= now + rounding) {
      watch->count = long(std::floor((now + rounding - watch->begin) / watch->period)) + 1;
      watching_ = std::this_thread::get_id();
      try {
        goes_on = watch->function(now);
      } catch (...) {
        watching_ = std::thread::id();
        const Lock lock(mutex_);
        std::erase(watches_, watch);
        holdNow();
        throw;
      }
      watching_ = std::thread::id();
    }
    const Lock lock(mutex_);
    if (goes_on) {
      ++i;
    } else {
      std::erase(watches_, watch);
    }
  }
}

void BotOp::advance(double seconds, bool keys_end_it) {
  if (watching_ == std::this_thread::get_id())
    throw ValueError("BotOp: a function of watch cannot wait (sync, wait, home, stop); it may command motions");
  if (!(seconds >= 0. && std::isfinite(seconds)))
    throw ValueError(cat("BotOp: the time to wait is ", seconds, " s; expected a finite number, 0 or more"));
  checkCancellation();
  if (options_.realtime) {
    waitRealtime(seconds, keys_end_it);
  } else {
    advanceVirtually(seconds);
  }
}

void BotOp::runThread(const std::stop_token& stop) {
  auto next = Clock::now();
  while (!stop.stop_requested()) {
    {
      const Lock lock(mutex_);
      try {
        if (options_.interrupted && options_.interrupted() && loop_->mode() == LoopMode::follow) holdNow();
        stepOnce(lock);
      } catch (const std::exception& error) {  // no caller could catch it
        loop_->stop(error.what());
      }
    }
    next += wallTime(options_.period, options_.hyper_speed);
    const auto now = Clock::now();
    if (next + kCatchUp < now) next = now;
    std::this_thread::sleep_until(next);
  }
}

int BotOp::show(Config& C, const std::string& message) {
  if (!options_.show) return 0;
  std::string text = cat("control time ", loop_->time(), " s");
  if (options_.realtime || isWatched()) {
    const double wall = duration<double>(Clock::now() - started_).count();
    text += cat(" (", int(100. * loop_->time() / std::max(wall, 1e-3) + .5), " % of real time)");
  }
  if (!message.empty()) text = cat(message, "\n", text);
  return options_.show(*this, C, text);
}

void BotOp::requireRunning(const char* call) const {
  const Lock lock(mutex_);
  if (loop_->mode() == LoopMode::fault)
    throw RobotFault(
        cat(call, ": the robot was stopped: ", loop_->fault(), "; resolve the cause, then call recover()"));
}

namespace {

/// A scene without the robot would be taken for a scene full of new frames.
void requireRobot(const Config& C, const Config& robot) {
  std::vector<std::string> missing;
  std::size_t joints = 0;
  for (const auto& frame : robot.scene()->frames()) {
    if (!frame->moves() || !frame->joint->active || frame->joint->mimic) continue;
    if (frame->joint->type == JointType::free) continue;  // an object, or a base
    ++joints;
    if (!C.scene()->find(frame->name)) missing.push_back(frame->name);
  }
  if (missing.empty()) return;
  throw ValueError(cat("BotOp: the configuration has ", missing.size() == joints ? "none" : "only a part",
                       " of the robot's joints; missing: ", join(missing),
                       "; expected the one that the BotOp was made of, or a copy of it"));
}

}  // namespace

/// Copies frames that are new in the configuration since its last sync into the world.
void BotOp::addNewFrames(const Config& C) {
  if (C.scene()->structureRevision() == seen_structure_) return;
  requireRobot(C, model_);
  seen_structure_ = C.scene()->structureRevision();
  const Lock lock(mutex_);
  if (SimulatedWorld* world = loop_->driver().world()) {
    world->addObjects(C);
  } else {
    copyNewFrames(C, scene_);
  }
}

int BotOp::sync(Config& C, double wait_time, const std::string& message) {
  key_ = 0;
  addNewFrames(C);
  if (options_.realtime) {
    update(C);
    key_ = show(C, message);
    advance(wait_time, true);
    update(C);
  } else {
    advance(wait_time, false);
    update(C);
    key_ = show(C, message);
  }
  requireRunning("BotOp::sync");
  return key_;
}

int BotOp::wait(Config& C, bool for_key, bool for_end, bool for_gripper, double sync_period) {
  if (!(sync_period > 0.))
    throw ValueError(cat("BotOp::wait: sync_period is ", sync_period, " s; expected a number above 0"));
  for (;;) {
    const int key = sync(C, sync_period);
    if (for_key && key) return key;
    const Lock lock(mutex_);
    if (for_end && timeToEnd() <= 0.) return 0;
    const auto& grippers = loop_->state().grippers;
    const bool done = std::all_of(grippers.begin(), grippers.end(), [](const GripperState& g) { return g.is_done; });
    if (for_gripper && done) return 'g';
    if (!for_end && !for_gripper && !(for_key && isWatched())) return 0;
  }
}

}  // namespace kinegraph
