#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/perception/register_scene.h"

namespace kinegraph {

std::string seenStatusName(SeenStatus status) {
  switch (status) {
    case SeenStatus::seen:
      return "seen";
    case SeenStatus::occluded:
      return "occluded";
    case SeenStatus::not_in_view:
      return "not_in_view";
    case SeenStatus::not_there:
      return "not_there";
    default:
      return "not_found";
  }
}

Prior priorFromName(const std::string& name) {
  if (name == "last") return Prior::last;
  if (name == "anywhere") return Prior::anywhere;
  throw ValueError(cat("registerScene: prior is '", name, "'; expected 'last' or 'anywhere'"));
}

Estimate estimateFromName(const std::string& name) {
  if (name == "camera") return Estimate::camera;
  if (name == "joints") return Estimate::joints;
  throw ValueError(cat("registerScene: estimate has '", name, "'; expected 'camera' or 'joints'"));
}

std::string SeenFrame::str() const {
  std::string text = seenStatusName(status);
  if (status == SeenStatus::occluded) text += cat(" by ", by.empty() ? "something unknown" : cat("'", by, "'"));
  if (status == SeenStatus::seen) {
    text += cat(" at ", pose.p.x(), " ", pose.p.y(), " ", pose.p.z(), " (", int(std::lround(100. * visible)),
                " % visible)");
    if (free_directions.rows() > 0) text += cat(", ", free_directions.rows(), " free directions");
    if (!alternatives.empty()) text += cat(", ", alternatives.size(), " alternatives");
  }
  if (!may_be.empty()) text += cat(", may be exchanged with '", join(may_be, "', '"), "'");
  return text;
}

std::string SeenScene::str() const {
  std::vector<std::string> lines;
  for (const auto& [name, frame] : frames) lines.push_back(cat(name, ": ", frame.str()));
  for (std::size_t k = 0; k < cameras.size(); ++k) {
    const VectorXd variances = cameras[k].covariance.diagonal();
    lines.push_back(cat("camera of view ", k, " within ", 1e3 * std::sqrt(variances.head(3).sum()), " mm and ",
                        std::sqrt(variances.tail(3).sum()), " rad"));
  }
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const auto at = Eigen::Index(i);
    lines.push_back(cat(joints[i], ": offset ", joint_offsets[at], " within ", std::sqrt(joint_covariance(at, at))));
  }
  for (const std::string& warning : warnings) lines.push_back(cat("warning: ", warning));
  return join(lines, "\n");
}

}  // namespace kinegraph
