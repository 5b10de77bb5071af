#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline collision_internal {

/// Upper bounds of the displacement of links and of the bodies on them. All of them sum, over the joints between a
/// point and the world (or another link), the largest rate at which a joint moves a point that it carries: a joint that
/// rotates with w moves a point at a distance r from its axis by w r.
///
///     DisplacementBound       along an edge: first and second derivative of any point by the path parameter
///     DeviationBound          near an edge: by how much pairs may come closer if dofs deviate from it
///     displacementBound()     near one configuration: tighter, as it uses the distances from the axes there
///
/// Source: Schwarzer, Saha, Latombe, Adaptive dynamic collision checking for single and multiple articulated robots,
/// 2005.

/// Bounds of the derivatives of points and directions on the links along an edge q(s) = (1 - s) from + s to, 0 <= s <=
/// 1. With dq/ds constant, a point p within r_j of the axis of joint j has
///
///     |dp/ds| <= sum_j v_j,   v_j = w_j r_j for joints that rotate with w_j = |dq_j|, |dq_j| for those that translate
///     |d^2p/ds^2| <= sum_j w_j (v_j + 2 sum_{k behind j} v_k)
///
/// Joints given by quaternions or circles add the change of their own rate. With 0 <= s <= 1, `speed` is also a bound
/// of the displacement over the edge.
class DisplacementBound {
 public:
  struct Rates {
    double speed = 0.;      ///< of the first derivative, m per unit of s
    double curvature = 0.;  ///< of the second derivative, m per unit of s squared
    double reach = 0.;      ///< of the distance from the origin of the link that the point is relative to, m
  };

  explicit DisplacementBound(const State& scene);

  void setEdge(const double* from, const double* to);

  /// Bounds of all points within `reach` (m) of a link's origin, relative to an ancestor of the link.
  Rates ratesOf(int link, double reach, int ancestor = 0) const;

  /// Bounds of unit vectors u fixed to a link, relative to an ancestor of the link: |du/ds| and |d^2u/ds^2|.
  Rates directionRates(int link, int ancestor = 0) const;

  /// Bounds of the points of two bodies relative to each other, each relative to the links' last common ancestor.
  Rates relativeRates(int link_a, double reach_a, int link_b, double reach_b) const;

  /// The last common ancestor of two links, which may be one of them.
  int commonLink(int link_a, int link_b) const;

  /// Distance of a link's joint from the origin of its parent, m.
  double offset(int link) const { return offset_[std::size_t(link)]; }

 private:
  /// Bounds of one step of a joint.
  struct StepBound {
    double rotation = 0.;         ///< rad per unit of s
    double rotation_change = 0.;  ///< of that rate, rad per unit of s squared
    double translation = 0.;      ///< m per unit of s
    double reach = 0.;            ///< largest displacement of the links that it carries, m
  };

  StepBound boundOf(const MotionStep& step, double scale, int dof, const double* from, const double* to) const;
  void climb(int link, Rates& rates) const;

  std::shared_ptr<const KinematicModel> model_;
  std::vector<double> offset_;    ///< per link
  std::vector<StepBound> steps_;  ///< as the steps of the model
};

/// Distance of the farthest point of a frame's body from the origin of the frame's link, m.
double bodyReach(const State& scene, int frame, const CollisionBody& body);

/// Bound of the amount by which two shapes may come closer than on an edge if each dof deviates from it by at most
/// `deviation_j`. Relative to another body, no point moves farther than by the sum over the joints between them of
///
///     reach_j deviation_j   for joints that rotate, reach_j the largest distance of a point behind j from its axis
///     deviation_j           for those that translate
///     reach_j angle_j       for those given by quaternions or circles, angle_j = 2 asin(|deviation_j| / |q_j|) <= pi
///
/// The pairs are KinematicModel::movingPairs.
class DeviationBound {
 public:
  explicit DeviationBound(const State& scene);

  /// Sets bounds of |q_j| of joints that translate, deviations included. Models without such joints need none.
  void setLargest(const VectorXd& largest);

  /// The bound for all configurations on the edge from `from` to `to`, m.
  double of(const VectorXd& from, const VectorXd& to, const VectorXd& deviation);

 private:
  struct LinkPair {
    int a, b, common;
  };
  void findReaches();
  double displacementBy(int link, const VectorXd& from, const VectorXd& to, const VectorXd& deviation) const;

  std::shared_ptr<const KinematicModel> model_;
  DisplacementBound links_;
  std::vector<double> body_reach_;  ///< per link: of the bodies on it, from its origin, m; negative: it has none
  std::vector<double> reach_;       ///< per step of the model: of all bodies behind it, from its axis, m
  std::vector<LinkPair> pairs_;
  std::vector<double> displacement_;  ///< per link: of the bodies on it, relative to the world, m
  VectorXd largest_;
  bool has_translations_ = false;
};

/// Bound of the displacement of any point of a collidable body if each dof changes by at most `change_j`, m. It holds
/// at all configurations whose dofs are within `spread_j` of the state's.
///
/// Joints closer to the world rotate a point's velocity by a joint, but keep its size; a joint closer to the point that
/// moves it by d changes that size by at most |w| d. The sum visits the joints from the point to the world. If joints
/// given by quaternions or circles move a body, this is no proof, and 5 % are added.
double displacementBound(const State& state, const VectorXd& change, const VectorXd& spread);

}  // namespace kinegraph::inline collision_internal
