#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/shape_types.h"
#include "kinegraph/geometry/tessellation.h"
#include "kinegraph/gfile/writer.h"
#include "kinegraph/scene/reader.h"
#include "scene_values.h"

namespace kinegraph::python {

namespace {

Pose poseOf(const Frame& frame, const std::optional<Frame>& relative_to) {
  return relative_to ? frame.getPose(*relative_to) : frame.getPose();
}

nb::object fourByFour(const Pose& X) {
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

Quaterniond rotation(const Frame& frame, const Numbers& numbers, const char* call) {
  if (numbers.values.size() != 4) {
    throw ValueError(cat(call, " of frame '", frame.getName(), "': got ", numbers.values.size(),
                         " numbers; expected 4, a quaternion w x y z"));
  }
  return unitQuaternion(numbers.values, cat("quaternion of frame '", frame.getName(), "'").c_str());
}

Quaterniond rotationFromMatrix(const Frame& frame, const Numbers& numbers) {
  if (numbers.values.size() != 9) {
    throw ValueError(cat("frame '", frame.getName(), "': a rotation matrix is 3 x 3, got ", numbers.values.size(), " numbers"));
  }
  const Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.values.data());
  if (!(R * R.transpose()).isIdentity(1e-3) || R.determinant() < 0.) {
    throw ValueError(cat("frame '", frame.getName(), "': the matrix is not a rotation (columns orthogonal, length 1, right-handed)"));
  }
  return Quaterniond(R).normalized();
}

/// Mesh of a shape in local coordinates: its own, or its surface as triangles.
Mesh meshOf(const Frame& frame) {
  const auto& shape = frame.data().shape;
  if (!shape) return {};
  const Geometry& geometry = *shape->geometry;
  if (geometry.mesh && geometry.type != ShapeType::ssCvx) return *geometry.mesh;
  return tessellate(geometry);
}

nb::object meshPoints(const Mesh& mesh) {
  NewArray array = newArray(mesh.vertices.size(), 3);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) std::copy_n(mesh.vertices[i].data(), 3, array.data + 3 * i);
  return array.array;
}

nb::object meshTriangles(const Mesh& mesh) {
  NewArray array = newArray(mesh.triangles.size(), 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) std::copy_n(mesh.triangles[i].data(), 3, array.data + 3 * i);
  return array.array.attr("astype")("uint32");
}

std::vector<Vector3d> points(const Numbers& numbers, const char* what) {
  if (numbers.values.size() % 3 != 0) throw ValueError(cat(what, " are n x 3 numbers, got ", numbers.values.size()));
  std::vector<Vector3d> list(numbers.values.size() / 3);
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = numbers.values.segment<3>(3 * Eigen::Index(i));
  return list;
}

Mesh meshFrom(const Numbers& vertices, const Numbers& triangles) {
  Mesh mesh;
  mesh.vertices = points(vertices, "mesh vertices");
  if (triangles.values.size() % 3 != 0) throw ValueError("mesh triangles are m x 3 indices");
  for (Eigen::Index i = 0; i < triangles.values.size(); i += 3) {
    std::array<std::uint32_t, 3> triangle;
    for (int k = 0; k < 3; ++k) {
      const double index = triangles.values[i + k];
      if (!(index >= 0. && index < double(mesh.vertices.size()))) {
        throw ValueError(cat("mesh triangle ", i / 3, " names vertex ", index, "; there are ", mesh.vertices.size()));
      }
      triangle[k] = std::uint32_t(index);
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

void setAttributes(Frame& frame, nb::dict attributes) {
  for (const auto& [key, value] : attributes) {
    const std::string name = nb::cast<std::string>(key);
    Node node;
    node.key = name;
    node.value = toValue(value, name);
    frame.attributes().set(node);
  }
}

constexpr auto kChain = nb::rv_policy::none;  // setters return the very object they were called on

}  // namespace

void bindFrame(nb::module_&, nb::class_<Frame>& frame) {
  using Relative = const std::optional<Frame>&;
  frame
      .def_prop_ro("ID", [](const Frame& f) { return f.id(); }, "Place in the list of frames.")
      .def_prop_rw("name", [](const Frame& f) { return f.getName(); }, [](Frame& f, std::string n) { f.setName(n); },
                   "The frame's name.")
      .def("getName", [](const Frame& f) { return f.getName(); }, "The frame's name.")
      .def("__eq__", [](const Frame& a, const Frame& b) { return a == b; }, "other"_a)
      .def("__eq__", [](const Frame&, nb::handle) { return false; }, "other"_a)
      .def("__hash__", [](const Frame& f) { return std::size_t(&f.data()); })
      .def("__repr__", [](const Frame& f) { return describe(f); })
      .def("getParent", &Frame::getParent, "The parent frame, or None.")
      .def("getChildren", &Frame::getChildren, "The frames directly below this one.")
      .def("getSubtree", &Frame::getSubtree, "All frames below this one, depth first.")

      .def("getPose", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).numbers().data(), 7); },
           "relativeTo"_a = nb::none(), "World pose, or pose relative to a frame: (7,) = x y z (m), qw qx qy qz.")
      .def("getPosition", [](const Frame& f, Relative r) { return toNumpy(poseOf(f, r).p.data(), 3); },
           "relativeTo"_a = nb::none(), "World position, or position relative to a frame: (3,), m.")
      .def("getQuaternion", [](const Frame& f, Relative r) { return toNumpy(wxyz(poseOf(f, r).q).data(), 4); },
           "relativeTo"_a = nb::none(), "World rotation, or rotation relative to a frame: (4,) = w x y z.")
      .def("getRotationMatrix", [](const Frame& f) { return toNumpy(MatrixXd(f.getPose().q.toRotationMatrix())); },
           "World rotation: (3, 3).")
      .def("getTransform", [](const Frame& f, Relative r) { return fourByFour(poseOf(f, r)); },
           "relativeTo"_a = nb::none(), "World pose, or pose relative to a frame, as homogeneous matrix (4, 4).")
      .def("getRelativePose", [](const Frame& f) { return toNumpy(f.getRelativePose().numbers().data(), 7); },
           "Pose in the parent: (7,); identity for a root.")
      .def("getRelativePosition", [](const Frame& f) { return toNumpy(f.getRelativePose().p.data(), 3); },
           "Position in the parent: (3,), m.")
      .def("getRelativeQuaternion", [](const Frame& f) { return toNumpy(wxyz(f.getRelativePose().q).data(), 4); },
           "Rotation in the parent: (4,) = w x y z.")
      .def("getRelativeTransform", [](const Frame& f) { return fourByFour(f.getRelativePose()); },
           "Pose in the parent as homogeneous matrix (4, 4).")

      .def("setPose",
           [](Frame& f, const Numbers& pose) -> Frame& { return f.setPose(Pose::fromNumbers(pose.values)); }, "pose"_a,
           kChain, "Sets the world pose: 7 numbers (x y z qw qx qy qz), 3 (position) or 4 (quaternion).")
      .def("setPose", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); }, "pose"_a,
           kChain, "Sets the world pose from text such as \"t(0 0 1) d(90 0 0 1)\".")
      .def("setPoseByText", [](Frame& f, const std::string& text) -> Frame& { return f.setPose(parsePose(text)); },
           "pose"_a, kChain, "Sets the world pose from text such as \"t(0 0 1) d(90 0 0 1)\" (d: degrees, r: radians).")
      .def("setPosition",
           [](Frame& f, const Numbers& p) -> Frame& { return f.setPosition(position(f, p, "setPosition")); }, "position"_a,
           kChain, "Sets the world position: 3 numbers, m.")
      .def("setQuaternion",
           [](Frame& f, const Numbers& q) -> Frame& { return f.setQuaternion(rotation(f, q, "setQuaternion")); },
           "quaternion"_a, kChain, "Sets the world rotation: 4 numbers w x y z; normalized.")
      .def("setRotationMatrix",
           [](Frame& f, const Numbers& R) -> Frame& { return f.setQuaternion(rotationFromMatrix(f, R)); }, "matrix"_a,
           kChain, "Sets the world rotation: (3, 3).")
      .def("setRelativePose",
           [](Frame& f, const Numbers& pose) -> Frame& { return f.setRelativePose(Pose::fromNumbers(pose.values)); },
           "pose"_a, kChain, "Sets the pose in the parent: 7, 3 or 4 numbers.")
      .def("setRelativePose", [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); },
           "pose"_a, kChain, "Sets the pose in the parent from text.")
      .def("setRelativePoseByText",
           [](Frame& f, const std::string& t) -> Frame& { return f.setRelativePose(parsePose(t)); }, "pose"_a, kChain,
           "Sets the pose in the parent from text.")
      .def("setRelativePosition",
           [](Frame& f, const Numbers& p) -> Frame& {
             return f.setRelativePosition(position(f, p, "setRelativePosition"));
           },
           "position"_a, kChain, "Sets the position in the parent: 3 numbers, m.")
      .def("setRelativeQuaternion",
           [](Frame& f, const Numbers& q) -> Frame& {
             return f.setRelativeQuaternion(rotation(f, q, "setRelativeQuaternion"));
           },
           "quaternion"_a, kChain, "Sets the rotation in the parent: 4 numbers w x y z.")
      .def("setRelativeRotationMatrix",
           [](Frame& f, const Numbers& R) -> Frame& { return f.setRelativeQuaternion(rotationFromMatrix(f, R)); },
           "matrix"_a, kChain, "Sets the rotation in the parent: (3, 3).")

      .def("setParent",
           [](Frame& f, const Frame& parent, bool keep, bool) -> Frame& { return f.setParent(parent, keep); }, "parent"_a,
           "keepAbsolutePose_and_adaptRelativePose"_a = false, "checkForLoop"_a = true, kChain,
           "Attaches the frame below `parent`. By default the relative pose stays, so the frame moves in the world.\n"
           "Loops are always refused.")
      .def("unLink", &Frame::unLink, kChain, "Cuts the frame from its parent, where it is; its joint is removed.")

      .def("setShape",
           [](Frame& f, ShapeType type, const Numbers& size) -> Frame& { return f.setShape(type, size.list()); },
           "type"_a, "size"_a, kChain,
           "Gives the frame a shape. Sizes in m: box [x y z], ssBox [x y z radius], sphere [r], capsule and cylinder\n"
           "[length r], marker [length], quad [x y].")
      .def("setShape",
           [](Frame& f, const std::string& type, const Numbers& size) -> Frame& {
             return f.setShape(shapeTypeFromName(type), size.list());
           },
           "type"_a, "size"_a, kChain, "The same with the type's name.")
      .def("setColor", [](Frame& f, const Numbers& color) -> Frame& { return f.setColor(color.list()); }, "color"_a, kChain,
           "Grey, grey and alpha, rgb, or rgba; in 0..1.")
      .def("setContact", [](Frame& f, int contact) -> Frame& { return f.setContact(contact); }, "contact"_a, kChain,
           "0: never collides; 1: with everything outside of its link; -k: not with links within k joints above.")
      .def("setMass",
           [](Frame& f, double mass, const std::optional<Numbers>& inertia) -> Frame& {
             return f.setMass(mass, inertia ? inertia->list() : std::vector<double>());
           },
           "mass"_a, "inertiaMatrix"_a = nb::none(), kChain,
           "Mass in kg. The inertia is that of the shape's surface, or 3, 6 or 9 numbers in kg m^2. 0 removes it.")
      .def("getInertia",
           [](const Frame& f) {
             const std::optional<Inertia> inertia = f.getInertia();
             if (!inertia) return nb::make_tuple(0., nb::list(), nb::list());
             return nb::make_tuple(inertia->mass, toNumpy(inertia->com.data(), 3), toNumpy(MatrixXd(inertia->matrix)));
           },
           "(mass in kg, centre of mass (3,) in m, inertia about it (3, 3) in kg m^2), in the frame; (0, [], []) without a mass.")
      .def("getMass", &Frame::getMass, "Mass in kg, 0 if none.")
      .def("setMesh",
           [](Frame& f, const Numbers& vertices, const Numbers& triangles, nb::object, nb::object) -> Frame& {
             return f.setMesh(meshFrom(vertices, triangles));
           },
           "vertices"_a, "triangles"_a, "colors"_a = nb::none(), "cvxParts"_a = nb::none(), kChain,
           "Gives the frame a mesh: vertices (n, 3) in m, triangles (m, 3).")
      .def("setConvexMesh",
           [](Frame& f, const Numbers& core, nb::object, double radius) -> Frame& {
             return f.setConvexCore(points(core, "core points"), radius);
           },
           "points"_a, "colors"_a = nb::none(), "radius"_a = 0., kChain,
           "Gives the frame the convex hull of points (n, 3), swept by a ball of `radius`, m.")
      .def("setPointCloud",
           [](Frame& f, const Numbers& cloud, nb::object, nb::object) -> Frame& {
             Mesh mesh;
             mesh.vertices = points(cloud, "points");
             return f.setMesh(std::move(mesh));
           },
           "points"_a, "colors"_a = nb::none(), "normals"_a = nb::none(), kChain, "Gives the frame points (n, 3), m.")
      .def("getShapeType", &Frame::getShapeType, "Its ST; ST.none without a shape.")
      .def("getSize", [](const Frame& f) { return toNumpy(f.getSize().data(), f.getSize().size()); },
           "Sizes as for setShape; empty without a shape.")
      .def("getMeshPoints", [](const Frame& f) { return meshPoints(meshOf(f)); },
           "Vertices of the shape's surface, (n, 3), in the frame.")
      .def("getMeshTriangles", [](const Frame& f) { return meshTriangles(meshOf(f)); },
           "Triangles of the shape's surface, (m, 3) uint32.")

      .def("setJoint",
           [](Frame& f, JointType type, const std::optional<Numbers>& limits, const std::optional<Numbers>& axis,
              double scale, const std::optional<Frame>& mimic) -> Frame& {
             const std::vector<double> none;
             return f.setJoint(type, limits ? limits->list() : none, axis ? axis->list() : none, scale, mimic);
           },
           "jointType"_a, "limits"_a = nb::none(), "axis"_a = nb::none(), "scale"_a = 1., "mimic"_a = nb::none(), kChain,
           "Gives the frame a joint to its parent. limits: all lower, then all upper bounds (rad, m). axis: for JT.hinge.\n"
           "JT.none removes the joint.")
      .def("getJointType", &Frame::getJointType, "Its JT; JT.none without a joint.")
      .def("getJointState", [](const Frame& f) { return toNumpy(f.getJointState()); }, "The joint's dofs (rad, m).")
      .def("setJointState", [](Frame& f, const Numbers& q) -> Frame& { return f.setJointState(q.values); }, "q"_a, kChain,
           "Sets the joint's dofs (rad, m).")

      .def("getAttributes", [](const Frame& f) { return toDict(f.attributes()); }, "The attributes, as a dict.")
      .def("setAttributes", [](Frame& f, nb::dict d) -> Frame& { return setAttributes(f, d), f; }, "attributes"_a, kChain,
           "Adds attributes that the library keeps but does not interpret.")
      .def("addAttributes", [](Frame& f, nb::dict d) -> Frame& { return setAttributes(f, d), f; }, "attributes"_a, kChain,
           "The same as setAttributes.");
}

}  // namespace kinegraph::python
