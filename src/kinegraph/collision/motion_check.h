#pragma once

#include <memory>
#include <optional>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/geometry/distance/box_tree.h"

namespace kinegraph {

class EdgeEngine;

/// The first pair that a motion brings too near; or, where limits are looked at, the first dof that leaves them.
struct MotionContact {
  double time = 0.;      ///< s in [0, 1]: until then the motion is free
  int a = 0, b = 0;      ///< frame ids; of a limit, both are the joint's
  double distance = 0.;  ///< of the pair at `time`, m; of a limit: what is left to it, m or rad, negative beyond
  int dof = -1;          ///< of a limit: the entry of q; else -1
};

/// Checks straight motions q(s) = (1 - s) from + s to, 0 <= s <= 1, at all times and not just at samples of them.
///
/// Conservative advancement: no point of a body moves, relative to the other one, faster than the sum over the joints
/// between them of |dq_j| r_j, with r_j a bound of its distance from the axis (1 for a translation). So a pair whose
/// distance is d need not be looked at again before s + (d - margin) / speed. Of all pairs, the one that is due next is
/// looked at. Where bodies are many, only pairs are looked at whose boxes, with room for all that the motion may move
/// them, meet. Whether there is any contact is found in another way before (EdgeEngine), which takes less. Source:
/// Mirtich, Impulse-based dynamic simulation of rigid body systems, 1996, ch. 2; Schwarzer, Saha, Latombe, Adaptive
/// dynamic collision checking for single and multiple articulated robots, 2005.
class MotionChecker {
 public:
  /// For the pairs of a scene that count (Program::movingPairs). `scene` is any State of it.
  explicit MotionChecker(const State& scene);

  MotionChecker(const MotionChecker& other) : MotionChecker(other.state_) {}
  ~MotionChecker();

  /// The first pair nearer than `margin` + `tolerance` that could not be shown to keep `margin` (m) apart; none if all
  /// do for the whole motion. A larger tolerance (m, > 0) takes fewer steps along surfaces that slide past each other.
  std::optional<MotionContact> firstContact(const double* from, const double* to, double margin, double tolerance);

 private:
  struct Due {
    double time;
    int pair;
    bool operator<(const Due& other) const { return time > other.time || (time == other.time && pair > other.pair); }
  };

  /// How near is too near, m.
  struct Limits {
    double margin, tolerance;
  };

  void setMotion(const double* from, const double* to);
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
  std::unique_ptr<EdgeEngine> edges_;  ///< says first whether there is any contact
  std::optional<BodyPairs> pairs_;  ///< where bodies are many, those of the present motion that it can bring together
  std::optional<PlacedBodies> bodies_;
  bool many_;  ///< bodies: then `pairs_` are chosen for each motion
  DisplacementBound bounds_;
  std::vector<int> fixed_, moving_;  ///< where bodies are many: their places in the Program's contacts
  BoxTree fixed_boxes_;
  VectorXd from_, change_, q_, until_;
  double time_ = 0.;
  std::vector<double> speed_;  ///< per pair, m per unit of s
  std::vector<Due> due_;       ///< a heap, the earliest first
};

}  // namespace kinegraph
