#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// Constraints that a ManipulationHelper adds to every problem that it sets up.
struct ManipulationDefaults {
  bool accumulated_collisions = true;  ///< no overlaps
  bool joint_limits = true;
  bool quaternion_norms = true;
};

/// Builds manipulation problems in a few calls: one sets a Komo up, the others add grasps, placements and motions. In
/// Python it is KOMO_ManipulationHelper; calls are spelled as in the reference.
///
///     ManipulationHelper m;
///     m.setup_pick_and_place_waypoints(C, "l_gripper", "box");
///     m.grasp_box(1., "l_gripper", "box", "l_palm", "x");
///     m.place_box(2., "box", "table", "l_palm", "z");
///     if (m.solve().feasible) std::cout << m.path;
///
/// Times are in phases. All calls except setups throw Error before a setup, and FrameNotFound or ValueError for
/// unsuitable frames. A grasp at `time` has aligned axes from .2 phases before it on, and a palm without collision from
/// .3 on.
class ManipulationHelper {
 public:
  explicit ManipulationHelper(std::string text = {}) : info(std::move(text)) {}
  virtual ~ManipulationHelper() = default;

  std::string info;                 ///< name of the problem in the output of `solve`
  std::shared_ptr<Komo> komo;       ///< null before a setup
  std::optional<SolverResult> ret;  ///< of the last solve
  MatrixXd path;                    ///< (T, n), rad or m: of the last solve if it was feasible, else empty

  bool feasible() const { return ret && ret->feasible; }

  // --- setups ------------------------------------------------------------------------------------------------------

  /// One configuration. `homing_scale` weighs the distance from home.
  void setup_inverse_kinematics(const Config& C, double homing_scale = 1e-1, const ManipulationDefaults& with = {});

  /// One configuration for each of K waypoints. `velocity_scale` weighs their distances.
  void setup_sequence(const Config& C, double K, double homing_scale = 1e-2, double velocity_scale = 1e-1,
                      const ManipulationDefaults& with = {});

  /// A smooth motion over K phases that ends at rest.
  void setup_motion(const Config& C, double K, int steps_per_phase, double homing_scale = 0.,
                    double acceleration_scale = 1e-1, const ManipulationDefaults& with = {});

  /// Two waypoints: at 1 the gripper takes the object in a pose that the solver finds, at 2 it still holds it.
  void setup_pick_and_place_waypoints(const Config& C, const std::string& gripper, const std::string& obj,
                                      double homing_scale = 1e-2, double velocity_scale = 1e-1,
                                      const ManipulationDefaults& with = {true, true, false});

  /// A motion of 50 slices to the joint vector q1, (n,), initialized by interpolation.
  void setup_point_to_point_motion(const Config& C, const VectorXd& q1, double homing_scale = 1e-2,
                                   double acceleration_scale = 1e-1,
                                   const ManipulationDefaults& with = {true, true, false});

  // --- frames and attachments --------------------------------------------------------------------------------------

  /// Adds a frame at `parent` with a joint whose dofs are variables shared by all slices. It starts at the pose of
  /// `initFrame`.
  void add_stable_frame(JointType jointType, const std::string& parent, const std::string& name,
                        const std::string& initFrame = {});

  /// Adds a frame on top of `parent` for an upright `obj`. It slides and rotates within the edges of the parent; all
  /// slices share it.
  void add_place_frame(const std::string& parent, const std::string& obj, const std::string& name);

  /// Attaches the object to `parent` from `time` on.
  void snap_switch(double time, const std::string& parent, const std::string& obj);

  // --- grasps and placements ---------------------------------------------------------------------------------------

  /// Grasps the object from above. `grasp_direction` is one of xz yz xy zy yx zx: the axes of the object along which
  /// the fingers close and the hand approaches.
  void grasp_top_box(double time, const std::string& gripper, const std::string& obj,
                     const std::string& grasp_direction = "xz");

  /// Closes the fingers along the axis `grasp_direction` (x y z) of a box, with the gripper `margin` m inside its
  /// sides.
  void grasp_box(double time, const std::string& gripper, const std::string& obj, const std::string& palm,
                 const std::string& grasp_direction = "x", double margin = .02);

  /// Closes the fingers across a cylinder or capsule, `margin` m inside its ends.
  void grasp_cylinder(double time, const std::string& gripper, const std::string& obj, const std::string& palm,
                      double margin = .02);

  /// Places a box on the table with its axis `place_direction` (x y z xNeg yNeg zNeg) up and its center `margin` m
  /// inside the edges. Cylinders are placed likewise. The palm may be empty; else it does not collide.
  void place_box(double time, const std::string& obj, const std::string& table, const std::string& palm,
                 const std::string& place_direction = "z", double margin = .02);

  // --- pushes ------------------------------------------------------------------------------------------------------

  /// Pushes the object over the table along a line from times[0] to times[1]. `helper` is the name of the frame on the
  /// object whose y axis is the line; it is added unless it exists, and returned. `scale` weighs the contact
  /// constraints.
  std::string straight_push(const std::vector<double>& times, const std::string& obj, const std::string& gripper,
                            const std::string& table, double scale = 1e1, std::string helper = {});

  /// Presses on the object from above and slides it upright over the table, from times[0] to times[1], to the frame
  /// `_pull_end`. A switch attaches it to the gripper.
  void pull(const std::vector<double>& times, const std::string& obj, const std::string& gripper,
            const std::string& table);

  // --- motions of the hand -----------------------------------------------------------------------------------------

  /// Moves the gripper only along its z axis between the times, to at least `dist` m from its position in the path at
  /// times[0]. Call it after the path was initialized.
  void retract(const std::vector<double>& times, const std::string& gripper, double dist = .03);
  void approach(const std::vector<double>& times, const std::string& gripper, double dist = .03);  ///< to times[1]

  /// The same, `dist` m back from a push and up.
  void retractPush(const std::vector<double>& times, const std::string& gripper, double dist = .03);
  void approachPush(const std::vector<double>& times, const std::string& gripper, double dist = .03);

  // --- conditions --------------------------------------------------------------------------------------------------

  /// Keeps pairs of frames `margin` m apart.
  void no_collisions(const std::vector<double>& times, const std::vector<std::string>& pairs, double margin = .001,
                     double scale = 1e1);
  void freeze_joint(const std::vector<double>& times, const std::vector<std::string>& joints);
  void freeze_relativePose(const std::vector<double>& times, const std::string& to, const std::string& from);
  void target_position(double time, const std::string& obj, const Vector3d& position);
  void target_relative_xy_position(double time, const std::string& obj, const std::string& relativeTo,
                                   const VectorXd& position);  ///< x and y in m; a third number is ignored
  void target_x_orientation(double time, const std::string& obj, const Vector3d& x_vector);
  void bias(double time, const VectorXd& q, double scale = 1.);  ///< stays near q

  // --- solutions ---------------------------------------------------------------------------------------------------

  /// Solves from the current path. With `verbose` 1 or more, prints the result in a line.
  const SolverResult& solve(int verbose = 1);

  /// Returns the motion problem of one phase (0: the first) of a solved sequence, between its waypoints, with the
  /// attachments of that phase.
  ManipulationHelper sub_motion(int phase, bool fixEnd = true, double homing_scale = 1e-2,
                                double acceleration_scale = 1e-1,
                                const ManipulationDefaults& with = {true, true, false}) const;

 protected:
  virtual std::shared_ptr<Komo> newKomo(const Config& C, double phases, int slices, int order) const;

 private:
  Komo& problem(const char* call) const;
  Frame frame(const std::string& name) const;
  bool hasFrame(const std::string& name) const;
  VectorXd boxSize(const std::string& name, const char* call) const;
  void setup(const Config& C, double phases, int slices, int order);
  void addDefaults(const ManipulationDefaults& with);
  void addPalm(double time, const std::string& palm, const std::string& obj);
  void addReference(const std::string& name, const std::string& gripper, double time);
  void moveAlongZ(const std::vector<double>& times, const std::string& gripper, double dist, bool leave);
  void moveAlongPush(const std::vector<double>& times, const std::string& gripper, double dist, bool leave);
};

}  // namespace kinegraph
