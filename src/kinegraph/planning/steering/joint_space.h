#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph {

/// The joint vectors of a scene as points between which planners measure distances and draw straight motions.
///
/// A dof has a range (its limits), is *endless* (an angle without limits: the shorter way around counts), belongs to a
/// quaternion or circle (both signs are one rotation), or is *still* (it moves nothing, or its limits are one number).
/// Distances are Euclidean in q, in rad and m; the four numbers of a quaternion count as the angle between rotations,
/// nearly.
class JointSpace {
 public:
  explicit JointSpace(const KinematicModel& model);

  int dofs() const { return int(kinds_.size()); }

  /// No dof is endless or part of a direction: the joint vectors are a plain vector space.
  bool isPlain() const { return plain_; }

  /// Names of the dofs that slide, or turn what an endless dof cannot, without limits: nothing can be drawn from them.
  const std::vector<std::string>& dofsWithoutRange() const { return without_range_; }

  /// Throws ValueError that names the dofs without range; `who` is what asks.
  void requireRanges(const char* who) const;

  /// What a straight motion adds: from + difference(from, to) is `to`, or the same with other signs and turns.
  VectorXd difference(const VectorXd& from, const VectorXd& to) const;

  double distance(const VectorXd& a, const VectorXd& b) const { return std::sqrt(squaredDistance(a.data(), b.data())); }
  double squaredDistance(const double* a, const double* b) const {
    if (!plain_) return squaredDistanceOfKinds(a, b);
    double square = 0.;
    for (std::size_t i = 0; i < kinds_.size(); ++i) square += (b[i] - a[i]) * (b[i] - a[i]);
    return square;
  }

  /// From now on dofs with a range are drawn between these (per dof) and their limits.
  void sampleWithin(const VectorXd& lower, const VectorXd& upper);

  /// Uniform within ranges; still dofs as in `like`.
  VectorXd sample(Rng& rng, const VectorXd& like) const;

  /// Puts endless dofs into [-pi, pi), and quaternions and circles at length one.
  void normalize(VectorXd& q) const;

  /// Moves dofs that are out of range to the nearest limit.
  void clamp(VectorXd& q) const;

  /// Of the dof that is farthest beyond a limit, and by more than `tolerance` (rad or m), in words; "" if there is none.
  std::string beyondLimits(const VectorXd& q, double tolerance) const;

  /// The same points, one per row, as a motion whose straight pieces between rows are the shortest ones: endless dofs
  /// count turns, quaternions keep their sign.
  MatrixXd unroll(const std::vector<VectorXd>& points) const;

  /// "panda_joint1 = 2.9"
  std::string nameOf(int dof) const { return names_[std::size_t(dof)]; }

 private:
  enum class Kind : unsigned char { ranged, endless, direction, still };

  double squaredDistanceOfKinds(const double* a, const double* b) const;

  const VectorXd lower_, upper_;
  VectorXd draw_lower_, draw_upper_;
  std::vector<Kind> kinds_;
  std::vector<KinematicModel::DofRange> directions_;
  std::vector<std::string> names_, without_range_;
  bool plain_ = true;
};

/// Length of a polyline whose points are rows, as JointSpace measures it.
double pathLength(const JointSpace& space, const MatrixXd& path);

/// "joint" or "joint:i" per dof.
std::vector<std::string> dofNames(const KinematicModel& model);

}  // namespace kinegraph
