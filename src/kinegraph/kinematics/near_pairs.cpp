#include "kinegraph/kinematics/near_pairs.h"

namespace kinegraph {

BodyPairs::BodyPairs(const Program& program, const std::vector<std::pair<int, int>>& frame_pairs) {
  static const std::shared_ptr<const CollisionBody> point = pointBody();
  std::vector<int> place(program.frame_link.size(), -1);
  const auto body = [&](int frame) {
    if (place[frame] < 0) {
      place[frame] = int(frames.size());
      frames.push_back(frame);
      bodies.push_back(program.body[frame] ? program.body[frame] : point);
    }
    return place[frame];
  };
  pairs.reserve(frame_pairs.size());
  for (const auto& [a, b] : frame_pairs) {
    const int place_a = body(a);
    pairs.emplace_back(place_a, body(b));
  }
}

void PlacedBodies::place(const State& state) {
  state_ = &state;
  for (std::size_t i = 0; i < placed_.size(); ++i) {
    const int frame = pairs_->frames[i];
    placed_[i].center = state.linkPose(state.link(frame)) * (state.parameters().frame_offset[frame] * pairs_->bodies[i]->boundCenter());
    placed_[i].posed = false;
  }
}

bool PlacedBodies::mayBeNear(int pair, double margin) {
  const auto [a, b] = pairs_->pairs[pair];
  const CollisionBody &body_a = *pairs_->bodies[a], &body_b = *pairs_->bodies[b];
  const Vector3d &center_a = placed_[a].center, &center_b = placed_[b].center;
  const double reach = body_a.boundRadius() + body_b.boundRadius() + margin;
  if (reach < 0.) return true;  // a depth that spheres say nothing about
  if ((center_a - center_b).squaredNorm() > reach * reach) return false;
  if (margin < 0.) return true;  // a centre inside of a core is at 0, however deep
  if (pointToCore(body_a, pose(a), center_b) > body_a.radius() + body_b.boundRadius() + margin) return false;
  return pointToCore(body_b, pose(b), center_a) <= body_b.radius() + body_a.boundRadius() + margin;
}

NearPairs::NearPairs(std::shared_ptr<const Program> program) : program_(std::move(program)) {
  if (program_->contacts.bodies.size() > kFew) {
    search_.emplace(program_);
  } else {
    pairs_.emplace(*program_, program_->collidable());
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
  const auto tooNear = [&](int pair) { return bodies_->mayBeNear(pair, margin) && bodies_->proximity(pair).distance < margin; };
  if (suspect_ >= 0 && tooNear(suspect_)) return false;
  for (int pair = 0; pair < bodies_->pairs(); ++pair) {
    if (pair == suspect_ || !tooNear(pair)) continue;
    suspect_ = pair;
    return false;
  }
  return true;
}

}  // namespace kinegraph
