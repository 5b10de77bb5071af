#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/kinematics/contact_rules.h"
#include "kinegraph/kinematics/joint.h"
#include "kinegraph/kinematics/lane_model.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

class CollisionBody;

/// The compiled structure of a scene: what moves what. Immutable and shared by everything that computes; all numbers
/// that people change between computations are in `Parameters` and in q.
///
/// Frames between which no active joint lies move as one *link*. Link 0 is the world with everything fixed to it. Every
/// other link is moved, relative to its parent link, by one active joint. Links are in topological order. Where a link
/// has its axes is up to placeJoint.
struct KinematicModel {
  struct Link {
    int parent = 0;
    int frame = -1;      ///< the frame that carries the joint
    int first_step = 0;  ///< its steps: [first_step, first_step + steps)
    int steps = 0;
    int dof = 0;           ///< first entry in q; a mimicking link has that of its source
    int first_column = 0;  ///< its twist columns: [first_column, first_column + dofs)
    int first_turn = 0;    ///< of its steps that turn, the first one's place in turn_dof
    double scale = 1.;
    Vector3d axis = Vector3d::UnitX();
  };
  struct DofRange {
    int first = 0;
    int count = 0;
  };

  int dofs = 0;             ///< length of q
  std::vector<Link> links;  ///< links[0] is the world
  std::vector<MotionStep> steps;
  std::vector<int> column_dof;     ///< entry of q that drives a twist column
  std::vector<int> column_before;  ///< of a twist column: the one before it in its chain, or -1
  std::vector<int>
      last_column;  ///< of link l: c = last_column[l], column_before[c], ... until -1 are those that move it
  std::vector<char>
      fixed_axes;             ///< per link: is each column that moves it one about or along an axis fixed to its links?
  std::vector<int> turn_dof;  ///< entries of q that are angles, in the order of the steps, an even number of them

  std::vector<std::string> frame_name;                    ///< per frame
  std::unordered_map<std::string_view, int> frame_index;  ///< of names: the first frame of that name
  std::vector<int> frame_link;                            ///< per frame
  std::vector<DofRange> frame_dofs;  ///< per frame: the dofs of its own active joint (of the source if it mimics)
  VectorXd lower, upper;             ///< per dof; -inf, +inf where there is no limit
  VectorXd home;                     ///< per dof: the q that the joint had when it was made
  VectorXd control_weight;           ///< per dof
  std::vector<DofRange> unit_norms;  ///< dofs that form a quaternion or circle

  std::vector<std::shared_ptr<const Geometry>> geometry;   ///< per frame, null without a shape
  std::vector<std::shared_ptr<const CollisionBody>> body;  ///< per frame, null without a shape
  ContactRules contacts;

  /// All frame pairs (a < b) that may collide, ascending. Listed when first asked for; threads may ask.
  const std::vector<std::pair<int, int>>& collidable() const;

  /// Are two frames on different links, so that a motion can part them or bring them together? Pairs for which it is
  /// false are as near at every q: they say nothing about q.
  bool movesApart(int a, int b) const { return frame_link[std::size_t(a)] != frame_link[std::size_t(b)]; }

  /// Those of them that joints move apart, ascending: the pairs that count wherever it is asked whether a q or a motion
  /// is free.
  std::vector<std::pair<int, int>> movingPairs() const;

 private:
  mutable std::once_flag listed_;
  mutable std::vector<std::pair<int, int>> collidable_;
};

/// What a frame weighs, as a point.
struct FrameMass {
  double mass = 0.;                 ///< kg
  Vector3d com = Vector3d::Zero();  ///< center of mass in the frame, m
};

/// The constants of a Program: where joints sit on their parent link and frames on their link, and what frames weigh.
struct Parameters {
  std::vector<LaneModel::Link> link;         ///< per link; set by placeJoint
  std::vector<LaneModel::Step> step;         ///< per step; its variable is a dof
  std::vector<double> turn_factor;           ///< per entry of Program::turn_dof: the angle per unit of it
  std::vector<RigidTransform> frame_offset;  ///< per frame: X_LF, the frame in its link
  std::vector<FrameMass> frame_mass;         ///< per frame
};

/// Room for all of them; frames are at the origin of their link, and weigh nothing.
Parameters emptyParameters(const KinematicModel& model);

/// Lets the joint of a link sit at X_PJ on its parent link, and returns the frame of the joint, as it is behind the
/// joint, in the link. Links have their axes such that as few as possible are turned against those of the parent while
/// their joints rest: where X_PJ has quarter turns, the axes of the joint are turned in its stead.
RigidTransform placeJoint(const KinematicModel& model, int link, const RigidTransform& X_PJ, Parameters& parameters);

/// Sets `frame_name` and `frame_index`.
void nameFrames(KinematicModel& model, std::vector<std::string> names);

/// The first frame of that name. Throws FrameNotFound with similar names; `who` is what asks for it.
int frameId(const KinematicModel& model, std::string_view name, std::string_view who);

/// Fills `last_column`, `column_before`, `column_dof`, `fixed_axes` and `turn_dof` from `links` and `steps`.
void connectChains(KinematicModel& model);

}  // namespace kinegraph
