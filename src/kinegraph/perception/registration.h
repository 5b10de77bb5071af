#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/perception/pose_fit.h"

namespace kinegraph::inline perception_internal {

inline constexpr int kCoarsePoints = 150, kFinePoints = 500;    // of a fit
inline constexpr int kCoarseSamples = 150, kFineSamples = 300;  // of a surface
inline constexpr double kSureScore = .6;                        // from here on a pose is only refined
inline constexpr double kSimilarScore = .12;                    // values of two poses that are about as good
inline const std::vector<double> kCoarseWidths{.015, .012, .009, .006, .004, .003};  // m, of robust weights
inline const std::vector<double> kFineWidths{.003, .002, .002, .002};

/// A pose of a thing; a larger value explains the images better, up to 3.
struct PoseCandidate {
  RigidTransform X;
  double value = -2.;
  double misfit = 0.;  ///< mean squared distance of points, over their noise; only of Registration::atPlaceOf
};

/// A frame to be found.
struct Thing {
  std::string name;
  VisibleShape shape;
  PoseFreedom freedom;
  RigidTransform last;
  std::vector<double> heights;                 ///< m, of the tops on which a resting thing may rest
  std::optional<double> height_of_place = {};  ///< the one of these on which it rests in its last pose
  double search;                               ///< how far from `start` it may be, m
  std::vector<Matrix3d> rotations = {};        ///< resting ones, for a thing that may be anywhere
  bool is_displaced = false;                   ///< another thing is at the only place where it may be
  bool anywhere = false;                       ///< its last pose tells nothing
  bool is_lost = anywhere;                     ///< it was not found yet
  RigidTransform start = last;                 ///< where it is looked for
  PoseCandidate best = {start, -2., 0.};
  std::vector<PoseCandidate> others = {};  ///< other poses that are about as good
  double score = -2.;

  const Vector3d& middle() const { return shape.middle(); }
};

/// The mean distance of the surfaces of a shape in two poses, m.
double meanDistance(const VisibleShape& shape, const RigidTransform& a, const RigidTransform& b);

/// Whether a displacement close to the given one maps a shape to itself.
bool isSymmetry(const VisibleShape& shape, const RigidTransform& displacement);

/// Whether a shape looks the same in two poses, but for a mean distance of .7 mm. Poses of nearly symmetric shapes that
/// are turned by more than 17 degrees do not.
bool looksTheSame(const VisibleShape& shape, const RigidTransform& a, const RigidTransform& b);

/// Turns the best pose of a thing to the one nearest to its last rotation, of those that look the same because the
/// shape is symmetric about the axes of its frame: a cube keeps its sides from look to look.
void keepRotation(Thing& thing);

/// The rotations of a resting thing: each stable face down, about the vertical in steps of 45 degrees, without those
/// that look the same.
std::vector<Matrix3d> restingRotations(const Thing& thing);

/// Fits the poses of several things to measured points. A point belongs to one thing only, and things do not overlap.
class Registration {
 public:
  Registration(std::vector<Thing>& things, const std::vector<ObservedView>& views,
               const std::vector<ObservedPoint>& points)
      : things_(things), views_(views), points_(points) {}

  /// Finds all things near their starts, but for lost ones.
  void run();

  /// Finds lost things at any place where points are measured. Those not found stay lost.
  void findLost();

  /// Whether things overlap in two poses.
  bool overlap(const Thing& a, const RigidTransform& of_a, const Thing& b, const RigidTransform& of_b) const;

  /// The pose in which one thing explains the images best at the place of another one, instead of it.
  PoseCandidate atPlaceOf(const Thing& thing, const Thing& other) const;

  /// Points near a pose that no other thing owns, at most `most`. `index` < 0: other things do not count.
  FitPoints pointsNear(const Thing& thing, int index, const std::vector<int>& owners, const Vector3d& center,
                       double reach, int most, int* thinning = nullptr) const;

  /// The share of the points within 15 mm of a thing, or in it, that its surface explains; other things' points do not
  /// count. 0 without any.
  double explainedBeside(const Thing& thing, const std::vector<int>& owners) const;

  /// For each point the index of the thing whose surface it is on, -1 for none.
  std::vector<int> ownersOfPoints() const;

 private:
  void addNeighbors(const Thing& thing, int index, const Vector3d& center, FitPoints& out) const;
  double shareInside(const Thing& thing, const RigidTransform& X, const Thing& other,
                     const RigidTransform& of_other) const;
  double misfit(const Thing& thing, const FitPoints& points, const RigidTransform& X) const;
  void addTurned(const Thing& thing, int index, const std::vector<int>& owners,
                 std::vector<PoseCandidate>& candidates) const;
  double explained(const Thing& thing, const FitPoints& points, const RigidTransform& X) const;
  double valueOf(const Thing& thing, int index, const FitPoints& points, const RigidTransform& X) const;
  double localValue(const Thing& thing, const std::vector<int>& owners, const RigidTransform& X) const;
  std::vector<PoseCandidate> candidatesAnywhere(const Thing& thing, const std::vector<int>& owners) const;
  std::vector<Vector3d> placesOfPoints(const std::vector<int>& owners, double radius) const;
  bool moveAway(Thing& thing, Thing& stayed, double least_score);
  void separate();
  std::vector<RigidTransform> starts(const Thing& thing, const RigidTransform& from, bool wide) const;
  bool isDoubtful(const Thing& thing, const std::vector<int>& owners) const;
  bool tryDoubtful();  ///< compares doubtful poses with others; whether there are any
  void find(Thing& thing, int index, const std::vector<int>& owners);
  void tryStarts(const Thing& thing, int index, const std::vector<int>& owners, const RigidTransform& from, bool wide,
                 std::vector<PoseCandidate>& candidates) const;
  void refine(Thing& thing, int index, const std::vector<int>& owners, const std::vector<PoseCandidate>& candidates);

  std::vector<Thing>& things_;
  const std::vector<ObservedView>& views_;
  const std::vector<ObservedPoint>& points_;
};

}  // namespace kinegraph::inline perception_internal
