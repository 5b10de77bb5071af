#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/komo/path/path_records.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline komo_internal {

/// The motion from one slice of a path to the next: q moves linearly. The kinematic structure is that of the first
/// slice, since a mode switch happens when its slice is reached; joints that end with it keep their values. The motion
/// shares no data with the path, which may change.
struct SliceMotion {
  int slice = 0;                ///< number of its last slice
  double begin = 0., end = 0.;  ///< phase times
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  VectorXd from, to;
  bool all_pairs = true;  ///< checks all pairs that may collide and that joints move relative to each other
  std::vector<std::pair<int, int>> pairs{};  ///< further pairs of frames whose shapes are checked
};

/// Returns for each dof of the previous slice the dof of the same joint in `slice`, or -1 if there is none.
std::vector<int> sameDofs(const Path& path, int slice);

/// Returns the first slice that a motion leads to: 0, or 1 for paths of order 0.
int firstMotion(const Path& path);

SliceMotion motionInto(const Path& path, int slice);

/// Returns all motions of a path, including the one from the slice before the start.
std::vector<SliceMotion> motionsOf(const Path& path);

/// Checks motions between slices. Consecutive checks of motions in the same scene are cheap.
class MotionProbe {
 public:
  /// Pairs within margin + `tolerance` (m, > 0) may count as too close.
  explicit MotionProbe(double tolerance) : tolerance_(tolerance) {}

  /// Returns the first pair, in time, that a motion brings closer than `margin` (m), if any.
  std::optional<MotionContact> firstContact(const SliceMotion& motion, double margin);

  /// Returns true if all pairs stay `margin` (m) apart continuously. Otherwise lastHit returns one that does not.
  bool isFree(const SliceMotion& motion, double margin);
  const MotionContact& lastHit() const { return *scene_->checker.lastHit(); }

  /// Returns local minima of the distances of pairs along the motion that are below `max_distance` (m); see
  /// EdgeChecker.
  const std::vector<MotionContact>& approaches(const SliceMotion& motion, double max_distance);

  /// Returns the smallest distance of all pairs at a fraction of the motion, at most `max_distance`, m.
  double clearance(const SliceMotion& motion, double time, double max_distance);

  /// Returns the checker for the scene of a motion. It is valid until a motion in another scene is checked.
  EdgeChecker& checkerOf(const SliceMotion& motion);

 private:
  struct Scene {
    Scene(const SliceMotion& motion, double tolerance);
    std::shared_ptr<const KinematicModel> model;
    std::shared_ptr<const Parameters> parameters;
    EdgeChecker checker;
  };
  std::optional<MotionContact> firstOfAllPairs(const SliceMotion& motion, double margin);

  double tolerance_;
  std::unique_ptr<Scene> scene_;  ///< of the last motion
};

/// Returns the first pair of each motion that comes closer than `margin` (m). The check is continuous; pairs within
/// margin + tolerance may count. `cancellation` is polled between motions, and may throw.
std::vector<PathContact> contactsOf(const std::vector<SliceMotion>& motions, double margin, double tolerance,
                                    const CancellationToken& cancellation = {});

}  // namespace kinegraph::inline komo_internal
