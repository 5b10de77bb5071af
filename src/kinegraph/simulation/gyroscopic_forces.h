#pragma once

#include <vector>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph::inline simulation_internal {

/// Corrects the velocity-dependent (Coriolis, gyroscopic) forces of unactuated bodies that rotate fast.
///
/// MuJoCo evaluates these forces at the beginning of a step for joints, so a spinning top on a joint gains energy and
/// diverges. For free bodies it evaluates them at the end: a body loses half of its energy in 5 s at 40 rad/s.
/// This class adds forces such that they act at the midpoint of the step instead:
///
/// - A free body keeps its angular momentum in space and the velocity of its center of mass. In body axes,
///
///       exp(h w'/2) I w' = exp(-h w/2) I w,
///
///   where w' is the angular velocity by which MuJoCo rotates the body over h (Verlet's method on the rotation group).
/// - Joints without motors get the velocity-dependent forces of (v + v')/2.
///
/// Both schemes are time-reversible: energies oscillate with an amplitude of order h^2, without drift.
/// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, chapters V and VII.5.
class GyroscopicForces {
 public:
  GyroscopicForces() = default;
  GyroscopicForces(const SceneModel& scene, const mjModel& model);

  /// Sets the forces of the unactuated dofs in `qfrc_applied`. Call it after MuJoCo's velocity stage and after the
  /// motors.
  void apply(mjModel& model, mjData& data, double h);

  /// Returns the model's id of a body that rotated by more than .5 rad in the step, too fast for these methods, or 0.
  int tooFast() const { return too_fast_; }

 private:
  struct FreeBody {
    int body, dof;
  };
  void applyToFree(mjData& d, const FreeBody& free, double h);
  void applyToJoints(const mjModel& m, mjData& d, double h);

  std::vector<FreeBody> free_;
  std::vector<int> joint_dofs_;     ///< unactuated dofs of trees that contain unactuated rotations
  std::vector<int> rotation_dofs_;  ///< the rotational ones among them
  std::vector<mjtNum> velocity_, middle_, bias_, force_, change_;
  int too_fast_ = 0;
};

}  // namespace kinegraph::inline simulation_internal
