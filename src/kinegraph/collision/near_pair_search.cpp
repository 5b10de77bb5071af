#include "kinegraph/collision/near_pair_search.h"

#include <algorithm>

namespace kinegraph::inline collision_internal {

NearPairSearch::NearPairSearch(std::shared_ptr<const KinematicModel> model, const std::vector<int>& frames)
    : model_(std::move(model)), frames_(frames), link_pose_(model_->links.size()), link_moved_(model_->links.size()) {
  for (const ContactRules::Body& body : model_->contacts.bodies) {
    const auto frame = std::size_t(body.frame);
    const bool wanted = frames.empty() || std::find(frames.begin(), frames.end(), body.frame) != frames.end();
    bodies_.push_back({model_->body[frame], body.frame, model_->frame_link[frame], wanted, {}});
  }
  boxes_.resize(bodies_.size());
  left_box_.resize(bodies_.size());
}

void NearPairSearch::update(std::size_t index, const State& state) {
  Body& body = bodies_[index];
  const RigidTransform pose = state.pose(body.frame);
  const Vector3d center = pose * body.shape->boundCenter();
  if (reach_ >= 0.) {
    body.travel += (center - body.center).norm() + (pose.R - body.pose.R).norm() * body.shape->boundRadius();
  }
  body.pose = pose;
  body.center = center;
  const Vector3d half = (pose.R.cwiseAbs() * body.shape->boundHalf()).array() + body.shape->radius();
  body.box = {center - half, center + half};
  if (reach_ >= 0. && boxes_[index].contains(body.box)) return;
  boxes_[index] = body.box.grown(.01 + .1 * body.shape->boundRadius());
  if (!left_box_[index]) moved_.push_back(int(index));
  left_box_[index] = 1;
}

void NearPairSearch::place(const State& state) {
  const bool all = state.sharedParameters() != parameters_;
  parameters_ = state.sharedParameters();
  for (std::size_t link = 0; link < link_pose_.size(); ++link) {
    const RigidTransform& pose = state.linkPose(int(link));
    link_moved_[link] = all || pose.p != link_pose_[link].p || pose.R != link_pose_[link].R;
    if (link_moved_[link]) link_pose_[link] = pose;
  }
  if (all) fixed_known_ = false;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (link_moved_[std::size_t(bodies_[i].link)]) update(i, state);
  }
}

void NearPairSearch::add(int a, int b) {
  if (a > b) std::swap(a, b);
  const Body &body_a = bodies_[std::size_t(a)], &body_b = bodies_[std::size_t(b)];
  if (!(body_a.wanted || body_b.wanted) || !model_->contacts.allow(std::size_t(a), std::size_t(b))) return;
  (body_a.link == 0 && body_b.link == 0 ? fixed_ : moving_).push_back({a, b});
}

void NearPairSearch::findCandidates(double reach) {
  reach_ = reach;
  if (moved_.size() > bodies_.size() / 2 || tree_.spread() > 1.5) {
    tree_.build(boxes_);
  } else {
    for (const int i : moved_) tree_.move(i, boxes_[std::size_t(i)]);
  }
  moved_.clear();
  std::fill(left_box_.begin(), left_box_.end(), char(0));
  fixed_.clear();
  moving_.clear();
  fixed_known_ = false;
  for (int i = 0; i < int(bodies_.size()); ++i) {
    tree_.forMeeting(boxes_[std::size_t(i)], reach_, [&](int j) {
      if (i < j) add(i, j);
    });
  }
}

void NearPairSearch::findCandidatesOfMoved() {
  if (moved_.empty()) return;
  if (moved_.size() > bodies_.size() / 4 || tree_.spread() > 1.5) return findCandidates(reach_);
  bool fixed_moved = false;
  for (const int i : moved_) {
    tree_.move(i, boxes_[std::size_t(i)]);
    fixed_moved |= bodies_[std::size_t(i)].link == 0;
  }
  const auto forget = [&](const Candidate& c) { return left_box_[std::size_t(c.a)] || left_box_[std::size_t(c.b)]; };
  std::erase_if(moving_, forget);
  if (fixed_moved) std::erase_if(fixed_, forget);
  for (const int i : moved_) {
    tree_.forMeeting(boxes_[std::size_t(i)], reach_, [&](int j) {
      if (j != i && !(left_box_[std::size_t(j)] && j < i)) add(i, j);
    });
  }
  for (const int i : moved_) left_box_[std::size_t(i)] = 0;
  moved_.clear();
}

Proximity NearPairSearch::proximity(const Near& pair) const {
  const Body &a = bodies_[std::size_t(pair.a)], &b = bodies_[std::size_t(pair.b)];
  return kinegraph::proximity(*a.shape, a.pose, *b.shape, b.pose);
}

bool NearPairSearch::isNear(Candidate& candidate, double margin) {
  const Body &a = bodies_[std::size_t(candidate.a)], &b = bodies_[std::size_t(candidate.b)];
  const double travel = a.travel + b.travel;
  if (candidate.travel >= 0.) {
    const double moved = travel - candidate.travel;
    if (moved == 0.) return candidate.distance <= margin;
    if (candidate.distance - moved > margin + 1e-9 * (1. + travel)) return false;
  }
  if (!a.box.meets(b.box, margin + 1e-12)) return false;
  const double reach = a.shape->boundRadius() + b.shape->boundRadius() + margin;
  if (reach >= 0. && (a.center - b.center).squaredNorm() > reach * reach) return false;
  if (margin >= 0.) {
    if (!mayBeWithin(*a.shape, a.pose, b.center, b.shape->boundRadius() + margin)) return false;
    if (!mayBeWithin(*b.shape, b.pose, a.center, a.shape->boundRadius() + margin)) return false;
  }
  ++measured_;
  candidate.distance = kinegraph::proximity(*a.shape, a.pose, *b.shape, b.pose).distance;
  candidate.travel = travel;
  return candidate.distance <= margin;
}

/// Updates the candidates for a margin, and the near pairs among static bodies.
void NearPairSearch::bringUpToDate(double margin) {
  const double reach = std::max(margin, 0.);
  if (reach > reach_) {
    findCandidates(reach);
  } else {
    findCandidatesOfMoved();
  }
  if (fixed_known_ && margin == fixed_margin_) return;
  fixed_near_.clear();
  for (Candidate& c : fixed_) {
    if (isNear(c, margin)) fixed_near_.push_back({c.a, c.b, c.distance});
  }
  fixed_known_ = true;
  fixed_margin_ = margin;
}

const std::vector<NearPairSearch::Near>& NearPairSearch::near(double margin) {
  bringUpToDate(margin);
  near_.assign(fixed_near_.begin(), fixed_near_.end());
  for (Candidate& c : moving_) {
    if (isNear(c, margin)) near_.push_back({c.a, c.b, c.distance});
  }
  std::sort(near_.begin(), near_.end(),
            [](const Near& x, const Near& y) { return x.a < y.a || (x.a == y.a && x.b < y.b); });
  return near_;
}

bool NearPairSearch::apart(double margin) {
  bringUpToDate(margin);
  const auto tooNear = [&](std::size_t i) {
    if (bodies_[std::size_t(moving_[i].a)].link == bodies_[std::size_t(moving_[i].b)].link) return false;
    if (!isNear(moving_[i], margin) || !(moving_[i].distance < margin)) return false;
    suspect_ = i;
    return true;
  };
  if (suspect_ < moving_.size() && tooNear(suspect_)) return false;
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    if (tooNear(i)) return false;
  }
  return true;
}

}  // namespace kinegraph::inline collision_internal
