#include "kinegraph/task_planning/motions/meant_contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using Names = std::set<std::string>;

constexpr double kNearAtRest = .012;  ///< m: closer bodies at the ends of a motion may belong to each other
constexpr double kConstant =
    1e-5;                        ///< m: pairs whose distance changes less, such as a base and its floor, do not count
constexpr double kBelow = 3e-3;  ///< m: what ends less than this above the lowest point of an object is below it
constexpr double kCloseToEnd = .08;  ///< m: contacts are meant up to this distance of a hand from an end

/// The nearest frame with an active joint, from a frame upwards; null for static frames. It identifies a link.
const FrameData* headOf(const Frame& frame) {
  const FrameData* up = &frame.data();
  while (up && !(up->moves() && dofSource(*up).joint->active)) up = up->parent;
  return up;
}

/// The frames with shapes of the same link as a frame.
Names linkOf(const Config& C, const std::string& name) {
  const FrameData* head = headOf(C.getFrame(name));
  Names parts;
  for (const Frame& frame : C.getFrames())
    if (frame.data().shape && headOf(frame) == head) parts.insert(frame.getName());
  return parts;
}

/// The frames with shapes at or below a frame.
Names bodyOf(const Config& C, const std::string& name) {
  Names parts;
  const std::optional<Frame> body = C.findFrame(name);
  if (!body) return parts;
  if (body->data().shape) parts.insert(name);
  for (const Frame& frame : body->getSubtree())
    if (frame.data().shape) parts.insert(frame.getName());
  return parts;
}

double extremeHeight(const Config& C, const Names& parts, bool highest) {
  double height = highest ? -1e9 : 1e9;
  for (const std::string& part : parts) {
    const Frame frame = C.getFrame(part);
    for (const Vector3d& point : boxCorners(frame)) {
      const double z = (frame.getPose().transform() * point).z();
      height = highest ? std::max(height, z) : std::min(height, z);
    }
  }
  return height;
}

/// Collects the pairs whose contact is meant.
class MeantPairs {
 public:
  /// Changes the q of the scene.
  MeantPairs(Config& scene, const std::vector<std::string>& hands)
      : scene_(scene), hands_(hands.begin(), hands.end()) {}

  void addAction(const TaskAction& action) {
    if (action.empty()) return;
    Names held;  // hands in the action
    for (const std::string& word : action)
      if (hands_.contains(word)) held.insert(word);
    Names bodies = bodyOf(scene_, objectOf(action));
    if (isHold(action) || isGuided(action)) bodies = bodyOf(scene_, action[2]);
    for (const std::string& hand : held) add(linkOf(scene_, hand), bodies);
    if (isPick(action) && action.size() > 2) addNamed(bodies, action[2]);
    if (isPlace(action) && action.size() > 3) addNamed(bodies, action[3]);
  }

  /// All pairs that are near at q.
  void addNear(const VectorXd& q) {
    scene_.setJointState(q);
    for (const Config::NearPair& pair : scene_.getCollisions(kNearAtRest)) add(nameOf(pair.a), nameOf(pair.b));
  }

  /// The pairs that are near at q0 and as near at q1, such as a base and its floor.
  void addConstant(const VectorXd& q0, const VectorXd& q1) {
    std::map<std::pair<int, int>, double> first;
    scene_.setJointState(q0);
    for (const Config::NearPair& pair : scene_.getCollisions(kNearAtRest))
      first[std::minmax(pair.a, pair.b)] = pair.distance;
    if (first.empty()) return;
    scene_.setJointState(q1);
    for (const Config::NearPair& pair : scene_.getCollisions(kNearAtRest)) {
      const auto before = first.find(std::minmax(pair.a, pair.b));
      if (before != first.end() && std::abs(pair.distance - before->second) < kConstant)
        add(nameOf(pair.a), nameOf(pair.b));
    }
  }

  /// What is near an object at q, with `only_below` only what it stands on.
  void addNearObject(const VectorXd& q, const std::string& obj, bool only_below) {
    if (!scene_.findFrame(obj)) return;
    scene_.setJointState(q);
    const Names parts = bodyOf(scene_, obj);
    const double lowest = extremeHeight(scene_, parts, false);
    for (const Config::NearPair& pair : scene_.getCollisions(kNearAtRest)) {
      const std::string a = nameOf(pair.a), b = nameOf(pair.b);
      if (parts.contains(a) == parts.contains(b)) continue;
      const std::string& other = parts.contains(a) ? b : a;
      if (only_below && extremeHeight(scene_, {other}, true) > lowest + kBelow) continue;
      add(a, b);
    }
  }

  FramePairs pairs() const { return {pairs_.begin(), pairs_.end()}; }

 private:
  std::string nameOf(int id) const { return scene_.getFrame(id).getName(); }

  void add(const std::string& a, const std::string& b) { pairs_.insert(std::minmax(a, b)); }

  void add(const Names& some, const Names& others) {
    for (const std::string& a : some)
      for (const std::string& b : others)
        if (a != b) add(a, b);
  }

  void addNamed(const Names& bodies, const std::string& place) {
    if (scene_.findFrame(place) && scene_.getFrame(place).data().shape) add(bodies, {place});
  }

  Config& scene_;
  const Names hands_;
  std::set<std::pair<std::string, std::string>> pairs_;
};

bool isSliding(const TaskAction& action) { return startsSliding(action) || endsSliding(action) || isGuided(action); }

/// The pairs whose contact is meant at the ends of a motion. With `throughout`, only those during the whole motion.
FramePairs meantPairs(Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                      const TaskAction& before, const std::vector<std::string>& hands, bool throughout) {
  MeantPairs meant(C, hands);
  const bool slides = endsSliding(action) || isGuided(action);
  meant.addConstant(q0, q1);
  if (before.empty() || slides || (isSliding(before) && !throughout) || (isSliding(action) && !throughout))
    meant.addNear(q0);
  if (slides || (!throughout && (isSliding(action) || (!action.empty() && action[0] == "pose")))) meant.addNear(q1);
  if (slides || !throughout) {
    meant.addAction(before);
    meant.addAction(action);
    if (isPick(before)) meant.addNearObject(q0, objectOf(before), false);
    if (isPlace(action)) meant.addNearObject(q1, objectOf(action), true);
  }
  return meant.pairs();
}

/// The hand of an action; "" if there is none.
std::string handOf(const TaskAction& action, const std::vector<std::string>& hands) {
  for (std::size_t i = action.size(); i-- > 1;)
    if (std::ranges::find(hands, action[i]) != hands.end()) return action[i];
  return "";
}

}  // namespace

Surroundings::Surroundings(const Config& C, const VectorXd& q0, const VectorXd& q1, const TaskAction& action,
                           const TaskAction& before, const std::vector<std::string>& hands)
    : all_(C), unmeant_(C) {
  const auto addEnd = [&](const std::string& hand, const VectorXd& q) {
    unmeant_.setJointState(q);
    ends_.push_back({hand, unmeant_.getFrame(hand).getPosition()});
  };
  if (const std::string hand = handOf(action, hands); !hand.empty()) {  // else all of the motion is close to its ends
    addEnd(hand, q1);
    if (const std::string first = handOf(before, hands); !first.empty()) addEnd(first, q0);
  }
  if (const FramePairs pairs = meantPairs(unmeant_, q0, q1, action, before, hands, true); !pairs.empty()) {
    middle_ = C;
    ignorePairs(*middle_, pairs);
  }
  ignorePairs(unmeant_, meantPairs(unmeant_, q0, q1, action, before, hands, false));
}

std::vector<bool> Surroundings::closeToEnds(const MatrixXd& path) const {
  std::vector<bool> close(std::size_t(path.rows()), ends_.empty());
  Config scene = all_;
  for (Eigen::Index row = 0; row < path.rows() && !ends_.empty(); ++row) {
    scene.setJointState(path.row(row));
    for (const End& end : ends_)
      if ((scene.getFrame(end.hand).getPosition() - end.at).norm() < kCloseToEnd) close[std::size_t(row)] = true;
  }
  return close;
}

std::string Surroundings::violation(const MatrixXd& path, double margin) const {
  std::string found = firstContact(all_, path);
  if (!found.empty() || !(margin > 0.)) return found;
  const std::vector<bool> close = closeToEnds(path);
  const auto isClose = [&](Eigen::Index edge) { return close[std::size_t(edge)] || close[std::size_t(edge) + 1]; };
  if (path.rows() == 1) return firstContact(close[0] ? unmeant_ : middle_.value_or(all_), path, margin);
  for (Eigen::Index first = 0, last = 0; first + 1 < path.rows() && found.empty(); first = last) {
    for (last = first + 1; last + 1 < path.rows() && isClose(last) == isClose(first);) ++last;
    const MatrixXd part = path.middleRows(first, last - first + 1);
    found = firstContact(isClose(first) ? unmeant_ : middle_ ? *middle_ : all_, part, margin);
  }
  return found;
}

NearBodies Surroundings::nearest(const MatrixXd& path, double limit, bool of_world) const {
  NearBodies nearest{"", "", limit};
  const std::vector<bool> close = closeToEnds(path);
  Config near_ends = unmeant_, middle = middle_ ? *middle_ : all_;
  for (Eigen::Index row = 0; row < path.rows(); ++row) {
    Config& scene = close[std::size_t(row)] ? near_ends : middle;
    scene.setJointState(path.row(row));
    for (const Config::NearPair& pair : scene.getCollisions(nearest.distance)) {
      const Frame a = scene.getFrame(pair.a), b = scene.getFrame(pair.b);
      if (pair.distance >= nearest.distance) continue;
      const FrameData *head_a = headOf(a), *head_b = headOf(b);
      if (head_a == head_b || (of_world && head_a && head_b)) continue;
      nearest = {a.getName(), b.getName(), pair.distance};
    }
  }
  return nearest;
}

}  // namespace kinegraph::inline task_planning_internal
