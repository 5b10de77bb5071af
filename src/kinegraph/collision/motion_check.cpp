#include "kinegraph/collision/motion_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/collision/edge_engine.h"

namespace kinegraph::inline collision_internal {

MotionChecker::MotionChecker(const State& scene)
    : state_(scene),
      edges_(std::make_unique<EdgeEngine>(scene, 1e-5)),
      many_(scene.model().contacts.bodies.size() > NearPairs::kFew),
      bounds_(scene),
      from_(scene.dofs()),
      change_(scene.dofs()),
      q_(scene.dofs()),
      until_(scene.dofs()) {
  const KinematicModel& model = scene.model();
  if (!many_) {
    pairs_.emplace(model, model.movingPairs());
    bodies_.emplace(*pairs_);
    speed_.resize(pairs_->pairs.size());
    due_.reserve(pairs_->pairs.size());
    return;
  }
  std::vector<WorldBox> boxes;
  for (std::size_t i = 0; i < model.contacts.bodies.size(); ++i) {
    const ContactRules::Body& body = model.contacts.bodies[i];
    if (model.frame_link[std::size_t(body.frame)] != 0) {
      moving_.push_back(int(i));
    } else {
      fixed_.push_back(int(i));
      boxes.push_back(sweptBox(body));
    }
  }
  fixed_boxes_.build(boxes);
}

MotionChecker::~MotionChecker() = default;

void MotionChecker::moveTo(double time) {
  if (time == time_) return;
  time_ = time;
  q_ = from_ + time * change_;
  state_.setJoints(q_.data());
  if (bodies_) bodies_->place(state_);
}

void MotionChecker::setEdge(const double* from, const double* to) {
  const KinematicModel& model = state_.model();
  from_ = Eigen::Map<const VectorXd>(from, model.dofs);
  change_ = Eigen::Map<const VectorXd>(to, model.dofs) - from_;
  bounds_.setEdge(from, to);
}

double MotionChecker::relativeSpeed(int pair) const {
  const auto [a, b] = pairs_->pairs[std::size_t(pair)];
  const int frame_a = pairs_->frames[std::size_t(a)], frame_b = pairs_->frames[std::size_t(b)];
  return bounds_
      .relativeRates(state_.link(frame_a), bodyReach(state_, frame_a, *pairs_->bodies[std::size_t(a)]),
                     state_.link(frame_b), bodyReach(state_, frame_b, *pairs_->bodies[std::size_t(b)]))
      .speed;
}

/// Bounds the displacement of the points of a frame's body over the edge.
double MotionChecker::displacementOf(int frame) const {
  const double reach = bodyReach(state_, frame, *state_.model().body[std::size_t(frame)]);
  return bounds_.ratesOf(state_.link(frame), reach).speed;
}

/// A box around all places of a body along the edge. `bounds_` is set to the edge, and `state_` is at its start.
WorldBox MotionChecker::sweptBox(const ContactRules::Body& body) const {
  const auto frame = std::size_t(body.frame);
  const CollisionBody& shape = *state_.model().body[frame];
  const RigidTransform X = state_.pose(body.frame);
  const Vector3d center = X * shape.boundCenter(), half = (X.R.cwiseAbs() * shape.boundHalf()).array() + shape.radius();
  constexpr double kAnywhere = 1e9;  // m
  return WorldBox{center - half, center + half}.grown(std::min(displacementOf(body.frame), kAnywhere));
}

/// Selects the pairs on different links whose swept boxes come within `margin`, in the order of frames.
void MotionChecker::findPairs(double margin) {
  const KinematicModel& model = state_.model();
  const std::vector<ContactRules::Body>& bodies = model.contacts.bodies;
  const double reach = std::max(margin, 0.) + 1e-9;
  std::vector<WorldBox> boxes;
  for (const int i : moving_) boxes.push_back(sweptBox(bodies[std::size_t(i)]));
  BoxTree moving_boxes;
  moving_boxes.build(boxes);
  std::vector<std::pair<int, int>> found;
  const auto add = [&](int i, int j) {
    if (i > j) std::swap(i, j);
    const int a = bodies[std::size_t(i)].frame, b = bodies[std::size_t(j)].frame;
    if (state_.link(a) != state_.link(b) && model.contacts.allow(std::size_t(i), std::size_t(j)))
      found.emplace_back(a, b);
  };
  for (std::size_t k = 0; k < moving_.size(); ++k) {
    fixed_boxes_.forMeeting(boxes[k], reach, [&](int j) { add(moving_[k], fixed_[std::size_t(j)]); });
    moving_boxes.forMeeting(boxes[k], reach, [&](int j) {
      if (std::size_t(j) > k) add(moving_[k], moving_[std::size_t(j)]);
    });
  }
  std::sort(found.begin(), found.end());
  bodies_.reset();
  pairs_.emplace(model, found);
  bodies_.emplace(*pairs_);
  bodies_->place(state_);
}

MotionContact MotionChecker::contactOf(int pair) const {
  const auto [a, b] = pairs_->pairs[std::size_t(pair)];
  return {time_, pairs_->frames[std::size_t(a)], pairs_->frames[std::size_t(b)], bodies_->proximity(pair).distance, -1};
}

std::optional<MotionContact> MotionChecker::firstContact(const double* from, const double* to, double margin,
                                                         double tolerance) {
  const Limits limits{margin, tolerance};
  edges_->setTolerance(tolerance);
  if (edges_->isFree(from, to, margin)) return std::nullopt;
  const MotionContact hit = *edges_->measuredHit();  // the first contact is no later
  const Eigen::Map<const VectorXd> start(from, state_.dofs()), end(to, state_.dofs());
  until_.noalias() = start + hit.time * (end - start);
  std::optional<MotionContact> contact = first(from, hit.time == 1. ? to : until_.data(), limits);
  if (!contact) return hit;
  contact->time *= hit.time;
  q_.noalias() = start + contact->time * (end - start);
  state_.setJoints(q_.data());
  const auto a = std::size_t(contact->a), b = std::size_t(contact->b);
  const auto& bodies = state_.model().body;
  contact->distance = proximity(*bodies[a], state_.pose(contact->a), *bodies[b], state_.pose(contact->b)).distance;
  return contact;
}

std::optional<MotionContact> MotionChecker::first(const double* from, const double* to, const Limits& limits) {
  return many_ ? firstInPieces(from, to, limits) : firstInOnePiece(from, to, limits);
}

/// Cuts the edge into pieces of small displacement, so that few swept boxes meet.
std::optional<MotionContact> MotionChecker::firstInPieces(const double* from, const double* to, const Limits& limits) {
  constexpr double kPiece = .25, kMostPieces = 256.;  // m
  setEdge(from, to);
  double farthest = 0.;
  for (const int i : moving_) {
    farthest = std::max(farthest, displacementOf(state_.model().contacts.bodies[std::size_t(i)].frame));
  }
  const int pieces = int(std::clamp(std::ceil(farthest / kPiece), 1., kMostPieces));
  const VectorXd start = from_, change = change_;
  VectorXd begin = start, end(state_.dofs());
  for (int i = 0; i < pieces; ++i) {
    end = start + double(i + 1) / pieces * change;
    if (std::optional<MotionContact> contact = firstInOnePiece(begin.data(), end.data(), limits)) {
      contact->time = (i + contact->time) / pieces;
      return contact;
    }
    begin = end;
  }
  return std::nullopt;
}

std::optional<MotionContact> MotionChecker::firstInOnePiece(const double* from, const double* to,
                                                            const Limits& limits) {
  setEdge(from, to);
  time_ = -1.;
  if (many_) bodies_.reset();  // of the last edge
  moveTo(0.);
  if (many_) findPairs(limits.margin);
  if (const auto contact = atTheStart(limits)) return contact;
  return due_.empty() ? std::nullopt : advance(limits);
}

/// Measures all pairs at the start. Returns one that is too close there; otherwise fills `due_` with the pairs that may
/// come too close, and the time until which each cannot.
std::optional<MotionContact> MotionChecker::atTheStart(const Limits& limits) {
  due_.clear();
  speed_.resize(pairs_->pairs.size());
  for (int pair = 0; pair < bodies_->pairs(); ++pair) {
    const double speed = speed_[pair] = relativeSpeed(pair);  // 0 if no joint between them moves
    if (!bodies_->mayBeNear(pair, limits.margin + speed)) continue;
    const double now = spare(pair, limits);
    if (now < 0. || (speed > 0. && (now < limits.tolerance || now / speed == 0.))) return contactOf(pair);
    if (now < speed) due_.push_back({now / speed, pair});
  }
  return std::nullopt;
}

/// Advances from one due time to the next, until a pair is too close or all pairs keep the margin to the end.
std::optional<MotionContact> MotionChecker::advance(const Limits& limits) {
  // Slack of the pairs at the end: the rest of the edge is free if this slack and the present one cover it.
  std::array<std::byte, 8192> buffer;
  std::pmr::monotonic_buffer_resource memory(buffer.data(), buffer.size());
  std::pmr::vector<double> at_end(speed_.size(), 0., &memory);
  moveTo(1.);
  for (const Due& due : due_) at_end[due.pair] = std::max(spare(due.pair, limits), 0.);
  std::erase_if(due_,
                [&](const Due& due) { return due.time * speed_[due.pair] + at_end[due.pair] >= speed_[due.pair]; });
  std::make_heap(due_.begin(), due_.end());
  while (!due_.empty()) {
    std::pop_heap(due_.begin(), due_.end());
    const auto [time, pair] = due_.back();
    due_.pop_back();
    moveTo(time);
    const double rest = speed_[pair] * (1. - time);
    if (!bodies_->mayBeNear(pair, limits.margin + rest)) continue;
    const double now = spare(pair, limits), next = time + now / speed_[pair];
    if (now < limits.tolerance || next == time) return contactOf(pair);
    if (now + at_end[pair] >= rest) continue;
    due_.push_back({next, pair});
    std::push_heap(due_.begin(), due_.end());
  }
  return std::nullopt;
}

}  // namespace kinegraph::inline collision_internal
