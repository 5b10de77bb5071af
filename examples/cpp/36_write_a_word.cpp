// Writing a word, in strokes with their own speed.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

namespace {

constexpr double kUp = .03, kDown = .002;  // m above the paper

/// Down, along the points, and up again.
ToolPath stroke(const std::vector<Eigen::Vector2d>& points) {
  const auto at = [](const Eigen::Vector2d& p, double height) { return Vector3d(p[0], p[1], height); };
  ToolPath path("tip", "paper");
  path.free().start(at(points.front(), kUp)).speed(.05).line(at(points.front(), kDown)).speed(.1);
  for (std::size_t k = 1; k < points.size(); ++k) path.line(at(points[k], kDown), k > 1 ? .004 : 0.);
  return path.speed(0.).line(at(points.back(), kUp));
}

}  // namespace

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("pen", "l_gripper").setShape(ShapeType::capsule, {.06, .008}).setRelativePosition({0., 0., -.032});
  C.getFrame("pen").setContact(-2);
  C.addFrame("tip", "l_gripper").setRelativePosition({0., 0., -.08});
  C.addFrame("paper", "table").setShape(ShapeType::box, {.4, .2, .001}).setRelativePosition({0., .35, .051});
  ToolPath shoulder("tip", "paper");
  shoulder.free().start(Vector3d(-.1, .03, kUp)).speed(.1).line(Vector3d(-.1, .03, kDown));
  shoulder.arc({-.085, .047, kDown}, Vector3d(-.065, .05, kDown)).speed(0.).line(Vector3d(-.065, .05, kUp));
  const std::vector<ToolPath> word = {stroke({{-.1, .05}, {-.1, 0.}}), shoulder, stroke({{-.03, .05}, {-.005, 0.}}),
                                      stroke({{.02, .05}, {-.005, 0.}, {-.02, -.03}})};
  const ToolPathPlan plan = planToolPath(
      C, word,
      {.speed = .3, .acceleration = VectorXd{{6.}}, .jerk = VectorXd{{120.}}, .transfer_from = C.getJointState()});
  std::cout << plan.str() << "\n";
  if (!plan.feasible()) return 1;
  for (double t = 0.; t < plan.duration(); t += .01)
    if (plan.speed(t) > .3 * 1.001) return 1;
  plan.view(C, word, true);
  return 0;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
