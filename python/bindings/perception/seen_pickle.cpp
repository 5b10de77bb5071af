#include "perception/seen_pickle.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>

#include "arguments.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/perception/register_scene.h"
#include "perception/depth_views.h"

namespace kinegraph::python {

namespace {

nb::tuple packMatrix(const MatrixXd& matrix) {
  return nb::make_tuple(matrix.rows(), matrix.cols(), toNumpy(VectorXd(matrix.reshaped())));
}

MatrixXd unpackMatrix(const nb::tuple& state) {
  const auto rows = nb::cast<Eigen::Index>(state[0]), columns = nb::cast<Eigen::Index>(state[1]);
  const Numbers numbers = nb::cast<Numbers>(state[2]);
  if (numbers.values.size() != rows * columns)
    throw ValueError("__setstate__: a matrix has another size than its state");
  return numbers.values.reshaped(rows, columns);
}

Pose unpackPose(const nb::object& state) { return Pose::fromNumbers(nb::cast<Numbers>(state).values); }

nb::tuple packView(const DepthView& view) {
  const nb::bytes depth(reinterpret_cast<const char*>(view.depth.data()), view.depth.size() * sizeof(float));
  return nb::make_tuple(depth, view.width, view.height, toNumpy(VectorXd(view.fxycxy)), view.camera,
                        seenPose(view.pose), view.noise, view.bias);
}

DepthView unpackView(const nb::tuple& state) {
  DepthView view;
  const nb::bytes depth = state[0];
  view.depth.resize(depth.size() / sizeof(float));
  std::memcpy(view.depth.data(), depth.c_str(), view.depth.size() * sizeof(float));
  view.width = nb::cast<int>(state[1]);
  view.height = nb::cast<int>(state[2]);
  view.fxycxy = nb::cast<Numbers>(state[3]).values;
  view.camera = nb::cast<std::string>(state[4]);
  view.pose = unpackPose(state[5]);
  view.noise = nb::cast<double>(state[6]);
  view.bias = nb::cast<double>(state[7]);
  view.validate("DepthView");
  return view;
}

nb::tuple packFrame(const SeenFrame& frame) {
  nb::list alternatives;
  for (const Pose& pose : frame.alternatives) alternatives.append(seenPose(pose));
  return nb::make_tuple(int(frame.status), seenPose(frame.pose), packMatrix(frame.covariance),
                        packMatrix(frame.free_directions), alternatives, frame.visible, frame.score, frame.by,
                        frame.may_be);
}

SeenFrame unpackFrame(const nb::tuple& state) {
  SeenFrame frame;
  frame.status = SeenStatus(nb::cast<int>(state[0]));
  frame.pose = unpackPose(state[1]);
  frame.covariance = unpackMatrix(state[2]);
  frame.free_directions = unpackMatrix(state[3]);
  for (nb::handle pose : state[4]) frame.alternatives.push_back(unpackPose(nb::borrow(pose)));
  frame.visible = nb::cast<double>(state[5]);
  frame.score = nb::cast<double>(state[6]);
  frame.by = nb::cast<std::string>(state[7]);
  frame.may_be = nb::cast<std::vector<std::string>>(state[8]);
  return frame;
}

nb::tuple packCamera(const SeenCamera& camera) {
  return nb::make_tuple(seenPose(camera.pose), packMatrix(camera.covariance));
}

SeenCamera unpackCamera(const nb::tuple& state) { return {unpackPose(state[0]), unpackMatrix(state[1])}; }

nb::tuple packSeen(const SeenScene& scene) {
  return nb::make_tuple(scene.frames, scene.cameras, scene.joints, toNumpy(scene.joint_offsets),
                        packMatrix(scene.joint_covariance), scene.warnings);
}

SeenScene unpackSeen(const nb::tuple& state) {
  SeenScene scene;
  scene.frames = nb::cast<std::map<std::string, SeenFrame>>(state[0]);
  scene.cameras = nb::cast<std::vector<SeenCamera>>(state[1]);
  scene.joints = nb::cast<std::vector<std::string>>(state[2]);
  scene.joint_offsets = nb::cast<Numbers>(state[3]).values;
  scene.joint_covariance = unpackMatrix(state[4]);
  scene.warnings = nb::cast<std::vector<std::string>>(state[5]);
  return scene;
}

template <typename T>
void bindPickling(nb::tuple (*state)(const T&), T (*from)(const nb::tuple&)) {
  nb::borrow<nb::class_<T>>(nb::type<T>())
      .def("__getstate__", state)
      .def(
          "__setstate__", [from](T& self, const nb::tuple& given) { new (&self) T(from(given)); }, "state"_a);
}

}  // namespace

void bindSeenCopies() {
  bindPickling(packView, unpackView);
  bindPickling(packFrame, unpackFrame);
  bindPickling(packCamera, unpackCamera);
  bindPickling(packSeen, unpackSeen);
}

}  // namespace kinegraph::python
