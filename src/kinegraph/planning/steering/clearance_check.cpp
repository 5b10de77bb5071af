#include "kinegraph/planning/steering/clearance_check.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline planning_internal {

ClearanceCheck::ClearanceCheck(const State& scene, const JointSpace& space, Clearance clearance)
    : space_(&space),
      clearance_(std::move(clearance)),
      edges_(scene, clearance_.margin, Clearance::kTolerance),
      state_(scene) {}

double ClearanceCheck::marginAt(const VectorXd& q) const {
  double margin = clearance_.margin;
  for (const Clearance::Tight& tight : clearance_.tight) {
    const double square = space_->squaredDistance(q.data(), tight.q.data());
    if (square <= Clearance::kAround * Clearance::kAround) margin = std::min(margin, tight.margin);
  }
  return margin + clearance_.guard;
}

void ClearanceCheck::countHit() {
  if (const auto& hit = edges_.lastHitPair()) ++hits_[{hit->a, hit->b}];
}

void ClearanceCheck::forget() {
  hits_.clear();
  edges_.forget();
}

bool ClearanceCheck::isFree(const VectorXd& q) {
  ++evaluations;
  edges_.setMargin(marginAt(q));
  if (edges_.isFree(q.data())) return true;
  countHit();
  return false;
}

bool ClearanceCheck::seemsFree(const VectorXd& from, const VectorXd& to) {
  constexpr int kLanes = EdgeChecker::kLanes;
  const VectorXd change = space_->difference(from, to);
  const int parts = std::max(1, int(std::ceil(space_->distance(from, to) / clearance_.resolution)));
  Places places;
  int count = 0;
  for (int k = 1; k <= std::min(parts, kLanes); ++k) places[std::size_t(count++)] = k * parts / std::min(parts, kLanes);
  if (!areFree(from, change, parts, places, count)) return false;
  const Places spread = places;
  count = 0;
  for (int i = 1, next = 0; i <= parts && parts > kLanes; ++i) {
    if (i == spread[std::size_t(next)]) {
      ++next;
    } else {
      places[std::size_t(count++)] = i;
    }
    if (count == 0 || (count < kLanes && i < parts)) continue;
    if (!areFree(from, change, parts, places, count)) return false;
    count = 0;
  }
  return true;
}

/// Checks the configurations at these multiples of 1 / parts of an edge. Consecutive ones with equal margins are
/// checked side by side.
bool ClearanceCheck::areFree(const VectorXd& from, const VectorXd& change, int parts, const Places& places, int count) {
  const double* rows[EdgeChecker::kLanes];
  double margins[EdgeChecker::kLanes];
  for (int i = 0; i < count; ++i) {
    VectorXd& q = samples_[i];
    q = from + double(places[std::size_t(i)]) / parts * change;
    rows[i] = q.data();
    margins[i] = marginAt(q);
  }
  for (int first = 0, next = 0; first < count; first = next) {
    while (next < count && margins[next] == margins[first]) ++next;
    ++evaluations;
    edges_.setMargin(margins[first]);
    if (edges_.areAllFree({rows + first, std::size_t(next - first)})) continue;
    countHit();
    return false;
  }
  return true;
}

/// If margins differ along the edge, it is cut into pieces of one margin each.
std::optional<MotionContact> ClearanceCheck::contact(const VectorXd& from, const VectorXd& to, double slack) {
  const VectorXd change = space_->difference(from, to);
  std::vector<double> cuts = {0., 1.};
  for (const Clearance::Tight& tight : clearance_.tight) {  // where the edge enters and leaves the ball
    const VectorXd away = space_->difference(tight.q, from);
    const double a = change.squaredNorm(), b = away.dot(change),
                 c = away.squaredNorm() - Clearance::kAround * Clearance::kAround;
    const double square = b * b - a * c;
    if (a == 0. || square <= 0.) continue;
    for (const double root : {(-b - std::sqrt(square)) / a, (-b + std::sqrt(square)) / a})
      if (root > 0. && root < 1.) cuts.push_back(root);
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    const double begin = cuts[i - 1], end = cuts[i];
    const VectorXd first = from + begin * change, last = from + end * change;
    ++evaluations;
    edges_.setMargin(marginAt(.5 * (first + last)) + slack);
    if (edges_.isFree(first.data(), last.data())) continue;
    countHit();
    MotionContact contact = *edges_.lastHitPair();
    contact.time = begin + contact.time * (end - begin);
    return contact;
  }
  return std::nullopt;
}

std::vector<ClearanceCheck::Nearest> ClearanceCheck::nearerThan(const VectorXd& q, double up_to) {
  ++evaluations;
  edges_.setMargin(up_to);
  if (edges_.isFree(q.data())) return {};  // faster
  if (!pairs_) pairs_.emplace(state_.sharedModel());
  state_.setJoints(q.data());
  pairs_->place(state_);
  std::vector<Nearest> near;
  pairs_->forDistances(up_to, [&](int a, int b, double distance) {
    const bool moves = state_.link(a) != state_.link(b);  // else q does not change the distance
    if (moves && distance < up_to) near.push_back({distance, a, b});
  });
  std::stable_sort(near.begin(), near.end(),
                   [](const Nearest& x, const Nearest& y) { return x.distance < y.distance; });
  return near;
}

std::optional<ClearanceCheck::Nearest> ClearanceCheck::nearest(const VectorXd& q, double up_to) {
  const std::vector<Nearest> near = nearerThan(q, up_to);
  return near.empty() ? std::nullopt : std::optional(near.front());
}

}  // namespace kinegraph::inline planning_internal
