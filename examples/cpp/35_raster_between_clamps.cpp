// A raster on a cylinder between clamps; the tool leans within a cone, and turns as it likes about its axis.
#include <kinegraph/kinegraph.h>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace kinegraph;

namespace {

constexpr double kRadius = .12;

/// Lines along the drum, which half circles connect: places along the axis, and angles from the top.
std::vector<std::pair<double, double>> rasterOnDrum() {
  std::vector<std::pair<double, double>> surface;
  const double pitch = .8 / 6.;
  for (int line = 0; line < 7; ++line) {
    const double angle = -.5 + pitch * line, side = line % 2 == 0 ? 1. : -1.;
    for (int k = 0; k <= 100; ++k) surface.emplace_back(side * (-.1 + .002 * k), angle);
    for (int k = 1; k < 29 && line < 6; ++k) {
      const double turn = std::numbers::pi * k / 29.;
      surface.emplace_back(side * (.1 + .5 * pitch * kRadius * std::sin(turn)),
                           angle + .5 * pitch * (1. - std::cos(turn)));
    }
  }
  return surface;
}

}  // namespace

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("pen", "l_gripper").setShape(ShapeType::capsule, {.06, .008}).setRelativePosition({0., 0., -.032});
  C.getFrame("pen").setContact(-2);
  C.addFrame("tool", "l_gripper").setRelativePosition({0., 0., -.08});
  C.addFrame("drum", "table").setShape(ShapeType::cylinder, {.3, kRadius - .01}).setContact(1);
  C.getFrame("drum").setRelativePose(
      Pose(Vector3d(0., .45, .22), Quaterniond(Eigen::AngleAxisd(.5 * std::numbers::pi, Vector3d::UnitY()))));
  for (const double x : {-.05, .07}) {
    Frame clamp = C.addFrame(x < 0. ? "clamp 0" : "clamp 1", "table");
    clamp.setShape(ShapeType::ssBox, {.015, .06, .05, .002}).setRelativePosition({x, .345, .33}).setContact(1);
  }
  const std::vector<std::pair<double, double>> surface = rasterOnDrum();
  MatrixXd points(Eigen::Index(surface.size()), 3), normals(points.rows(), 3);
  for (Eigen::Index k = 0; k < points.rows(); ++k) {
    const auto [x, angle] = surface[std::size_t(k)];
    normals.row(k) << 0., std::sin(angle), std::cos(angle);
    points.row(k) = kRadius * normals.row(k) + Eigen::RowVector3d(x, 0., 0.);
  }
  points.rowwise() += C.getFrame("drum").getPosition().transpose();
  const ToolPath raster = ToolPath::along("tool", points, normals).tilt(.35);
  const ToolPathPlan plan = planToolPath(C, {raster},
                                         {.speed = .1,
                                          .approach = .03,
                                          .retract = .03,
                                          .margin = .002,
                                          .acceleration = VectorXd{{6.}},
                                          .jerk = VectorXd{{120.}}});
  std::cout << plan.str() << "\n";
  if (!plan.feasible()) return 1;
  for (const SlowStretch& s : plan.slow)
    std::cout << "  " << s.from << " to " << s.to << " m: " << s.speed << " m/s, " << s.cause << "\n";
  plan.view(C, {raster}, true);
  return firstContact(C, plan, .0019) ? 1 : 0;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
