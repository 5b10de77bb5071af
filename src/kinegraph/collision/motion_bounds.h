#pragma once

#include <vector>

#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// How fast a straight motion q(s) = (1 - s) from + s to, 0 <= s <= 1, moves what hangs on the links, and how far from
/// straight, at most. With dq/ds constant, a point p within r_j of the axis of joint j has
///
///     |dp/ds| <= sum_j v_j,   v_j = w_j r_j for joints that turn with w_j = |dq_j|, |dq_j| for those that slide
///     |d^2p/ds^2| <= sum_j w_j (v_j + 2 sum_{k behind j} v_k)
///
/// and for joints given by quaternions or circles also what their own rate changes by.
class MotionBounds {
 public:
  struct Rates {
    double speed = 0.;  ///< m per unit of s
    double bend = 0.;   ///< m per unit of s squared
    double reach = 0.;  ///< from the origin of the link that it is relative to, m
  };

  explicit MotionBounds(const State& scene);

  void setMotion(const double* from, const double* to);

  /// Of all points within `reach` (m) of a link's origin, relative to another link that it hangs on.
  Rates ratesOf(int link, double reach, int ancestor = 0) const;

  /// Of unit vectors fixed to a link, relative to another link that it hangs on: |du/ds| and |d^2u/ds^2|, at most.
  Rates directionOf(int link, int ancestor = 0) const;

  /// Of the points of two bodies relative to each other: both relative to the last link that both hang on.
  Rates relative(int link_a, double reach_a, int link_b, double reach_b) const;

  /// The last link that both hang on, or one of them.
  int commonLink(int link_a, int link_b) const;

 private:
  struct StepBound {
    double turn = 0.;   ///< rad per unit of s
    double twist = 0.;  ///< by how much that changes, rad per unit of s squared
    double move = 0.;   ///< m per unit of s
    double reach = 0.;  ///< largest distance that it moves what follows, m
  };

  StepBound boundOf(const MotionStep& step, double scale, int dof, const double* from, const double* to) const;
  void climb(int link, Rates& rates) const;

  std::shared_ptr<const KinematicModel> model_;
  std::vector<double> offset_;    ///< per link: how far its joint sits from the origin of its parent, m
  std::vector<StepBound> steps_;  ///< as the Program's
};

}  // namespace kinegraph
