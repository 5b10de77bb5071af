#pragma once

#include <memory>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"

namespace kinegraph {

/// Rows of a Jacobian in row-major order, as a view: features write or add into it.
using JacobianRows =
    Eigen::Ref<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>, 0, Eigen::OuterStride<>>;

/// What a joint vector q makes of a Program: link poses and the twist of every dof. One State is one page of the book.
/// After construction nothing here requests memory.
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

  /// Sets q (program().dofs numbers) and computes all link poses and twists.
  void setJoints(const double* q);

  /// Replaces the constant transforms and recomputes.
  void setParameters(std::shared_ptr<const Parameters> parameters);

  /// The same without computing anything: setJoints must follow.
  void replaceParameters(std::shared_ptr<const Parameters> parameters) { parameters_ = std::move(parameters); }

  const VectorXd& q() const { return q_; }
  int link(int frame) const { return model_->frame_link[frame]; }
  const RigidTransform& linkPose(int link) const { return link_pose_[link]; }

  /// The velocity field of a twist column (see Program::last_column and Program::column_dof).
  const Twist& twist(int column) const { return twists_[column]; }

  /// X_WF of a frame.
  RigidTransform pose(int frame) const { return link_pose_[link(frame)] * parameters_->frame_offset[frame]; }

  /// p_WF of a frame.
  Vector3d position(int frame) const { return link_pose_[link(frame)] * parameters_->frame_offset[frame].p; }

  /// J = d p_WQ / dq for point Q (world coordinates, m) fixed to a frame's link, and below it d w / d(dq/dt) of the
  /// angular velocity in world coordinates. J is 6 x dofs; all of it is written.
  void jacobian(int frame, const Vector3d& p_WQ, JacobianRows J) const;

  /// J += factor * d p_WQ / dq for point Q (world coordinates, m) fixed to a frame's link. J is 3 x dofs.
  void addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const;

  /// J += factor * d w / d(dq/dt), the angular velocity of the frame in world coordinates. J is 3 x dofs.
  void addAngularJacobian(int frame, double factor, JacobianRows J) const;

  /// Calls visit(dof, twist) for each column that moves a frame, from the frame towards the world.
  template <class Visit>
  void forTwists(int frame, const Visit& visit) const {
    const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
    const Twist* twists = twists_.data();
    for (int c = model_->last_column[link(frame)]; c >= 0; c = before[c]) visit(dof[c], twists[c]);
  }

  /// Does any dof move a frame?
  bool moves(int frame) const { return model_->last_column[link(frame)] >= 0; }

  /// Can the second derivatives of where a frame is be told? Not where quaternions or circles move it.
  bool hasCurvature(int frame) const { return model_->fixed_axes[std::size_t(link(frame))]; }

  /// H += sum_i weight_i d^2 p_WQ,i / dq^2 for point Q fixed to a frame's link that hasCurvature; H is dofs x dofs, and
  /// just its lower triangle is changed. Where columns c and d move Q with velocities v, c nearer to the world: w_c x
  /// v_d.
  void addPointCurvature(int frame, const Vector3d& p_WQ, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const;

  /// The same for a direction u (world coordinates) fixed to the link: H += sum_i weight_i d^2 u_i / dq^2.
  void addDirectionCurvature(int frame, const Vector3d& u, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const;

  /// J += A * (point Jacobian at p_WQ) + B * (angular Jacobian). A, B are m x 3, J is m x dofs.
  template <class DerivedA, class DerivedB>
  void addJacobian(int frame, const Vector3d& p_WQ, const Eigen::MatrixBase<DerivedA>& A_given,
                   const Eigen::MatrixBase<DerivedB>& B_given, JacobianRows J) const {
    const typename DerivedA::PlainObject A = A_given;
    const typename DerivedB::PlainObject B = B_given;
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

  struct Turn {
    double sine, cosine;
  };
  void update();

  std::shared_ptr<const KinematicModel> model_;
  std::shared_ptr<const Parameters> parameters_;
  VectorXd q_;
  std::vector<RigidTransform> link_pose_;  ///< per link, and one that is no link's; see StateArrays
  std::vector<Twist> twists_;              ///< per column, and one more
  std::vector<Turn> turns_;                ///< per entry of program().turn_dof
};

}  // namespace kinegraph
