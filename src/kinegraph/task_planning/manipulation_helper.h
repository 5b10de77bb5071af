#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// What a ManipulationHelper adds to every problem that it sets up.
struct ManipulationDefaults {
  bool accumulated_collisions = true;  ///< nothing overlaps
  bool joint_limits = true;
  bool quaternion_norms = true;
};

/// Problems of manipulation in a few calls: one that sets a Komo up, then one for each thing that a hand does. Python has
/// it as KOMO_ManipulationHelper with the same calls; they are spelled as scripts know them.
///
///     ManipulationHelper m;
///     m.setup_pick_and_place_waypoints(C, "l_gripper", "box");
///     m.grasp_box(1., "l_gripper", "box", "l_palm", "x");
///     m.place_box(2., "box", "table", "l_palm", "z");
///     if (m.solve().feasible) std::cout << m.path;
///
/// Times are in phases. All calls but the setups throw Error before a setup, FrameNotFound and ValueError for frames that
/// do not fit. A grasp is approached in the last fifth of the phase before `time`: that much before it the axes are
/// aligned, and from .3 before it on the palm keeps off.
class ManipulationHelper {
 public:
  explicit ManipulationHelper(std::string text = {}) : info(std::move(text)) {}
  virtual ~ManipulationHelper() = default;

  std::string info;                 ///< what `solve` calls the problem
  std::shared_ptr<Komo> komo;       ///< null before a setup
  std::optional<SolverResult> ret;  ///< of the last solve
  MatrixXd path;                    ///< T x n, rad or m: that of the last solve if it was feasible, else empty

  bool feasible() const { return ret && ret->feasible; }

  // --- setups ------------------------------------------------------------------------------------------------------

  /// One configuration. `homing_scale` weighs the distance from home.
  void setup_inverse_kinematics(const Config& C, double homing_scale = 1e-1, const ManipulationDefaults& with = {});

  /// One configuration for each of K waypoints, near each other by `velocity_scale`.
  void setup_sequence(const Config& C, double K, double homing_scale = 1e-2, double velocity_scale = 1e-1,
                      const ManipulationDefaults& with = {});

  /// A smooth motion over K phases that ends at rest.
  void setup_motion(const Config& C, double K, int steps_per_phase, double homing_scale = 0.,
                    double acceleration_scale = 1e-1, const ManipulationDefaults& with = {});

  /// Two waypoints: at 1 the gripper takes the object, in a pose that is found, at 2 it still has it.
  void setup_pick_and_place_waypoints(const Config& C, const std::string& gripper, const std::string& obj,
                                      double homing_scale = 1e-2, double velocity_scale = 1e-1,
                                      const ManipulationDefaults& with = {true, true, false});

  /// A motion of 50 slices to the joint vector q1, shape (n), that starts on the way there.
  void setup_point_to_point_motion(const Config& C, const VectorXd& q1, double homing_scale = 1e-2,
                                   double acceleration_scale = 1e-1,
                                   const ManipulationDefaults& with = {true, true, false});

  // --- frames and attachments --------------------------------------------------------------------------------------

  /// A frame that sits at `parent` by a joint whose dofs are found, the same at all times; it starts where `initFrame` is.
  void add_stable_frame(JointType jointType, const std::string& parent, const std::string& name,
                        const std::string& initFrame = {});

  /// A frame on top of `parent` where `obj` would stand upright: it slides and turns there, within the parent's edges, and
  /// is the same at all times.
  void add_place_frame(const std::string& parent, const std::string& obj, const std::string& name);

  /// From `time` on the object sits at `parent`.
  void snap_switch(double time, const std::string& parent, const std::string& obj);

  // --- grasps and placements ---------------------------------------------------------------------------------------

  /// The gripper is at the object, from above; `grasp_direction` is one of xz yz xy zy yx zx: the object's axes that the
  /// fingers close along and the hand comes along.
  void grasp_top_box(double time, const std::string& gripper, const std::string& obj,
                     const std::string& grasp_direction = "xz");

  /// The fingers close along the axis `grasp_direction` (x y z) of a box, and the gripper is `margin` m inside its sides.
  void grasp_box(double time, const std::string& gripper, const std::string& obj, const std::string& palm,
                 const std::string& grasp_direction = "x", double margin = .02);

  /// The fingers close across a cylinder or capsule, `margin` m inside its ends.
  void grasp_cylinder(double time, const std::string& gripper, const std::string& obj, const std::string& palm,
                      double margin = .02);

  /// The box stands on the table with its axis `place_direction` (x y z xNeg yNeg zNeg) up, its center `margin` m inside
  /// the edges. Without a palm (empty) nothing is asked of it.
  void place_box(double time, const std::string& obj, const std::string& table, const std::string& palm,
                 const std::string& place_direction = "z", double margin = .02);

  // --- pushes ------------------------------------------------------------------------------------------------------

  /// From times[0] to times[1] the gripper pushes the object over the table along a line. `helper` is the name of the
  /// frame on the object whose y axis is the line; `scale` weighs how the gripper touches.
  void straight_push(const std::vector<double>& times, const std::string& obj, const std::string& gripper,
                     const std::string& table, double scale = 1e1, std::string helper = {});

  /// From times[0] to times[1] the gripper presses on the object from above and slides it over the table.
  void pull(const std::vector<double>& times, const std::string& obj, const std::string& gripper,
            const std::string& table);

  // --- motions of the hand -----------------------------------------------------------------------------------------

  /// Between the times the gripper moves along its z axis only, `dist` m or more away from where it is in the path at
  /// times[0]. To be called after the path was initialized.
  void retract(const std::vector<double>& times, const std::string& gripper, double dist = .03);
  void approach(const std::vector<double>& times, const std::string& gripper, double dist = .03);  ///< to times[1]

  /// The same, `dist` m back from the push and up.
  void retractPush(const std::vector<double>& times, const std::string& gripper, double dist = .03);
  void approachPush(const std::vector<double>& times, const std::string& gripper, double dist = .03);

  // --- conditions --------------------------------------------------------------------------------------------------

  /// Frames two by two stay `margin` m apart.
  void no_collisions(const std::vector<double>& times, const std::vector<std::string>& pairs, double margin = .001,
                     double scale = 1e1);
  void freeze_joint(const std::vector<double>& times, const std::vector<std::string>& joints);
  void freeze_relativePose(const std::vector<double>& times, const std::string& to, const std::string& from);
  void target_position(double time, const std::string& obj, const Vector3d& position);
  void target_relative_xy_position(double time, const std::string& obj, const std::string& relativeTo,
                                   const VectorXd& position);  ///< 2 or 3 numbers, of which two count, m
  void target_x_orientation(double time, const std::string& obj, const Vector3d& x_vector);
  void bias(double time, const VectorXd& q, double scale = 1.);  ///< stays near q

  // --- solutions ---------------------------------------------------------------------------------------------------

  /// Solves from the present path. From `verbose` 1 on a line says how it ended.
  const SolverResult& solve(int verbose = 1);

  /// The motion of one phase (0: the first) of a solved sequence, with attachments as they are then, between its
  /// waypoints.
  ManipulationHelper sub_motion(int phase, bool fixEnd = true, double homing_scale = 1e-2,
                                double acceleration_scale = 1e-1,
                                const ManipulationDefaults& with = {true, true, false}) const;

 protected:
  virtual std::shared_ptr<Komo> newKomo(const Config& C, double phases, int slices, int order) const;

 private:
  Komo& problem(const char* call) const;
  Frame frame(const std::string& name) const;
  VectorXd boxSize(const std::string& name, const char* call) const;
  void setup(const Config& C, double phases, int slices, int order);
  void addDefaults(const ManipulationDefaults& with);
  void addPalm(double time, const std::string& palm, const std::string& obj);
  void addReference(const std::string& name, const std::string& gripper, double time);
  void moveAlongZ(const std::vector<double>& times, const std::string& gripper, double dist, bool leave);
  void moveAlongPush(const std::vector<double>& times, const std::string& gripper, double dist, bool leave);
};

}  // namespace kinegraph
