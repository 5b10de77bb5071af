// Pictures of plans and roadmaps in their scene.
#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/planning/roadmap.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/scene/frame_setters.h"

namespace kinegraph {

namespace {

constexpr double kDrawnStep = .1;  // between points of a line, in joint space
constexpr int kMostParts = 40;
using Color = std::array<std::uint8_t, 4>;
constexpr Color kBlue = {40, 110, 220, 255}, kOrange = {240, 140, 30, 255}, kGray = {120, 120, 120, 255},
                kGreen = {20, 160, 60, 255};

/// Returns one frame of each link without children.
std::vector<int> tips(const KinematicModel& model) {
  std::vector<char> ends(model.links.size(), 1);
  for (const KinematicModel::Link& link : model.links) ends[std::size_t(link.parent)] = 0;
  std::vector<int> frames;
  for (std::size_t l = 1; l < model.links.size(); ++l)
    if (ends[l]) frames.push_back(model.links[l].frame);
  return frames;
}

/// Traces of frames along edges, as lines in a copy of the scene.
class Drawing {
 public:
  Drawing(const Config& config, const JointSpace& space, const std::vector<std::string>& frames, const char* who)
      : picture_(config), space_(space), state_(config.state()) {
    if (config.getJointDimension() != space.dofs())
      throw ValueError(cat(who, ": the scene has ", config.getJointDimension(), " dofs; expected ", space.dofs(),
                           ", as the scene of the plan has"));
    const KinematicModel& model = *config.model();
    for (const std::string& name : frames) frames_.push_back(frameId(model, name, who));
    if (frames.empty()) frames_ = tips(model);
  }

  void addEdge(const VectorXd& from, const VectorXd& to) {
    const VectorXd change = space_.difference(from, to);
    const int parts = std::clamp(int(std::ceil(change.norm() / kDrawnStep)), 1, kMostParts);
    for (const int frame : frames_) {
      for (int i = 0; i <= parts; ++i) {
        const VectorXd q = from + double(i) / parts * change;
        state_.setJoints(q.data());
        points_.push_back(state_.position(frame));
        if (i > 0 && i < parts) points_.push_back(points_.back());
      }
    }
  }

  void addPath(const MatrixXd& path) {
    for (Eigen::Index k = 1; k < path.rows(); ++k) addEdge(path.row(k - 1).transpose(), path.row(k).transpose());
  }

  void addTree(const SearchTree& tree) {
    for (int i = 0; i < tree.size(); ++i)
      if (tree.node(i).parent >= 0) addEdge(tree.q(tree.node(i).parent), tree.q(i));
  }

  /// Adds a frame with the lines since the last call.
  void addLines(const std::string& name, const Color& color) {
    if (points_.empty()) return;
    Frame frame = picture_.addFrame(name);
    setLines(frame, points_, {color});
    points_.clear();
  }

  Config& picture() { return picture_; }

 private:
  Config picture_;
  const JointSpace& space_;
  State state_;
  std::vector<int> frames_;
  std::vector<Vector3d> points_;
};

}  // namespace

Config MotionPlan::picture(const Config& config, const std::vector<std::string>& frames) const {
  Drawing drawing(config, *space, frames, "MotionPlan.picture");
  for (std::size_t i = 0; i < trees.size(); ++i) {
    drawing.addTree(trees[i]);
    drawing.addLines(i == 0 ? "start tree" : "goal tree", i == 0 ? kBlue : kOrange);
  }
  drawing.addPath(raw_path);
  drawing.addLines("raw path", kGray);
  drawing.addPath(path);
  drawing.addLines("path", kGreen);
  if (!feasible() && !obstacles.empty()) drawing.picture().getFrame(obstacles.front().frame).setColor({1., 0., 0.});
  return std::move(drawing.picture());
}

Config Roadmap::picture(const Config& config, const std::vector<std::string>& frames) const {
  Drawing drawing(config, *space_, frames, "Roadmap.picture");
  for (const auto& [a, b] : edgeEnds()) drawing.addEdge(nodes_[std::size_t(a)], nodes_[std::size_t(b)]);
  drawing.addLines("roadmap", kBlue);
  return std::move(drawing.picture());
}

}  // namespace kinegraph
