#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/planning/steering/joint_space.h"

namespace kinegraph::inline planning_internal {

/// The distance that all collidable pairs have to keep: a margin, and a smaller one around configurations that do not
/// keep it.
struct Clearance {
  /// A start or goal closer to contact than the margin.
  struct Tight {
    VectorXd q;
    double margin;  ///< m, around q
  };
  static constexpr double kAround = .25;      ///< radius around it, in joint space
  static constexpr double kTolerance = 1e-5;  ///< m, of the continuous check
  static constexpr double kGuard = 2e-5;      ///< m, added by searches, so that parts of a free edge are free

  double margin = 0.;             ///< m
  double guard = 0.;              ///< m, in addition to all margins
  std::vector<Tight> tight = {};  ///< few
  double resolution = 1. / 32.;   ///< between samples of an edge, in joint space
};

using PairCounts = std::map<std::pair<int, int>, long>;

/// Collision checks of configurations and edges. Every thread has its own.
class ClearanceCheck {
 public:
  /// `space` must outlive the check.
  ClearanceCheck(const State& scene, const JointSpace& space, Clearance clearance);

  const JointSpace& space() const { return *space_; }
  const State& scene() const { return edges_.scene(); }

  /// Replaces the clearance to keep.
  void setClearance(Clearance clearance) { clearance_ = std::move(clearance); }

  /// The distance to keep at a configuration, guard included, m.
  double marginAt(const VectorXd& q) const;

  /// Whether all collidable pairs keep the clearance. Does not check joint limits.
  bool isFree(const VectorXd& q);

  /// Whether samples of the edge, `resolution` apart, are free. Checks some that are spread over the edge first, which
  /// finds most collisions soon. If all samples are free, the edge nearly always is.
  bool seemsFree(const VectorXd& from, const VectorXd& to);

  /// Checks an edge continuously, with `slack` (m) beyond all margins. Returns one of its contacts with the time in [0,
  /// 1] along the edge, or none. The distance of the contact is NaN; see lastDistance.
  std::optional<MotionContact> contact(const VectorXd& from, const VectorXd& to, double slack = 0.);
  bool isMotionFree(const VectorXd& from, const VectorXd& to, double slack = 0.) { return !contact(from, to, slack); }

  /// Distance of the last contact, m.
  double lastDistance() const { return edges_.lastHit()->distance; }

  /// A pair and its distance.
  struct Nearest {
    double distance;
    int a, b;  ///< frame ids
  };
  /// The closest pair at q, if its distance is less than `up_to` (m).
  std::optional<Nearest> nearest(const VectorXd& q, double up_to);

  /// All pairs closer than `up_to` (m), the closest first.
  std::vector<Nearest> nearerThan(const VectorXd& q, double up_to);

  /// Number of checks so far. One check is up to EdgeChecker::kLanes configurations side by side, also if it exits
  /// early, or the continuous check of an edge, or of each of its pieces if margins differ along it.
  long evaluations = 0;

  /// Number of collisions per pair of frames (ids).
  const PairCounts& hits() const { return hits_; }
  /// Resets these counts and the pair that is checked first.
  void forget();

 private:
  using Places = std::array<int, EdgeChecker::kLanes>;
  bool areFree(const VectorXd& from, const VectorXd& change, int parts, const Places& places, int count);
  void countHit();

  const JointSpace* space_;
  Clearance clearance_;
  EdgeChecker edges_;
  State state_;
  std::optional<NearPairs> pairs_;  ///< constructed on first use
  PairCounts hits_;
  VectorXd samples_[EdgeChecker::kLanes];
};

}  // namespace kinegraph::inline planning_internal
