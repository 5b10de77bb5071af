#pragma once

#include <memory>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/math/eigen.h"

namespace kinegraph::inline kinematics_internal {

/// Kinematics of a KinematicModel at a joint vector q: link poses and the twist of each dof. Allocates no memory after
/// construction.
class State {
 public:
  /// Velocity field of a dof: angular, rad/s, and linear at the world's origin, m/s, per unit of the dof's velocity.
  struct Twist {
    Vector3d angular, linear;
  };

  State(std::shared_ptr<const KinematicModel> model, std::shared_ptr<const Parameters> parameters);

  const KinematicModel& model() const { return *model_; }
  const std::shared_ptr<const KinematicModel>& sharedModel() const { return model_; }
  const Parameters& parameters() const { return *parameters_; }
  const std::shared_ptr<const Parameters>& sharedParameters() const { return parameters_; }
  int dofs() const { return model_->dofs; }

  /// Sets q (model().dofs numbers) and computes all link poses and twists.
  void setJoints(const double* q);

  /// Replaces the parameters and recomputes poses and twists.
  void setParameters(std::shared_ptr<const Parameters> parameters);

  /// Replaces the parameters without computing anything; setJoints must follow.
  void replaceParameters(std::shared_ptr<const Parameters> parameters) { parameters_ = std::move(parameters); }

  const VectorXd& q() const { return q_; }
  int link(int frame) const { return model_->frame_link[frame]; }
  const RigidTransform& linkPose(int link) const { return link_pose_[link]; }

  /// Returns the velocity field of a twist column (see KinematicModel::last_column and KinematicModel::column_dof).
  const Twist& twist(int column) const { return twists_[column]; }

  /// Returns X_WF of a frame.
  RigidTransform pose(int frame) const { return link_pose_[link(frame)] * parameters_->frame_offset[frame]; }

  /// Returns p_WF of a frame.
  Vector3d position(int frame) const { return link_pose_[link(frame)] * parameters_->frame_offset[frame].p; }

  /// Computes J = d p_WQ / dq for a point Q (world coordinates, m) fixed to a frame's link, and below it the derivative
  /// of the angular velocity by dq/dt, in world coordinates. J is 6 x dofs; all entries are written.
  void jacobian(int frame, const Vector3d& p_WQ, JacobianRows J) const;

  /// Adds factor * d p_WQ / dq for a point Q (world coordinates, m) fixed to a frame's link. J is 3 x dofs.
  void addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const;

  /// Adds factor * d w / d(dq/dt), for the angular velocity w of the frame in world coordinates. J is 3 x dofs.
  void addAngularJacobian(int frame, double factor, JacobianRows J) const;

  /// Calls visit(dof, twist) for each column that moves a frame, from the frame towards the world.
  template <class Visit>
  void forTwists(int frame, const Visit& visit) const {
    const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
    const Twist* twists = twists_.data();
    for (int c = model_->last_column[link(frame)]; c >= 0; c = before[c]) visit(dof[c], twists[c]);
  }

  /// Returns true if a dof moves the frame.
  bool moves(int frame) const { return model_->last_column[link(frame)] >= 0; }

  /// Returns true if second derivatives of the frame's pose are available: no quaternion or circle moves it.
  bool hasCurvature(int frame) const { return model_->fixed_axes[std::size_t(link(frame))]; }

  /// Adds sum_i weight_i d^2 p_WQ,i / dq^2 to the lower triangle of H (dofs x dofs), for a point Q fixed to a frame's
  /// link that hasCurvature. For columns c and d with velocities v of Q, c nearer to the world, the derivative is w_c x
  /// v_d.
  void addPointCurvature(int frame, const Vector3d& p_WQ, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const;

  /// Adds sum_i weight_i d^2 u_i / dq^2 likewise, for a direction u (world coordinates) fixed to the link.
  void addDirectionCurvature(int frame, const Vector3d& u, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const;

  /// Adds A * (point Jacobian at p_WQ) + B * (angular Jacobian). A, B are m x 3, J is m x dofs.
  template <class DerivedA, class DerivedB>
  void addJacobian(int frame, const Vector3d& p_WQ, const Eigen::MatrixBase<DerivedA>& A_expression,
                   const Eigen::MatrixBase<DerivedB>& B_expression, JacobianRows J) const {
    const typename DerivedA::PlainObject A = A_expression;
    const typename DerivedB::PlainObject B = B_expression;
    forTwists(frame, [&](int dof, const Twist& twist) {
      const Vector3d velocity = twist.linear + twist.angular.cross(p_WQ);
      for (int r = 0; r < A.rows(); ++r) {
        J(r, dof) += A(r, 0) * velocity[0] + A(r, 1) * velocity[1] + A(r, 2) * velocity[2] +
                     B(r, 0) * twist.angular[0] + B(r, 1) * twist.angular[1] + B(r, 2) * twist.angular[2];
      }
    });
  }

 private:
  template <class Velocity>
  void addCurvature(int frame, const Velocity& velocity, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const;

  struct SineCosine {
    double sine, cosine;
  };
  void update();

  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  VectorXd q_;
  std::vector<RigidTransform> link_pose_;  ///< per link, and one more; see StateArrays
  std::vector<Twist> twists_;              ///< per column, and one more
  std::vector<SineCosine> sines_cosines_;  ///< per entry of model().angle_dof
};

}  // namespace kinegraph::inline kinematics_internal
