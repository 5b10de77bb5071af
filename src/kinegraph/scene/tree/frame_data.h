#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/gfile/value.h"
#include "kinegraph/kinematics/joint.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline scene_internal {
class SceneTree;
}

namespace kinegraph {

class CollisionBody;
struct FrameData;

/// A joint: lets a frame move relative to its parent. Its dofs `q` determine the frame's relative pose completely; only
/// a rigid joint, without dofs, stores a pose.
struct Joint {
  JointType type = JointType::rigid;
  std::string code;                   ///< of JointType::generic
  Vector3d axis = Vector3d::UnitX();  ///< of JointType::hinge, unit length
  double scale = 1.;                  ///< the joint moves by scale * q; a mimic by scale * the source's motion
  VectorXd q;                         ///< current dofs; unused if `mimic` is set
  VectorXd home;                      ///< initial dofs; mean of random sampling
  VectorXd lower, upper;              ///< limits in units of q; both empty: unlimited
  double control_weight = 1.;         ///< `ctrl_H`
  bool active = true;                 ///< whether its dofs are in q
  bool stable = false;                ///< constant over the slices of a path
  FrameData* mimic = nullptr;         ///< the joint whose dofs this one repeats; may be null
  double sample_uniform = 0.;         ///< probability of uniform sampling within the limits
  double sample_deviation = .01;      ///< standard deviation of Gaussian sampling
  std::vector<MotionStep> steps;      ///< motionSteps(type, code)

  explicit Joint(JointType joint_type = JointType::rigid, std::string joint_code = {});
  int dofs() const { return int(home.size()); }
};

/// Geometry attached to a frame, with its color, contact flag and looks.
struct Shape {
  std::shared_ptr<const Geometry> geometry = std::make_shared<Geometry>();
  std::optional<Vector4d> color;  ///< rgba in 0..1
  int contact = 0;                ///< 0: never collides; see Config::getCollidablePairs
  std::string visual_mesh;        ///< path of a mesh file that viewers show instead of the geometry, or empty
  Pose visual_pose;               ///< pose of that mesh in the frame
  std::shared_ptr<const Image> texture = {};        ///< a picture that covers the visible surface, or null
  std::array<double, 2> texture_repeat = {1., 1.};  ///< repetitions to the right and up
  std::uint64_t revision = 0;                       ///< grows with every change

  /// The collision body; built at the first use by any copy and shared by all copies.
  std::shared_ptr<const CollisionBody> body() const;

 private:
  struct BodyCache {
    std::mutex mutex;
    std::shared_ptr<const CollisionBody> body;
    std::shared_ptr<const Geometry> of;
  };
  mutable std::shared_ptr<BodyCache> body_cache_ =
      std::make_shared<BodyCache>();  ///< shared with copies of the same geometry
};
/// The mass of a link: its center and its matrix of inertia.
struct Inertia {
  double mass = 0.;                    ///< kg
  Vector3d com = Vector3d::Zero();     ///< m, in the frame
  Matrix3d matrix = Matrix3d::Zero();  ///< kg m^2, about the center of mass, in the frame's axes
};

/// Attributes as read. Copies share them until one is edited, so copying a scene is cheap.
class SharedGraph {
 public:
  const Graph& operator*() const { return *graph_; }
  const Graph* operator->() const { return graph_.get(); }
  Graph& edit() {
    if (graph_.use_count() > 1) graph_ = std::make_shared<Graph>(*graph_);
    return *graph_;
  }

 private:
  static const std::shared_ptr<Graph>& none() {
    static const auto empty = std::make_shared<Graph>();  // never edited, shared by all
    return empty;
  }
  std::shared_ptr<Graph> graph_ = none();
};

/// One frame of a scene, owned by its SceneTree. Code outside of scene/ uses the handle `Frame`.
struct FrameData {
  std::string name;
  int id = 0;                 ///< index in the list of frames
  SceneTree* tree = nullptr;  ///< null after deletion
  FrameData* parent = nullptr;
  std::vector<FrameData*> children;
  Pose pose;  ///< in the parent; in the world for a root; unused with a joint that has dofs
  std::optional<Joint> joint;
  std::shared_ptr<Shape> shape;  ///< may be shared between frames
  std::optional<Inertia> inertia;
  SharedGraph attributes;              ///< as read, including the interpreted ones
  std::vector<FrameData*> no_contact;  ///< frames whose shapes never collide with this frame's: `contact_exclude`

  bool moves() const { return joint && joint->dofs() > 0; }
  Pose relativePose() const;  ///< `pose`, or the motion of the joint's dofs
  Pose worldPose() const;     ///< composed along the parents
};

/// The joint that drives `frame`: its own, or the one it mimics, through any number of steps.
FrameData& dofSource(FrameData& frame);
const FrameData& dofSource(const FrameData& frame);

/// Factor between the source's dofs and a joint's motion: its own scale, for a mimic times the source's scale.
double motionScale(const FrameData& frame);

}  // namespace kinegraph
