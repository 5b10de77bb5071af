#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/closed_form/box_tree.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline collision_internal {

/// Finds the near pairs among many moving bodies, incrementally.
///
/// Each body has an enlarged box. Pairs whose boxes meet are candidates; the search is repeated only for bodies that
/// leave their boxes. The displacements of each body are summed, so that a candidate is measured again only when its
/// bodies may have come within the margin. Neither changes the results.
class NearPairSearch {
 public:
  /// Searches all collidable pairs, or those that involve one of the frames.
  explicit NearPairSearch(std::shared_ptr<const KinematicModel> model, const std::vector<int>& frames = {});

  /// A copy has no history.
  NearPairSearch(const NearPairSearch& other) : NearPairSearch(other.model_, other.frames_) {}

  void place(const State& state);

  struct Near {
    int a, b;  ///< indices of the bodies, a < b
    double distance;
  };

  /// The pairs at a distance of at most `margin`, ordered by frames; valid until the next call.
  const std::vector<Near>& near(double margin);

  /// Whether all pairs that joints move apart are at least `margin` apart. Returns at the first pair that is closer,
  /// and checks the pair of the last such result first.
  bool apart(double margin);

  int frame(int body) const { return bodies_[std::size_t(body)].frame; }
  Proximity proximity(const Near& pair) const;

  /// Number of distances computed so far.
  long measured() const { return measured_; }

 private:
  struct Body {
    std::shared_ptr<const CollisionBody> shape;
    int frame, link;
    bool wanted;  ///< one of the searched frames
    RigidTransform pose;
    Vector3d center = Vector3d::Zero();
    WorldBox box = {Vector3d::Zero(), Vector3d::Zero()};
    double travel = 0.;  ///< bound of the displacement of its points, summed over all calls
  };

  struct Candidate {
    int a, b;
    double distance = 0.;  ///< when measured
    double travel = -1.;   ///< of both bodies at that time; negative: not measured
  };

  void update(std::size_t body, const State& state);
  void findCandidates(double reach);
  void findCandidatesOfMoved();
  void bringUpToDate(double margin);
  void add(int a, int b);
  bool isNear(Candidate& candidate, double margin);

  std::shared_ptr<const KinematicModel> model_;
  std::vector<int> frames_;
  std::shared_ptr<const Parameters> parameters_;
  std::vector<RigidTransform> link_pose_;
  std::vector<char> link_moved_, left_box_;
  std::vector<Body> bodies_;
  std::vector<WorldBox> boxes_;  ///< per body: its enlarged box
  BoxTree tree_;
  std::vector<int> moved_;                 ///< bodies that left their boxes
  double reach_ = -1.;                     ///< margin of the candidates
  std::vector<Candidate> fixed_, moving_;  ///< candidates of two static bodies, and the others
  double fixed_margin_ = 0.;
  bool fixed_known_ = false;
  std::vector<Near> fixed_near_, near_;
  std::size_t suspect_ = 0;  ///< index into moving_ of the pair that was too close the last time
  long measured_ = 0;
};

}  // namespace kinegraph::inline collision_internal
