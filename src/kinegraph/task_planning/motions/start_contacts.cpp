#include "kinegraph/task_planning/motions/start_contacts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kIrrelevant = 2.;  ///< factor on the margin: pairs that are farther apart do not matter
constexpr double kSameGap = 1e-6;   ///< m
constexpr int kSampled = 8;         ///< configurations

}  // namespace

Config withoutGivenContacts(const Config& C, double margin) {
  const std::vector<Literal> facts = taskFacts(C);
  const std::vector<std::string> objects = wordsOf(facts, "is_object");
  FramePairs pairs = wedgedPairs(C, wordsOf(facts, "is_gripper"), objects, kOverlap);
  const auto isCarried = [&](int id) {  // its neighbors change, although no joint moves it
    const std::string name = C.getFrame(id).getName();
    return std::ranges::find(objects, name) != objects.end() || !holderOf(C, name, objects).empty();
  };
  Config scene = C;
  std::map<std::pair<int, int>, double> near;
  for (const Config::NearPair& pair : scene.getCollisions(kIrrelevant * margin))
    if (pair.distance > 0. && !isCarried(pair.a) && !isCarried(pair.b))
      near[std::minmax(pair.a, pair.b)] = pair.distance;
  Rng rng(1);
  for (int k = 0; k < kSampled && !near.empty(); ++k) {
    scene.setRandom(rng);
    std::map<std::pair<int, int>, double> still;
    for (const Config::NearPair& pair : scene.getCollisions(kIrrelevant * margin)) {
      const auto before = near.find(std::minmax(pair.a, pair.b));
      if (before != near.end() && std::abs(before->second - pair.distance) < kSameGap) still.insert(*before);
    }
    near = std::move(still);
  }
  for (const auto& [pair, distance] : near)
    pairs.emplace_back(C.getFrame(pair.first).getName(), C.getFrame(pair.second).getName());
  scene = C;
  ignorePairs(scene, pairs);
  return scene;
}

std::string startContact(const Config& C, const std::vector<std::string>& hands) {
  std::set<std::string> joints;  // that move hands
  const auto isMovedLike = [&](std::optional<Frame> frame) {
    for (; frame; frame = frame->getParent())
      if (frame->data().moves() && joints.contains(frame->getName())) return true;
    return false;
  };
  for (const std::string& hand : hands)
    for (std::optional<Frame> frame = C.getFrame(hand); frame; frame = frame->getParent())
      if (frame->data().moves() && frame->data().joint->active) joints.insert(frame->getName());
  std::vector<std::string> overlaps;
  for (const Config::NearPair& pair : C.getCollisions(-kOverlap)) {
    const Frame a = C.getFrame(pair.a), b = C.getFrame(pair.b);
    if (isMovedLike(a) || isMovedLike(b))
      overlaps.push_back(
          cat("'", a.getName(), "' and '", b.getName(), "' overlap by ", fixed(-1e3 * pair.distance, 1), " mm"));
  }
  return overlaps.empty() ? "" : cat("the start collides: ", join(overlaps, ", "));
}

}  // namespace kinegraph::inline task_planning_internal
