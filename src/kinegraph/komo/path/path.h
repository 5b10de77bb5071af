#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/komo/path/initial_configuration.h"
#include "kinegraph/komo/path/modes.h"
#include "kinegraph/komo/path/path_layout.h"
#include "kinegraph/komo/path/time_grid.h"

namespace kinegraph::inline komo_internal {

/// Configurations of a scene, one per slice of a time grid, preceded by `order` more. The kinematic structure may
/// change along the path: slices share the model of their mode. Empty until it has both a scene and a grid.
///
/// `layout()` describes x, the vector of variables for solvers. Layout and states follow from the modes: each call that
/// changes the structure rebuilds both and increments `revision()`.
class Path {
 public:
  void setScene(const Config& config);      ///< resets all slices to the initial configuration, without modes
  void setGrid(const TimeGrid& time_grid);  ///< likewise
  Path clone() const;                       ///< copies the modes; kinematic models are shared

  /// Throws Error that names the call if a scene or a grid is missing.
  void requireBuilt(const char* call) const;

  const TimeGrid& grid() const { return grid_; }
  const InitialConfiguration& initial() const { return initial_; }
  const Modes& modes() const { return modes_; }
  const PathLayout& layout() const { return layout_; }
  int revision() const { return revision_; }
  int dofs() const { return initial_.model->dofs; }                      ///< of the initial configuration
  const std::vector<int>& shownFrames() const { return shown_frames_; }  ///< without auxiliary frames of modes

  // --- states ------------------------------------------------------------------------------------------------------

  /// slice in -order .. T-1
  const State& state(int slice) const { return states_[std::size_t(slice + grid_.order())]; }
  const Mode& mode(int slice) const { return modes_.at(std::size_t(slice + grid_.order())); }  ///< requires modes
  void setSlice(int slice, const double* q) { states_[std::size_t(slice + grid_.order())].setJoints(q); }

  /// Sets parameters of a single slice, such as the poses of dynamic obstacles, for its kinematic model. They are reset
  /// by the next change of the structure or of root objects.
  void setParameters(int slice, std::shared_ptr<const Parameters> parameters) {
    states_[std::size_t(slice + grid_.order())].setParameters(std::move(parameters));
  }

  VectorXd ownDofs(int slice) const;     ///< entries of x that belong to the slice
  VectorXd variables() const;            ///< x
  void setVariables(const VectorXd& x);  ///< `x` has layout().dimension entries

  /// Returns the indices of the joints of these frames in the q of a slice. Throws ValueError for frames without one.
  std::vector<int> dofsOf(const std::vector<int>& frames, int slice) const;

  /// Returns the dofs of the initial configuration in all slices (T x n), or those of the joints of the frames with
  /// these ids.
  MatrixXd joints(const std::vector<int>& frames = {}) const;

  /// Sets the initial configuration's dofs in a slice. Shared dofs are set in this slice only;
  /// setVariables(variables()) copies them to the others.
  void setJoints(int slice, const VectorXd& q);

  /// Returns world poses of the shown frames in a slice, rows x y z qw qx qy qz.
  MatrixXd framePoses(int slice) const;

  /// Returns a copy of the scene in a slice.
  Config configuration(int slice) const;

  // --- changes of the structure; existing joints keep their dofs
  // ------------------------------------------------------

  /// Gives all slices a mode. Must be called before the edits below.
  void beginModes() { modes_.begin(*initial_.tree); }

  /// Attaches `object` to `parent` from a slice on.
  void attach(int from, const std::string& parent, const std::string& object, const Attachment& attachment);

  /// Adds an auxiliary frame with a joint to the world in the slices [from, to]. Returns its id.
  int addDofs(const std::string& name, int from, int to, const Attachment& attachment);

  /// Adds a frame to all slices, below `parent` (empty: none), or below an additional frame whose present world pose is
  /// `origin`. It has a joint, stable or not, unless the type is none.
  void addFrame(const std::string& name, const std::string& parent, JointType type, bool stable,
                const std::optional<Pose>& origin);

  /// Copies the constant poses (root objects, markers) of the configuration, and uses its q as the start of the motion:
  /// it sets the slices before the first, except for dofs that are variables. The slices from 0 on do not change.
  /// Throws ValueError if its frames and joints are not those of the initial scene.
  void updateRootObjects(const Config& config);

  // --- content beside scene and grid, to reconstruct the path
  // ---------------------------------------------------------

  struct Content {
    std::vector<Mode> modes;
    std::vector<int> mode_of, shown_frames;
    int next_joint = 1;
    std::vector<VectorXd> states;  ///< q of all slices, starting with those before the start
  };
  Content content() const;
  void setContent(Content content);  ///< throws ValueError if it is inconsistent

 private:
  void build();
  void rebuildStates();
  void moveStart(const VectorXd& q);
  void layOut() { layout_ = makeLayout(states_, grid_.order(), initial_.shared_joints, modes_); }
  void requireSlice(int slice) const;

  InitialConfiguration initial_;
  TimeGrid grid_;
  Modes modes_;
  std::vector<State> states_;
  PathLayout layout_;
  std::vector<int> shown_frames_;
  int revision_ = 0;
};

}  // namespace kinegraph::inline komo_internal
