#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/planning/steering/joint_space.h"

namespace kinegraph {

/// What counts as free: all collidable pairs keep `margin` apart, or, near a posture that is itself closer to contact,
/// what that posture keeps.
struct Clearance {
  /// A start or goal that keeps less than the margin.
  struct Tight {
    VectorXd q;
    double margin;  ///< m, that holds around it
  };
  static constexpr double kAround = .25;      ///< how far around it, in joint space
  static constexpr double kTolerance = 1e-5;  ///< m, of the check at all times
  static constexpr double kGuard = 2e-5;  ///< m, by which searches keep more, so that pieces of what is free are free

  double margin = 0.;             ///< m
  double guard = 0.;              ///< m, in addition to all margins
  std::vector<Tight> tight = {};  ///< few
  double resolution = 1. / 32.;   ///< between postures that are looked at first, in joint space
};

using PairCounts = std::map<std::pair<int, int>, long>;

/// One thread's answers to whether postures and straight motions between them are free.
class ClearanceCheck {
 public:
  /// `space` must stay.
  ClearanceCheck(const State& scene, const JointSpace& space, Clearance clearance);

  const JointSpace& space() const { return *space_; }
  const State& scene() const { return edges_.scene(); }

  /// Replaces what counts as free.
  void setClearance(Clearance clearance) { clearance_ = std::move(clearance); }

  /// What a posture has to keep: the margin that holds there, and the guard, m.
  double marginAt(const VectorXd& q) const;

  /// All collidable pairs far enough apart? Limits are not looked at.
  bool isFree(const VectorXd& q);

  /// Are the postures of the motion free that are looked at, every `resolution` of it? First some that are spread over
  /// it, where what is not free comes to light soon; then the others. What seems free nearly always is, at all times.
  bool seemsFree(const VectorXd& from, const VectorXd& to);

  /// Is it free at all times? A contact is one of those on the way, its time that on the way from `from` to `to`.
  /// `room` (m) is kept beyond all margins. Its distance is NaN, see lastDistance.
  std::optional<MotionContact> contact(const VectorXd& from, const VectorXd& to, double room = 0.);
  bool isMotionFree(const VectorXd& from, const VectorXd& to, double room = 0.) { return !contact(from, to, room); }

  /// Of the last contact, m.
  double lastDistance() const { return edges_.lastHit()->distance; }

  /// The least distance of a collidable pair at q, if it is less than `up_to`, and that pair.
  struct Nearest {
    double distance;
    int a, b;  ///< frame ids
  };
  std::optional<Nearest> nearest(const VectorXd& q, double up_to);
  /// All pairs nearer than that.
  std::vector<Nearest> nearerThan(const VectorXd& q, double up_to);

  /// Questions to the kinematics: each is up to EdgeChecker::kLanes postures side by side, wherever the first of them
  /// is not free, or a motion at all times, or one of its pieces where margins differ.
  long evaluations = 0;

  /// How often a pair of frames (ids) was what a posture or motion ran into.
  const PairCounts& hits() const { return hits_; }
  /// Forgets these counts, and what was hit last.
  void forget();

 private:
  using Places = std::array<int, EdgeChecker::kLanes>;
  bool areFree(const VectorXd& from, const VectorXd& change, int parts, const Places& places, int count);
  void countHit();

  const JointSpace* space_;
  Clearance clearance_;
  EdgeChecker edges_;
  State state_;
  std::optional<NearPairs> pairs_;  ///< made when it is first needed
  PairCounts hits_;
  VectorXd samples_[EdgeChecker::kLanes];
};

}  // namespace kinegraph
