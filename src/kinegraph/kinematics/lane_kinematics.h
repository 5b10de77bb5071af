#pragma once

#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/lane_model.h"

namespace kinegraph::inline kinematics_internal {

/// The links of a KinematicModel that move certain frames, for kernels in lanes.
class LaneLinks {
 public:
  /// `variable`: per dof of the model, its number among the kernel's variables.
  LaneLinks(const KinematicModel& model, const Parameters& parameters, const std::vector<int>& frames,
            const std::vector<int>& variable, int variables);

  LaneModel view() const;

  /// Returns the pose of one of the frames in its link.
  LaneRows::Frame place(const KinematicModel& model, const Parameters& parameters, int frame) const;

  /// A twist column: its variable, and whether it is a rotation. Columns of dofs without motion are in no chain.
  struct Column {
    int variable;
    bool is_rotation;
  };
  const Column& column(int index) const { return column_[index]; }

  /// Returns the columns that move a link of view().
  std::vector<int> chain(int link) const;

 private:
  std::vector<int> lane_link_;
  std::vector<LaneModel::Link> link_;
  std::vector<LaneModel::Step> step_;
  std::vector<Column> column_;
  int variables_;
};

/// A list of rows that depend on poses of frames and on joints, as input of the kernels in lanes. LaneRows::Block
/// documents the kinds.
class LaneRowList {
 public:
  void addPosition(LaneRows::Block::Kind kind, int a, int b = -1, int rows = 3) { add(kind, rows, a, b); }
  void addQuaternion(LaneRows::Block::Kind kind, int a, int b = -1) { add(kind, 4, a, b); }
  void addPose(int frame);  ///< position, then the quaternion with canonical sign
  void addAxis(LaneRows::Block::Kind kind, int axis, int a, int b = -1) { addAxes(kind, 3, axis, axis, a, b); }
  void addAxisProduct(int axis_a, int axis_b, int a, int b) {
    addAxes(LaneRows::Block::axis_product, 1, axis_a, axis_b, a, b);
  }
  void addTwist(int frame) { add(LaneRows::Block::twist, 6, frame, -1); }
  void addJoint(int dof, double scale = 1., double shift = 0.);

  int rows() const { return rows_; }
  const std::vector<LaneRows::Block>& blocks() const { return blocks_; }

 private:
  LaneRows::Block& add(LaneRows::Block::Kind kind, int rows, int a, int b);
  void addAxes(LaneRows::Block::Kind kind, int rows, int axis_a, int axis_b, int a, int b);

  std::vector<LaneRows::Block> blocks_;
  int rows_ = 0;
};

/// Rows compiled for a scene. Evaluates many configurations in the lanes of wide registers. Threads may share it, each
/// with its own Scratch.
class LaneKinematics {
 public:
  LaneKinematics(const KinematicModel& model, const Parameters& parameters, const LaneRowList& list);

  int rows() const { return view().rows; }

  /// Memory for one thread at a `width` of laneWidths(), 0 for the widest.
  class Scratch {
   public:
    Scratch(const LaneKinematics& model, int width);

   private:
    friend class LaneKinematics;
    std::vector<double> storage_;
    LaneMemory memory_;
    RunLanes run_;
  };

  void run(Scratch& scratch, const LaneBatch& batch) const {
    scratch.run_(links_.view(), view(), scratch.memory_, batch);
  }

 private:
  LaneRows view() const;
  void connect(LaneRows::Block& block);

  LaneLinks links_;
  std::vector<LaneRows::Frame> frame_;
  std::vector<LaneRows::Block> block_;
  std::vector<LaneRows::Entry> entry_;
};

}  // namespace kinegraph::inline kinematics_internal
