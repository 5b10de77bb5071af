#include "kinegraph/tool_paths/plan_tool_path.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/ik/target_questions.h"
#include "kinegraph/planning/arrive_moving.h"
#include "kinegraph/planning/plan_motion.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/tool_paths/path_order.h"
#include "kinegraph/tool_paths/path_search.h"
#include "kinegraph/tool_paths/path_timing.h"
#include "kinegraph/tool_paths/slow_stretches.h"

namespace kinegraph {

namespace {

constexpr double kFitShare = .25, kRotationFitShare = .625;  // of the tolerances, for fitting rows
constexpr std::size_t kManyCorners = 20;
constexpr int kSolutionsPerPath = 3, kBranches = 8;  // for transfers and orders; the latter of arms without freedom
constexpr std::int64_t kQuickEvaluations = 20000;    // for transfers between which there is a choice
constexpr double kLeastTime = 1e-3;                  // s, of a transfer
constexpr double kLeastTolerance = 1e-6, kLeastRotationTolerance = 4e-6;  // m and rad that splines of joints keep
constexpr double kFlows[] = {1., .5, .25};  // start speeds that are tried, of the largest one
constexpr const char* kPlanToolPath = "planToolPath";

void requirePositive(const char* name, double value) {
  if (!(value > 0.)) throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected a number > 0"));
}

void requireNotNegative(const char* name, double value) {
  if (!(value >= 0.) || !std::isfinite(value))
    throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected a finite number >= 0"));
}

void requireAtLeast(const char* name, double value, double least) {
  if (!(value >= least) || !std::isfinite(value))
    throw ValueError(cat(kPlanToolPath, ": ", name, " is ", value, "; expected a finite number of at least ", least));
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

/// Asks whether lengths of a path are in mm; "" if they are such as a robot has.
std::string questionAbout(const ToolPath& path) {
  for (const ToolPathElement& element : path.elements())
    for (const ToolWaypoint& waypoint : element.waypoints)
      if (const std::string question = askAboutLength(waypoint.p, waypoint.p.norm()); !question.empty())
        return question;
  return "";
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
    plan_.setParts({}, config.getJointDimension());
    transfer_.margin = options.margin;
    transfer_.velocity = options.velocity, transfer_.acceleration = options.acceleration, transfer_.jerk = options.jerk;
    transfer_.seed = options.seed;
    limits_ = planLimits(config, transfer_);
    transfer_.velocity = limits_.velocity, transfer_.acceleration = limits_.acceleration;
  }

  ToolPathPlan run() {
    try {
      if (!solveAll()) return std::move(plan_);
    } catch (const Cancelled&) {
      if (!isLate()) throw;
      failLate(int(curves_.size()) - 1);
      return std::move(plan_);
    }
    const PathSequence sequence = sequenceOf();
    if (!sequence.feasible && isLate()) {
      failLate(0);
      return std::move(plan_);
    }
    for (std::size_t k = 0; k < sequence.order.size(); ++k)
      if (!addPath(sequence, k)) return std::move(plan_);
    report(2 * paths_.size());
    plan_.status = ToolPathStatus::solved;
    plan_.setParts(std::move(parts_), config_.getJointDimension());
    return std::move(plan_);
  }

 private:
  /// Each path counts twice: it is searched, then timed with its transfer.
  void report(std::size_t done) const {
    if (progress_) progress_({int(done), int(2 * paths_.size())});
  }

  bool solveAll() {
    const ToolTolerance fit{kFitShare * options_.tolerance, kRotationFitShare * options_.rotation_tolerance};
    const bool several = paths_.size() > 1 || options_.transfer_from.has_value();
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      report(k);
      if (isLate()) return failLate(int(k));
      tools_.push_back(std::make_unique<ToolKinematics>(touching_, paths_[k]));
      ToolKinematics& tool = *tools_.back();
      const VectorXd present = config_.getJointState();
      const Pose now(tool.pose(present));
      const std::optional<ToolWaypoint>& first = paths_[k].first();
      const double side = tool.side(first ? Pose{first->p, first->rotation.value_or(now.q)} : now);
      curves_.emplace_back(paths_[k], now, fit, side * options_.approach, side * options_.retract);
      for (const std::string& warning : paths_[k].warnings()) plan_.warnings.push_back(warning);
      for (const std::string& warning : curves_.back().warnings())
        plan_.warnings.push_back(cat("path ", k, ": ", warning));
      if (const std::size_t corners = curves_.back().corners().size(); corners >= kManyCorners)
        plan_.warnings.push_back(cat("path ", k, ": the tool stops at ", corners, " corners; `blend` rounds them"));
      PathSearchSettings settings;
      settings.limits = {limits_.velocity, limits_.acceleration, curves_.back().largestSpeed(options_.speed)};
      settings.tolerance = {options_.tolerance, options_.rotation_tolerance};
      settings.seed = options_.seed;
      const bool is_free = tool.rows() != ToolRows::pose || tool.movingDofs() > 6;
      settings.wanted = !several ? 1 : is_free ? kSolutionsPerPath : kBranches;
      settings.cancellation = [this] { return cancellation_() || isLate(); };
      settings.first = {present};
      if (k == 0 && options_.start) settings.first = {*options_.start}, settings.only_first = true;
      // Solutions near those of the path before shorten the transfers.
      if (k > 0)
        for (const JointCurve& curve : solutions_[k - 1].curves) settings.first.push_back(curve.pieces.eval(0.));
      solutions_.push_back(searchPath(tool, curves_.back(), checker_, settings));
      if (!solutions_.back().curves.empty()) {
        if (settings.only_first) warnOfStart(tool);
        continue;
      }
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

  /// The motion begins on the path, next to a `start` that is not there.
  void warnOfStart(ToolKinematics& tool) {
    const double off = tool.miss(*options_.start, curves_[0].at(0.)).p.norm();
    if (off > options_.tolerance)
      plan_.warnings.push_back(cat("path 0: at `start`, the tool is ", numberText(off, 3),
                                   " m from the beginning of the path, where the motion begins"));
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
    const bool asks = failure.status == ToolPathStatus::out_of_reach && failure.text.find("mm") == std::string::npos;
    const std::string question = asks ? questionAbout(paths_[std::size_t(path)]) : "";
    const std::string text = question.empty() ? failure.text : cat(failure.text, "; ", question);
    return fail(failure.status, path, failure.place - curves_.back().approachEnd(), text + more);
  }

  PathSequence sequenceOf() {
    const bool both = options_.free_order && options_.approach == options_.retract;
    std::vector<std::vector<PathVariant>> variants;
    for (std::size_t path = 0; path < solutions_.size(); ++path) {
      const std::vector<JointCurve>& curves = solutions_[path].curves;
      variants.emplace_back();
      for (int k = 0; k < int(curves.size()); ++k) {
        const JointCurve& joints = curves[std::size_t(k)];
        const VectorXd first = joints.pieces.eval(0.), last = joints.pieces.eval(joints.pieces.length);
        const PathTiming timing(*tools_[path], curves_[path], joints, limits_, options_, cancellation_);
        const double duration = curves.size() > 1 ? timing.estimatedDuration() : 0.;
        variants.back().push_back({k, false, first, last, duration});
        if (both) variants.back().push_back({k, true, last, first, duration});
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
    report(paths_.size() + position);
    const OrderedPath& choice = sequence.order[position];
    const int path = choice.path;
    ToolKinematics& tool = *tools_[std::size_t(path)];
    const JointCurve& solved = solutions_[std::size_t(path)].curves[std::size_t(choice.solution)];
    const JointCurve joints = choice.reversed ? reversed(solved) : solved;
    const ToolCurve curve = choice.reversed ? curves_[std::size_t(path)].reversed() : curves_[std::size_t(path)];
    const VectorXd start = joints.pieces.eval(0.);
    std::optional<VectorXd> from = options_.transfer_from;
    if (position > 0) from = last_;
    std::optional<MotionPlan> transfer;
    if (sequence.feasible) {
      transfer = sequence.transfers[position];
    } else if (from && (start - *from).cwiseAbs().maxCoeff() >= kSameConfiguration) {
      transfer_.time_limit = timeLeft();
      transfer = planMotion(touching_, MotionGoal(start), transfer_, from, cancellation_);
      if (!transfer->feasible() && isLate()) return failLate(path);
      if (!transfer->feasible())
        return fail(ToolPathStatus::no_transfer, path, 0.,
                    cat("there is no transfer to its start: ", transfer->message));
    }
    const PathTiming timing(tool, curve, joints, limits_, options_, cancellation_);
    TimedPath timed = timing.timed();
    if (!timed.feasible()) return fail(ToolPathStatus::too_fast, path, 0., cat("there is no timing: ", timed.message));
    const bool flows =
        options_.flow == TransferFlow::path || (options_.flow == TransferFlow::approach && curve.approachEnd() > 0.);
    if (transfer && flows) flowInto(timing, joints, *transfer, timed);
    if (transfer) addTransfer(*transfer, path);
    addSlowStretches(
        timed, path, curve.approachEnd(), curve.retractStart(), timing.limits(), tool.model(),
        [&timing](double s) { return timing.speedAt(s); }, plan_.slow);
    plan_.position_deviation = std::max(plan_.position_deviation, joints.position_deviation);
    plan_.rotation_deviation = std::max(plan_.rotation_deviation, joints.rotation_deviation);
    last_ = joints.pieces.eval(joints.pieces.length);
    addTimed(std::move(timed), curve, path, choice.reversed);
    return true;
  }

  double end() const { return parts_.empty() ? 0. : parts_.back().begin + parts_.back().timed.duration(); }

  void addTransfer(const MotionPlan& plan, int path) {
    plan_.segments.push_back({ToolSegment::Kind::transfer, path, false, end(), end() + plan.duration()});
    for (const std::string& warning : plan.warnings)
      plan_.warnings.push_back(cat("transfer to path ", path, ": ", warning));
    parts_.push_back({end(), path, 0., true, plan.timed_path});
  }

  void addTimed(TimedPath timed, const ToolCurve& curve, int path, bool is_reversed) {
    const double begin = end(), in = timed.scaling().timeOf(curve.approachEnd()),
                 out = timed.scaling().timeOf(curve.retractStart());
    const auto segment = [&](ToolSegment::Kind kind, double a, double b) {
      if (b > a) plan_.segments.push_back({kind, path, is_reversed, begin + a, begin + b});
    };
    segment(ToolSegment::Kind::approach, 0., in);
    segment(ToolSegment::Kind::path, in, out);
    segment(ToolSegment::Kind::retract, out, timed.duration());
    parts_.push_back({begin, path, curve.approachEnd(), false, std::move(timed)});
  }

  /// Replaces a transfer and the path behind it by those that meet with a speed, if that takes less time.
  void flowInto(const PathTiming& timing, const JointCurve& joints, MotionPlan& transfer, TimedPath& timed) {
    const double fastest = timing.fastestStart();
    for (const double share : kFlows) {
      const double speed = share * fastest;
      TimedPath moving = timing.timed(speed);
      if (!moving.feasible()) continue;
      PlanOptions options = transfer_;
      options.end_velocity = speed * joints.pieces.eval(0., 1);
      if (limits_.limitsJerk()) options.end_acceleration = speed * speed * joints.pieces.eval(0., 2);
      std::optional<MotionPlan> flowing = arriveMoving(touching_, transfer, options, cancellation_);
      if (!flowing || flowing->duration() + moving.duration() >= transfer.duration() + timed.duration()) continue;
      transfer = std::move(*flowing), timed = std::move(moving);
      return;
    }
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

TransferFlow transferFlowOfName(const std::string& name) {
  static const std::vector<std::string> names = {"none", "approach", "path"};
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw ValueError(
        cat(kPlanToolPath, ": flow is '", name, "'; expected one of ", join(names), similarHint(name, names)));
  return TransferFlow(found - names.begin());
}

void ToolPathOptions::validate(int dofs) const {
  requirePositive("speed", speed);
  requirePositive("tool_acceleration", tool_acceleration);
  requirePositive("tool_jerk", tool_jerk);
  requirePositive("time_limit", time_limit);
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
