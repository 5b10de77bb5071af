#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "bindings.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/gfile/writer.h"
#include "kinegraph/scene/inertia_edits.h"
#include "kinegraph/scene/reader.h"
#include "kinegraph/scene/tree_edits.h"
#include "scene_values.h"

namespace kinegraph::python {

namespace {

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

/// A quaternion far from unit length is often no quaternion. The text is always the same, so that Python shows it once.
void warnOfLength(double norm) {
  if (norm > 1e-10 && std::abs(norm - 1.) > .1) {
    emitWarning(
        "a quaternion that is far from length 1 is normalized; its numbers are w x y z, and those of a pose x y z qw "
        "qx qy qz");
  }
}

Pose poseFrom(const Frame& frame, const Numbers& numbers) {
  const VectorXd& v = numbers.values;
  if (v.size() == 4 || v.size() == 7) {
    warnOfLength(v.tail<4>().norm());
    unitQuaternion(v.tail<4>(), cat("quaternion of frame '", frame.getName(), "'").c_str());
  }
  return Pose::fromNumbers(v);
}

Quaterniond rotation(const Frame& frame, const Numbers& numbers, const char* call) {
  if (numbers.values.size() != 4) {
    throw ValueError(cat(call, " of frame '", frame.getName(), "': got ", numbers.values.size(),
                         " numbers; expected 4, a quaternion w x y z"));
  }
  warnOfLength(numbers.values.norm());
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

void setAttributes(Frame& frame, nb::dict attributes) {
  for (const auto& [key, value] : attributes) {
    const std::string name = nb::cast<std::string>(key);
    Node node;
    node.key = name;
    node.value = toValue(value, name);
    frame.editAttributes().set(node);
  }
}

Frame& setAttribute(Frame& frame, nb::str key, nb::handle value) {
  nb::dict attributes;
  attributes[key] = value;
  setAttributes(frame, attributes);
  return frame;
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

constexpr auto kChain = nb::rv_policy::none;  // setters return the very object they were called on

}  // namespace

void bindFrame(nb::module_&, nb::class_<Frame>& frame) {
  bindShapes(frame);
  using Relative = const std::optional<Frame>&;
  frame
      .def_prop_ro(
          "ID", [](const Frame& f) { return f.id(); }, "Place in the list of frames.")
      .def_prop_rw(
          "name", [](const Frame& f) { return f.getName(); }, [](Frame& f, std::string n) { f.setName(n); },
          "The frame's name.")
      .def(
          "getName", [](const Frame& f) { return f.getName(); }, "The frame's name.")
      .def(
          "__eq__", [](const Frame& a, const Frame& b) { return a == b; }, "other"_a,
          nb::sig("def __eq__(self, other: Frame, /) -> bool"))
      .def(
          "__eq__", [](const Frame&, nb::handle) { return false; }, "other"_a,
          nb::sig("def __eq__(self, other: object, /) -> bool"))
      .def("__hash__", [](const Frame& f) { return std::size_t(&f.data()); })
      .def("__repr__", [](const Frame& f) { return f.isDeleted() ? std::string("<Frame, deleted>") : describe(f); })
      .def(
          "_repr_html_",
          [](nb::handle self) {
            return nb::cast<std::string>(nb::module_::import_("kinegraph.scene_html").attr("frameHtml")(self));
          },
          "A table of what the frame is, for notebooks.")
      .def("getParent", &Frame::getParent, "The parent frame, or None.")
      .def("getChildren", &Frame::getChildren, "The frames directly below this one.")
      .def("getSubtree", &Frame::getSubtree, "All frames below this one, depth first.")

      .def(
          "getPose", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).numbers().data(), 7); },
          "relativeTo"_a = nb::none(), "World pose, or pose relative to a frame: (7,) = x y z (m), qw qx qy qz.")
      .def(
          "getPosition", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).p.data(), 3); },
          "relativeTo"_a = nb::none(), "World position, or position relative to a frame: (3,), m.")
      .def(
          "getQuaternion", [](const Frame& f, Relative r) { return toNumpy(wxyz(poseOf(f, r).q).data(), 4); },
          "relativeTo"_a = nb::none(), "World rotation, or rotation relative to a frame: (4,) = w x y z.")
      .def(
          "getRotationMatrix", [](const Frame& f) { return toNumpy(MatrixXd(f.getPose().q.toRotationMatrix())); },
          "World rotation: (3, 3).")
      .def(
          "getTransform", [](const Frame& f, Relative r) { return fourByFour(poseOf(f, r)); },
          "relativeTo"_a = nb::none(), "World pose, or pose relative to a frame, as homogeneous matrix (4, 4).")
      .def(
          "getRelativePose", [](const Frame& f) { return toNumpy(f.getRelativePose().numbers().data(), 7); },
          "Pose in the parent: (7,); identity for a root.")
      .def(
          "getRelativePosition", [](const Frame& f) { return toNumpy(f.getRelativePose().p.data(), 3); },
          "Position in the parent: (3,), m.")
      .def(
          "getRelativeQuaternion", [](const Frame& f) { return toNumpy(wxyz(f.getRelativePose().q).data(), 4); },
          "Rotation in the parent: (4,) = w x y z.")
      .def(
          "getRelativeTransform", [](const Frame& f) { return fourByFour(f.getRelativePose()); },
          "Pose in the parent as homogeneous matrix (4, 4).")

      .def(
          "setPose", [](Frame& f, const Numbers& pose) -> Frame& { return f.setPose(poseFrom(f, pose)); }, "pose"_a,
          kChain, "Sets the world pose: 7 numbers (x y z qw qx qy qz), 3 (position) or 4 (quaternion).")
      .def(
          "setPose", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); }, "pose"_a,
          kChain, "Sets the world pose from text such as \"t(0 0 1) d(90 0 0 1)\".")
      .def(
          "setPoseByText", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); },
          "pose"_a, kChain, "Sets the world pose from text such as \"t(0 0 1) d(90 0 0 1)\" (d: degrees, r: radians).")
      .def(
          "setPosition",
          [](Frame& f, const Numbers& p) -> Frame& { return f.setPosition(position(f, p, "setPosition")); },
          "position"_a, kChain, "Sets the world position: 3 numbers, m.")
      .def(
          "setQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& { return f.setQuaternion(rotation(f, q, "setQuaternion")); },
          "quaternion"_a, kChain, "Sets the world rotation: 4 numbers w x y z; normalized.")
      .def(
          "setRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& { return f.setQuaternion(rotationFromMatrix(f, R)); }, "matrix"_a,
          kChain, "Sets the world rotation: (3, 3).")
      .def(
          "setRelativePose",
          [](Frame& f, const Numbers& pose) -> Frame& { return f.setRelativePose(poseFrom(f, pose)); }, "pose"_a,
          kChain, "Sets the pose in the parent: 7, 3 or 4 numbers.")
      .def(
          "setRelativePose", [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); },
          "pose"_a, kChain, "Sets the pose in the parent from text.")
      .def(
          "setRelativePoseByText",
          [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); }, "pose"_a, kChain,
          "Sets the pose in the parent from text.")
      .def(
          "setRelativePosition",
          [](Frame& f, const Numbers& p) -> Frame& {
            return f.setRelativePosition(position(f, p, "setRelativePosition"));
          },
          "position"_a, kChain, "Sets the position in the parent: 3 numbers, m.")
      .def(
          "setRelativeQuaternion",
          [](Frame& f, const Numbers& q) -> Frame& {
            return f.setRelativeQuaternion(rotation(f, q, "setRelativeQuaternion"));
          },
          "quaternion"_a, kChain, "Sets the rotation in the parent: 4 numbers w x y z.")
      .def(
          "setRelativeRotationMatrix",
          [](Frame& f, const Numbers& R) -> Frame& { return f.setRelativeQuaternion(rotationFromMatrix(f, R)); },
          "matrix"_a, kChain, "Sets the rotation in the parent: (3, 3).")

      .def(
          "setParent",
          [](Frame& f, const Frame& parent, bool keep, bool) -> Frame& { return f.setParent(parent, keep); },
          "parent"_a, "keepAbsolutePose_and_adaptRelativePose"_a = false, "checkForLoop"_a = true, kChain,
          "Attaches the frame below `parent`. By default the relative pose stays, so the frame moves in the world.\n"
          "Loops are always refused.")
      .def("unLink", &Frame::unLink, kChain, "Cuts the frame from its parent, where it is; its joint is removed.")

      .def(
          "makeRoot", [](Frame& f, bool until) -> Frame& { return makeRoot(*f.scene(), f.data(), until), f; },
          "untilPartBreak"_a = false, kChain,
          "Turns the path above the frame around, so that it becomes the root of its tree; nothing moves. Joints on "
          "the path move\n"
          "to the frame that is below them now, with the sign of q (and the limits) changed. untilPartBreak: only up "
          "to the first\n"
          "rigid or free joint, which is cut. ArgumentError for joints that no joint type inverts (universal, ...).")
      .def("get_Jacobian_pos", positionJacobian, "world_pos"_a = nb::none(),
           "d p / d q, (3, n), world coordinates: of the frame's origin, or of a world point (3,), m, that moves with "
           "the frame.")
      .def("get_Jacobian_angular", angularJacobian,
           "The angular velocity per velocity of q, (3, n), world coordinates, rad/s.")
      .def(
          "trans_rel2world",
          [](const Frame& f, const Numbers& p) {
            const Vector3d point = f.getPose().transform() * position(f, p, "trans_rel2world");
            return toNumpy(point.data(), 3);
          },
          "point"_a, "A point (3,) in the frame's coordinates, m, in those of the world.")
      .def(
          "computeCompoundInertia", [](Frame& f) -> Frame& { return gatherInertia(f.data()), f; }, kChain,
          "Gathers the inertias of the frame and of all that is fixed to it from below in the frame; the others lose "
          "theirs.")
      .def(
          "transformToDiagInertia",
          [](Frame& f, bool mesh) {
            return toNumpy(moveToPrincipalAxes(*f.scene(), f.data(), mesh).numbers().data(), 7);
          },
          "transformMesh"_a = true,
          "Moves the frame to its center of mass and turns it to its principal axes of inertia; what is below it stays "
          "in place, and\n"
          "with transformMesh so do the points of its mesh. Returns the motion, (7,): the new frame in the old one.\n"
          "ArgumentError without a mass, with dofs, or with a shape that would have to move.")
      .def(
          "setMass",
          [](Frame& f, double mass, const std::optional<Numbers>& inertia) -> Frame& {
            return f.setMass(mass, inertia ? inertia->list() : std::vector<double>());
          },
          "mass"_a, "inertiaMatrix"_a = nb::none(), kChain,
          "Mass in kg. The inertia is that of the shape's surface, or 3, 6 or 9 numbers in kg m^2. 0 removes it.")
      .def(
          "getInertia",
          [](const Frame& f) -> nb::typed<nb::tuple, nb::float_, nb::any, nb::any> {
            const std::optional<Inertia> inertia = f.getInertia();
            if (!inertia) return nb::make_tuple(0., nb::list(), nb::list());
            return nb::make_tuple(inertia->mass, toNumpy(inertia->com.data(), 3), toNumpy(MatrixXd(inertia->matrix)));
          },
          "(mass in kg, center of mass (3,) in m, inertia about it (3, 3) in kg m^2), in the frame; (0, [], []) "
          "without a mass.")
      .def("getMass", &Frame::getMass, "Mass in kg, 0 if none.")
      .def(
          "setJoint",
          [](Frame& f, JointType type, const std::optional<Numbers>& limits, const std::optional<Numbers>& axis,
             double scale, const std::optional<Frame>& mimic) -> Frame& {
            const std::vector<double> none;
            return f.setJoint(type, limits ? limits->list() : none, axis ? axis->list() : none, scale, mimic);
          },
          "jointType"_a, "limits"_a = nb::none(), "axis"_a = nb::none(), "scale"_a = 1., "mimic"_a = nb::none(), kChain,
          "Gives the frame a joint to its parent. limits: all lower, then all upper bounds (rad, m). axis: for "
          "JT.hinge.\n"
          "JT.none removes the joint.")
      .def("getJointType", &Frame::getJointType, "Its JT; JT.none without a joint.")
      .def(
          "getJointState", [](const Frame& f) { return toNumpy(f.getJointState()); }, "The joint's dofs (rad, m).")
      .def(
          "setJointState", [](Frame& f, const Numbers& q) -> Frame& { return f.setJointState(q.values); }, "q"_a,
          kChain, "Sets the joint's dofs (rad, m).")

      .def(
          "getJointQIndex", [](const Frame& f) { return dofIndex(*f.scene(), f.data()); },
          "Where the joint's dofs begin in q; a mimic has the index of its source. Of an inactive joint: among the "
          "dofs of the\n"
          "inactive ones. ArgumentError without a joint.")
      .def(
          "setJointSampleStdDev",
          [](Frame& f, double deviation) -> Frame& {
            if (!f.data().joint) throw ValueError(cat("setJointSampleStdDev: frame '", f.getName(), "' has no joint"));
            if (!(deviation >= 0.))
              throw ValueError(cat("setJointSampleStdDev: ", deviation, " is not zero or positive"));
            f.data().joint->sample_deviation = deviation;
            return f;
          },
          "deviation"_a, kChain,
          "Standard deviation (rad, m) with which setRandom draws the joint's dofs around its home.")
      .def(
          "getAttributes", [](const Frame& f) { return toDict(f.attributes()); }, "The attributes, as a dict.")
      .def(
          "setAttributes", [](Frame& f, nb::dict d) -> Frame& { return setAttributes(f, d), f; }, "attributes"_a,
          kChain, "Adds attributes that the library keeps but does not interpret.")
      .def(
          "addAttributes", [](Frame& f, nb::dict d) -> Frame& { return setAttributes(f, d), f; }, "attributes"_a,
          kChain, "The same as setAttributes.")
      .def("addAttribute", setAttribute, "key"_a, "value"_a, kChain, "setAttributes with one key.")
      .def("setAttribute", setAttribute, "key"_a, "value"_a, kChain, "setAttributes with one key.");
}

}  // namespace kinegraph::python
