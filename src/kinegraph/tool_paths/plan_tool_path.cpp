#include "kinegraph/tool_paths/plan_tool_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/tool_paths/path_order.h"
#include "kinegraph/tool_paths/path_search.h"
#include "kinegraph/tool_paths/slow_stretches.h"

namespace kinegraph {

namespace {

constexpr double kFitShare = .25;  // of the tolerance, for fitting rows
constexpr int kLeastTimingIntervals = 100;
constexpr int kMostTimingIntervals = 500, kFinest = 2;  // the latter per piece of the joint curve
constexpr double kIdle = .02, kMuchIdle = .03;          // share of the duration without a limit that is reached
constexpr int kSolutionsPerPath = 3, kBranches = 8;     // for transfers and orders; the latter of arms without freedom
constexpr std::int64_t kQuickEvaluations = 20000;       // for transfers between which there is a choice
constexpr double kLeastTime = 1e-3;                     // s, of a transfer
constexpr double kLeastTolerance = 1e-6, kLeastRotationTolerance = 4e-6;  // m and rad that splines of joints keep
constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr const char* kPlanToolPath = "planToolPath";

void requirePositive(const char* name, double value) {
  if (!(value > 0.)) throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected a number > 0"));
}

void requireNotNegative(const char* name, double value) {
  if (!(value >= 0.) || !std::isfinite(value))
    throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected a finite number >= 0"));
}

void requireAtLeast(const char* name, double value, double least) {
  if (!(value >= least)) throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected at least ", least));
}

bool mayCollide(const Config& scene, const Frame& frame) {
  const FrameData& data = *scene.scene()->frames()[std::size_t(frame.id())];
  return data.shape && data.shape->contact != 0;
}

/// Puts a frame between a named frame with a shape and the shapes that are fixed to it, such as a clamp on a part. An
/// exclusion of a frame also holds for shapes fixed to it, which are those of the link if it has none of its own.
void separate(Config& scene, const std::string& name, const std::vector<std::string>& touching) {
  const Frame owner = scene.getFrame(name);
  if (!mayCollide(scene, owner)) return;
  for (Frame child : owner.getChildren()) {
    const bool is_named = std::find(touching.begin(), touching.end(), child.getName()) != touching.end();
    if (child.getJointType() != JointType::none || !mayCollide(scene, child) || is_named) continue;
    const Frame between = scene.addFrame(cat(name, " below ", child.getName()), owner);
    child.setParent(between, true);
  }
}

/// A copy of the scene in which the links of the tools may touch some frames.
Config withTouching(const Config& config, const std::vector<ToolPath>& paths,
                    const std::vector<std::string>& touching) {
  Config scene(config);
  if (touching.empty()) return scene;
  for (const std::string& name : touching) {
    frameId(*config.model(), name, "planToolPath: touching");
    separate(scene, name, touching);
  }
  const std::shared_ptr<const KinematicModel> model = scene.model();
  SceneTree& tree = *scene.scene();
  for (const std::string& name : touching) {
    const int other = frameId(*model, name, "planToolPath: touching");
    for (const ToolPath& path : paths) {
      const int tool = frameId(*model, path.frame(), kPlanToolPath);
      for (std::size_t frame = 0; frame < model->frame_link.size(); ++frame)
        if (model->frame_link[frame] == model->frame_link[std::size_t(tool)] && model->geometry[frame])
          tree.frames()[frame]->no_contact.push_back(tree.frames()[std::size_t(other)].get());
    }
  }
  tree.structureChanged();
  return scene;
}

/// Appends the limits of one more dof: velocity, acceleration, and jerk if jerks are limited.
void appendTo(MotionLimits& limits, const std::array<double, 3>& more) {
  const std::array<VectorXd*, 3> all = {&limits.velocity, &limits.acceleration, &limits.jerk};
  for (std::size_t k = 0; k < std::size_t(limits.limitsJerk() ? 3 : 2); ++k) {
    all[k]->conservativeResize(all[k]->size() + 1);
    (*all[k])[all[k]->size() - 1] = more[k];
  }
}

/// The joint curve in the other direction.
JointCurve reversed(const JointCurve& curve) {
  JointCurve back = curve;
  back.pieces = {};
  const CubicPieces& pieces = curve.pieces;
  bool corner = false;
  for (int k = pieces.pieces() - 1; k >= 0; --k) {
    const double begin = pieces.begin[std::size_t(k)], end = pieces.end(k);
    MatrixXd y(pieces.coefficient[0].rows(), 2), slope(y.rows(), 2);
    y << pieces.eval(k, end), pieces.eval(k, begin);
    slope << -pieces.eval(k, end, 1), -pieces.eval(k, begin, 1);
    back.pieces.addHermite({pieces.length - end, pieces.length - begin}, y, slope, corner);
    corner = pieces.is_corner[std::size_t(k)];
  }
  return back;
}

/// One planToolPath call.
class ToolPathPlanner {
 public:
  ToolPathPlanner(const Config& config, const std::vector<ToolPath>& paths, const ToolPathOptions& options,
                  const CancellationToken& cancellation, const ProgressCallback& progress)
      : config_(config),
        touching_(withTouching(config, paths, options.touching)),
        paths_(paths),
        options_(options),
        cancellation_(cancellation),
        progress_(progress),
        checker_(touching_.state(), options.margin) {
    transfer_.margin = options.margin;
    transfer_.velocity = options.velocity, transfer_.acceleration = options.acceleration, transfer_.jerk = options.jerk;
    transfer_.seed = options.seed;
    limits_ = planLimits(config, transfer_);
    transfer_.velocity = limits_.velocity, transfer_.acceleration = limits_.acceleration;
  }

  ToolPathPlan run() {
    if (!solveAll()) return std::move(plan_);
    const PathSequence sequence = sequenceOf();
    if (!sequence.feasible && isLate()) {
      failLate(0);
      return std::move(plan_);
    }
    for (std::size_t k = 0; k < sequence.order.size(); ++k)
      if (!addPath(sequence, k)) return std::move(plan_);
    plan_.status = ToolPathStatus::solved;
    plan_.setParts(std::move(parts_), config_.getJointDimension());
    return std::move(plan_);
  }

 private:
  bool solveAll() {
    const bool several = paths_.size() > 1 || options_.transfer_from.has_value();
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      if (progress_) progress_({int(k), int(paths_.size())});
      if (isLate()) return failLate(int(k));
      tools_.push_back(std::make_unique<ToolKinematics>(touching_, paths_[k]));
      ToolKinematics& tool = *tools_.back();
      const VectorXd present = config_.getJointState();
      const Pose now(tool.pose(present));
      const std::optional<ToolWaypoint>& first = paths_[k].first();
      const double side = tool.side(first ? Pose{first->p, first->rotation.value_or(now.q)} : now);
      curves_.emplace_back(paths_[k], now, kFitShare * options_.tolerance, side * options_.approach,
                           side * options_.retract);
      for (const std::string& warning : paths_[k].warnings()) plan_.warnings.push_back(warning);
      for (const std::string& warning : curves_.back().warnings())
        plan_.warnings.push_back(cat("path ", k, ": ", warning));
      PathSearchSettings settings;
      settings.limits = {limits_.velocity, limits_.acceleration, curves_.back().largestSpeed(options_.speed)};
      settings.tolerance = {options_.tolerance, options_.rotation_tolerance};
      settings.seed = options_.seed;
      const bool is_free = tool.rows() != ToolRows::pose || tool.movingDofs() > 6;
      settings.wanted = !several ? 1 : is_free ? kSolutionsPerPath : kBranches;
      settings.cancellation = cancellation_;
      settings.first = {present};
      if (k == 0 && options_.start) settings.first = {*options_.start}, settings.only_first = true;
      // Solutions near those of the path before shorten the transfers.
      if (k > 0)
        for (const JointCurve& curve : solutions_[k - 1].curves) settings.first.push_back(curve.pieces.eval(0.));
      solutions_.push_back(searchPath(tool, curves_.back(), checker_, settings));
      if (!solutions_.back().curves.empty()) continue;
      std::string other;
      if (settings.only_first) {
        settings.only_first = false;
        const PathSolutions free_start = searchPath(tool, curves_.back(), checker_, settings);
        if (!free_start.curves.empty())
          other = cat("; from the start (",
                      free_start.curves[0].pieces.eval(0.).transpose().format(
                          Eigen::IOFormat(4, Eigen::DontAlignCols, ", ", ", ")),
                      ") there is a motion");
        const double off = tool.miss(*options_.start, curves_.back().at(0.)).p.norm();
        if (off > options_.tolerance)
          other = cat("; at `start`, the tool is ", numberText(off, 3), " m from the beginning of the path", other);
      }
      return failPath(int(k), other);
    }
    return true;
  }

  bool fail(ToolPathStatus status, int path, double place, const std::string& text) {
    plan_.status = status;
    plan_.where = {path, place};
    plan_.message = cat("path ", path, ", ", place, " m: ", text);
    return false;
  }

  bool isLate() const { return clock_.seconds() > options_.time_limit; }
  bool failLate(int path) { return fail(ToolPathStatus::out_of_time, path, 0., "the time limit ended the search"); }
  double timeLeft() const { return std::max(kLeastTime, options_.time_limit - clock_.seconds()); }

  bool failPath(int path, const std::string& more) {
    const PathFailure& failure = solutions_.back().failure;
    plan_.frames = failure.frames;
    plan_.joint = failure.joint;
    plan_.reached.resize(Eigen::Index(failure.reached.size()), config_.getJointDimension());
    for (std::size_t k = 0; k < failure.reached.size(); ++k)
      plan_.reached.row(Eigen::Index(k)) = failure.reached[k].transpose();
    return fail(failure.status, path, failure.place - curves_.back().approachEnd(), failure.text + more);
  }

  PathSequence sequenceOf() {
    const bool both = options_.free_order && options_.approach == options_.retract;
    std::vector<std::vector<PathVariant>> variants;
    for (const PathSolutions& solutions : solutions_) {
      variants.emplace_back();
      for (int k = 0; k < int(solutions.curves.size()); ++k) {
        const CubicPieces& pieces = solutions.curves[std::size_t(k)].pieces;
        const VectorXd first = pieces.eval(0.), last = pieces.eval(pieces.length);
        variants.back().push_back({k, false, first, last});
        if (both) variants.back().push_back({k, true, last, first});
      }
    }
    PlanOptions quick = transfer_;
    quick.max_evaluations = kQuickEvaluations;
    return orderWithTransfers(std::move(variants), options_.free_order, options_.transfer_from, limits_,
                              [&](const VectorXd& from, const VectorXd& to) {
                                quick.time_limit = timeLeft();
                                // Ends of paths may touch what the paths touch.
                                return planMotion(touching_, MotionGoal(to), quick, from, cancellation_);
                              });
  }

  bool addPath(const PathSequence& sequence, std::size_t position) {
    const OrderedPath& choice = sequence.order[position];
    const int path = choice.path;
    ToolKinematics& tool = *tools_[std::size_t(path)];
    const JointCurve& solved = solutions_[std::size_t(path)].curves[std::size_t(choice.solution)];
    const JointCurve joints = choice.reversed ? reversed(solved) : solved;
    const ToolCurve curve = choice.reversed ? curves_[std::size_t(path)].reversed() : curves_[std::size_t(path)];
    const VectorXd start = joints.pieces.eval(0.);
    std::optional<VectorXd> from = options_.transfer_from;
    if (position > 0) from = last_;
    if (sequence.feasible) {
      if (sequence.transfers[position]) addTransfer(*sequence.transfers[position], path);
    } else if (from && (start - *from).cwiseAbs().maxCoeff() >= kSameConfiguration) {
      transfer_.time_limit = timeLeft();
      const MotionPlan plan = planMotion(touching_, MotionGoal(start), transfer_, from, cancellation_);
      if (!plan.feasible() && isLate()) return failLate(path);
      if (!plan.feasible())
        return fail(ToolPathStatus::no_transfer, path, 0., cat("there is no transfer to its start: ", plan.message));
      addTransfer(plan, path);
    }
    TimedPath timed;
    if (!time(tool, curve, joints, timed))
      return fail(ToolPathStatus::too_fast, path, 0., cat("there is no timing: ", timed.message));
    const double begin = parts_.empty() ? 0. : parts_.back().begin + parts_.back().timed.duration();
    const double in = timed.scaling().timeOf(curve.approachEnd()), out = timed.scaling().timeOf(curve.retractStart());
    const auto segment = [&](ToolSegment::Kind kind, double a, double b) {
      if (b > a) plan_.segments.push_back({kind, path, choice.reversed, begin + a, begin + b});
    };
    segment(ToolSegment::Kind::approach, 0., in);
    segment(ToolSegment::Kind::path, in, out);
    segment(ToolSegment::Kind::retract, out, timed.duration());
    addSlowStretches(timed, path, curve.approachEnd(), curve.retractStart(), timingLimits(curve), tool.model(),
                     speedOf(curve), plan_.slow);
    plan_.position_deviation = std::max(plan_.position_deviation, joints.position_deviation);
    plan_.rotation_deviation = std::max(plan_.rotation_deviation, joints.rotation_deviation);
    last_ = joints.pieces.eval(joints.pieces.length);
    parts_.push_back({begin, path, curve.approachEnd(), false, std::move(timed)});
    return true;
  }

  void addTransfer(const MotionPlan& plan, int path) {
    const double begin = parts_.empty() ? 0. : parts_.back().begin + parts_.back().timed.duration();
    plan_.segments.push_back({ToolSegment::Kind::transfer, path, false, begin, begin + plan.duration()});
    parts_.push_back({begin, path, 0., true, plan.timed_path});
  }

  /// The limits of the joints, and of the tool's way as one more dof.
  MotionLimits timingLimits(const ToolCurve& curve) const {
    MotionLimits limits = limits_;
    appendTo(limits, {curve.largestSpeed(options_.speed), options_.tool_acceleration, options_.tool_jerk});
    return limits;
  }

  /// The speed asked at s.
  std::function<double(double)> speedOf(const ToolCurve& curve) const {
    return [&curve, otherwise = options_.speed](double s) {
      const double speed = curve.speedAt(s);
      return speed > 0. ? speed : otherwise;
    };
  }

  bool time(ToolKinematics& tool, const ToolCurve& curve, const JointCurve& joints, TimedPath& timed) {
    const PathCurve way = withToolWay(tool, curve, joints.pieces);
    MatrixXd points(way.pieces() + 1, way.dofs());
    for (int k = 0; k <= way.pieces(); ++k)
      points.row(k) = way.eval(k < way.pieces() ? way.begin(k) : way.length()).transpose();
    const MotionLimits limits = timingLimits(curve);
    // Several speeds are the velocity limit of one more dof, for the time of this call.
    const bool several = !curve.speedChanges().empty();
    const PathCurve path = several ? withSpeedShare(way, speedOf(curve)) : way;
    MotionLimits all = limits;
    if (several) appendTo(all, {1., kUnlimited, kUnlimited});
    const auto timedOn = [&](int intervals) {
      RetimeOptions options;
      options.cancellation = cancellation_;
      options.intervals = intervals;
      TimedPath result = retimeTightly(points, path, all, options);
      if (!several || !result.feasible()) return result;
      return TimedPath::fromParts(result.status, result.message, points, result.times, way, result.scaling());
    };
    // A coarse grid leaves limits unused between its points: a finer one, by the share of the time that is lost.
    int intervals = std::max(kLeastTimingIntervals, path.pieces());
    const int most = std::max(kMostTimingIntervals, kFinest * path.pieces());
    timed = timedOn(intervals);
    while (timed.feasible() && intervals < most) {
      const double idle = idleShare(timed, limits, speedOf(curve));
      if (idle <= kIdle) break;
      intervals = std::min(most, intervals * (idle > kMuchIdle ? 4 : 2));
      TimedPath finer = timedOn(intervals);
      if (!finer.feasible() || finer.duration() >= timed.duration()) break;
      timed = std::move(finer);
    }
    return timed.feasible();
  }

  const Config& config_;
  const Config touching_;
  const std::vector<ToolPath>& paths_;
  const ToolPathOptions& options_;
  const CancellationToken& cancellation_;
  const ProgressCallback& progress_;
  EdgeChecker checker_;
  PlanOptions transfer_;
  MotionLimits limits_;
  Stopwatch clock_;
  std::vector<std::unique_ptr<ToolKinematics>> tools_;
  std::vector<ToolCurve> curves_;
  std::vector<PathSolutions> solutions_;
  std::vector<ToolPathPlan::Part> parts_;
  VectorXd last_;
  ToolPathPlan plan_;
};

}  // namespace

void ToolPathOptions::validate(int dofs) const {
  requirePositive("speed", speed);
  requirePositive("tool_acceleration", tool_acceleration);
  requirePositive("tool_jerk", tool_jerk);
  requireNotNegative("approach", approach);
  requireNotNegative("retract", retract);
  requireNotNegative("margin", margin);
  requireAtLeast("tolerance", tolerance, kLeastTolerance);
  requireAtLeast("rotation_tolerance", rotation_tolerance, kLeastRotationTolerance);
  const std::pair<const char*, const VectorXd*> limits[] = {
      {"velocity", &velocity}, {"acceleration", &acceleration}, {"jerk", &jerk}};
  for (const auto& [name, values] : limits) {
    if (values->size() > 1 && values->size() != dofs)
      throw ValueError(cat(kPlanToolPath, ": ", name, " has ", values->size(), " entries; expected 1 or ", dofs));
    for (const double value : *values) requirePositive(name, value);
  }
  const std::pair<const char*, const std::optional<VectorXd>*> configurations[] = {{"start", &start},
                                                                                   {"transfer_from", &transfer_from}};
  for (const auto& [name, q] : configurations)
    if (*q && ((*q)->size() != dofs || !(*q)->allFinite()))
      throw ValueError(
          cat(kPlanToolPath, ": ", name, " has ", (*q)->size(), " entries; expected ", dofs, " finite ones"));
}

ToolPathPlan planToolPath(const Config& config, const std::vector<ToolPath>& paths, const ToolPathOptions& options,
                          const CancellationToken& cancellation, const ProgressCallback& progress) {
  options.validate(config.getJointDimension());
  if (paths.empty()) throw ValueError("planToolPath: there are no paths; expected at least one");
  return ToolPathPlanner(config, paths, options, cancellation, progress).run();
}

}  // namespace kinegraph
