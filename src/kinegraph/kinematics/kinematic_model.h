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
}

namespace kinegraph::inline kinematics_internal {

/// The compiled kinematic structure of a scene. It is immutable and shared by all computations. Numbers that may change
/// between computations are in `Parameters` and in q.
///
/// Frames without an active joint between them form one *link*. Link 0 is the world with everything fixed to it. Each
/// other link is moved relative to its parent link by one active joint. Links are in topological order. placeJoint
/// chooses the axes of a link.
struct KinematicModel {
  struct Link {
    int parent = 0;
    int frame = -1;      ///< the frame that carries the joint
    int first_step = 0;  ///< its steps: [first_step, first_step + steps)
    int steps = 0;
    int dof = 0;           ///< first entry in q; mimicking links share that of their source
    int first_column = 0;  ///< its twist columns: [first_column, first_column + dofs)
    int first_angle = 0;   ///< index in angle_dof of the first of its steps that rotate
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
  std::vector<int> column_dof;     ///< entry of q of a twist column
  std::vector<int> column_before;  ///< per twist column: the previous one of its chain, or -1
  std::vector<int>
      last_column;  ///< per link l: the columns that move it are c = last_column[l], column_before[c], ... until -1
  std::vector<char> fixed_axes;  ///< per link: true if all columns that move it have axes fixed to links
  std::vector<int> angle_dof;    ///< entries of q that are angles, in the order of the steps; an even number

  std::vector<std::string> frame_name;                    ///< per frame
  std::unordered_map<std::string_view, int> frame_index;  ///< maps a name to the first frame with this name
  std::vector<int> frame_link;                            ///< per frame
  std::vector<DofRange> frame_dofs;  ///< per frame: the dofs of its active joint (of the source if it mimics)
  VectorXd lower, upper;             ///< per dof; -inf, +inf without a limit
  VectorXd home;                     ///< per dof: initial q of the joint
  VectorXd control_weight;           ///< per dof
  std::vector<DofRange> unit_norms;  ///< dofs that form a quaternion or circle

  std::vector<std::shared_ptr<const Geometry>> geometry;   ///< per frame, null without a shape
  std::vector<std::shared_ptr<const CollisionBody>> body;  ///< per frame, null without a shape
  ContactRules contacts;

  /// Returns all pairs of frames (a < b) that may collide, ascending. The list is computed on first use; thread-safe.
  const std::vector<std::pair<int, int>>& collidable() const;

  /// Returns true if two frames are on different links, so that their distance may depend on q.
  bool movesApart(int a, int b) const { return frame_link[std::size_t(a)] != frame_link[std::size_t(b)]; }

  /// Returns the collidable pairs on different links, ascending: the pairs that collision checks of configurations and
  /// motions consider.
  std::vector<std::pair<int, int>> movingPairs() const;

 private:
  mutable std::once_flag listed_;
  mutable std::vector<std::pair<int, int>> collidable_;
};

/// Mass of a frame as a point.
struct FrameMass {
  double mass = 0.;                 ///< kg
  Vector3d com = Vector3d::Zero();  ///< center of mass in the frame, m
};

/// The constants of a KinematicModel: poses of joints on their parent links and of frames on their links, and masses of
/// frames.
struct Parameters {
  std::vector<LaneModel::Link> link;         ///< per link; set by placeJoint
  std::vector<LaneModel::Step> step;         ///< per step; its variable is a dof
  std::vector<double> angle_factor;          ///< per entry of KinematicModel::angle_dof: the angle per unit of it
  std::vector<RigidTransform> frame_offset;  ///< per frame: X_LF, the frame in its link
  std::vector<FrameMass> frame_mass;         ///< per frame
};

/// Returns default parameters: frames are at the origin of their link and have no mass.
Parameters emptyParameters(const KinematicModel& model);

/// Places the joint of a link at X_PJ on its parent link. Returns the pose of the joint frame, behind the joint, in the
/// link. The axes of links are chosen parallel to those of the parent at zero joint values if possible: if X_PJ is a
/// quarter rotation, the axes of the joint are rotated instead.
RigidTransform placeJoint(const KinematicModel& model, int link, const RigidTransform& X_PJ, Parameters& parameters);

/// Sets `frame_name` and `frame_index`.
void nameFrames(KinematicModel& model, std::vector<std::string> names);

/// Returns the first frame with this name. Throws FrameNotFound with similar names; `caller` starts the message.
int frameId(const KinematicModel& model, std::string_view name, std::string_view caller);

/// Computes `last_column`, `column_before`, `column_dof`, `fixed_axes` and `angle_dof` from `links` and `steps`.
void connectChains(KinematicModel& model);

}  // namespace kinegraph::inline kinematics_internal
