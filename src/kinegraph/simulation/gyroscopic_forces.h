#pragma once

#include <vector>

#include "kinegraph/simulation/scene_model.h"

namespace kinegraph {

/// What MuJoCo's step lacks where things turn fast without a motor. It takes the forces of turning (Coriolis, gyroscopic)
/// at the beginning of a step, so that a top on a joint gains energy and at last leaves all bounds; and at its end for a
/// body that is free, which loses half of its energy in 5 s at 40 rad/s.
///
/// Here they are taken in the middle, by forces in addition:
///
/// - a free body turns such that its angular momentum in space and the velocity of its center stay as they are,
///
///       exp(h w'/2) I w' = exp(-h w/2) I w,
///
///   in its axes, where w' is the velocity with which MuJoCo turns it on by h: Verlet's method on the group of rotations;
/// - what turns about joints without motors has the forces that belong to (v + v')/2.
///
/// Both are the same forwards and backwards in time, so that energies oscillate with h^2 and neither grow nor fall.
/// Source: Hairer, Lubich, Wanner, Geometric Numerical Integration, chapters V and VII.5.
class GyroscopicForces {
 public:
  GyroscopicForces() = default;
  GyroscopicForces(const SceneModel& scene, const mjModel& model);

  /// Sets the forces of dofs without motors, in `qfrc_applied`. After the stage of velocities, and after the motors.
  void apply(mjModel& model, mjData& data, double h);

  /// The model's body that turned by more than .5 rad in a step, which is too much for these methods, or 0.
  int tooFast() const { return too_fast_; }

 private:
  struct FreeBody {
    int body, dof;
  };
  void applyToFree(mjData& d, const FreeBody& free, double h);
  void applyToJoints(const mjModel& m, mjData& d, double h);

  std::vector<FreeBody> free_;
  std::vector<int> joint_dofs_;  ///< without motors, of trees in which such dofs turn
  std::vector<int> turns_;       ///< those of them that turn
  std::vector<mjtNum> velocity_, middle_, bias_, force_, change_;
  int too_fast_ = 0;
};

}  // namespace kinegraph
