#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/joint.h"
#include "kinegraph/scene/frame.h"
#include "kinegraph/scene/loading/file_options.h"

namespace kinegraph::inline kinematics_internal {
class State;
struct KinematicModel;
struct Parameters;
}

namespace kinegraph {

class ConfigViewer;
class FeatureSource;
struct Evaluation;

/// A scene as a person edits it: named frames with joints, shapes and masses, and the joint vector q.
/// Copies are deep. Derived data (world poses, the compiled KinematicModel) is updated automatically. Frames of a const
/// Config can be read only. Calls on a Config that was moved from throw ValueError.
class Config {
 public:
  Config();
  Config(const Config& other);
  explicit Config(const SceneTree& scene);  ///< a deep copy
  explicit Config(std::shared_ptr<SceneTree> scene) : scene_("Config", std::move(scene)) {}
  Config& operator=(const Config& other);
  Config(Config&&) = default;
  Config& operator=(Config&&) = default;

  // Building

  /// Adds the frames of a scene file and returns the first of them, if any. The extension selects the format: .urdf,
  /// .xml (MJCF), .srdf, .xacro (expanded by the function of setXacroExpander), otherwise the .g language. `prefix` is
  /// put before the names. An .srdf file adds collision pairs, groups and states to frames that already exist; one
  /// beside a .urdf file is read with it. Flaws of URDF and MJCF files are mended with a warning, or refused if
  /// `options.strict`. `options.floating` gives the root a free joint. On an error (FileError, ParseError) the
  /// configuration is unchanged.
  std::optional<Frame> addFile(const std::string& path, const std::string& prefix = {},
                               const FileOptions& options = {});

  /// Adds the frames of scene text. `name` stands for the file in messages, and its extension selects the format;
  /// included files are relative to `folder`. `strict` refuses a text with warnings.
  std::optional<Frame> addText(std::string_view text, const std::string& name = "text", const std::string& folder = {},
                               bool strict = false);

  /// The warnings of all files and texts added since the last clear(): "file:line:column: what was found and assumed".
  const std::vector<std::string>& fileWarnings() const { return file_warnings_; }

  /// Appends a frame at its parent's pose, or at the world's origin without a parent. `attributes` is text as inside
  /// the braces of a `.g` file. If the name already exists, returns that frame unchanged and adds a warning. Throws
  /// ValueError if that frame was made with another parent or other attributes, and FrameNotFound for an unknown
  /// parent.
  Frame addFrame(const std::string& name, const std::string& parent = {}, const std::string& attributes = {});
  Frame addFrame(const std::string& name, const Frame& parent, const std::string& attributes = {});

  /// Appends copies of all frames of `other`, names prefixed. Returns the first, if any.
  std::optional<Frame> addConfigurationCopy(const Config& other, const std::string& prefix = {});

  /// Removes a frame (the first one with that name). Its children become roots and keep their world poses.
  void delFrame(const std::string& name);
  void delFrame(const Frame& frame);
  void clear();

  /// Re-attaches the link of `child`: cuts off its topmost frame and fixes it below `parent`, keeping its world pose.
  void attach(const std::string& parent, const std::string& child);

  // Frames

  Frame getFrame(std::string_view name);  ///< the first frame with that name; throws FrameNotFound
  Frame getFrame(std::string_view name) const;
  std::optional<Frame> findFrame(std::string_view name);
  std::optional<Frame> findFrame(std::string_view name) const;
  Frame getFrame(int id);  ///< throws ValueError
  Frame getFrame(int id) const;
  std::vector<Frame> getFrames();
  std::vector<Frame> getFrames() const;
  std::vector<Frame> getRoots();
  std::vector<Frame> getRoots() const;
  std::vector<Frame> getJoints();  ///< frames whose joint is active and has dofs
  std::vector<Frame> getJoints() const;
  std::vector<std::string> getFrameNames() const;
  int getFrameDimension() const;

  /// World poses, shape (frames, 7): x y z qw qx qy qz, qw >= 0.
  MatrixXd getFrameState() const;

  /// Sets the world poses of all frames, or of the named ones. Joints move to the nearest poses they can reach.
  void setFrameState(const MatrixXd& poses, const std::vector<std::string>& names = {});

  // Joints

  int getJointDimension() const;
  VectorXd getJointState() const;
  VectorXd getJointState(const std::vector<std::string>& names) const;

  /// Sets q, or the dofs of the named frames in that order, active or not. Throws ValueError for a wrong length and for
  /// non-finite numbers.
  void setJointState(const VectorXd& q);
  void setJointState(const VectorXd& q, const std::vector<std::string>& names);

  /// One name per entry of q: the frame's name, followed by ":i" if its joint has several dofs.
  std::vector<std::string> getJointNames() const;
  std::vector<int> getJointIDs() const;  ///< ids of the frames of getJoints

  /// Names of the stored joint states (attribute `joint_states`, SRDF), of one group if given.
  std::vector<std::string> getStateNames(const std::string& group = {}) const;

  /// Returns the current q with the values of a stored state; joints not named by the state keep their values. Without
  /// a group, merges the states of that name of all groups. Throws NameError for an unknown state or group.
  VectorXd getNamedState(const std::string& name, const std::string& group = {}) const;

  /// Groups of joints (attribute `joint_groups`, SRDF): the name of each and the names of its joint frames.
  std::vector<std::pair<std::string, std::vector<std::string>>> getJointGroups() const;

  /// Limits, shape (2, n): lower in row 0, upper in row 1; -inf and inf for a dof without limits.
  MatrixXd getJointLimits() const;

  /// Activates the joints at or above the named frames and deactivates the others; `not_those` swaps the two sets.
  void selectJoints(const std::vector<std::string>& names, bool not_those = false);

  /// Samples q per joint: uniformly within its limits, or Gaussian around its home and clipped, as its sampling
  /// attributes specify.
  void setRandom(Rng& rng);

  // Dynamics

  /// Inertia of each link; links as in model().
  const std::vector<LinkInertia>& inertias() const;

  /// M(q) and F(q, dq) of u = M ddq + F at the current q, with gravity 9.81 m/s^2 along -z.
  EquationOfMotion equationOfMotion(const VectorXd& velocity) const;

  /// Generalized forces u (N m, N) for a velocity and an acceleration of q.
  VectorXd inverseDynamics(const VectorXd& velocity, const VectorXd& acceleration) const;

  /// Writes the same forces into `forces` (n,); a control loop requests no memory with it.
  void inverseDynamics(const Eigen::Ref<const VectorXd>& velocity, const Eigen::Ref<const VectorXd>& acceleration,
                       Eigen::Ref<VectorXd> forces) const;

  /// Total mass (kg) of all moving links and its center, world coordinates, m.
  std::pair<double, Vector3d> centerOfMass() const;

  // Collisions

  struct NearPair {
    int a, b;         ///< frame ids, a < b
    double distance;  ///< m, negative: penetration depth
  };

  /// Pairs of frames that may collide. Both have a shape and a nonzero contact flag and belong to different links. A
  /// negative flag -k excludes contacts with the links above within k joints. `contact_exclude` excludes the frames it
  /// names; for both rules, a shape that is fixed to its parent counts as the parent's shape.
  std::vector<std::pair<int, int>> getCollidablePairs() const;

  /// All collidable pairs with a distance of at most `margin` (m), ordered by id. Includes pairs at a constant relative
  /// pose.
  std::vector<NearPair> getCollisions(double margin = 0.) const;

  /// Sum of the penetration depths of all pairs, or the largest one, in m.
  double getTotalPenetration(bool largest_only = false) const;

  /// Returns the first obstruction of the straight motion between two joint vectors: a pair closer than `margin` (m) at
  /// any time (continuously, not only at samples), or a joint beyond its limits by more than 1e-5 rad or m. Returns
  /// nullopt for a collision-free motion. Pairs at a constant relative pose are ignored because they do not depend on
  /// q. Pairs within margin + tolerance may count as too close. Throws ValueError for joint vectors of a wrong length
  /// and for a tolerance <= 0.
  std::optional<MotionContact> checkMotion(const VectorXd& from, const VectorXd& to, double margin = 0.,
                                           double tolerance = 1e-5) const;

  // Members that higher layers define; kinegraph/kinegraph.h includes all of them.

  /// Value y (d,) of a feature of these frames at the current q, and its Jacobian J (d x n). Throws FrameNotFound, and
  /// ValueError for a wrong number of frames and for features of several configurations.
  Evaluation eval(const FeatureSource& feature, const std::vector<std::string>& frames = {}) const;

  /// Shows the scene in the browser and applies the edits made there; see ConfigViewer::view. `pause` waits for a
  /// key.
  /// Returns the key pressed since the last call, or 0.
  int view(bool pause = false, const std::string& message = {});

  /// Plays a motion of T joint states, shape (T, n), with a time slider; `pause` then waits for a key. Leaves q
  /// unchanged.
  int viewPath(const MatrixXd& path, double seconds = 3., bool pause = false, const std::string& message = {});

  /// Loads and shows a scene file, and reloads it after each change until q is pressed; see kinegraph::watchFile.
  void watchFile(const std::string& path);

  /// The viewer of this scene; it also follows a Simulation or BotOp that moves the scene. A copied Config gets its
  /// own.
  ConfigViewer& viewer();

  // Compiled data

  std::shared_ptr<const KinematicModel> model() const;
  std::shared_ptr<const Parameters> parameters() const;
  const State& state() const;
  const std::shared_ptr<SceneTree>& scene() const { return scene_; }

  /// Describes the scene: numbers of frames, joints and shapes, the colliding shapes, and contactWarnings().
  std::string report() const;

  /// Describes unexpected collision settings, one sentence each: overlapping shapes at a constant relative pose, and
  /// shapes without `contact` near moving links. Python warns of them once per scene.
  std::vector<std::string> contactWarnings() const;

  /// Returns and clears the warnings collected since the last call.
  std::vector<std::string> takeWarnings();

 private:
  std::optional<Frame> appendFile(const SceneTree& scratch, const std::string& prefix, const std::string& file,
                                  std::vector<std::string> warnings);
  void keepWarnings(const std::vector<std::string>& warnings);
  Frame addFrameBelow(const std::string& name, FrameData* parent, const std::string& attributes);
  FrameData& ownFrame(const Frame& frame, const char* call) const;  ///< throws ValueError for a frame of another Config

  Frame readOnly(FrameData& frame) const;
  std::vector<Frame> framesThat(bool (*apply)(const FrameData&)) const;  ///< read-only; null: all
  static std::vector<Frame> editable(std::vector<Frame> frames);

  Held<std::shared_ptr<SceneTree>> scene_;
  std::vector<std::string> warnings_, file_warnings_;
};

}  // namespace kinegraph
