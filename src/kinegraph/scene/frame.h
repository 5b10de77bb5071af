#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph {

/// A handle on one frame of a Config. Copies refer to the same frame. The handle keeps the scene alive; after its frame
/// is deleted, every call throws FrameDeleted. Setters return the frame for chaining; of a frame of a const Config they
/// throw ValueError. Poses are (x y z qw qx qy qz) in m; setters normalize quaternions.
class Frame {
 public:
  Frame(std::shared_ptr<SceneTree> scene, FrameData& data);

  int id() const { return data().id; }  ///< index in the list of frames
  const std::string& getName() const { return data().name; }
  Frame& setName(std::string name);  ///< throws ValueError for the name of another frame
  bool operator==(const Frame& other) const { return data_ == other.data_; }

  std::optional<Frame> getParent() const;
  std::vector<Frame> getChildren() const;
  std::vector<Frame> getSubtree() const;  ///< all descendants, depth first, without this frame

  /// World pose, or the pose relative to another frame.
  Pose getPose() const;
  Pose getPose(const Frame& relative_to) const { return relative_to.getPose().inverse() * getPose(); }
  Pose getRelativePose() const;  ///< in the parent; identity for a root
  Vector3d getPosition() const { return getPose().p; }
  Quaterniond getQuaternion() const { return getPose().q; }
  Matrix3d getRotationMatrix() const { return getPose().q.toRotationMatrix(); }
  Vector3d getRelativePosition() const { return getRelativePose().p; }
  Quaterniond getRelativeQuaternion() const { return getRelativePose().q; }

  /// Sets the world pose. A frame with a joint moves to the nearest pose that the joint can reach.
  Frame& setPose(const Pose& pose);
  Frame& setPosition(const Vector3d& position);
  Frame& setQuaternion(const Quaterniond& rotation);

  /// Sets the pose in the parent. Throws ValueError for a root.
  Frame& setRelativePose(const Pose& pose);
  Frame& setRelativePosition(const Vector3d& position);
  Frame& setRelativeQuaternion(const Quaterniond& rotation);

  /// Attaches this frame below `parent`. Keeps the relative pose, so the frame moves in the world; `keep_world_pose`
  /// keeps the world pose instead. Throws ValueError for a loop or a frame of another Config.
  Frame& setParent(const Frame& parent, bool keep_world_pose = false);

  /// Cuts the frame from its parent, keeps its world pose and removes its joint. Throws ValueError for a root.
  Frame& unLink();

  /// Gives the frame a shape, or changes its type and size. `size` as in Geometry, or with the counts of older files.
  Frame& setShape(ShapeType type, const std::vector<double>& size);
  Frame& setGeometry(Geometry geometry);  ///< keeps color and contact flag
  Frame& setMesh(Mesh mesh);              ///< triangles, or points if the mesh has no triangles
  Frame& setConvexCore(std::vector<Vector3d> points,
                       double radius);                ///< ssCvx: convex hull of the points swept by a ball
  Frame& setColor(const std::vector<double>& color);  ///< in 0..1: 1 gray; 2 gray, alpha; 3 rgb; 4 rgba
  Frame& setContact(int contact);                     ///< see Config::getCollidablePairs
  ShapeType getShapeType() const;                     ///< ShapeType::none without a shape
  std::vector<double> getSize() const;                ///< empty without a shape

  /// Gives the frame a joint to its parent. `limits` are all lower, then all upper bounds, or empty. Keeps the pose as
  /// far as the joint can reach it. JointType::none removes the joint. Throws ValueError for a root.
  Frame& setJoint(JointType type, const std::vector<double>& limits = {}, const std::vector<double>& axis = {},
                  double scale = 1., std::optional<Frame> mimic = std::nullopt, const std::string& code = {});
  JointType getJointType() const;  ///< JointType::none without a joint
  VectorXd getJointState() const;  ///< throws ValueError without a joint
  Frame& setJointState(const VectorXd& q);

  /// Sets the mass in kg; 0 removes it. The inertia is that of the shape's surface, or `matrix` (3 diagonal, 6 or 9
  /// numbers).
  Frame& setMass(double mass, const std::vector<double>& matrix = {});
  double getMass() const;
  std::optional<Inertia> getInertia() const { return data().inertia; }

  const Graph& attributes() const { return *data().attributes; }
  Graph& editAttributes() { return edit().attributes.edit(); }

  FrameData& data() const;  ///< throws FrameDeleted
  FrameData& edit();        ///< throws FrameDeleted, and ValueError for a frame of a const Config
  bool isDeleted() const { return data_->tree == nullptr; }
  const std::shared_ptr<SceneTree>& scene() const { return scene_; }

 private:
  friend class Config;
  Shape& editableShape();
  Frame related(FrameData& data) const;  ///< of the same Config

  std::shared_ptr<SceneTree> scene_;
  std::shared_ptr<FrameData> data_;
  bool is_const_ = false;  ///< whether it is of a const Config
};

}  // namespace kinegraph
