#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/path/path.h"

namespace kinegraph {

/// The motion from one slice of a path to the next: q goes straight. What hangs where is as in the first of the two,
/// so that a mode switch happens as its slice is reached; joints that end with it keep their values. It shares nothing
/// with the path, which may change.
struct SliceMotion {
  int slice = 0;                ///< where it ends
  double begin = 0., end = 0.;  ///< phase times
  std::shared_ptr<const KinematicModel> model;
  std::shared_ptr<const Parameters> parameters;
  VectorXd from, to;
  bool of_all = true;                        ///< does it count for all pairs that may collide and that joints part?
  std::vector<std::pair<int, int>> pairs{};  ///< frames whose shapes count as well
};

/// Per dof of the slice before: the dof of `slice` that is of the same joint, or -1 where there is none.
std::vector<int> sameDofs(const Path& path, int slice);

/// The first slice that a motion leads to: 0, or 1 for paths that begin with slice 0.
int firstMotion(const Path& path);

SliceMotion motionInto(const Path& path, int slice);

/// All motions of a path, those out of the slice before the start included.
std::vector<SliceMotion> motionsOf(const Path& path);

/// Looks at motions between slices, one after the other; those of one scene are cheap.
class MotionProbe {
 public:
  /// Pairs within margin + `tolerance` (m, > 0) may count as too near.
  explicit MotionProbe(double tolerance) : tolerance_(tolerance) {}

  /// The first pair that a motion brings nearer than `margin` (m), if any, of those that count for it.
  std::optional<MotionContact> firstContact(const SliceMotion& motion, double margin);

  /// Do all pairs keep `margin` (m) all along? If not, lastHit tells one that does not.
  bool isFree(const SliceMotion& motion, double margin);
  const MotionContact& lastHit() const { return *scene_->checker.lastHit(); }

  /// Where pairs come nearer than `most` (m) on the way, and nearer than just before and just after; see EdgeChecker.
  const std::vector<MotionContact>& approaches(const SliceMotion& motion, double most);

  /// The least distance of all pairs at a share of the way, at most `most`, m.
  double clearance(const SliceMotion& motion, double share, double most);

  /// What answers for the scene that a motion is in, until a motion of another one is looked at.
  EdgeChecker& checkerOf(const SliceMotion& motion);

 private:
  struct Scene {
    Scene(const SliceMotion& motion, double tolerance);
    std::shared_ptr<const KinematicModel> model;
    std::shared_ptr<const Parameters> parameters;
    EdgeChecker checker;
  };
  std::optional<MotionContact> firstOfAll(const SliceMotion& motion, double margin);

  double tolerance_;
  std::unique_ptr<Scene> scene_;  ///< of the last motion
};

/// Two shapes that the motion between two slices brings too near.
struct PathContact {
  int slice = 0;         ///< where that motion ends
  double time = 0.;      ///< phase time at which they come too near
  std::string a, b;      ///< names of their frames
  double distance = 0.;  ///< the least one until the slice, m; negative: penetration depth
  double deepest = 0.;   ///< phase time of that

  std::string str() const;  ///< "'a' and 'b' overlap by 3.1 mm at phase time 0.52, between slices 7 and 8"
};

/// The first pair of each motion that comes nearer than `margin` (m), at any time and not just at samples of them;
/// pairs within margin + tolerance may count. `cancellation` is called between motions, and may throw.
std::vector<PathContact> contactsOf(const std::vector<SliceMotion>& motions, double margin, double tolerance,
                                    const CancellationToken& cancellation = {});

}  // namespace kinegraph
