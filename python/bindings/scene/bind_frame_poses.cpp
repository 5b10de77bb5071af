#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cmath>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/loading/reader.h"
#include "scene/frame_poses_docs.h"
#include "scene/quaternion_order.h"

namespace kinegraph::python {

void warnOfOrder(const Vector4d& wxyz) {
  const double norm = wxyz.norm();
  if (wxyz == Vector4d(0., 0., 0., 1.))
    emitWarning(
        "the quaternion 0 0 0 1 is half a turn about z; did you mean no rotation, 1 0 0 0? The order is w x y z");
  if (norm > 1e-10 && std::abs(norm - 1.) > .1) {
    emitWarning(
        "a quaternion far from unit length is normalized; expected the order w x y z, and x y z qw "
        "qx qy qz for a pose");
  }
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
    warnOfOrder(v.tail<4>());
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
          "setPose", [](Frame& f, const Numbers& pose) -> Frame& { return f.setPose(poseFrom(f, pose)); }, "pose"_a,
          kChain, docs::frame_poses::setPose)
      .def(
          "setPose", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); }, "pose"_a,
          kChain, docs::frame_poses::setPoseFromText)
      .def(
          "setPoseByText", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); },
          "pose"_a, kChain, docs::frame_poses::setPoseByText)
      .def(
          "setPosition",
          [](Frame& f, const Numbers& p) -> Frame& { return f.setPosition(position(f, p, "setPosition")); },
          "position"_a, kChain, docs::frame_poses::setPosition)
      .def(
          "setQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& { return f.setQuaternion(rotation(f, q, "setQuaternion")); },
          "quaternion"_a, kChain, docs::frame_poses::setQuaternion)
      .def(
          "setRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& { return f.setQuaternion(rotationFromMatrix(f, R)); }, "matrix"_a,
          kChain, docs::frame_poses::setRotationMatrix);
}

void bindSettingInParent(nb::class_<Frame>& frame) {
  frame
      .def(
          "setRelativePose",
          [](Frame& f, const Numbers& pose) -> Frame& { return f.setRelativePose(poseFrom(f, pose)); }, "pose"_a,
          kChain, docs::frame_poses::setRelativePose)
      .def(
          "setRelativePose", [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); },
          "pose"_a, kChain, docs::frame_poses::setRelativePoseFromText)
      .def(
          "setRelativePoseByText",
          [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); }, "pose"_a, kChain,
          docs::frame_poses::setRelativePoseByText)
      .def(
          "setRelativePosition",
          [](Frame& f, const Numbers& p) -> Frame& {
            return f.setRelativePosition(position(f, p, "setRelativePosition"));
          },
          "position"_a, kChain, docs::frame_poses::setRelativePosition)
      .def(
          "setRelativeQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& {
            return f.setRelativeQuaternion(rotation(f, q, "setRelativeQuaternion"));
          },
          "quaternion"_a, kChain, docs::frame_poses::setRelativeQuaternion)
      .def(
          "setRelativeRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& { return f.setRelativeQuaternion(rotationFromMatrix(f, R)); },
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
