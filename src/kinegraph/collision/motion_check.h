#pragma once

#include <memory>
#include <optional>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/collision/edge_check.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/geometry/distance/closed_form/box_tree.h"

namespace kinegraph::inline collision_internal {

class EdgeEngine;

/// Finds the first contact along an edge q(s) = (1 - s) from + s to, 0 <= s <= 1, continuously.
///
/// Conservative advancement: relative to the other body, no point moves faster than the sum over the joints between
/// them of |dq_j| r_j, with r_j a bound of its distance from the axis (1 for a translation). A pair at a distance d
/// therefore keeps the margin until s + (d - margin) / speed. A queue orders the pairs by these times. For many bodies,
/// only pairs whose swept boxes meet are checked. EdgeEngine, which is faster, first decides whether there is any
/// contact.
///
/// Sources: Mirtich, Impulse-based dynamic simulation of rigid body systems, 1996, ch. 2; Schwarzer, Saha, Latombe,
/// Adaptive dynamic collision checking for single and multiple articulated robots, 2005.
class MotionChecker {
 public:
  /// Checks the pairs KinematicModel::movingPairs. `scene` is any State of the scene.
  explicit MotionChecker(const State& scene);

  MotionChecker(const MotionChecker& other) : MotionChecker(other.state_) {}
  ~MotionChecker();

  /// Returns the first pair closer than `margin` + `tolerance` (m); none if all pairs keep `margin` along the edge. A
  /// larger tolerance (> 0) takes fewer steps along surfaces that slide past each other.
  std::optional<MotionContact> firstContact(const double* from, const double* to, double margin, double tolerance);

 private:
  struct Due {
    double time;
    int pair;
    bool operator<(const Due& other) const { return time > other.time || (time == other.time && pair > other.pair); }
  };

  /// Distances, m.
  struct Limits {
    double margin, tolerance;
  };

  void setEdge(const double* from, const double* to);
  void moveTo(double time);
  double displacementOf(int frame) const;
  double relativeSpeed(int pair) const;
  WorldBox sweptBox(const ContactRules::Body& body) const;
  void findPairs(double margin);

  std::optional<MotionContact> first(const double* from, const double* to, const Limits& limits);
  std::optional<MotionContact> firstInPieces(const double* from, const double* to, const Limits& limits);
  std::optional<MotionContact> firstInOnePiece(const double* from, const double* to, const Limits& limits);
  std::optional<MotionContact> atTheStart(const Limits& limits);
  std::optional<MotionContact> advance(const Limits& limits);
  double spare(int pair, const Limits& limits) const { return bodies_->proximity(pair).distance - limits.margin; }
  MotionContact contactOf(int pair) const;

  State state_;
  std::unique_ptr<EdgeEngine> edges_;  ///< decides first whether there is any contact
  std::optional<BodyPairs> pairs_;     ///< for many bodies: pairs whose swept boxes meet
  std::optional<PlacedBodies> bodies_;
  bool many_;  ///< bodies: `pairs_` are selected for each edge
  DisplacementBound bounds_;
  std::vector<int> fixed_, moving_;  ///< for many bodies: indices into the contacts of the model
  BoxTree fixed_boxes_;
  VectorXd from_, change_, q_, until_;
  double time_ = 0.;
  std::vector<double> speed_;  ///< per pair, m per unit of s
  std::vector<Due> due_;       ///< a heap, the earliest first
};

}  // namespace kinegraph::inline collision_internal
