// A seam on a part at a constant speed, with an approach, a retract, and the place where a clamp is in the way.
#include <kinegraph/kinegraph.h>

#include <cmath>
#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("ur10e/ur10e.g"));
  C.addFrame("torch", "tool0").setShape(ShapeType::capsule, {.14, .012}).setRelativePosition({0., 0., .09});
  C.getFrame("torch").setContact(-2);
  C.addFrame("tip", "tool0").setRelativePosition({0., 0., .18});
  C.addFrame("part").setShape(ShapeType::ssBox, {.5, .3, .1, .005}).setPosition({.75, 0., .2}).setContact(1);

  // The seam is a wave on the top of the part, in its coordinates. The axis of the torch points into the part.
  MatrixXd points(401, 3), into(401, 3);
  for (int k = 0; k < 401; ++k) {
    const double x = -.2 + 1e-3 * k;
    points.row(k) << x, .06 * std::sin(12. * x), .052;
    into.row(k) << 0., 0., -1.;
  }
  const ToolPath seam = ToolPath::along("tip", points, into, "part").tilt(.26);
  const ToolPathOptions options{.speed = .05,
                                .approach = .05,
                                .retract = .05,
                                .acceleration = VectorXd{{8.}},
                                .jerk = VectorXd{{150.}},
                                .touching = {"part"}};
  const ToolPathPlan plan = planToolPath(C, {seam}, options);
  std::cout << plan.str() << "\n";
  if (!plan.feasible() || plan.position_deviation > 2e-5) return 1;
  for (const ToolSegment& s : plan.segments)
    std::cout << "  " << toolSegmentName(s.kind) << ": " << s.from << " to " << s.to << " s\n";
  plan.view(C, {seam});

  // A clamp on the seam: the plan says where and why, and has the motion up to there.
  C.addFrame("clamp", "part").setShape(ShapeType::ssBox, {.04, .3, .06, .002}).setRelativePosition({.12, 0., .09});
  C.getFrame("clamp").setContact(1);
  const ToolPathPlan blocked = planToolPath(C, {seam}, options);
  std::cout << blocked.message << "\n" << blocked.reached.rows() << " configurations lead there\n";
  blocked.view(C, {seam}, true);
  return blocked.status == ToolPathStatus::in_collision ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
