#include "kinegraph/api/execution/task_execution.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <iterator>

#include "kinegraph/api/execution/action_motion.h"
#include "kinegraph/api/execution/execution_motions.h"
#include "kinegraph/api/execution/observed_world.h"
#include "kinegraph/api/execution/standing_sides.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph {

namespace {

using Words = std::vector<std::string>;

constexpr double kEmpty = 2e-3;                         ///< m: a gripper that is narrower holds nothing
constexpr double kWeak = .5;                            ///< N: fingers that press less hold nothing
constexpr double kTimeout = 12., kQueryInterval = .05;  ///< s for a gripper, and between queries
constexpr double kComesToRest = .3;                     ///< s until objects are at rest
constexpr double kThere = 1e-3;                         ///< rad or m: a start that is closer needs no motion
constexpr double kFar = .05;                            ///< rad or m: tolerance of joints
constexpr double kRelease = 4e-3;                       ///< m: a hand opens by more to release an object
constexpr double kOpenEnough = .9;                      ///< share of the widest opening

}  // namespace

class TaskRun::Impl {
 public:
  Impl(const TaskPlan& plan, BotOp& bot, Config& seen, ExecutionOptions options)
      : bot_(bot), options_(std::move(options)), world_(bot, seen, options_.observe), plan_(plan) {
    plan_.requireScenes("execute");
    limits_ = effortLimits(options_, plan_.path.cols());
    repairs_left_ = plan_.replanner ? options_.repairs : 0;
    if (world_.isSimulated()) requireMovable(plan_, seen);
    grippers_ = grippersOf(bot, seen);
    requireGrippers(plan_, grippers_, world_.isSimulated() ? &seen : nullptr);
    setPlan();
  }

  std::optional<TaskEvent> next() {
    if (step_ == Step::ended) return std::nullopt;
    try {
      if (is_stopped_) return stopped();
      return (this->*steps()[std::size_t(step_)])();
    } catch (const RobotFault& fault) {
      if (step_ == Step::fail || !recovers()) return end(fault.what());
      return fail(fault.what());
    }
  }

  void stop() { is_stopped_ = true; }

  const TaskPlan& plan() const { return plan_; }
  TaskExecution result;

 private:
  enum class Step { begin, motion, grip, fail, ended };
  using Call = TaskEvent (Impl::*)();
  static const std::array<Call, 4>& steps() {
    static const std::array<Call, 4> calls = {&Impl::begin, &Impl::motion, &Impl::grip, &Impl::repair};
    return calls;
  }

  // --- steps

  TaskEvent begin() {
    bot_.hold();
    world_.look();
    openEmptyHands();
    index_ = plan_.actions.size();  // no action has begun
    if (std::string failure = moveToStart(); !failure.empty()) return fail(failure);
    index_ = 0;
    step_ = Step::motion;
    return {TaskEventKind::start, -1, {}, ""};
  }

  TaskEvent motion() {
    world_.look();
    if (index_ == plan_.actions.size()) return finish();
    std::string failure = deviation(false);
    const RowRange& rows = plan_.segments[index_];
    if (failure.empty())
      failure = world_.blockedByCells(plan_.scenes[index_], plan_.path.middleRows(rows.begin, rows.size()));
    if (failure.empty()) failure = follow(ActionMotion(plan_, plan_.segments[index_]));
    if (is_stopped_) return stopped();
    world_.look();
    if (failure.empty()) failure = deviation(true);
    if (!failure.empty()) return fail(failure);
    step_ = Step::grip;
    return {TaskEventKind::motion, int(index_), plan_.actions[index_], ""};
  }

  TaskEvent grip() {
    world_.look();
    std::string failure = deviation(true);
    if (failure.empty()) failure = moveFingers(plan_.actions[index_]);
    world_.look();
    if (is_stopped_) return stopped();
    if (failure.empty()) failure = deviation(true);
    if (!failure.empty()) return fail(failure);
    step_ = Step::motion;
    ++result.done;
    return {TaskEventKind::grip, int(index_), plan_.actions[index_++], ""};
  }

  TaskEvent finish() {
    world_.comeToRest();  // what still falls has not arrived
    if (is_stopped_) return stopped();
    const Config scene = world_.scene();
    const Words missed = world_.missedGoals(plan_.goal, scene), fallen = sides_.fallen(scene, world_.held());
    if (!missed.empty()) return fail(join(missed, ", ") + " does not hold");
    if (!fallen.empty()) return fail(cat("'", fallen[0], "' has fallen: it stands on another side than planned"));
    result.feasible = true;
    return end("");
  }

  TaskEvent fail(const std::string& message) {
    const bool is_action = index_ < plan_.actions.size();  // else before the first one, or after the last one
    failure_ = is_action ? cat(planText({plan_.actions[index_]}), ": ", message) : message;
    step_ = Step::fail;
    const Words turned = world_.shortenLevers();
    try {
      if (is_action) backOut(index_, turned);
    } catch (const RobotFault&) {
      recovers();
    }
    return {TaskEventKind::failure, is_action ? int(index_) : -1, is_action ? plan_.actions[index_] : TaskAction(),
            failure_};
  }

  /// Clears a fault of the robot; whether that worked.
  bool recovers() {
    try {
      bot_.recover();
      return true;
    } catch (const RobotFault&) {
      return false;
    }
  }

  TaskEvent repair() {
    if (repairs_left_ == 0) return end(failure_);
    world_.comeToRest();  // what falls is planned for where it ends
    if (is_stopped_) return stopped();
    --repairs_left_;
    const Config scene = world_.scene();
    const Words fallen = sides_.fallen(scene, world_.held());
    TaskPlan plan = planOnward(scene, fallen);
    if (!plan.feasible()) return end(cat(failure_, "; no plan leads on: ", plan.message));
    if (plan.actions.empty() && !fallen.empty())
      return end(cat(failure_, "; no plan puts ", join(fallen, ", "), " up again"));
    ++result.repairs;
    plan.replanner = plan_.replanner;
    plan_ = std::move(plan);
    plan_.requireMotion("execute");
    setPlan();
    handles_.clear();
    step_ = Step::begin;
    return {TaskEventKind::repair, -1, {}, plan_.actions.empty() ? plan_.summary() : planText(plan_.actions)};
  }

  /// Plans to the goal with all fallen objects put up again, else with those of the goal, else without.
  TaskPlan planOnward(const Config& scene, const Words& fallen) {
    Words of_goal;
    std::ranges::copy_if(fallen, std::back_inserter(of_goal), [&](const std::string& obj) {
      return std::ranges::any_of(
          plan_.goal, [&](const Literal& literal) { return std::ranges::count(literal.arguments, obj) > 0; });
    });
    RepairOptions options = options_.repair;
    std::string tried;
    for (const Words& objects : {fallen, of_goal}) {
      const std::string sides = sides_.asGoal(objects);
      if (sides == tried) continue;
      tried = sides;
      options.also = options_.repair.also + sides;
      if (TaskPlan plan = plan_.repair(scene, options); plan.feasible()) return plan;
    }
    return plan_.repair(scene, options_.repair);
  }

  void setPlan() {
    world_.setPlan(plan_);
    sides_.setPlan(plan_);
  }

  TaskEvent stopped() {
    bot_.hold();
    world_.advance(kComesToRest);
    return end("the execution was stopped by its caller");
  }

  TaskEvent end(const std::string& message) {
    step_ = Step::ended;
    result.message = message;
    result.C = world_.scene();
    return {TaskEventKind::end, -1, {}, result.str()};
  }

  /// The first deviation from the plan at the beginning or the end of the motion of the present action, or "". If new
  /// plans may follow, the next object and its place are compared more closely.
  std::string deviation(bool at_end) const {
    const RowRange& rows = plan_.segments[index_];
    const bool is_close = repairs_left_ > 0 && !at_end;
    const TaskAction& action = plan_.actions[index_];
    return world_.deviation(plan_.scenes[index_], plan_.path.row(at_end ? rows.end - 1 : rows.begin),
                            is_close ? Words(action.begin() + 1, action.end()) : Words());
  }

  // --- motions

  /// Moves to the beginning of the plan. Returns the failure, or "".
  std::string moveToStart() {
    if (plan_.actions.empty()) return "";
    VectorXd start = plan_.path.row(0);
    const double off = world_.jointErrors(start).maxCoeff();
    if (off <= kThere) return "";
    const Config scene = world_.scene();
    const VectorXd q = scene.getJointState();  // joints a little beyond a limit are at it
    for (const auto& [door, dof] : world_.doors()) start[dof] = q[dof];
    const MotionPlan motion = motionToStart(plan_, scene, start);
    if (!motion.feasible())
      return cat("the robot is ", fixed(off, 3),
                 " (rad or m) beside the start of the plan, and no motion leads there: ", motion.message);
    return follow(motion);
  }

  /// Follows a motion, and watches it. Returns the reason for which it stopped, or "".
  std::string follow(const Trajectory& motion) {
    if (!(motion.duration() > 0.)) return "";
    FollowOptions options;
    options.tolerance = kFar;
    try {
      bot_.follow(motion, options);
    } catch (const ValueError& error) {
      return error.what();
    }
    if (limits_.size() > 0) bot_.get_tauExternal();  // its mean begins again
    while (bot_.getTimeToEnd() > 0. && !is_stopped_) {
      world_.advance(kQueryInterval);
      std::string failure = unexpectedContact();
      if (failure.empty()) failure = world_.slipped();
      if (failure.empty()) continue;
      bot_.hold();
      world_.advance(kComesToRest);
      return failure;
    }
    if (!is_stopped_) world_.advance(kComesToRest);
    return "";
  }

  std::string unexpectedContact() {
    if (limits_.size() == 0) return "";
    const VectorXd effort = bot_.get_tauExternal().cwiseAbs();
    Eigen::Index joint = 0;
    if (!(effort.allFinite() && (effort - limits_).maxCoeff(&joint) > 0.)) return "";
    return cat("unexpected contact: joint '", bot_.getInfo().joints[std::size_t(joint)], "' feels ",
               fixed(effort[joint], 1), " N m or N; the limit is ", fixed(limits_[joint], 1));
  }

  /// After a failure: opens hands that have lost their objects, and reverses the motion until the robot is
  /// collision-free. Objects that have turned in the hand that has just taken them are put back.
  void backOut(std::size_t i, const Words& turned) {
    const std::map<std::string, std::string> held = world_.held(), handles = handles_;
    for (const auto& [obj, hand] : held)
      if (!world_.touches(hand, obj)) openWithout(i, hand, obj);
    for (const auto& [handle, hand] : handles) release(handle, hand);
    if (isGuided(plan_.actions[i])) return;
    const bool is_put_back = i > 0 && isPick(plan_.actions[i - 1]) && turned == Words{plan_.actions[i - 1][1]};
    Config C = world_.scene();
    if (!is_put_back && isClear(C, bot_.get_q())) return;
    const auto back =
        retreatAlong(plan_, plan_.segments[i], world_, bot_.get_q(),
                     [&](Eigen::Index row, const VectorXd& q) { return is_put_back ? row == 0 : isClear(C, q); });
    if (!back || !retreat(*back) || !is_put_back) return;
    world_.advance(kComesToRest);
    open(plan_.actions[i - 1][3], turned[0]);
    world_.release(turned[0]);
    world_.advance(kComesToRest);
  }

  /// Opens a hand that has lost its object, where the fingers push nothing aside.
  void openWithout(std::size_t i, const std::string& hand, const std::string& obj) {
    world_.release(obj);
    const auto gripper = grippers_.find(hand);
    if (gripper != grippers_.end())
      if (const auto back = retreatToOpen(plan_, i, world_, bot_.get_q(), hand, openingOf(gripper->second)))
        retreat(*back);
    open(hand, obj);
  }

  /// Whether the robot could move back.
  bool retreat(const Retreat& back) {
    try {
      bot_.move(back.path, back.times);
    } catch (const ValueError&) {
      return false;  // beyond limits: a new plan starts here
    }
    while (bot_.getTimeToEnd() > 0. && !is_stopped_) world_.advance(kQueryInterval);
    return !is_stopped_;
  }

  // --- hands

  const GripperInfo& infoOf(int number) const { return bot_.getInfo().grippers[std::size_t(number)]; }

  void openEmptyHands() {
    for (const auto& [hand, number] : grippers_) {
      const bool holds = std::ranges::any_of(world_.held(), [&](const auto& pair) { return pair.second == hand; });
      const double most = infoOf(number).max_width, wanted = openingOf(number);
      const double off = bot_.getGripperPos(number) - wanted;
      if (!holds && (off < (kOpenEnough - 1.) * most || (wanted < most && off > kEmpty))) open(hand);
    }
  }

  /// Closes or opens grippers for an action. Returns the failure, or "".
  std::string moveFingers(const TaskAction& action) {
    const std::string& obj = action[1];
    std::string failure;
    if (isPick(action) || action[0] == "handover") {
      failure = close(action[3], obj);
      if (!failure.empty() && isEmpty(action[3], obj)) {
        open(action[3], obj);
      } else {
        if (action[0] == "handover" && failure.empty()) open(action[2], obj);
        world_.take(obj, action[3]);
      }
    } else if (isHold(action)) {
      handles_[action[2]] = action[3];
      failure = close(action[3], action[2]);
    } else if (isGuided(action)) {
      release(action[2], action[3]);
    } else if (isPlace(action)) {
      open(action[2], obj);
      world_.release(obj);
    }
    world_.advance(kComesToRest);
    return failure;
  }

  void release(const std::string& handle, const std::string& hand) {
    open(hand, handle);
    handles_.erase(handle);
  }

  std::string close(const std::string& hand, const std::string& obj) {
    const auto gripper = grippers_.find(hand);
    if (gripper == grippers_.end()) {
      if (world_.isSimulated()) bot_.attach(hand, obj);
      return "";
    }
    const int number = gripper->second;
    bot_.gripperCloseGrasp(number, obj, std::min(kHoldingForce, infoOf(number).max_force));
    waitFor(number);
    if (isShut(number)) return cat("'", hand, "' closed on nothing");
    const double force = world_.gripForce(hand, obj);
    if (force < kWeak && !bot_.gripperDone(number))
      return cat("'", hand, "' is still closing after ", fixed(kTimeout, 0), " s");
    return force < kWeak ? cat("'", hand, "' closed, and presses on '", obj, "' with ", fixed(force, 1), " N only")
                         : "";
  }

  double openingOf(int number) const { return plannedOpening(plan_, number, infoOf(number).max_width); }

  bool isShut(int number) const { return bot_.getGripperPos(number) < infoOf(number).min_width + kEmpty; }

  /// Whether a hand is shut, and presses on nothing as far as contacts tell.
  bool isEmpty(const std::string& hand, const std::string& obj) const {
    const auto gripper = grippers_.find(hand);
    if (gripper == grippers_.end() || !isShut(gripper->second)) return false;
    const double force = world_.gripForce(hand, obj);
    return force < kWeak || !std::isfinite(force);
  }

  void open(const std::string& hand, const std::string& obj = {}) {
    const auto gripper = grippers_.find(hand);
    if (gripper != grippers_.end()) {
      const int number = gripper->second;
      const double wanted = openingOf(number);
      const bool keeps = !obj.empty() && wanted - bot_.getGripperPos(number) < kRelease;
      bot_.gripperMove(number, keeps ? infoOf(number).max_width : wanted);
      waitFor(number);
    } else if (!obj.empty() && world_.isSimulated()) {
      bot_.detach(hand, obj);
    }
  }

  void waitFor(int gripper) {
    for (int k = 0; k < int(std::lround(kTimeout / kQueryInterval)); ++k) {
      world_.advance(kQueryInterval);
      if (is_stopped_ || bot_.gripperDone(gripper)) return;
    }
  }

  BotOp& bot_;
  const ExecutionOptions options_;
  ObservedWorld world_;
  TaskPlan plan_;
  StandingSides sides_;
  VectorXd limits_;                             ///< of external efforts; empty: none
  std::map<std::string, int> grippers_;         ///< indices by the names of hands
  std::map<std::string, std::string> handles_;  ///< by handle: the hand that holds it
  Step step_ = Step::begin;
  std::size_t index_ = 0;  ///< of the present action
  std::string failure_;
  int repairs_left_ = 0;
  std::atomic<bool> is_stopped_ = false;
};

TaskRun::TaskRun(const TaskPlan& plan, BotOp& bot, Config& seen, ExecutionOptions options)
    : impl_(std::make_unique<Impl>(plan, bot, seen, std::move(options))) {}
TaskRun::TaskRun(TaskRun&&) noexcept = default;
TaskRun::~TaskRun() = default;

std::optional<TaskEvent> TaskRun::next() { return impl_->next(); }
void TaskRun::stop() { impl_->stop(); }
const TaskExecution& TaskRun::result() const { return impl_->result; }
const TaskPlan& TaskRun::plan() const { return impl_->plan(); }

TaskExecution execute(const TaskPlan& plan, BotOp& bot, Config& seen, const ExecutionOptions& options) {
  TaskRun run(plan, bot, seen, options);
  while (const std::optional<TaskEvent> event = run.next())
    if (options.callback && !options.callback(*event)) run.stop();
  return run.result();
}

TaskExecution TaskPlan::execute(BotOp& bot) const { return execute(bot, {}); }

TaskExecution TaskPlan::execute(BotOp& bot, const ExecutionOptions& options) const {
  Config seen = worldOf(bot, *this, bool(options.observe));
  return kinegraph::execute(*this, bot, seen, options);
}

}  // namespace kinegraph
