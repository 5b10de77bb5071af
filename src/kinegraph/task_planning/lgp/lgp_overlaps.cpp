#include "kinegraph/task_planning/lgp/lgp_overlaps.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "kinegraph/common/text.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kDepth = 1e-3;  ///< m

/// The objects and the fixed parts of a scene.
class SceneParts {
 public:
  explicit SceneParts(const Config& C) : C_(C) {
    for (const Frame& frame : C.getFrames()) {
      const JointType joint = frame.getJointType();
      if (joint == JointType::none || joint == JointType::rigid) continue;
      for (std::optional<Frame> above = frame; above; above = above->getParent())
        carries_joint_.insert(above->getName());
      if (!isAnObject(frame)) moving_.insert(frame.getName());
    }
    for (const auto& pair : C.getCollisions(-kDepth)) overlapping_.insert({pair.a, pair.b});
  }

  /// The object that a frame belongs to; empty for robots and fixed parts. A robot may stand on a rigid joint.
  std::string object(const std::string& name) const {
    for (std::optional<Frame> frame = find(name); frame; frame = frame->getParent()) {
      if (isAnObject(*frame)) return frame->getName();
    }
    return {};
  }

  /// Whether a frame is fixed to the world.
  bool isFixed(const std::string& name) const {
    for (std::optional<Frame> frame = find(name); frame; frame = frame->getParent()) {
      if (moving_.contains(frame->getName())) return false;
    }
    return true;
  }

  bool overlapsAtOnce(const std::string& a, const std::string& b) const {
    const std::optional<Frame> first = find(a), second = find(b);
    if (!first || !second) return false;
    const int i = first->data().id, k = second->data().id;
    return overlapping_.contains({std::min(i, k), std::max(i, k)});
  }

 private:
  bool isAnObject(const Frame& frame) const {
    const JointType joint = frame.getJointType();
    return joint == JointType::free || (joint == JointType::rigid && !carries_joint_.contains(frame.getName()));
  }

  std::optional<Frame> find(const std::string& name) const {
    try {
      return C_.getFrame(name);
    } catch (const FrameNotFound&) {
      return std::nullopt;
    }
  }

  const Config& C_;
  std::set<std::string> carries_joint_, moving_;
  std::set<std::pair<int, int>> overlapping_;
};

}  // namespace

std::string WaypointOverlap::str() const {
  return cat("'", a, "' and '", b, "' overlap by ", std::round(depth * 1e4) / 10., " mm");
}

std::vector<WaypointOverlap> overlapsWithOthers(const Config& C, const Komo& waypoints,
                                                const std::vector<TaskAction>& plan) {
  std::vector<WaypointOverlap> overlaps;
  const SceneParts parts(C);
  for (int t = 0; t < std::min(waypoints.slices(), int(plan.size())); ++t) {
    const TaskAction& action = plan[std::size_t(t)];
    const auto names = [&](const std::string& frame, const std::string& object) {
      return std::ranges::find(action, frame) != action.end() || std::ranges::find(action, object) != action.end();
    };
    const Config config = waypoints.configuration(t);
    for (const auto& pair : config.getCollisions(-kDepth)) {
      const std::string a = config.getFrame(pair.a).getName(), b = config.getFrame(pair.b).getName();
      if (parts.overlapsAtOnce(a, b)) continue;
      const auto isOther = [&](const std::string& frame, const std::string& partner) {
        const std::string object = parts.object(frame);
        if (names(frame, object)) return false;
        const std::string moved = action.size() > 1 ? action[1] : "";
        return !object.empty() || (parts.isFixed(frame) && parts.object(partner) == moved);
      };
      if (isOther(a, b) || isOther(b, a)) overlaps.push_back({t, a, b, -pair.distance});
    }
  }
  return overlaps;
}

}  // namespace kinegraph::inline task_planning_internal
