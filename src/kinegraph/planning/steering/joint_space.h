#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph::inline planning_internal {

/// The joint vectors of a scene as a metric space with samples and straight edges.
///
/// A dof is of one of four kinds. It has a range (its limits), or is *endless*: an angle without limits, modulo a
/// rotation. It may belong to a quaternion or circle, whose signs are one rotation, or be *fixed*: it moves nothing, or
/// its limits are one number. Distances are Euclidean in q, in rad and m; the four numbers of a quaternion count as the
/// angle between rotations, nearly.
class JointSpace {
 public:
  explicit JointSpace(const KinematicModel& model);

  int dofs() const { return int(kinds_.size()); }

  /// No dof is endless or part of a quaternion or circle: the joint vectors are a vector space.
  bool isPlain() const { return plain_; }

  /// Names of the dofs that have no limits and are not endless, as translations: they cannot be sampled.
  const std::vector<std::string>& dofsWithoutRange() const { return without_range_; }

  /// Throws ValueError that names the dofs without range; `who` names the caller.
  void requireRanges(const char* who) const;

  /// The change along a straight edge: from + difference(from, to) is `to`, up to signs of quaternions and whole
  /// rotations.
  VectorXd difference(const VectorXd& from, const VectorXd& to) const;

  double distance(const VectorXd& a, const VectorXd& b) const { return std::sqrt(squaredDistance(a.data(), b.data())); }
  double squaredDistance(const double* a, const double* b) const {
    if (!plain_) return squaredDistanceOfKinds(a, b);
    double square = 0.;
    for (std::size_t i = 0; i < kinds_.size(); ++i) square += (b[i] - a[i]) * (b[i] - a[i]);
    return square;
  }

  /// Samples dofs without range within these bounds (per dof); their limits stay open.
  void sampleUnlimitedWithin(const VectorXd& lower, const VectorXd& upper);

  /// Restricts the samples of dofs with a range to these bounds (per dof), within their limits.
  void sampleWithin(const VectorXd& lower, const VectorXd& upper);

  /// Samples uniformly within ranges; fixed dofs are as in `like`.
  VectorXd sample(Rng& rng, const VectorXd& like) const;

  /// Maps endless dofs to [-pi, pi), and quaternions and circles to length one.
  void normalize(VectorXd& q) const;

  /// The dofs that form a quaternion or a circle.
  const std::vector<KinematicModel::DofRange>& unitNorms() const { return directions_; }

  /// Moves dofs that are out of range to the nearest limit.
  void clamp(VectorXd& q) const;

  /// Describes the dof that exceeds its limit most, and by more than `tolerance` (rad or m); "" if there is none.
  std::string beyondLimits(const VectorXd& q, double tolerance) const;

  /// Returns the points, one per row, so that rows are connected by the shortest edges: endless dofs accumulate
  /// rotations, and quaternions keep their sign.
  MatrixXd unroll(const std::vector<VectorXd>& points) const;

  /// The name of a dof, for messages.
  std::string nameOf(int dof) const { return names_[std::size_t(dof)]; }

 private:
  enum class Kind : unsigned char { ranged, endless, direction, fixed };

  double squaredDistanceOfKinds(const double* a, const double* b) const;

  const VectorXd lower_, upper_;
  VectorXd sample_lower_, sample_upper_;
  std::vector<Kind> kinds_;
  std::vector<KinematicModel::DofRange> directions_;
  std::vector<std::string> names_, without_range_;
  bool plain_ = true;
};

/// The length of a polyline whose points are rows, in joint space.
double pathLength(const JointSpace& space, const MatrixXd& path);

/// "joint" or "joint:i" per dof.
std::vector<std::string> dofNames(const KinematicModel& model);

}  // namespace kinegraph::inline planning_internal
