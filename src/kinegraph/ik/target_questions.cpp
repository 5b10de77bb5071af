#include "kinegraph/ik/target_questions.h"

#include <cmath>

#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline ik_internal {

namespace {

constexpr double kSame = .1, kOther = 1.;  // rad
constexpr double kMissed = 10.;            // m
constexpr double kPlain = .999;            // a unit quaternion such as 1 0 0 0 is meant as it is

}  // namespace

Quaterniond readAsXyzw(const Quaterniond& rotation) { return {rotation.z(), rotation.w(), rotation.x(), rotation.y()}; }

std::string askAboutOrder(const IkTask& task, const State& present) {
  if (!task.hasRotation() || !task.target.taken_from.empty()) return "";
  const Quaterniond given = task.target.pose.q.normalized();
  if (given.coeffs().cwiseAbs().maxCoeff() > kPlain) return "";
  Quaterniond now(present.pose(task.frame).R);
  if (task.reference >= 0) now = Quaterniond(present.pose(task.reference).R).conjugate() * now;
  if (now.angularDistance(readAsXyzw(given)) > kSame || now.angularDistance(given) < kOther) return "";
  return cat("the quaternion of ", task.name(), " is read as w x y z; did you mean x y z w? So read, it is ",
             numberText(now.angularDistance(readAsXyzw(given)), 3), " rad from the present rotation, and not ",
             numberText(now.angularDistance(given), 3), " rad");
}

std::string askAboutLength(const Vector3d& position, double missed_by) {
  if (missed_by < kMissed || !isMillimeterPosition(position[0], position[1], position[2])) return "";
  Eigen::Index most = 0;
  position.cwiseAbs().maxCoeff(&most);
  return askForMeters(position[most]);
}

}  // namespace kinegraph::inline ik_internal
