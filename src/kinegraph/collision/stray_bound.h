#pragma once

#include <memory>
#include <vector>

#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// By how much two shapes may be nearer to each other than at a configuration, where each dof is at most `stray_j` from it.
///
/// No point of a body moves farther, relative to another one, than by the sum over the joints between them of
///     reach_j stray_j   for joints that turn, reach_j the largest distance of a point behind it from its axis
///     stray_j           for those that slide
///     reach_j angle_j   for those given by quaternions or circles, angle_j = 2 asin(|stray_j| / |q_j|), at most pi
///
/// The pairs are those that joints move apart (Program::movingPairs).
class StrayBound {
 public:
  explicit StrayBound(const State& scene);

  /// Joints that slide are no farther out than that, strays included, |q_j|; needed where there are such joints only.
  void setLargest(const VectorXd& largest);

  /// For all configurations on the straight line from `from` to `to`, m.
  double of(const VectorXd& from, const VectorXd& to, const VectorXd& stray);

 private:
  struct LinkPair {
    int a, b, common;
  };
  void findReaches();
  double moveOf(int link, const VectorXd& from, const VectorXd& to, const VectorXd& stray) const;

  std::shared_ptr<const KinematicModel> model_;
  std::vector<double> offset_;      ///< per link: how far its joint sits from the origin of its parent, m
  std::vector<double> body_reach_;  ///< per link: of the bodies on it, from its origin, m; negative: it has none
  std::vector<double> reach_;       ///< per step of the Program: of what is behind it, from its axis, m
  std::vector<LinkPair> pairs_;
  std::vector<double> move_;  ///< per link: of what is on it, relative to the world, m
  VectorXd largest_;
  bool has_slides_ = false;
};

}  // namespace kinegraph
