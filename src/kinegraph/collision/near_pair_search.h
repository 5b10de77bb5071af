#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/box_tree.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// Finds the near ones among the collidable pairs of many bodies, again and again as they move.
///
/// Each body has a box with room to move in. Pairs whose boxes meet are candidates; they are looked for again only for
/// bodies that leave their boxes. How far a body can have moved is summed up, so that a candidate whose distance was
/// measured is not measured again before its bodies can have met. Neither changes what is found.
class NearPairSearch {
 public:
  /// Of all collidable pairs, or of those that involve one of the given frames.
  explicit NearPairSearch(std::shared_ptr<const KinematicModel> model, const std::vector<int>& frames = {});

  /// A copy starts anew.
  NearPairSearch(const NearPairSearch& other) : NearPairSearch(other.model_, other.frames_) {}

  void place(const State& state);

  struct Near {
    int a, b;  ///< places among the bodies, a < b
    double distance;
  };

  /// The pairs that are nearer than `margin`, or that near, by frames. They stay until the next question.
  const std::vector<Near>& near(double margin);

  /// Are all pairs that joints move apart at least `margin` apart? Looks no farther than to the first that is nearer,
  /// and first at the one that was so the last time.
  bool apart(double margin);

  int frame(int body) const { return bodies_[std::size_t(body)].frame; }
  Proximity proximity(const Near& pair) const;

  /// How many distances were computed so far.
  long measured() const { return measured_; }

 private:
  struct Body {
    std::shared_ptr<const CollisionBody> shape;
    int frame, link;
    bool wanted;  ///< one of the frames that were asked for
    RigidTransform pose;
    Vector3d center = Vector3d::Zero();
    WorldBox box = {Vector3d::Zero(), Vector3d::Zero()};
    double travel = 0.;  ///< no point of it has moved farther, all moves added up
  };

  struct Candidate {
    int a, b;
    double distance = 0.;  ///< when measured
    double travel = -1.;   ///< of both bodies then; negative: not measured
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
  std::vector<WorldBox> rooms_;  ///< per body: its box with room to move
  BoxTree tree_;
  std::vector<int> moved_;                 ///< bodies that left their rooms
  double reach_ = -1.;                     ///< up to which margin the candidates are known
  std::vector<Candidate> fixed_, moving_;  ///< candidates that both belong to link 0, and the others
  double fixed_margin_ = 0.;
  bool fixed_known_ = false;
  std::vector<Near> fixed_near_, near_;
  std::size_t suspect_ = 0;  ///< the place in moving_ of the pair that was too near the last time
  long measured_ = 0;
};

}  // namespace kinegraph
