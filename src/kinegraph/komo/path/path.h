#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/komo/path/initial_configuration.h"
#include "kinegraph/komo/path/modes.h"
#include "kinegraph/komo/path/path_layout.h"
#include "kinegraph/komo/path/time_grid.h"

namespace kinegraph {

/// Configurations of a scene, one per slice of a time grid, and `order` more before the first. What hangs where may
/// change along it: slices share the Program of their mode. Empty until it has both a scene and a grid.
///
/// What is in x, the vector that solvers see, is said by `layout()`. It follows from the modes, as the states do: every
/// call that changes the structure makes both anew and counts `revision()` up.
class Path {
 public:
  void setScene(const Config& config);      ///< all slices as given, without modes
  void setGrid(const TimeGrid& time_grid);  ///< the same
  Path clone() const;                       ///< its modes are its own; Programs are shared

  /// Throws Error that names the call, if a scene or a grid is missing.
  void requireBuilt(const char* call) const;

  const TimeGrid& grid() const { return grid_; }
  const InitialConfiguration& given() const { return given_; }
  const Modes& modes() const { return modes_; }
  const PathLayout& layout() const { return layout_; }
  int revision() const { return revision_; }
  int dofs() const { return given_.model->dofs; }                        ///< of the given configuration
  const std::vector<int>& shownFrames() const { return shown_frames_; }  ///< without those that only modes need

  // --- states ------------------------------------------------------------------------------------------------------

  const State& state(int slice) const { return states_[std::size_t(slice + grid_.order())]; }  ///< -order .. T-1
  const Mode& mode(int slice) const { return modes_.at(std::size_t(slice + grid_.order())); }  ///< if there are any
  void setSlice(int slice, const double* q) { states_[std::size_t(slice + grid_.order())].setJoints(q); }

  /// Constants of a slice's own, as where objects move by themselves, for the Program that it has; until the next change
  /// of the structure or of root objects.
  void setParameters(int slice, std::shared_ptr<const Parameters> parameters) {
    states_[std::size_t(slice + grid_.order())].setParameters(std::move(parameters));
  }

  VectorXd ownDofs(int slice) const;     ///< those entries of x that belong to the slice
  VectorXd variables() const;            ///< x
  void setVariables(const VectorXd& x);  ///< of layout().dimension entries

  /// Where the dofs of the joints of these frames are in the q of a slice. Throws ValueError for frames without one.
  std::vector<int> dofsOf(const std::vector<int>& frames, int slice) const;

  /// T x n: the dofs of the given configuration in all slices; or those of the joints of the frames with these ids.
  MatrixXd joints(const std::vector<int>& frames = {}) const;

  /// The given configuration's dofs in a slice. Those that all slices share are set in it only: setVariables(variables())
  /// takes the others along.
  void setJoints(int slice, const VectorXd& q);

  /// World poses of the shown frames in a slice, rows x y z qw qx qy qz.
  MatrixXd framePoses(int slice) const;

  /// A copy of the scene as it is in a slice.
  Config configuration(int slice) const;

  // --- changes of the structure; joints that were there before keep their dofs ---------------------------------------

  /// Gives all slices a mode. To be called before the edits below.
  void beginModes() { modes_.begin(*given_.tree); }

  /// From a slice on, `object` hangs below `parent`.
  void attach(int from, const std::string& parent, const std::string& object, const Attachment& attachment);

  /// A frame that is not shown, with a joint to the world in the slices [from, to]. Returns its id.
  int addDofs(const std::string& name, int from, int to, const Attachment& attachment);

  /// A frame in all slices, below `parent` (empty: none), or below one more frame whose world pose is now `origin`. It
  /// has a joint, stable or not, unless the type is none.
  void addFrame(const std::string& name, const std::string& parent, JointType type, bool stable,
                const std::optional<Pose>& origin);

  /// Takes over the constant poses (root objects, markers) of the configuration, and its q as the one that the motion
  /// begins from: in the slices before the first, but for dofs that are variables. The slices from 0 on stay where they
  /// are. Throws ValueError if its frames and joints are not those of the given scene.
  void updateRootObjects(const Config& config);

  // --- what it consists of beside scene and grid, to make it anew ----------------------------------------------------

  struct Content {
    std::vector<Mode> modes;
    std::vector<int> mode_of, shown_frames;
    int next_joint = 1;
    std::vector<VectorXd> states;  ///< q of all slices, those before the start first
  };
  Content content() const;
  void setContent(Content content);  ///< throws ValueError if it does not fit

 private:
  void build();
  void rebuildStates();
  void moveStart(const VectorXd& q);
  void layOut() { layout_ = makeLayout(states_, grid_.order(), given_.shared_joints, modes_); }
  void requireSlice(int slice) const;

  InitialConfiguration given_;
  TimeGrid grid_;
  Modes modes_;
  std::vector<State> states_;
  PathLayout layout_;
  std::vector<int> shown_frames_;
  int revision_ = 0;
};

}  // namespace kinegraph
