#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "kinegraph/collision/motion_check.h"
#include "kinegraph/common/random.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph {

class ConfigViewer;
class FeatureSource;
struct Evaluation;

/// A scene as a person edits it: named frames with joints, shapes and masses, and the joint vector q.
/// Copies are deep. Everything that is derived (world poses, the compiled Program) follows by itself.
class Config {
 public:
  Config() : scene_(std::make_shared<SceneTree>()) {}
  Config(const Config& other);
  explicit Config(const SceneTree& scene);  ///< a deep copy
  explicit Config(std::shared_ptr<SceneTree> scene) : scene_(std::move(scene)) {}
  Config& operator=(const Config& other);
  Config(Config&&) = default;
  Config& operator=(Config&&) = default;

  // --- building --------------------------------------------------------------------------------------------------

  /// Adds the frames of a scene file, in the .g language or of a format that its extension tells (.urdf, .xml);
  /// `prefix` is put before their names. Returns the first of them, if any. What an .srdf file says about a robot is
  /// entered into its frames, which are there already; one beside a .urdf file is read with it. On an error (FileError,
  /// ParseError) the configuration is unchanged. Warnings go to `takeWarnings`.
  std::optional<Frame> addFile(const std::string& path, const std::string& prefix = {});

  /// The same for text; `name` stands for the file in messages, and files included are relative to `folder`.
  std::optional<Frame> addText(std::string_view text, const std::string& name = "text", const std::string& folder = {});

  /// Appends a frame. It sits at its parent's pose, or at the world's origin without one. `attributes` is text as
  /// inside the braces of a `.g` file. A name that exists already gives that frame, unchanged, with a warning; but
  /// throws ValueError if the call asks for another parent or other attributes than that frame was made with. Throws
  /// FrameNotFound for an unknown parent.
  Frame addFrame(const std::string& name, const std::string& parent = {}, const std::string& attributes = {});
  Frame addFrame(const std::string& name, const Frame& parent, const std::string& attributes = {});

  /// Appends copies of all frames of `other`, names prefixed. Returns the first, if any.
  std::optional<Frame> addConfigurationCopy(const Config& other, const std::string& prefix = {});

  /// Removes a frame, by name the first of that name. Its children become roots and stay where they are.
  void delFrame(const std::string& name);
  void delFrame(const Frame& frame);
  void clear() { scene_->clear(); }

  /// Re-attaches the link that `child` belongs to: its topmost frame is cut off and hangs, rigidly and where it is,
  /// below `parent`.
  void attach(const std::string& parent, const std::string& child);

  // --- frames ----------------------------------------------------------------------------------------------------

  Frame getFrame(std::string_view name) const;  ///< the first of that name; throws FrameNotFound
  std::optional<Frame> findFrame(std::string_view name) const;
  Frame getFrame(int id) const;  ///< throws ValueError
  std::vector<Frame> getFrames() const;
  std::vector<Frame> getRoots() const;
  std::vector<Frame> getJoints() const;  ///< frames whose joint is active and has dofs
  std::vector<std::string> getFrameNames() const { return scene_->names(); }
  int getFrameDimension() const { return int(scene_->frames().size()); }

  /// World poses, one row (x y z qw qx qy qz) per frame, qw >= 0.
  MatrixXd getFrameState() const;

  /// Sets the world poses of all frames, or of the named ones. Joints take the nearest poses that they can reach.
  void setFrameState(const MatrixXd& poses, const std::vector<std::string>& names = {});

  // --- joints ----------------------------------------------------------------------------------------------------

  int getJointDimension() const { return scene_->model()->dofs; }
  VectorXd getJointState() const { return scene_->jointState(); }
  VectorXd getJointState(const std::vector<std::string>& names) const;

  /// Sets q, or the dofs of the named frames in that order, active or not. Throws ValueError for a wrong length or
  /// numbers that are not finite.
  void setJointState(const VectorXd& q);
  void setJointState(const VectorXd& q, const std::vector<std::string>& names);

  /// One name per entry of q: the frame's, with ":i" where its joint has several dofs.
  std::vector<std::string> getJointNames() const;
  std::vector<int> getJointIDs() const;  ///< ids of the frames of getJoints

  /// Names of joint states that the scene knows (attribute `joint_states`, SRDF), or of those of one group.
  std::vector<std::string> getStateNames(const std::string& group = {}) const;

  /// The present q with the values of such a state; joints that it does not name keep theirs. Without a group, the
  /// states of that name of all groups are taken together. Throws NameError for a name that is not there.
  VectorXd getNamedState(const std::string& name, const std::string& group = {}) const;

  /// Groups of joints (attribute `joint_groups`, SRDF): their names, and those of the joints' frames.
  std::vector<std::pair<std::string, std::vector<std::string>>> getJointGroups() const;

  /// 2 x n: row 0 lower, row 1 upper limits; 0 and -1 for a dof without limits.
  MatrixXd getJointLimits() const;

  /// Makes the joints at or above the named frames the active ones, or all others.
  void selectJoints(const std::vector<std::string>& names, bool not_those = false);

  /// Draws q: per joint uniform within its limits, or Gaussian around its home and clipped, as its sampling attributes
  /// say.
  void setRandom(Rng& rng);

  // --- dynamics ---------------------------------------------------------------------------------------------------

  /// What each link weighs; links as in program().
  std::vector<LinkInertia> inertias() const {
    return collectInertias(*scene_, *scene_->model(), *scene_->parameters());
  }

  /// M(q) and F(q, dq) of u = M ddq + F at the present q, with gravity 9.81 m/s^2 along -z.
  EquationOfMotion equationOfMotion(const VectorXd& velocity) const;

  /// Generalized forces u (N m, N) for a velocity and an acceleration of q.
  VectorXd inverseDynamics(const VectorXd& velocity, const VectorXd& acceleration) const;

  /// Total mass of everything that moves, kg, and its center, world coordinates, m.
  std::pair<double, Vector3d> centerOfMass() const { return kinegraph::centerOfMass(scene_->state(), inertias()); }

  // --- collisions ------------------------------------------------------------------------------------------------

  struct NearPair {
    int a, b;         ///< frame ids, a < b
    double distance;  ///< m, negative: penetration depth
  };

  /// Pairs of frames that may collide. Both have a shape and a contact flag other than 0, they belong to different
  /// links, a negative flag -k excludes contacts with the links above within k joints, and so does `contact_exclude`
  /// with the frames that it names; there, a shape counts as that of its parent, too, if it is fixed to it.
  std::vector<std::pair<int, int>> getCollidablePairs() const { return scene_->model()->collidable(); }

  /// All collidable pairs whose distance is at most `margin`, by id, also those that no joint moves apart.
  std::vector<NearPair> getCollisions(double margin = 0.) const;

  /// Sum of the penetration depths of all pairs, or the largest one, in m.
  double getTotalPenetration(bool largest_only = false) const;

  /// What first ends the straight motion of q between two joint vectors: a pair that comes nearer than `margin` (m), at
  /// any time of it and not just at samples, or a joint that passes its limits (by more than 1e-5 rad or m). None if the
  /// motion is free. Pairs that no joint moves apart do not count: they say nothing about q. Pairs within margin +
  /// tolerance may count as too near. Throws ValueError for joint vectors of a wrong length, and for a tolerance that is not positive.
  std::optional<MotionContact> checkMotion(const VectorXd& from, const VectorXd& to, double margin = 0.,
                                           double tolerance = 1e-5) const;

  // --- what rooms above the scene add: defined in front, all in kinegraph/kinegraph.h -------------------------------

  /// Value y (d,) of a feature of these frames at the present q, and its Jacobian J (d x n). Throws FrameNotFound, and
  /// ValueError for a wrong number of frames and for features that need several configurations.
  Evaluation eval(const FeatureSource& feature, const std::vector<std::string>& frames = {}) const;

  /// Shows the scene in the browser, and takes over what people have changed there; see ConfigViewer::view. `pause`
  /// waits for a key. Returns the key pressed since the last call, or 0.
  int view(bool pause = false, const std::string& message = {});

  /// Plays a motion, one joint state per row (T x n), with a time slider; `pause`, then waits for a key. q stays.
  int viewPath(const MatrixXd& path, double seconds = 3., bool pause = false, const std::string& message = {});

  /// Loads a scene file and shows it, again whenever it changes, until q is pressed; see kinegraph::watchFile.
  void watchFile(const std::string& path);

  /// What shows this scene, also while a Simulation or a BotOp moves it. Copies of a Config have viewers of their own.
  ConfigViewer& viewer();

  // --- for computing ---------------------------------------------------------------------------------------------

  std::shared_ptr<const KinematicModel> model() const { return scene_->model(); }
  std::shared_ptr<const Parameters> parameters() const { return scene_->parameters(); }
  const State& state() const { return scene_->state(); }
  const std::shared_ptr<SceneTree>& scene() const { return scene_; }

  /// The numbers of frames, joints and shapes, which shapes collide, and contactWarnings().
  std::string report() const;

  /// What people may not expect about which shapes collide, a sentence each: shapes that overlap and that no joint moves
  /// apart; shapes without `contact` near what moves. Python warns of them once per scene.
  std::vector<std::string> contactWarnings() const;

  /// What was odd but not wrong in what was read since the last call.
  std::vector<std::string> takeWarnings();

 private:
  Frame addFrameBelow(const std::string& name, FrameData* parent, const std::string& attributes);
  FrameData& ownFrame(const Frame& frame, const char* call) const;  ///< throws ValueError if it is another Config's

  std::shared_ptr<SceneTree> scene_;
  std::vector<std::string> warnings_;
};

}  // namespace kinegraph
