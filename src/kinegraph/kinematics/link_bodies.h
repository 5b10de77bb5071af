#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/closed_form/box_tree.h"
#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph::inline kinematics_internal {

/// The collision bodies of a scene grouped by link, and the pairs that collision checks consider. Each body fixed to
/// the world forms a group of its own, since such bodies need not be near each other.
struct LinkBodies {
  static constexpr std::size_t kMostListed = 64;  ///< maximum number of bodies fixed to the world for which pairs are
                                                  ///< listed

  struct Body {
    std::shared_ptr<const CollisionBody> shape;
    int frame, contact;  ///< id; index in the model's ContactRules
    int group;
    RigidTransform X_LB;  ///< pose in its link
    double reach;         ///< largest distance of its points from the link's origin, m
  };
  struct Group {
    int link;
    int first, last;  ///< bodies [first, last)
    Vector3d center;  ///< center of the bounding sphere, in the link
    double radius, reach;
  };
  struct Pair {
    int a, b;      ///< bodies; a moves
    int ancestor;  ///< last common ancestor of their links
    bool convex;   ///< both bodies are convex
  };
  /// All pairs of two groups.
  struct Block {
    int a, b;
    int first, last;  ///< pairs [first, last)
  };

  explicit LinkBodies(const State& scene);

  bool fixed(int group) const { return groups[std::size_t(group)].link == 0; }
  int link(int body) const { return groups[std::size_t(bodies[std::size_t(body)].group)].link; }

  /// Appends the pairs of two groups that may collide.
  void appendPairs(int group_a, int group_b, std::vector<Pair>& to) const;

  std::vector<Body> bodies;
  std::vector<Group> groups;  ///< moving groups come first
  int moving = 0;             ///< number of moving groups
  std::vector<Pair> pairs;
  std::vector<Block> blocks;
  bool many = false;   ///< there are more than kMostListed fixed bodies, which are in `fixed_tree` instead of `blocks`
  BoxTree fixed_tree;  ///< item i is group moving + i
  std::shared_ptr<const KinematicModel> model;
};

}  // namespace kinegraph::inline kinematics_internal
