#include "kinegraph/motion/clearance_check.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

ClearanceCheck::ClearanceCheck(const State& scene, const JointSpace& space, Clearance clearance)
    : space_(&space),
      clearance_(std::move(clearance)),
      edges_(scene, clearance_.margin, Clearance::kTolerance),
      state_(scene),
      pairs_(scene.sharedProgram()) {}

double ClearanceCheck::marginAt(const VectorXd& q) const {
  double margin = clearance_.margin;
  for (const Clearance::Tight& tight : clearance_.tight) {
    const double square = space_->squaredDistance(q.data(), tight.q.data());
    if (square <= Clearance::kAround * Clearance::kAround) margin = std::min(margin, tight.margin);
  }
  return margin + clearance_.guard;
}

void ClearanceCheck::countHit() {
  if (const auto& hit = edges_.lastHit()) ++hits_[{hit->a, hit->b}];
}

bool ClearanceCheck::isFree(const VectorXd& q) {
  ++evaluations;
  edges_.setMargin(marginAt(q));
  if (edges_.isFree(q.data())) return true;
  countHit();
  return false;
}

bool ClearanceCheck::seemsFree(const VectorXd& from, const VectorXd& to) {
  const VectorXd change = space_->difference(from, to);
  if (!isFree(from + change)) return false;
  const double length = space_->distance(from, to);
  for (int parts = 2; length * 2. > clearance_.resolution * parts; parts *= 2) {
    for (int i = 1; i < parts; i += 2) {
      if (!isFree(from + double(i) / parts * change)) return false;
    }
  }
  return true;
}

/// Where margins differ along the motion, it is cut there, and each piece has one margin.
std::optional<MotionContact> ClearanceCheck::contact(const VectorXd& from, const VectorXd& to, double room) {
  const VectorXd change = space_->difference(from, to);
  std::vector<double> cuts = {0., 1.};
  for (const Clearance::Tight& tight : clearance_.tight) {  // where the straight motion enters and leaves the ball
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
    edges_.setMargin(marginAt(.5 * (first + last)) + room);
    if (edges_.isFree(first.data(), last.data())) continue;
    countHit();
    MotionContact contact = *edges_.lastHit();
    contact.time = begin + contact.time * (end - begin);
    return contact;
  }
  return std::nullopt;
}

std::vector<ClearanceCheck::Nearest> ClearanceCheck::nearerThan(const VectorXd& q, double up_to) {
  ++evaluations;
  state_.setJoints(q.data());
  pairs_.place(state_);
  std::vector<Nearest> near;
  pairs_.forDistances(up_to, [&](int a, int b, double distance) {
    const bool moves = state_.link(a) != state_.link(b);  // else it says nothing about q
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

}  // namespace kinegraph
