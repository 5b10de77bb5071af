#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/reader.h"
#include "scene/frame_poses_docs.h"
#include "scene/pose_warnings.h"

namespace kinegraph::python {

namespace {

constexpr double kUnitError = 1e-3, kFarFromUnit = .1;
constexpr double kLargeNorm = 10.;  // solvers pass quaternions of any norm near 1

}  // namespace

void warnOfOrder(const VectorXd& numbers) {
  const Vector4d last = numbers.tail<4>();
  if (last == Vector4d(0., 0., 0., 1.))
    emitWarning(
        "the quaternion 0 0 0 1 is half a turn about z; did you mean no rotation, 1 0 0 0? The order is w x y z");
  const auto isUnit = [](const Vector4d& v) { return std::abs(v.norm() - 1.) < kUnitError; };
  if (numbers.size() == 7 && isUnit(numbers.head<4>()) && std::abs(last.norm() - 1.) > kFarFromUnit)
    emitWarning("the first four numbers of a pose are a unit quaternion; did you mean x y z qw qx qy qz?");
  if (last.norm() > kLargeNorm)
    emitWarning("a quaternion with a norm above 10 is normalized; did you mean an angle? The order is w x y z");
}

void warnOfLostPose(const Frame& frame, const Pose& pose, const Pose& wanted, const char* call) {
  constexpr double kSame = 1e-6;  // m, rad
  if (!frame.data().moves()) return;
  const double apart = (pose.p - wanted.p).norm(), rotated = pose.q.angularDistance(wanted.q);
  if (apart <= kSame && rotated <= kSame) return;
  emitWarning(
      cat(call, ": the joint of frame '", frame.getName(), "', ", jointTypeName(frame.getJointType()),
          ", does not allow this pose: ",
          apart > kSame ? cat("the frame is ", numberText(apart, 3), " m") : cat(numberText(rotated, 3), " rad"),
          " away from it. Put a constant offset into a frame between it and its parent (`pre` in a file)"));
}

namespace {

using Relative = const std::optional<Frame>&;

Pose poseOf(const Frame& frame, const std::optional<Frame>& relative_to) {
  return relative_to ? frame.getPose(*relative_to) : frame.getPose();
}

Array fourByFour(const Pose& X) {
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = X.q.toRotationMatrix();
  T.topRightCorner<3, 1>() = X.p;
  return toNumpy(MatrixXd(T));
}

Vector3d position(const Frame& frame, const Numbers& numbers, const char* call) {
  if (numbers.values.size() != 3 || !numbers.values.allFinite()) {
    throw ValueError(cat(call, " of frame '", frame.getName(), "': got ", numbers.values.size(), " numbers (",
                         numbers.values.transpose(), "); expected 3 finite ones, x y z in m"));
  }
  return numbers.values;
}

Pose poseFrom(const Frame& frame, const Numbers& numbers) {
  const VectorXd& v = numbers.values;
  if (v.size() == 4 || v.size() == 7) {
    warnOfOrder(v);
    unitQuaternion(v.tail<4>(), cat("quaternion of frame '", frame.getName(), "'").c_str());
  }
  return Pose::fromNumbers(v);
}

Quaterniond rotation(const Frame& frame, const Numbers& numbers, const char* call) {
  if (numbers.values.size() != 4) {
    throw ValueError(cat(call, " of frame '", frame.getName(), "': got ", numbers.values.size(),
                         " numbers; expected 4, a quaternion w x y z"));
  }
  warnOfOrder(numbers.values);
  return unitQuaternion(numbers.values, cat("quaternion of frame '", frame.getName(), "'").c_str());
}

Quaterniond rotationFromMatrix(const Frame& frame, const Numbers& numbers) {
  if (numbers.values.size() != 9) {
    throw ValueError(
        cat("frame '", frame.getName(), "': a rotation matrix is 3 x 3, got ", numbers.values.size(), " numbers"));
  }
  const Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.values.data());
  if (!(R * R.transpose()).isIdentity(1e-3) || R.determinant() < 0.) {
    throw ValueError(cat("frame '", frame.getName(),
                         "': the matrix is not a rotation (columns orthogonal, length 1, right-handed)"));
  }
  return Quaterniond(R).normalized();
}

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Array positionJacobian(const Frame& frame, const std::optional<Numbers>& world_point) {
  const State& state = frame.scene()->state();
  const bool given = world_point && world_point->values.size() > 0;
  const Vector3d point = given ? position(frame, *world_point, "get_Jacobian_pos") : state.position(frame.id());
  Rows J = Rows::Zero(3, state.dofs());
  state.addPointJacobian(frame.id(), point, 1., J);
  return toNumpy(J);
}

Array angularJacobian(const Frame& frame) {
  const State& state = frame.scene()->state();
  Rows J = Rows::Zero(3, state.dofs());
  state.addAngularJacobian(frame.id(), 1., J);
  return toNumpy(J);
}

Pose with(Pose pose, const Vector3d& p) {
  pose.p = p;
  return pose;
}

Pose with(Pose pose, const Quaterniond& q) {
  pose.q = q;
  return pose;
}

Frame& setPose(Frame& frame, const Pose& pose, const char* call) {
  frame.setPose(pose);
  warnOfLostPose(frame, frame.getPose(), pose, call);
  return frame;
}

Frame& setRelativePose(Frame& frame, const Pose& pose, const char* call) {
  frame.setRelativePose(pose);
  warnOfLostPose(frame, frame.getRelativePose(), pose, call);
  return frame;
}

Frame& setQuaternion(Frame& frame, const Quaterniond& q, const char* call) {
  const Pose wanted = with(frame.getPose(), q);
  frame.setQuaternion(q);
  warnOfLostPose(frame, frame.getPose(), wanted, call);
  return frame;
}

Frame& setRelativeQuaternion(Frame& frame, const Quaterniond& q, const char* call) {
  const Pose wanted = with(frame.getRelativePose(), q);
  frame.setRelativeQuaternion(q);
  warnOfLostPose(frame, frame.getRelativePose(), wanted, call);
  return frame;
}

void bindReading(nb::class_<Frame>& frame) {
  frame

      .def(
          "getPose", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).numbers().data(), 7); },
          "relativeTo"_a = nb::none(), docs::frame_poses::getPose)
      .def(
          "getPosition", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).p.data(), 3); },
          "relativeTo"_a = nb::none(), docs::frame_poses::getPosition)
      .def(
          "getQuaternion", [](const Frame& f, Relative r) { return toNumpy(wxyz(poseOf(f, r).q).data(), 4); },
          "relativeTo"_a = nb::none(), docs::frame_poses::getQuaternion)
      .def(
          "getRotationMatrix", [](const Frame& f) { return toNumpy(MatrixXd(f.getPose().q.toRotationMatrix())); },
          "Returns the rotation in the world, shape (3, 3); its columns are the frame's axes.")
      .def(
          "getTransform", [](const Frame& f, Relative r) { return fourByFour(poseOf(f, r)); },
          "relativeTo"_a = nb::none(), docs::frame_poses::getTransform)
      .def(
          "getRelativePose", [](const Frame& f) { return toNumpy(f.getRelativePose().numbers().data(), 7); },
          "Returns the pose in the parent, shape (7,): x y z (m) qw qx qy qz; the identity for a root.")
      .def(
          "getRelativePosition", [](const Frame& f) { return toNumpy(f.getRelativePose().p.data(), 3); },
          "Returns the position in the parent, shape (3,), m.")
      .def(
          "getRelativeQuaternion", [](const Frame& f) { return toNumpy(wxyz(f.getRelativePose().q).data(), 4); },
          "Returns the rotation in the parent, shape (4,): w x y z.")
      .def(
          "getRelativeTransform", [](const Frame& f) { return fourByFour(f.getRelativePose()); },
          "Returns the pose in the parent as a homogeneous matrix, shape (4, 4), lengths in m.");
}

void bindSetting(nb::class_<Frame>& frame) {
  frame

      .def(
          "setPose", [](Frame& f, const Numbers& pose) -> Frame& { return setPose(f, poseFrom(f, pose), "setPose"); },
          "pose"_a, kChain, docs::frame_poses::setPose)
      .def(
          "setPose", [](Frame& f, const std::string& text) -> Frame& { return setPose(f, parsePose(text), "setPose"); },
          "pose"_a, kChain, docs::frame_poses::setPoseFromText)
      .def(
          "setPoseByText",
          [](Frame& f, const std::string& text) -> Frame& { return setPose(f, parsePose(text), "setPoseByText"); },
          "pose"_a, kChain, docs::frame_poses::setPoseByText)
      .def(
          "setPosition",
          [](Frame& f, const Numbers& p) -> Frame& {
            const Pose wanted = with(f.getPose(), position(f, p, "setPosition"));
            f.setPosition(wanted.p);
            warnOfLostPose(f, f.getPose(), wanted, "setPosition");
            return f;
          },
          "position"_a, kChain, docs::frame_poses::setPosition)
      .def(
          "setQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& {
            return setQuaternion(f, rotation(f, q, "setQuaternion"), "setQuaternion");
          },
          "quaternion"_a, kChain, docs::frame_poses::setQuaternion)
      .def(
          "setRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& {
            return setQuaternion(f, rotationFromMatrix(f, R), "setRotationMatrix");
          },
          "matrix"_a, kChain, docs::frame_poses::setRotationMatrix);
}

void bindSettingInParent(nb::class_<Frame>& frame) {
  frame
      .def(
          "setRelativePose",
          [](Frame& f, const Numbers& pose) -> Frame& {
            return setRelativePose(f, poseFrom(f, pose), "setRelativePose");
          },
          "pose"_a, kChain, docs::frame_poses::setRelativePose)
      .def(
          "setRelativePose",
          [](Frame& f, const std::string& t) -> Frame& { return setRelativePose(f, parsePose(t), "setRelativePose"); },
          "pose"_a, kChain, docs::frame_poses::setRelativePoseFromText)
      .def(
          "setRelativePoseByText",
          [](Frame& f, const std::string& t) -> Frame& {
            return setRelativePose(f, parsePose(t), "setRelativePoseByText");
          },
          "pose"_a, kChain, docs::frame_poses::setRelativePoseByText)
      .def(
          "setRelativePosition",
          [](Frame& f, const Numbers& p) -> Frame& {
            const Pose wanted = with(f.getRelativePose(), position(f, p, "setRelativePosition"));
            f.setRelativePosition(wanted.p);
            warnOfLostPose(f, f.getRelativePose(), wanted, "setRelativePosition");
            return f;
          },
          "position"_a, kChain, docs::frame_poses::setRelativePosition)
      .def(
          "setRelativeQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& {
            return setRelativeQuaternion(f, rotation(f, q, "setRelativeQuaternion"), "setRelativeQuaternion");
          },
          "quaternion"_a, kChain, docs::frame_poses::setRelativeQuaternion)
      .def(
          "setRelativeRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& {
            return setRelativeQuaternion(f, rotationFromMatrix(f, R), "setRelativeRotationMatrix");
          },
          "matrix"_a, kChain, docs::frame_poses::setRelativeRotationMatrix);
}

}  // namespace

void bindFramePoses(nb::class_<Frame>& frame) {
  bindReading(frame);
  bindSetting(frame);
  bindSettingInParent(frame);
  frame
      .def("get_Jacobian_pos", positionJacobian, "world_pos_optional"_a = nb::none(),
           docs::frame_poses::get_Jacobian_pos)
      .def("get_Jacobian_angular", angularJacobian, docs::frame_poses::get_Jacobian_angular)
      .def(
          "trans_rel2world",
          [](const Frame& f, const Numbers& p) {
            const Vector3d point = f.getPose().transform() * position(f, p, "trans_rel2world");
            return toNumpy(point.data(), 3);
          },
          "point"_a, docs::frame_poses::trans_rel2world);
}

}  // namespace kinegraph::python
