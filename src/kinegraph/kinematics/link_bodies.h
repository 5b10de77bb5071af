#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/box_tree.h"
#include "kinegraph/geometry/distance/collision_body.h"
#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// The bodies of a scene, grouped by the links that they are fixed to, and the pairs of them that count where it is
/// asked whether a q is free. What is fixed to the world is a group of its own each: such bodies are not near one
/// another.
struct LinkBodies {
  static constexpr std::size_t kMostListed = 64;  ///< bodies fixed to the world; of more, pairs are not listed

  struct Body {
    std::shared_ptr<const CollisionBody> shape;
    int frame, contact;  ///< id; place in the Program's ContactRules
    int group;
    RigidTransform X_LB;  ///< in its link
    double reach;         ///< no point of it is farther from the link's origin, m
  };
  struct Group {
    int link;
    int first, last;  ///< bodies [first, last)
    Vector3d center;  ///< of the bounding sphere, in the link
    double radius, reach;
  };
  struct Pair {
    int a, b;      ///< bodies, of which a moves
    int ancestor;  ///< the last link that both hang on
    bool convex;   ///< both of them
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
  std::vector<Group> groups;  ///< those that move come first
  int moving = 0;             ///< groups
  std::vector<Pair> pairs;
  std::vector<Block> blocks;
  bool many = false;   ///< are the fixed bodies too many, so that `fixed_tree` has them and `blocks` have not?
  BoxTree fixed_tree;  ///< item i is group moving + i
  std::shared_ptr<const KinematicModel> model;
};

}  // namespace kinegraph
