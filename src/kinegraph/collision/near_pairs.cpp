#include "kinegraph/collision/near_pairs.h"

namespace kinegraph::inline collision_internal {

BodyPairs::BodyPairs(const KinematicModel& model, const std::vector<std::pair<int, int>>& frame_pairs) {
  static const std::shared_ptr<const CollisionBody> point = pointBody();
  std::vector<int> place(model.frame_link.size(), -1);
  const auto body = [&](int frame) {
    if (place[frame] < 0) {
      place[frame] = int(frames.size());
      frames.push_back(frame);
      bodies.push_back(model.body[frame] ? model.body[frame] : point);
    }
    return place[frame];
  };
  pairs.reserve(frame_pairs.size());
  reach.reserve(frame_pairs.size());
  for (const auto& [a, b] : frame_pairs) {
    const int place_a = body(a);
    pairs.emplace_back(place_a, body(b));
    reach.push_back(bodies[pairs.back().first]->boundRadius() + bodies[pairs.back().second]->boundRadius());
  }
}

void PlacedBodies::place(const State& state) {
  for (std::size_t i = 0; i < poses_.size(); ++i) {
    RigidTransform& pose = poses_[i];
    pose = state.pose(pairs_->frames[i]);
    centers_[i].noalias() = pose.R * pairs_->bodies[i]->boundCenter() + pose.p;
  }
}

bool PlacedBodies::coresMayBeNear(int a, int b, double margin) const {
  if (margin < 0.) return true;  // the distance of a center inside of a core is 0
  const CollisionBody &body_a = *pairs_->bodies[a], &body_b = *pairs_->bodies[b];
  return mayBeWithin(body_a, poses_[a], centers_[b], body_b.boundRadius() + margin) &&
         mayBeWithin(body_b, poses_[b], centers_[a], body_a.boundRadius() + margin);
}

NearPairs::NearPairs(std::shared_ptr<const KinematicModel> model) : model_(std::move(model)) {
  if (model_->contacts.bodies.size() > kFew) {
    search_.emplace(model_);
  } else {
    pairs_.emplace(*model_, model_->collidable());
    bodies_.emplace(*pairs_);
  }
}

void NearPairs::place(const State& state) {
  if (search_) {
    search_->place(state);
  } else {
    bodies_->place(state);
  }
}

bool NearPairs::apart(double margin) {
  if (search_) return search_->apart(margin);
  const auto tooNear = [&](int pair) {
    const auto [a, b] = model_->collidable()[std::size_t(pair)];
    return model_->movesApart(a, b) && bodies_->mayBeNear(pair, margin) && bodies_->proximity(pair).distance < margin;
  };
  if (suspect_ >= 0 && tooNear(suspect_)) return false;
  for (int pair = 0; pair < bodies_->pairs(); ++pair) {
    if (pair == suspect_ || !tooNear(pair)) continue;
    suspect_ = pair;
    return false;
  }
  return true;
}

}  // namespace kinegraph::inline collision_internal
