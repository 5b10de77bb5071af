#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/inertia_edits.h"
#include "kinegraph/scene/tree/joint_limits.h"
#include "kinegraph/scene/tree/tree_edits.h"
#include "scene/frame_joint_docs.h"
#include "scene/pose_warnings.h"

namespace kinegraph::python {

namespace {

void bindInertia(nb::class_<Frame>& frame) {
  frame
      .def(
          "computeCompoundInertia", [](Frame& f) -> Frame& { return gatherInertia(f.data()), f; }, kChain,
          docs::frame_joint::computeCompoundInertia)
      .def(
          "transformToDiagInertia",
          [](Frame& f, bool mesh) {
            return toNumpy(moveToPrincipalAxes(*f.scene(), f.data(), mesh).numbers().data(), 7);
          },
          "transformMesh"_a = true, docs::frame_joint::transformToDiagInertia)
      .def(
          "setMass",
          [](Frame& f, double mass, const std::optional<Numbers>& inertia) -> Frame& {
            return f.setMass(mass, inertia ? inertia->list() : std::vector<double>());
          },
          "mass"_a, "inertiaMatrix"_a = nb::none(), kChain, docs::frame_joint::setMass)
      .def(
          "getInertia",
          [](const Frame& f) {
            const std::optional<Inertia> inertia = f.getInertia();
            if (!inertia) return nb::make_tuple(0., nb::list(), nb::list());
            return nb::make_tuple(inertia->mass, toNumpy(inertia->com.data(), 3), toNumpy(MatrixXd(inertia->matrix)));
          },
          nb::sig("def getInertia(self) -> tuple[float, numpy.typing.NDArray[numpy.float64] | list[float], "
                  "numpy.typing.NDArray[numpy.float64] | list[float]]"),
          docs::frame_joint::getInertia)
      .def("getMass", &Frame::getMass, "Returns the mass in kg; 0 without one.");
}

}  // namespace

void bindFrameJoint(nb::class_<Frame>& frame) {
  bindInertia(frame);
  frame
      .def(
          "setJoint",
          [](Frame& f, JointType type, const std::optional<Numbers>& limits, const std::optional<Numbers>& axis,
             double scale, const std::optional<Frame>& mimic) -> Frame& {
            const std::vector<double> none;
            const Pose before = f.getRelativePose();
            f.setJoint(type, limits ? limits->list() : none, axis ? axis->list() : none, scale, mimic);
            std::string warning;
            if (limits && limitsInTurn(limits->list(), warning))
              emitWarning(cat("Frame.setJoint: frame '", f.getName(), "': ", warning));
            if (!mimic) warnOfLostPose(f, f.getRelativePose(), before, "setJoint");
            return f;
          },
          "jointType"_a, "limits"_a = nb::none(), "axis"_a = nb::none(), "scale"_a = 1., "mimic"_a = nb::none(), kChain,
          docs::frame_joint::setJoint)
      .def("getJointType", &Frame::getJointType, "Returns the joint type, a JT; JT.none without a joint.")
      .def(
          "getJointState", [](const Frame& f) { return toNumpy(f.getJointState()); },
          "Returns the joint's dofs, shape (k,), rad or m.")
      .def(
          "setJointState", [](Frame& f, const Numbers& q) -> Frame& { return f.setJointState(q.values); }, "q"_a,
          kChain, docs::frame_joint::setJointState)

      .def(
          "getJointQIndex", [](const Frame& f) { return dofIndex(*f.scene(), f.data()); },
          docs::frame_joint::getJointQIndex)
      .def(
          "setJointSampleStdDev",
          [](Frame& f, double deviation) -> Frame& {
            if (!f.data().joint) throw ValueError(cat("setJointSampleStdDev: frame '", f.getName(), "' has no joint"));
            if (!(deviation >= 0.))
              throw ValueError(cat("setJointSampleStdDev: ", deviation, " is not zero or positive"));
            f.data().joint->sample_deviation = deviation;
            return f;
          },
          "deviation"_a, kChain, docs::frame_joint::setJointSampleStdDev);
}

}  // namespace kinegraph::python
