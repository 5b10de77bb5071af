// What a plan of a task looks like: its motion, and where the search failed.
#include <algorithm>
#include <cmath>

#include "kinegraph/api/task_view.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kMoved = 1e-3;  ///< m or of a quaternion: what moved less than that is no ghost
const std::vector<double> kRed = {.9, .2, .2, .4};

}  // namespace

void showTask(Config& C, Config& scene, const VectorXd& q) {
  scene.setJointState(q);
  C.setJointState(q);
  for (Frame& frame : C.getFrames())
    if (!frame.getParent() || frame.getJointType() == JointType::rigid)
      frame.setPose(scene.getFrame(frame.getName()).getPose());
}

void TaskPlan::play(Config& C, bool pause) const {
  requireMotion("play");
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::string text = planText({actions[i]});
    if (pause) C.view(true, text);
    Config scene = scenes[i];
    for (Eigen::Index row = segments[i].begin; row < segments[i].end; ++row) {
      showTask(C, scene, path.row(row));
      C.view(false, text);
    }
  }
}

std::vector<MatrixXd> TaskPlan::frames(const Config& C, double rate) const {
  requireMotion("frames");
  Config shown = C;
  std::vector<Config> there = scenes;
  std::vector<MatrixXd> poses;
  const long last = std::max(2L, std::lround(duration() * rate)) - 1;
  std::size_t part = 0;
  for (long k = 0; k <= last; ++k) {
    const double t = k == last ? duration() : duration() * double(k) / double(last);
    while (part < segments.size() && t > times[segments[part].end - 1]) ++part;
    if (part < segments.size()) showTask(shown, there[part], at(t));
    poses.push_back(shown.getFrameState());
  }
  return poses;
}

Config TaskPlan::failedConfiguration(const Config& C) const {
  const TaskBranch* farthest = nullptr;
  for (const TaskBranch& branch : tree)
    if (branch.ghost && (!farthest || branch.actions.size() > farthest->actions.size())) farthest = &branch;
  if (!farthest) throw ValueError(cat("view: no branch failed at a waypoint; ", message));
  Config scene = C;
  for (const Frame& frame : C.getFrames()) {
    const Frame there = farthest->ghost->getFrame(frame.getName());
    const Pose is = frame.getPose(), was = there.getPose();
    const double moved =
        std::max((is.p - was.p).cwiseAbs().maxCoeff(), (is.q.coeffs() - was.q.coeffs()).cwiseAbs().maxCoeff());
    const ShapeType type = frame.getShapeType();
    if (!(moved > kMoved) || type == ShapeType::none || type == ShapeType::marker) continue;
    Frame copy = scene.addFrame(cat("ghost of ", frame.getName())).setPose(was);
    copy.setGeometry(*frame.data().shape->geometry).setColor(kRed).setContact(0);
  }
  return scene;
}

int TaskPlan::view(Config& C, bool pause) const {
  if (path.rows() == 0) return failedConfiguration(C).view(pause, cat(message, "\n", searchTree()));
  const MatrixXd before = C.getFrameState();
  play(C);
  const int key = C.view(pause, str());
  C.setFrameState(before);
  return key;
}

}  // namespace kinegraph
