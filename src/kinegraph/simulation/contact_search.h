#pragma once

#include <vector>

#include "kinegraph/simulation/physics.h"

namespace kinegraph::inline simulation_internal {

/// Tells when no two shapes of a model can touch, so that MuJoCo's search for contacts, which would find none, may be
/// left out. Distances of pairs are measured once; a pair is measured again when both shapes could have moved by as
/// much as their distance since then. The results of steps do not depend on it.
class ContactSearch {
 public:
  ContactSearch() = default;
  explicit ContactSearch(const mjModel& model);

  /// Returns whether no contact is possible at the positions in `d`. Call it once before each step; `d` may be moved to
  /// its positions.
  bool isNeedless(const mjModel& m, mjData& d);

 private:
  struct Pair {
    int geom_a, geom_b, body_a, body_b;
    double reach;        ///< m: distance of the geoms at which contacts are found
    std::size_t origin;  ///< index in origins_ of the last body that carries both
    double apart_until;  ///< both bodies' travel up to which the geoms are farther apart than that
  };
  /// How far bodies could have moved in the axes of a body that carries them, since the start.
  struct Origin {
    int body, end;               ///< it carries the bodies between both
    std::vector<double> travel;  ///< per carried body: the path of any of its points is at most this long, m
  };
  /// Bounds of a body's motion in its parent, in the last move.
  struct Motion {
    double turn = 0., shift = 0.;  ///< of its axes (rad), of its origin (m)
    double arm = 0.;               ///< distance of its origin from the parent's, m
  };
  std::size_t originOf(const mjModel& m, int body_a, int body_b);
  double travelled(const Pair& pair) const;
  void move(const mjModel& m, const mjData& d);
  static double freeSpace(const mjModel& m, mjData& d, const Pair& pair);

  std::vector<Pair> pairs_;
  std::vector<Origin> origins_;
  std::vector<double> radius_;   ///< per body: largest distance of a point of a geom from the body's origin
  std::vector<Motion> motions_;  ///< per body
  std::vector<double> shift_, turn_;
  std::vector<mjtNum> qpos_;  ///< at the last move
  int pause_ = 0;             ///< number of steps without measurements, after a pair was near
};

}  // namespace kinegraph::inline simulation_internal
