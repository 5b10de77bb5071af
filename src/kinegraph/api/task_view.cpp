// Shows plans of tasks in the viewer: the motion, or the waypoint at which the search failed.
#include <algorithm>
#include <cmath>

#include "kinegraph/api/task_view.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/config_viewer.h"

namespace kinegraph {

namespace {

constexpr double kMoved = 1e-3;  ///< m, or component of a quaternion: frames that moved less get no red copy
const std::vector<double> kRed = {.9, .2, .2, .4};

/// Sets q in `scene`, that of an action with held objects attached, and moves the frames of C to the same poses.
void followScene(Config& C, Config& scene, const VectorXd& q) {
  scene.setJointState(q);
  C.setJointState(q);
  for (Frame& frame : C.getFrames())
    if (!frame.getParent() || frame.getJointType() == JointType::rigid)
      frame.setPose(scene.getFrame(frame.getName()).getPose());
}

}  // namespace

void api_internal::playTask(const TaskPlan& plan, Config& C, bool pause, const ShowScene& show) {
  plan.requireScenes("play");
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    const std::string text = planText({plan.actions[i]});
    if (pause) show(true, text);
    Config scene = plan.scenes[i];
    for (Eigen::Index row = plan.segments[i].begin; row < plan.segments[i].end; ++row) {
      followScene(C, scene, plan.path.row(row));
      show(false, text);
    }
  }
}

void TaskPlan::play(Config& C, bool pause) const {
  playTask(*this, C, pause, [&](bool wait, const std::string& text) { return C.view(wait, text); });
}

std::vector<MatrixXd> TaskPlan::frames(const Config& C, double rate) const {
  requireScenes("frames");
  if (!(rate > 0.)) throw ValueError(cat("TaskPlan.frames: rate is ", rate, " Hz; expected a positive number"));
  Config shown = C;
  std::vector<Config> there = scenes;
  std::vector<MatrixXd> poses;
  const long last = std::max(2L, std::lround(duration() * rate)) - 1;
  std::size_t part = 0;
  for (long k = 0; k <= last; ++k) {
    const double t = k == last ? duration() : duration() * double(k) / double(last);
    while (part < segments.size() && t > times[segments[part].end - 1]) ++part;
    if (part < segments.size()) followScene(shown, there[part], eval(t).q);
    poses.push_back(shown.getFrameState());
  }
  return poses;
}

const TaskBranch* api_internal::farthestFailed(const TaskPlan& plan) {
  const TaskBranch* farthest = nullptr;
  for (const TaskBranch& branch : plan.tree)
    if (branch.failed_configuration && (!farthest || branch.actions.size() > farthest->actions.size()))
      farthest = &branch;
  return farthest;
}

Config TaskPlan::failedConfiguration(const Config& C) const {
  const TaskBranch* farthest = farthestFailed(*this);
  if (!farthest) throw ValueError(cat("TaskPlan.failedConfiguration: no branch failed at a waypoint; ", summary()));
  Config scene = C;
  for (const Frame& frame : C.getFrames()) {
    const Frame there = farthest->failed_configuration->getFrame(frame.getName());
    const Pose is = frame.getPose(), was = there.getPose();
    const double moved =
        std::max((is.p - was.p).cwiseAbs().maxCoeff(), (is.q.coeffs() - was.q.coeffs()).cwiseAbs().maxCoeff());
    const ShapeType type = frame.getShapeType();
    if (!(moved > kMoved) || type == ShapeType::none || type == ShapeType::marker) continue;
    Frame copy = scene.addFrame(cat("failed ", frame.getName())).setPose(was);
    copy.setGeometry(*frame.data().shape->geometry).setColor(kRed).setContact(0);
  }
  return scene;
}

ShownMotion api_internal::taskMotion(const TaskPlan& plan, const Config& C) {
  constexpr double kRate = 25.;  // slices per second
  ShownMotion motion;
  motion.seconds = std::max(plan.duration(), 1e-3);
  motion.start = ShownMotion::Start::play;
  const std::vector<MatrixXd> frames = plan.frames(C, kRate);
  std::size_t part = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    std::vector<Pose>& slice = motion.poses.emplace_back();
    for (const auto& row : frames[k].rowwise())
      slice.push_back({row.head<3>().transpose(), Quaterniond(row[3], row[4], row[5], row[6])});
    const double t = plan.duration() * double(k) / double(frames.size() - 1);
    while (part + 1 < plan.segments.size() && t > plan.times[plan.segments[part].end - 1]) ++part;
    motion.texts.push_back(plan.actions.empty() ? "" : planText({plan.actions[part]}));
  }
  return motion;
}

Config api_internal::failedScene(const TaskPlan& plan, const Config& C) {
  return farthestFailed(plan) ? plan.failedConfiguration(C) : Config(C);
}

int TaskPlan::view(Config& C, bool pause) const {
  ConfigViewer& viewer = C.viewer();
  const auto never = [] { return false; };
  if (path.rows() > 0) return viewer.showMotion(C, taskMotion(*this, C), pause, str(), never);
  Config shown = failedScene(*this, C);
  return viewer.view(shown, pause, cat(message, "\n", searchTree()), never);
}

}  // namespace kinegraph
