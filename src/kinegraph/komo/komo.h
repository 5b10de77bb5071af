#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/komo/mode.h"
#include "kinegraph/komo/path_layout.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A motion problem: T configurations (slices) of a scene, tied together by objectives on features of k+1 consecutive
/// ones. With one phase of one slice and order 0 it is inverse kinematics.
///
/// T = ceil(phases * slices_per_phase); slice t is at phase time (t+1) / slices_per_phase. Before slice 0 lie `order`
/// copies of the given configuration, so that motions start there, at rest. Slices share the Program of their mode:
/// what hangs where may change along the path (`addModeSwitch`), as when an object is grasped and put down. Source:
/// Toussaint, A tutorial on Newton methods for constrained trajectory optimization, 2017.
class Komo {
 public:
  struct Objective {
    std::string name;  ///< of the feature
    FeatureSource feature;
    std::vector<std::string> frames;
    ObjectiveType type;
    MatrixXd scale;
    VectorXd target;
    int order;  ///< number of slices it looks at, minus one
    std::vector<double> times;
    int from, to;  ///< slices, inclusive; none if from > to
    bool time_integral = false;
    bool without_gravity = false;  ///< of physics
    bool damped = false;           ///< of physics: forces balance friction, not inertia
  };

  /// A contact force in a slice.
  struct Interaction {
    int slice;
    std::string object, onto;
    Vector3d point;  ///< m, in the world
    Vector3d force;  ///< N, on the object, in the world
  };

  Komo() = default;
  Komo(Komo&&) = default;
  Komo& operator=(Komo&&) = default;
  Komo(const Config& config, double phases, int slices_per_phase, int order);

  /// The same problem at the same path, to be solved beside this one, as on another thread.
  Komo clone() const;

  /// All that a Komo consists of, to make it anew elsewhere, as in another process. Empty before there is a timing.
  struct Parts {
    struct Structure {
      Config config;
      std::map<int, Mode::Added> added;
    };
    Config config;
    double phases = 0., duration_per_phase = 1.;
    int slices_per_phase = 0, order = 0, next_joint = 1;
    std::vector<Structure> modes;
    std::vector<int> mode_of, shown_frames;
    std::vector<Objective> objectives;
    std::vector<ContactForce> contacts;
    std::vector<VectorXd> states;  ///< q of all slices, those before the start first
  };
  Parts parts() const;
  explicit Komo(Parts parts);

  /// In either order, for a Komo made without arguments; before the first objective.
  void setConfig(const Config& config);
  void setTiming(double phases, int slices_per_phase, double duration_per_phase, int order);

  // --- objectives -------------------------------------------------------------------------------------------------

  /// Adds scale * (d^order feature / dt^order - target) in the slices that `times` selects: empty all, {a} the one at
  /// time a, {a, b} those from a to b inclusive; negative: the last. `order` -1: the feature's own. For joint features
  /// no frames are the joints of the configuration as it was given.
  void addObjective(const std::vector<double>& times, const FeatureSource& feature,
                    const std::vector<std::string>& frames, ObjectiveType type, const MatrixXd& scale = {},
                    const VectorXd& target = {}, int order = -1);

  /// Sum of squares of the order-th derivative of the given configuration's dofs, weighted by their control weights and
  /// integrated over time; order 0 is the distance from home.
  void addControlObjective(const std::vector<double>& times, int order, double scale = 1., const VectorXd& target = {},
                           int delta_from = 0, int delta_to = 0);

  /// Keeps quaternions among the dofs of a slice at norm one.
  void addQuaternionNorms(const std::vector<double>& times = {}, double scale = 3., bool hard = true);

  /// Removes the objectives, those of mode switches included; what the switches attached stays attached.
  void clearObjectives() { objectives_.clear(); }

  // --- changes of the structure along the path ---------------------------------------------------------------------

  /// From time `times[0]` on, `frames[1]` hangs below `frames[0]` by a joint that `mode` says. Adds what keeps the
  /// motion continuous there (if `first`) and at times[1], where a next switch takes over; negative: it holds to the
  /// end. Modes in which an object moves by itself take it alone, too.
  void addModeSwitch(const std::vector<double>& times, SwitchMode mode, const std::vector<std::string>& frames,
                     bool first = true);

  /// From `time` on, `object` sits at `parent`, without a joint. `no_jump`: it does not jump there.
  void addRigidSwitch(double time, const std::string& parent, const std::string& object, bool no_jump = true);

  /// Adds a frame to all slices, with a joint whose dofs are the same in all of them (`stable`) or one set per slice.
  /// It moves relative to `parent` (empty: the world), or to where `origin` is relative to it now. JointType::none: it
  /// does not move.
  void addFrameDof(const std::string& name, const std::string& parent, JointType type, bool stable,
                   const std::string& origin = {});

  // --- contact forces ----------------------------------------------------------------------------------------------

  /// In the slices that `times` selects, `onto` pushes `object` at a point where they touch, within the cone of
  /// friction. The point is a frame on the object, the same in all slices; its name is returned. The force is along its
  /// z axis: one more dof per slice, in units of the weight of `mass` kg, up to ten times that. What balances it is up
  /// to totalForce and physics.
  std::string addContactForce(const std::vector<double>& times, const std::string& object, const std::string& onto,
                              double friction, double mass);

  /// The same with a force of any direction in the cone, three dofs per slice. The point starts `distance` off the
  /// object, m.
  std::string addFreeContactForce(const std::vector<double>& times, const std::string& object, const std::string& onto,
                                  double friction, double mass, double distance);

  /// What a contact that moves along both surfaces does to the bodies.
  enum class Exchange {
    slide,          ///< they touch; the force is along the normal
    stick,          ///< they touch and do not slide; at kOrder 0 the force is within the cone of friction
    complementary,  ///< they do not overlap; the force is along the normal where they touch, and zero elsewhere
    bounce,         ///< they touch in the first of the slices and fly apart with 0.9 of the speed; kOrder 2
  };

  /// In the slices that `times` selects, `object` and `onto` may push each other: six more dofs per slice, the point
  /// where they do and the force on `object` there. Adds what the kind demands, and small costs on both. Returns the
  /// name of the point.
  std::string addExchange(const std::vector<double>& times, const std::string& object, const std::string& onto,
                          Exchange kind, double friction = .5);

  std::vector<Interaction> interactions() const;

  // --- the path ---------------------------------------------------------------------------------------------------

  int slices() const { return slices_; }  ///< T
  int order() const { return order_; }    ///< k
  int slicesPerPhase() const { return slices_per_phase_; }
  double phases() const { return phases_; }
  int dofs() const { return program_->dofs; }                   ///< of the given configuration
  int jointCount() const { return int(joint_frames_.size()); }  ///< joints of the given configuration
  double tau() const { return tau_; }                           ///< s per slice
  const Program& program() const { return *program_; }          ///< of the given configuration
  const std::vector<Objective>& objectives() const { return objectives_; }
  const PathLayout& layout() const { return layout_; }
  int structureRevision() const { return structure_revision_; }  ///< changes with every change of the structure

  /// T x n: the dofs of the given configuration in all slices; or those of the joints of the frames with these ids.
  MatrixXd getPath(const std::vector<int>& frames = {}) const;
  VectorXd ownDofs(int slice) const;     ///< those entries of x that belong to the slice
  VectorXd variables() const;            ///< x
  void setVariables(const VectorXd& x);  ///< of layout().dimension entries
  const State& state(int slice) const { return states_[slice + order_]; }  ///< -order .. T-1

  /// World poses of all frames in a slice, rows x y z qw qx qy qz.
  MatrixXd getFrameState(int slice) const;
  int frameCount() const { return int(shown_frames_.size()); }

  /// A copy of the scene as it is in a slice.
  Config configuration(int slice) const;

  /// For one slice per phase: the scene at the beginning of a phase, only the given configuration's joints active, and
  /// its q at the beginning and at the end.
  struct SubProblem {
    Config config;
    VectorXd start, end;
  };
  SubProblem subProblem(int phase) const;

  /// Takes over the constant poses (root objects, markers) of the configuration. Throws ValueError if its frames and
  /// joints are not those that this problem was made from.
  void updateRootObjects(const Config& config);

  // --- where a solver starts ---------------------------------------------------------------------------------------

  void setPath(const MatrixXd& path);       ///< T x n; throws ValueError
  void setConstantPath(const VectorXd& q);  ///< n numbers, or T*n for a path
  void resetPath();                         ///< all slices as given
  void setRandomPath(Rng& rng);             ///< as Config::setRandom, slice after slice

  /// Puts waypoint i into the slice at phase time (i+1) / per_phase: the given configuration's dofs, or all that the
  /// slice owns. Between them: the one before, or with `interpolate` a cosine blend, moved towards home by
  /// `towards_home` (0..1) in the middle. Returns the slices.
  std::vector<int> setWaypoints(const std::vector<VectorXd>& waypoints, int per_phase, bool interpolate,
                                double towards_home = 0.);

  /// Writes rows of `path` into the slices of a phase, for the joints of these frames. `resample`: whatever their
  /// number.
  void setPhasePath(int phase, const std::vector<int>& frames, const MatrixXd& path, bool resample);

  // --- for the Nlp -------------------------------------------------------------------------------------------------

  /// The selected slices [from, to], clipped to the horizon; empty if from > to.
  std::pair<int, int> selectSlices(const std::vector<double>& times) const;

  /// The slice at a phase time; -order .. beyond the horizon.
  int sliceAt(double time) const;

  /// An objective's residual in a slice. Where the dofs do not matter it is the same in all slices.
  Residual residualIn(const Objective& objective, int slice) const;

  void setSlice(int slice, const double* q) { states_[slice + order_].setJoints(q); }

  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  Komo(const Komo&) = default;  ///< see clone()
  void build();
  void requireBuilt(const char* call) const;
  std::unique_ptr<Feature> featureIn(const Objective& objective, int slice) const;
  void add(Objective objective, int delta_from, int delta_to);
  void addContinuity(FeatureSymbol feature, const std::vector<std::string>& frames, double scale, int order, int slice);
  void makeModes();
  std::string addContact(const std::vector<double>& times, const std::string& object, const std::string& onto,
                         double friction, double mass, double distance, bool is_free);
  int addForceDofs(const std::string& name, int from, int to, bool is_free);
  int addDofs(const std::string& name, int from, int to, const Attachment& attachment);
  std::unique_ptr<Feature> physicsOf(int frame, const Objective& objective) const;
  void addPhysics(SwitchMode mode, const std::string& object, int from, int to);
  int addHiddenFrame(const std::string& name);
  void switchFrom(int slice, const std::string& parent, const std::string& object, const Attachment& attachment);
  void rebuildStates();
  std::vector<int> dofsOf(const std::vector<int>& frames, int slice) const;
  void writeJoints(int slice, const VectorXd& q);

  std::shared_ptr<const SceneTree> base_;    ///< the scene as given, without the frames' attributes
  std::shared_ptr<const SceneTree> source_;  ///< where it came from, for the attributes
  std::shared_ptr<const Program> program_;
  std::shared_ptr<const Parameters> parameters_;
  VectorXd start_;
  std::set<int> stable_;           ///< frames whose original joints are the same in all slices
  std::vector<int> joint_frames_;  ///< those whose joints make up the given q
  std::vector<int> shown_frames_;  ///< without those that mode switches need
  int slices_ = 0, slices_per_phase_ = 0, order_ = 0, structure_revision_ = 0, next_joint_ = 1;
  double phases_ = 0., tau_ = 1.;
  std::vector<std::shared_ptr<Mode>> modes_;  ///< empty until the structure changes
  std::vector<int> mode_of_;                  ///< per slice, those before the start first
  std::vector<State> states_;
  PathLayout layout_;
  std::vector<Objective> objectives_;
  std::vector<ContactForce> contacts_;
  std::vector<std::string> warnings_;
};

/// slide, stick, complementary or bounce. Throws NameError for other names, with those that are near.
Komo::Exchange exchangeFromName(const std::string& name);

/// The problem of a Komo, for a solver. It keeps the Komo alive, and leaves it at the point last evaluated. Objectives
/// that are added to the Komo later are not part of it; after a later change of the structure it throws Error.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo);

/// The Komo that a problem was made from; null for other problems.
std::shared_ptr<Komo> komoOf(const Nlp& nlp);

}  // namespace kinegraph
