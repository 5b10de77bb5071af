#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kinegraph/collision/motion_check.h"

namespace kinegraph {

class EdgeEngine;

/// Answers the questions that a planner asks of one scene, thousands of times: is this q free, is this edge? An edge is
/// the straight motion q(s) = (1 - s) from + s to, 0 <= s <= 1. Free means that all pairs that joints move apart
/// (Program::movingPairs) keep the margin, on an edge at all of its times and not just at samples; MotionChecker, which
/// gives the *first* contact, does not differ by more than the tolerance. Limits of joints are not looked at (see
/// withinLimits).
///
/// Each thread has its own; a copy has the same settings and remembers nothing. Answers do not depend on what was asked
/// before, only `lastHit` does: what was hit last is looked at first.
class EdgeChecker {
 public:
  static constexpr int kLanes = 8;  ///< configurations that are looked at side by side

  /// Any State of the scene will do. Of a pair within margin + tolerance (m, > 0), `isFree` of an edge may say no.
  explicit EdgeChecker(const State& scene, double margin = 0., double tolerance = 1e-5);
  EdgeChecker(const EdgeChecker& other);
  ~EdgeChecker();

  /// m; the distance that all pairs have to keep. Negative: they may overlap by that much.
  double margin() const { return margin_; }
  void setMargin(double margin) { margin_ = margin; }
  void setTolerance(double tolerance);

  const State& scene() const { return state_; }

  /// Are all pairs at least `margin` apart at q (dofs numbers)?
  bool isFree(const double* q);

  /// Of at most kLanes configurations at once, per configuration. Quickest where they follow one another.
  void areFree(std::span<const double* const> Q, bool* free);

  /// Are they all free? Ends at the first pair that is found too near, in any of them.
  bool areAllFree(std::span<const double* const> Q);

  /// Of an edge, at all times. Ends at the first pair that is found too near, at any time.
  bool isFree(const double* from, const double* to);

  /// A pair, with time and distance, that the last question was answered no for; of configurations, the time is 0.
  const std::optional<MotionContact>& lastHit() const;
  /// The same without its distance (NaN), which is computed when it is asked for.
  const std::optional<MotionContact>& lastHitPair() const;

  /// Forgets what was hit last, as if nothing had been asked before.
  void forget();

  /// What an edge meets first in time; see MotionChecker. None if it is free.
  std::optional<MotionContact> firstContact(const double* from, const double* to);

  /// The least distance of all pairs at q, m; `most` if none is nearer than that.
  double clearance(const double* q, double most = std::numeric_limits<double>::infinity());

  /// A lower bound of the least distance of all pairs along an edge, m, or of `most` if none is nearer than that; by no
  /// more than the tolerance.
  double clearance(const double* from, const double* to, double most);

  /// Where pairs come nearer than `most` (m) and nearer than just before and just after, between the ends of an edge.
  /// Looked for among samples of it (8 for each .35 m that a point moves at most) and near them: what one finds, not a
  /// proof.
  const std::vector<MotionContact>& approaches(const double* from, const double* to, double most);

 private:
  State state_;
  double margin_, tolerance_;
  std::unique_ptr<EdgeEngine> engine_;
  std::unique_ptr<MotionChecker> motions_;  ///< made when it is first asked
  std::vector<MotionContact> approaches_;
};

}  // namespace kinegraph
