#include "kinegraph/scene/tree/contact_warnings.h"

#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr double kDeep = 1e-3, kNear = .05;            // m
constexpr double kCovered = .05, kCoveredShare = .25;  // m, and share of a shape's bounding radius
constexpr std::size_t kMaxNamed = 3;

std::vector<std::pair<int, int>> restingPairs(const State& state) {
  NearPairSearch search(state.sharedModel());
  search.place(state);
  std::vector<std::pair<int, int>> resting;
  for (const NearPairSearch::Near& near : search.near(-kDeep)) {
    const int a = search.frame(near.a), b = search.frame(near.b);
    if (!state.model().movesApart(a, b)) resting.emplace_back(a, b);
  }
  return resting;
}

Proximity proximityOf(const State& state, int a, int b) {
  return proximity(*state.model().body[std::size_t(a)], state.pose(a), *state.model().body[std::size_t(b)],
                   state.pose(b));
}

/// Returns the colliding shapes of the same frame as a shape, or of frames fixed to the same parent, that overlap it.
std::vector<int> collidingPartners(const FrameData& frame, const State& state) {
  const auto ownerOf = [](const FrameData& f) { return f.parent && !f.joint ? f.parent->id : f.id; };
  const auto& frames = frame.tree->frames();
  std::vector<int> partners;
  for (const ContactRules::Body& body : state.model().contacts.bodies) {
    const FrameData& other = *frames[std::size_t(body.frame)];
    if (ownerOf(other) != ownerOf(frame) && body.frame != ownerOf(frame) && ownerOf(other) != frame.id) continue;
    if (proximityOf(state, frame.id, other.id).distance < -kDeep) partners.push_back(other.id);
  }
  return partners;
}

/// Returns whether one of the colliding shapes stops a moving body about where the shape itself would. An obstacle that
/// stands sunk into a table overlaps it, but the table does not stop what meets the obstacle.
bool isStopped(const State& state, const std::vector<int>& colliding, int shape, int moving) {
  const double size = state.model().body[std::size_t(shape)]->boundRadius();
  const double least =
      std::max(proximityOf(state, shape, moving).distance, 0.) + std::min(kCovered, kCoveredShare * size);
  return std::any_of(colliding.begin(), colliding.end(),
                     [&](int other) { return proximityOf(state, other, moving).distance <= least; });
}

bool isOpaque(const Shape& shape) { return !shape.color || (*shape.color)[3] >= 1.; }

std::vector<int> passedThrough(const SceneTree& scene, const State& state) {
  const KinematicModel& model = state.model();
  std::vector<int> frames;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape || frame->shape->contact != 0 || model.frame_link[std::size_t(frame->id)] != 0) continue;
    if (shapeKind(frame->shape->geometry->type).is_symbol || !isOpaque(*frame->shape)) continue;
    if (frame->attributes->find("simulate")) continue;
    const CollisionBody& shape = *model.body[std::size_t(frame->id)];
    const Vector3d center = state.pose(frame->id) * shape.boundCenter();
    const auto isNear = [&](const ContactRules::Body& body) {
      if (model.frame_link[std::size_t(body.frame)] == 0) return false;
      const CollisionBody& other = *model.body[std::size_t(body.frame)];
      const double reach = shape.boundRadius() + other.boundRadius() + kNear;
      if ((state.pose(body.frame) * other.boundCenter() - center).squaredNorm() > reach * reach) return false;
      return proximityOf(state, frame->id, body.frame).distance < kNear;
    };
    std::vector<int> near;
    for (const ContactRules::Body& body : model.contacts.bodies)
      if (isNear(body)) near.push_back(body.frame);
    if (near.empty()) continue;
    const std::vector<int> partners = collidingPartners(*frame, state);
    if (!std::all_of(near.begin(), near.end(), [&](int body) { return isStopped(state, partners, frame->id, body); }))
      frames.push_back(frame->id);
  }
  return frames;
}

std::vector<int> robotsWithoutContact(const SceneTree& scene, const KinematicModel& model) {
  struct Robot {
    std::set<int> links;
    bool collides = false;
  };
  std::map<int, Robot> robots;  // by root
  for (const auto& frame : scene.frames()) {
    const int link = model.frame_link[std::size_t(frame->id)];
    if (link == 0 || !frame->shape || shapeKind(frame->shape->geometry->type).is_symbol) continue;
    const FrameData* root = frame.get();
    while (root->parent) root = root->parent;
    Robot& robot = robots[root->id];
    if (isOpaque(*frame->shape)) robot.links.insert(link);
    robot.collides |= frame->shape->contact != 0;
  }
  std::vector<int> without;
  for (const auto& [root, robot] : robots) {
    if (!robot.collides && robot.links.size() > 1) without.push_back(root);
  }
  return without;
}

/// Lists the first few names and the number of the others.
std::string listed(std::vector<std::string> names) {
  const std::size_t count = names.size();
  names.resize(std::min(count, kMaxNamed));
  return cat(join(names, ", "), count > kMaxNamed ? cat(" and ", count - kMaxNamed, " more") : "");
}

}  // namespace

ContactWarnings contactWarnings(SceneTree& scene) {
  const State& state = scene.state();
  return {restingPairs(state), passedThrough(scene, state), robotsWithoutContact(scene, state.model())};
}

std::vector<std::string> describe(const ContactWarnings& warnings, const SceneTree& scene) {
  const auto nameOf = [&](int frame) { return cat("'", scene.frames()[std::size_t(frame)]->name, "'"); };
  std::vector<std::string> sentences, names;
  for (const auto& [a, b] : warnings.resting) names.push_back(cat(nameOf(a), " and ", nameOf(b)));
  if (!names.empty()) {
    sentences.push_back(
        cat(listed(names), names.size() == 1 ? " overlap" : " overlap (pairs of frames)",
            " at a constant relative pose; such pairs do not depend on q and are not counted as collisions"));
  }
  names.clear();
  for (const int frame : warnings.passed_through) names.push_back(nameOf(frame));
  if (!names.empty()) {
    sentences.push_back(cat(listed(names), names.size() == 1 ? " is" : " are",
                            " near moving links but cannot collide because `contact` is 0; setContact(1) makes an"
                            " obstacle of a frame, and the attribute `simulate` silences this warning"));
  }
  names.clear();
  for (const int frame : warnings.without_contact) names.push_back(nameOf(frame));
  if (!names.empty()) {
    sentences.push_back(
        cat("no moving shape of ",
            names == std::vector<std::string>{"'world'"} ? "the scene" : cat("the robot ", listed(names)),
            " can collide, because `contact` is 0 for all of them: every configuration and motion counts as free."
            " Use its variant with collision (of shipped robots: <name>_collision.g), or give its shapes `contact`"));
  }
  return sentences;
}

}  // namespace kinegraph::inline scene_internal
