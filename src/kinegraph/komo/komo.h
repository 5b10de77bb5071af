#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/kinematics/joint.h"
#include "kinegraph/komo/path/path_records.h"
#include "kinegraph/nlp/nlp.h"
#include "kinegraph/nlp/parameter.h"
#include "kinegraph/scene/config.h"

namespace kinegraph::inline komo_internal {
class Contacts;
class ObjectiveList;
class Path;
struct MotionProblem;
struct Objective;
}

namespace kinegraph {

class ConfigViewer;
struct SolveManyOptions;
struct SolveManyResult;
struct SolverOptions;
struct SolverResult;

/// A trajectory optimization problem: T configurations (slices) of a scene, coupled by objectives on features of k+1
/// consecutive ones. With one phase of one slice and order 0 it is inverse kinematics.
///
/// The path is preceded by `order` copies of the initial configuration, so that motions start there, at rest.
/// Source: Toussaint, A tutorial on Newton methods for constrained trajectory optimization, 2017.
class Komo {
 public:
  Komo();
  Komo(Komo&&) = default;
  Komo& operator=(Komo&&) = default;
  Komo(const Config& config, double phases, int slices_per_phase, int order);

  /// Returns an independent copy of the problem and its path, for example to solve it on another thread.
  Komo clone() const;

  /// The complete content of a Komo, from which it can be reconstructed, for example in another process. Empty before
  /// setTiming.
  struct Parts;
  Parts parts() const;
  explicit Komo(Parts parts);  ///< throws ValueError if the parts are inconsistent

  /// Complete a default-constructed Komo, in either order, before the first objective.
  void setConfig(const Config& config);
  void setTiming(double phases, int slices_per_phase, double duration_per_phase, int order);

  // --- objectives --------------------------------------------------------------------------------------------------

  /// Adds scale * (d^order feature / dt^order - target) in the slices that `times` selects (see TimeGrid::select).
  /// `order` -1 is the feature's own order. Joint features without frames use the joints of the initial configuration.
  /// `margin` (m) applies to accumulatedCollisions, pairCollisions and distance: closer shapes count as colliding.
  /// Throws FrameNotFound and ValueError.
  void addObjective(const std::vector<double>& times, const FeatureSource& feature,
                    const std::vector<std::string>& frames, ObjectiveType type, const Scale& scale = {},
                    const Target& target = {}, int order = -1, double margin = 0.);

  /// Adds scale * (feature - target) with a target of its own in each of the K slices that `times` selects: rows of
  /// `targets` (K, d). Throws ValueError for another number of rows.
  void addObjectivePerSlice(const std::vector<double>& times, const FeatureSource& feature,
                            const std::vector<std::string>& frames, ObjectiveType type, const MatrixXd& targets,
                            const Scale& scale = {}, int order = -1);

  /// Adds the sum of squares of the order-th derivative of the initial configuration's dofs, weighted by their control
  /// weights and integrated over time. Order 0 penalizes the distance from home.
  void addControlObjective(const std::vector<double>& times, int order, double scale = 1., const Target& target = {},
                           int delta_from = 0, int delta_to = 0);

  /// Keeps all pairs that may collide at least `margin` (m) apart in the slices that `times` selects, and continuously
  /// along the motions between them, including the motion to the first slice; see continuous_collisions.h. Throws
  /// ValueError for a margin below 0.
  void addFreeMotion(const std::vector<double>& times = {}, double margin = 1e-3, double scale = 10.);

  /// Constrains quaternions among the dofs of a slice to norm one.
  void addQuaternionNorms(const std::vector<double>& times = {}, double scale = 3., bool hard = true);

  /// Removes all objectives, including those of mode switches. Attachments remain.
  void clearObjectives();

  // --- mode switches: changes of the kinematic structure along the path; see mode_switches.h -------------------------

  void addModeSwitch(const std::vector<double>& times, SwitchMode mode, const std::vector<std::string>& frames,
                     bool first = true);
  void addRigidSwitch(double time, const std::string& parent, const std::string& object, bool no_jump = true);
  void addFrameDof(const std::string& name, const std::string& parent, JointType type, bool stable,
                   const std::string& origin = {});

  // --- contact forces ----------------------------------------------------------------------------------------------
  // The features totalForce and physics balance them.

  /// Lets `from` push `object` at a point of contact, within the friction cone, in the slices that `times` selects. The
  /// point is a frame on the object, the same in all slices; returns its name. The force acts along its z axis: one
  /// more dof per slice, in units of the weight of `mass` kg, at most ten times that.
  std::string addContactForce(const std::vector<double>& times, const std::string& object, const std::string& from,
                              double friction, double mass);

  /// Adds a contact force of any direction in the friction cone, with three dofs per slice. The point starts `distance`
  /// (m) away from the object.
  std::string addFreeContactForce(const std::vector<double>& times, const std::string& object, const std::string& from,
                                  double friction, double mass, double distance);

  /// Adds a point of contact that moves along both surfaces, and a force there; see force_exchange.h.
  std::string addForceExchange(const std::vector<double>& times, const std::string& object, const std::string& from,
                               ForceExchange kind, double friction = .5);

  std::vector<Interaction> interactions() const;

  // --- the path ----------------------------------------------------------------------------------------------------

  int slices() const;  ///< the number T of slices
  int order() const;   ///< the largest order k of the objectives
  double tau() const;  ///< duration of a slice, s
  int dofs() const;    ///< n, of the initial configuration

  MatrixXd getPath(const std::vector<int>& frames = {}) const;  ///< T x n; see Path::joints
  MatrixXd getFrameState(int slice) const;                      ///< frames x 7; see Path::framePoses
  Config configuration(int slice) const;                        ///< copy of the scene in a slice
  void updateRootObjects(const Config& config);                 ///< see Path::updateRootObjects

  // --- the motion between slices: q moves linearly, attached objects move along; see path_motion.h
  // ---------------------

  /// Returns, for each slice whose preceding motion collides, the first pair that comes closer than `margin` (m). The
  /// check is continuous; pairs within margin + tolerance (m) may count. Throws ValueError for a margin that is not
  /// finite, and a tolerance that is not positive.
  std::vector<PathContact> checkMotion(double margin = 0., double tolerance = 1e-5,
                                       const CancellationToken& cancellation = {}) const;

  /// Returns true if all pairs stay `margin` (m) apart continuously.
  bool isFree(double margin = 0.) const { return checkMotion(margin).empty(); }

  // --- initialization; see path_initialization.h
  // ----------------------------------------------------------------------

  void setPath(const MatrixXd& path);
  void setConstantPath(const VectorXd& q);
  void resetPath();
  void setRandomPath(Rng& rng);
  std::vector<int> setWaypoints(const std::vector<VectorXd>& waypoints, const WaypointOptions& options = {});
  void setPhasePath(int phase, const std::vector<int>& frames, const MatrixXd& path, bool resample = false);

  // --- defined in higher rooms; include kinegraph/kinegraph.h
  // ----------------------------------------------------------

  /// Returns this problem for a solver, which leaves the path of this Komo at its result. It shares the path with this
  /// Komo, and stays valid when the Komo is moved or destroyed; see makeNlp.
  std::shared_ptr<Nlp> nlp();

  /// Solves from the present path and leaves the path at the result. Failing to converge is a status, not an error.
  SolverResult solve();
  SolverResult solve(const SolverOptions& options);

  /// Solves from the present path and from `starts` - 1 random ones (by `seed`), and leaves the path at the best
  /// result. Throws ValueError for fewer than one start or thread.
  SolveManyResult solveFromMany(int starts, const SolveManyOptions& options, std::uint64_t seed = 0);

  /// Shows all slices in the browser, with a time slider, the errors of the objectives, and violations in red. `pause`
  /// waits for a key. Returns the key, or 0.
  int view(bool pause = false, const std::string& message = {});

  /// Plays the slices once, `seconds_per_slice` each, and waits until the end or a key press. Returns the key, or 0.
  int viewPlay(bool pause = false, const std::string& message = {}, double seconds_per_slice = .1);

  /// Returns the viewer of this problem, created on first use.
  ConfigViewer& viewer();

  // --- the parts, for the library itself: their headers are not installed ------------------------------------------

  const Path& path() const;
  Path& path();
  const ObjectiveList& objectives() const;
  const Contacts& contacts() const;

  /// Returns and clears the warnings about calls without effect.
  std::vector<std::string> takeWarnings();

 private:
  explicit Komo(std::shared_ptr<MotionProblem> motion);
  std::shared_ptr<Komo> sharing() const;  ///< another Komo with the same path, objectives and viewer
  void requireUntouched(const char* what) const;

  Held<std::shared_ptr<MotionProblem>> motion_;
  std::shared_ptr<ConfigViewer> viewer_;  ///< null until first used
};

/// Returns the problem of a Komo for a solver; throws ValueError for null. It keeps the Komo alive, leaves its path at
/// the last evaluated point, and lacks objectives added later. After a change of the structure it throws Error.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo);

/// Returns the Komo from which a problem was made; null for other problems.
std::shared_ptr<Komo> komoOf(const Nlp& nlp);

/// Residuals of a trajectory optimization problem at its present path, summed by objective and slice.
struct PathErrors {
  std::vector<double> per_objective;  ///< sum over its slices
  MatrixXd per_slice;                 ///< T x objectives
  ErrorSums totals;                   ///< see sumErrors
};

/// Computes the errors of the present path. A residual counts with its square (sos, and ineqP if positive), its
/// absolute value (eq), its positive part (ineq, ineqB), or its value (f).
PathErrors measurePath(const Komo& komo);

/// Returns a short name such as "F_qItself/acc[#14]" or "F_PositionDiff[l_gripper,target]".
std::string objectiveTag(const Komo& komo, const Objective& objective);

/// Returns the tag of the objective of each residual.
std::vector<std::string> residualTags(const Komo& komo);

/// Lists the objectives with an error above 1e-4 in a slice, largest first, one per line. `per_slice` as in PathErrors.
std::string sliceErrors(const Komo& komo, int slice, const MatrixXd& per_slice);

/// Lists the pairs of shapes closer than `margin` (m) in a slice, one per line.
std::string sliceCollisions(const Komo& komo, int slice, double margin);

class Komo;

/// Limits the motion of each joint between consecutive slices to `step` (rad, m), in the slices that `times` selects.
/// Adds two inequalities per dof, in rad or m. Throws ValueError for a step that is not positive, and for a Komo of
/// order 0.
void addStepLimit(Komo& komo, double step, const std::vector<double>& times = {});

// Parameters of a trajectory optimization problem, for sensitivities. `nlp` must be made from a Komo; otherwise the
// functions throw ValueError.

/// Returns the number of an objective, in the order of addition, from its name ("positionDiff") or its name with frames
/// ("positionDiff of l_gripper, target"). Throws NameError unless exactly one matches.
int objectiveNumber(const Nlp& nlp, const std::string& name);

/// The target of an objective: one number per component of the feature, the same in all slices; for pairCollisions one
/// number for all pairs. Throws ValueError for an objective that does not exist, selects no slice, or has no target.
std::shared_ptr<NlpParameter> objectiveTarget(const Nlp& nlp, int objective);

/// The scale of an objective: one number, or one per component, as it was specified. Throws ValueError for an objective
/// that does not exist or selects no slice, for a matrix, and for a scale of zero.
std::shared_ptr<NlpParameter> objectiveScale(const Nlp& nlp, int objective);

/// The position or pose of a frame relative to its parent, or in the world if it has none: x y z (m); for a pose also a
/// rotation vector r (rad) about its own origin, along axes of the parent: R <- exp(r) R. Throws FrameNotFound, and
/// ValueError for frames that a joint moves; name their parent instead.
std::shared_ptr<NlpParameter> framePosition(const Nlp& nlp, const std::string& frame);
std::shared_ptr<NlpParameter> framePose(const Nlp& nlp, const std::string& frame);  ///< position and quaternion

/// The q from which the motion starts, at rest. Throws ValueError for problems of order 0, which have no slices before
/// the first.
std::shared_ptr<NlpParameter> motionStart(const Nlp& nlp);

}  // namespace kinegraph
