#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/features/scale.h"
#include "kinegraph/komo/force_exchange.h"
#include "kinegraph/komo/motion_problem.h"
#include "kinegraph/komo/path/path_initialization.h"
#include "kinegraph/komo/path/path_motion.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

class ConfigViewer;
struct SolveManyOptions;
struct SolveManyResult;
struct SolverOptions;
struct SolverResult;

/// A motion problem: T configurations (slices) of a scene, tied together by objectives on features of k+1 consecutive
/// ones. With one phase of one slice and order 0 it is inverse kinematics.
///
/// It is made of a `Path` (time grid, modes, states), an `ObjectiveList` and `Contacts`; the calls here say what people
/// want in one line each, the parts say everything about themselves. Before slice 0 lie `order` copies of the given
/// configuration, so that motions start there, at rest. Source: Toussaint, A tutorial on Newton methods for constrained
/// trajectory optimization, 2017.
class Komo {
 public:
  Komo() = default;
  Komo(Komo&&) = default;
  Komo& operator=(Komo&&) = default;
  Komo(const Config& config, double phases, int slices_per_phase, int order);

  /// The same problem at the same path, to be solved beside this one, as on another thread.
  Komo clone() const;

  /// All that a Komo consists of, to make it anew elsewhere, as in another process. Empty before there is a timing.
  struct Parts {
    Config config;
    double phases = 0., duration_per_phase = 1.;
    int slices_per_phase = 0, order = 0;
    Path::Content path;
    std::vector<Objective> objectives;
    std::vector<ContactForce> contacts;
  };
  Parts parts() const;
  explicit Komo(Parts parts);  ///< throws ValueError if they do not fit together

  /// In either order, for a Komo made without arguments; before the first objective.
  void setConfig(const Config& config);
  void setTiming(double phases, int slices_per_phase, double duration_per_phase, int order);

  // --- objectives --------------------------------------------------------------------------------------------------

  /// Adds scale * (d^order feature / dt^order - target) in the slices that `times` selects (see TimeGrid::select).
  /// `order` -1: the feature's own. For joint features no frames are the joints of the configuration as it was given.
  /// `margin` (m) of accumulatedCollisions, pairCollisions and distance: shapes that are nearer count as colliding.
  /// Throws FrameNotFound and ValueError.
  void addObjective(const std::vector<double>& times, const FeatureSource& feature,
                    const std::vector<std::string>& frames, ObjectiveType type, const Scale& scale = {},
                    const Target& target = {}, int order = -1, double margin = 0.);

  /// Sum of squares of the order-th derivative of the given configuration's dofs, weighted by their control weights and
  /// integrated over time; order 0 is the distance from home.
  void addControlObjective(const std::vector<double>& times, int order, double scale = 1., const Target& target = {},
                           int delta_from = 0, int delta_to = 0);

  /// Keeps all pairs that may collide `margin` (m) apart in the slices that `times` selects, and at all times of the
  /// motions between them, of that to the first slice, too; see free_motion.h. Throws ValueError for a margin below 0.
  void addFreeMotion(const std::vector<double>& times = {}, double margin = 1e-3, double scale = 10.);

  /// Keeps quaternions among the dofs of a slice at norm one.
  void addQuaternionNorms(const std::vector<double>& times = {}, double scale = 3., bool hard = true);

  /// Removes the objectives, those of mode switches included; what the switches attached stays attached.
  void clearObjectives() { motion_.objectives.clear(); }

  // --- changes of the structure along the path; see mode_switches.h ------------------------------------------------

  void addModeSwitch(const std::vector<double>& times, SwitchMode mode, const std::vector<std::string>& frames,
                     bool first = true);
  void addRigidSwitch(double time, const std::string& parent, const std::string& object, bool no_jump = true);
  void addFrameDof(const std::string& name, const std::string& parent, JointType type, bool stable,
                   const std::string& origin = {});

  // --- contact forces ----------------------------------------------------------------------------------------------
  // What balances them is up to totalForce and physics.

  /// In the slices that `times` selects, `from` pushes `object` at a point where they touch, within the cone of
  /// friction. The point is a frame on the object, the same in all slices; its name is returned. The force is along its
  /// z axis: one more dof per slice, in units of the weight of `mass` kg, up to ten times that.
  std::string addContactForce(const std::vector<double>& times, const std::string& object, const std::string& from,
                              double friction, double mass);

  /// The same with a force of any direction in the cone, three dofs per slice. The point starts `distance` off the
  /// object, m.
  std::string addFreeContactForce(const std::vector<double>& times, const std::string& object, const std::string& from,
                                  double friction, double mass, double distance);

  /// A point that moves along both surfaces, and a force there: see exchanges.h.
  std::string addForceExchange(const std::vector<double>& times, const std::string& object, const std::string& from,
                               ForceExchange kind, double friction = .5);

  std::vector<Interaction> interactions() const { return motion_.contacts.interactions(motion_.path); }

  // --- the path ----------------------------------------------------------------------------------------------------

  int slices() const { return path().grid().slices(); }  ///< T
  int order() const { return path().grid().order(); }    ///< k
  double tau() const { return path().grid().tau(); }     ///< s per slice
  int dofs() const { return path().dofs(); }             ///< n, of the given configuration

  MatrixXd getPath(const std::vector<int>& frames = {}) const;  ///< T x n; see Path::joints
  MatrixXd getFrameState(int slice) const;                      ///< frames x 7; see Path::framePoses
  Config configuration(int slice) const;                        ///< a copy of the scene as it is in a slice
  void updateRootObjects(const Config& config);                 ///< see Path::updateRootObjects

  // --- the motion from slice to slice: q goes straight, objects that are attached move along; see path_motion.h --------

  /// Where the motion is not free: for each slice that it leads to, the first pair that comes nearer than `margin` (m) on
  /// the way, at any time and not just at samples of them; pairs within margin + tolerance (m) may count. Throws
  /// ValueError for a margin that is not finite, and a tolerance that is not positive.
  std::vector<PathContact> checkMotion(double margin = 0., double tolerance = 1e-5,
                                       const CancellationToken& cancellation = {}) const;

  /// Do all pairs keep `margin` (m) apart, at all times?
  bool isFree(double margin = 0.) const { return checkMotion(margin).empty(); }

  // --- where a solver starts; see path_starts.h ----------------------------------------------------------------------

  void setPath(const MatrixXd& path) { startAtPath(motion_.path, path); }
  void setConstantPath(const VectorXd& q) { startAtConstant(motion_.path, q); }
  void resetPath() { startAsGiven(motion_.path); }
  void setRandomPath(Rng& rng) { startAtRandom(motion_.path, rng); }
  std::vector<int> setWaypoints(const std::vector<VectorXd>& waypoints, const WaypointOptions& options = {}) {
    return startAtWaypoints(motion_.path, waypoints, options);
  }
  void setPhasePath(int phase, const std::vector<int>& frames, const MatrixXd& path, bool resample = false) {
    startPhaseAt(motion_.path, phase, frames, path, resample);
  }

  // --- what rooms above add: defined in front, all in kinegraph/kinegraph.h ------------------------------------------

  /// This problem for a solver, which leaves the path at its result. It must not outlive the Komo, nor may the Komo be
  /// moved meanwhile; see makeNlp.
  std::shared_ptr<Nlp> nlp();

  /// Solves from the present path, and leaves the path at the result. Not converging is a status, not an error.
  SolverResult solve();
  SolverResult solve(const SolverOptions& options);

  /// Solves from the present path and from `starts` - 1 random ones (by `seed`), and leaves the path at the best
  /// result. Throws ValueError for less than one start or thread.
  SolveManyResult solveFromMany(int starts, const SolveManyOptions& options, std::uint64_t seed = 0);

  /// Shows all slices in the browser, with a time slider, the errors of the objectives, and what violates them in red;
  /// `pause` waits for a key. Returns the key, or 0.
  int view(bool pause = false, const std::string& message = {});

  /// Plays the slices, `seconds_per_slice` each, and waits until they have been played once; a key ends it.
  int viewPlay(bool pause = false, const std::string& message = {}, double seconds_per_slice = .1);

  /// What shows this problem.
  ConfigViewer& viewer();

  // --- the parts ---------------------------------------------------------------------------------------------------

  const Path& path() const { return motion_.path; }
  Path& path() { return motion_.path; }
  const ObjectiveList& objectives() const { return motion_.objectives; }
  const Contacts& contacts() const { return motion_.contacts; }

  /// What had no effect since this was last called.
  std::vector<std::string> takeWarnings() { return motion_.objectives.takeWarnings(); }

 private:
  Komo(const Komo&) = default;  ///< see clone()
  void requireUntouched(const char* what) const;

  MotionProblem motion_;
  std::shared_ptr<ConfigViewer> viewer_;  ///< null until there is something to show
};

/// The problem of a Komo, for a solver. It keeps the Komo alive, and leaves it at the point last evaluated. Objectives
/// that are added to the Komo later are not part of it; after a later change of the structure it throws Error.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo);

/// The Komo that a problem was made from; null for other problems.
std::shared_ptr<Komo> komoOf(const Nlp& nlp);

}  // namespace kinegraph
