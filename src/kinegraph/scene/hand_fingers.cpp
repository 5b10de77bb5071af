#include "kinegraph/scene/hand_fingers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr int kSamples = 33;           ///< of an opening that is not linear
constexpr double kSameOpening = 1e-3;  ///< m: tolerance of an opening that starts at zero
constexpr double kLeastRange = 1e-3;   ///< m: shapes whose distance changes less measure no opening

bool slides(JointType type) {
  return type == JointType::transX || type == JointType::transY || type == JointType::transZ;
}

/// The nearest frame with a joint, from a frame upwards; null without one.
const FrameData* linkOf(const FrameData& frame) {
  const FrameData* up = &frame;
  while (up && !up->joint) up = up->parent;
  return up;
}

/// The shapes of one link of a finger, and where their centers are at both limits.
struct FingerLink {
  std::vector<const FrameData*> shapes;
  Vector3d closed = Vector3d::Zero(), opened = Vector3d::Zero();
  Vector3d motion() const { return opened - closed; }
};

using ShapePair = std::pair<const FrameData*, const FrameData*>;

class Fingers {
 public:
  Fingers(const Config& C, const FrameData& joint) : scene_(C), joint_(joint.name) {
    for (const auto& other : C.scene()->frames())
      if (other->moves() && &dofSource(*other) == &joint) fingers_.push_back(other->name);
  }

  HandFingers measured() {
    const FrameData& joint = *scene_.scene()->find(joint_);
    HandFingers hand{joint_, fingers_, {}, {}, {}};
    double sum = 0.;
    bool all_slide = true;
    for (const std::string& name : fingers_) {
      const FrameData& finger = *scene_.scene()->find(name);
      sum += std::abs(motionScale(finger));
      all_slide = all_slide && slides(finger.joint->type);
    }
    const bool has_limits = joint.joint->lower.size() == 1 && joint.joint->upper[0] > joint.joint->lower[0];
    const double lower = has_limits ? joint.joint->lower[0] : 0., upper = has_limits ? joint.joint->upper[0] : 0.;
    if (has_limits) measure(hand, lower, upper, all_slide);
    const bool is_sum = all_slide && hand.q.size() > 0 && std::abs(hand.widthAt(lower) - sum * lower) < kSameOpening &&
                        std::abs(hand.widthAt(upper) - sum * upper) < kSameOpening;
    if (hand.q.size() > 0 && !is_sum) return hand;
    hand.per_position = sum;
    if (!has_limits) return hand;
    hand.q = Eigen::Vector2d(lower, upper);
    hand.widths = sum * hand.q;
    return hand;
  }

 private:
  /// Samples the distance between the two links that move the most against each other.
  void measure(HandFingers& hand, double lower, double upper, bool all_slide) {
    std::map<const FrameData*, FingerLink> links;
    for (const bool colliding : {true, false}) {
      collect(links, colliding);
      if (links.size() > 1) break;
      links.clear();
    }
    place(links, lower, &FingerLink::closed);
    place(links, upper, &FingerLink::opened);
    const FingerLink* most = nullptr;
    for (const std::string& name : ordered(links))
      if (const FingerLink& link = links.at(scene_.scene()->find(name));
          !most || link.motion().norm() > most->motion().norm() + 1e-9)
        most = &link;
    const FingerLink* other = nullptr;
    for (const std::string& name : ordered(links))
      if (const FingerLink& link = links.at(scene_.scene()->find(name));
          &link != most &&
          link.motion().dot(most->motion()) < (other ? other->motion().dot(most->motion()) - 1e-9 : 0.))
        other = &link;
    if (!other) return;
    const std::vector<ShapePair> pairs = openingPairs(*most, *other, lower, upper);
    const bool overlaps = std::min(distanceOf(pairs, lower), distanceOf(pairs, upper)) < -kSameOpening;
    hand.q = VectorXd::LinSpaced(all_slide && !overlaps ? 2 : kSamples, lower, upper);
    hand.widths.resize(hand.q.size());
    for (Eigen::Index k = 0; k < hand.q.size(); ++k) hand.widths[k] = std::max(distanceOf(pairs, hand.q[k]), 0.);
    if (hand.widths.maxCoeff() - hand.widths.minCoeff() < kLeastRange) {
      hand.q.resize(0);
      return;
    }
    for (const FingerLink* link : {most, other})
      for (const FrameData* shape : link->shapes)
        if (std::ranges::any_of(pairs, [&](const auto& pair) { return pair.first == shape || pair.second == shape; }))
          hand.pads.push_back(shape->name);
  }

  /// The pairs of shapes between which something is held: their distance changes at least half as much as that of any
  /// pair. The distance of carriages on a rail, side by side, hardly changes.
  std::vector<ShapePair> openingPairs(const FingerLink& one, const FingerLink& other, double lower, double upper) {
    std::vector<std::pair<double, ShapePair>> ranges;
    double most = 0.;
    for (const FrameData* a : one.shapes) {
      for (const FrameData* b : other.shapes) {
        const double range = std::abs(distanceOf({{a, b}}, upper) - distanceOf({{a, b}}, lower));
        most = std::max(most, range);
        ranges.push_back({range, {a, b}});
      }
    }
    std::vector<ShapePair> pairs;
    for (const auto& [range, pair] : ranges)
      if (range >= .5 * most) pairs.push_back(pair);
    return pairs;
  }

  void collect(std::map<const FrameData*, FingerLink>& links, bool colliding) const {
    for (const auto& frame : scene_.scene()->frames()) {
      if (!frame->shape || shapeKind(frame->shape->geometry->type).is_symbol) continue;
      if (colliding && frame->shape->contact == 0) continue;
      const FrameData* link = linkOf(*frame);
      if (link && std::ranges::find(fingers_, link->name) != fingers_.end()) links[link].shapes.push_back(frame.get());
    }
  }

  /// Names of links in the order of their frames.
  std::vector<std::string> ordered(const std::map<const FrameData*, FingerLink>& links) const {
    std::vector<std::string> names;
    for (const auto& frame : scene_.scene()->frames())
      if (links.contains(frame.get())) names.push_back(frame->name);
    return names;
  }

  void place(std::map<const FrameData*, FingerLink>& links, double at, Vector3d FingerLink::*centers) {
    setFingers(at);
    for (auto& [frame, link] : links) {
      Vector3d sum = Vector3d::Zero();
      for (const FrameData* shape : link.shapes)
        sum += scene_.scene()->state().pose(shape->id) * shape->shape->body()->boundCenter();
      link.*centers = sum / double(link.shapes.size());
    }
  }

  /// The least distance of the pairs with the fingers at a joint position; negative for overlaps.
  double distanceOf(const std::vector<ShapePair>& pairs, double at) {
    setFingers(at);
    const State& state = scene_.scene()->state();
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : pairs)
      least = std::min(least,
                       proximity(*a->shape->body(), state.pose(a->id), *b->shape->body(), state.pose(b->id)).distance);
    return least;
  }

  void setFingers(double at) { scene_.setJointState(VectorXd::Constant(1, at), {joint_}); }

  Config scene_;
  const std::string joint_;
  std::vector<std::string> fingers_;
};

}  // namespace

double HandFingers::widthAt(double at) const {
  if (per_position != 0. || q.size() < 2) return per_position * at;
  const double step = (q[q.size() - 1] - q[0]) / double(q.size() - 1);
  const double place = std::clamp((at - q[0]) / step, 0., double(q.size() - 1));
  const Eigen::Index k = std::min(Eigen::Index(place), q.size() - 2);
  return widths[k] + (place - double(k)) * (widths[k + 1] - widths[k]);
}

double HandFingers::positionAt(double width) const {
  if (per_position != 0. || q.size() < 2) {
    const double at = per_position == 0. ? 0. : width / per_position;
    return q.size() < 2 ? at : std::clamp(at, q[0], q[q.size() - 1]);
  }
  const double sign = widths[q.size() - 1] > widths[0] ? 1. : -1.;
  if (width <= widths.minCoeff()) return sign > 0. ? q[0] : q[q.size() - 1];
  for (Eigen::Index k = 0; k + 1 < q.size(); ++k) {
    const Eigen::Index i = sign > 0. ? k : q.size() - 1 - k, next = sign > 0. ? i + 1 : i - 1;  // from closed to open
    if (width > widths[next] && k + 2 < q.size()) continue;
    const double range = widths[next] - widths[i];
    const double share = range > 0. ? std::clamp((width - widths[i]) / range, 0., 1.) : 1.;
    return q[i] + share * (q[next] - q[i]);
  }
  return q[0];
}

double HandFingers::slopeAt(double at) const {
  if (per_position != 0. || q.size() < 2) return per_position;
  const double step = (q[q.size() - 1] - q[0]) / double(q.size() - 1);
  const Eigen::Index k = std::clamp(Eigen::Index((at - q[0]) / step), Eigen::Index(0), q.size() - 2);
  const double slope = (widths[k + 1] - widths[k]) / step;
  const double mean = (widths[q.size() - 1] - widths[0]) / (q[q.size() - 1] - q[0]);
  return slope / mean > .1 ? slope : mean;  // flat where closed fingers overlap
}

HandFingers HandFingers::scaled(double scale) const {
  HandFingers hand = *this;
  if (scale == 1.) return hand;
  hand.q *= scale;
  hand.per_position /= scale;
  if (scale < 0.) {  // q increases
    hand.q.reverseInPlace();
    hand.widths.reverseInPlace();
  }
  return hand;
}

std::vector<HandFingers> handFingersOf(const Config& C) {
  std::vector<HandFingers> hands;
  for (const auto& frame : C.scene()->frames()) {
    const auto& joint = frame->joint;
    if (!joint || joint->active || joint->mimic || joint->dofs() != 1 || !frame->parent) continue;
    const bool has_followers = std::ranges::any_of(C.scene()->frames(), [&](const auto& other) {
      return other->moves() && other.get() != frame.get() && &dofSource(*other) == frame.get();
    });
    if (has_followers) hands.push_back(Fingers(C, *frame).measured());
  }
  return hands;
}

}  // namespace kinegraph::inline scene_internal
