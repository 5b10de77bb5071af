#include "kinegraph/task_planning/search/step_tolerance.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kLifted = kHoldingForce;  ///< N: half of the friction of both fingers is to spare
constexpr double kApproach = .08;          ///< m: up to this distance of a hand from its end it approaches an object
constexpr Eigen::Index kEvery = 8;         ///< rows of a path that are left out between two

/// Some rows of a path, its ends included.
MatrixXd sampled(const MatrixXd& path) {
  const Eigen::Index last = path.rows() - 1, count = last / kEvery;
  MatrixXd rows(count + 2, path.cols());
  for (Eigen::Index k = 0; k <= count; ++k) rows.row(k) = path.row(k * kEvery);
  rows.row(count + 1) = path.row(last);
  return rows;
}

/// Says why the weight of an object turns it in a hand; "" if it does not.
std::string turnText(double lever, double most) {
  if (lever <= most) return "";
  return cat(": its center of mass is ", fixed(1e3 * lever, 0), " mm beside the fingers, which withstand ",
             fixed(1e3 * most, 0), " mm");
}

void lower(StepTolerance& tolerance, double error, const std::string& limit) {
  if (error < tolerance.error) tolerance = {error, limit};
}

/// Lowers a tolerance to the least distance of a hand from the object that it takes, also on the way.
void lowerByHand(StepTolerance& tolerance, Config scene, const MatrixXd& path, const TaskAction& action) {
  const MatrixXd rows = sampled(path);
  const auto handAt = [&](Eigen::Index row) {
    scene.setJointState(rows.row(row));
    return scene.getFrame(action[3]).getPosition();
  };
  const Vector3d end = handAt(rows.rows() - 1);
  std::vector<std::string> hand = fingerShapes(scene, action[3]);
  const std::string palm = palmOf(scene, action[3]);
  const auto collides = [](const FrameData& data) { return data.shape && data.shape->contact != 0; };
  if (!hand.empty() && !palm.empty() && collides(scene.getFrame(palm).data())) hand.push_back(palm);
  const std::vector<Frame> parts = shapesOf(scene.getFrame(action[1]));
  for (Eigen::Index row = rows.rows() - 1; row >= 0; --row) {
    if ((handAt(row) - end).norm() > kApproach) continue;
    for (const std::string& shape : hand)
      for (const Frame& part : parts)
        if (part.data().shape->contact)
          lower(tolerance, std::max(gapOf(scene, shape, part.getName()), 0.),
                cat("'", shape, "' meets '", part.getName(), "'"));
  }
}

}  // namespace

StepTolerance toleranceOf(const Config& C, const Surroundings& around, const MatrixXd& path, const TaskAction& action,
                          const std::vector<std::string>& hands) {
  StepTolerance tolerance{kMaxTolerance, ""};
  const NearBodies near = around.nearest(sampled(path), kMaxTolerance, true);
  if (!near.a.empty()) lower(tolerance, std::max(near.distance, 0.), cat("'", near.a, "' meets '", near.b, "'"));
  Config end = C;
  end.setJointState(path.row(path.rows() - 1));
  if (action.size() < 4 || !end.findFrame(action[1])) return tolerance;
  if (isPick(action) && std::ranges::find(hands, action[3]) != hands.end()) {
    lowerByHand(tolerance, end, path, action);
    const Frame obj = end.getFrame(action[1]), hand = end.getFrame(action[3]);
    const double mass = massOfBody(obj), most = kLifted / kGravity.norm();
    if (opening(end, action[3]) && mass > most)
      lower(tolerance, 0.,
            cat("'", action[1], "' (", fixed(mass, 1), " kg) slips out of '", action[3], "', which lifts ",
                fixed(most, 1), " kg"));
    if (opening(end, action[3]))
      lower(tolerance, std::max(leverOf(obj) - leverIn(hand, obj), 0.),
            cat("'", action[1], "' turns in '", action[3], "'", turnText(leverIn(hand, obj), leverOf(obj))));
  } else if (action[0] == "place" && end.findFrame(action[3])) {
    const Frame obj = end.getFrame(action[1]);
    lower(tolerance, std::max(supportOf(obj, end.getFrame(action[3])), 0.),
          cat("'", action[1], isBall(obj) ? "' rolls off" : "' falls over"));
  }
  return tolerance;
}

}  // namespace kinegraph::inline task_planning_internal
