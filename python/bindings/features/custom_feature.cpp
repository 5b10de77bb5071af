#include <nanobind/stl/string.h>

#include "bindings.h"
#include "features/custom_features_docs.h"
#include "features/feature_arguments.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/custom_feature.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

using FeatureRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A frame in a custom function. It shares an immutable State, so the function may store it.
struct FrameView {
  std::shared_ptr<const State> state;
  int frame;
};

/// Wraps a Python object that is released under the interpreter lock, by whichever thread.
std::shared_ptr<const nb::object> sharedObject(nb::object object) {
  return {new nb::object(std::move(object)), [](const nb::object* held) {
            const nb::gil_scoped_acquire lock;
            delete held;
          }};
}

/// Calls a Python function of frames and converts its result.
class PythonFunction {
 public:
  PythonFunction(std::shared_ptr<const nb::object> function, std::string name)
      : function_(std::move(function)), name_(std::move(name)) {}

  FeatureValue operator()(const State& state, const std::vector<int>& frames) const {
    const auto shared = std::make_shared<const State>(state);
    nb::list arguments;
    for (int frame : frames) arguments.append(nb::cast(FrameView{shared, frame}));
    if (frames.empty()) arguments.append(toNumpy(state.q()));
    return read((*function_)(*arguments), state.dofs());
  }

 private:
  /// Reads y or (y, J). Two numbers in a tuple are a y.
  FeatureValue read(nb::object result, int dofs) const {
    Numbers y, J;
    const bool two = nb::isinstance<nb::tuple>(result) && nb::len(result) == 2;
    const bool pair = two && readNumbers(result[1], J) && J.rank > 0;
    if (!readNumbers(pair ? nb::object(result[0]) : result, y) || y.rank > 1) {
      throw ValueError(cat("feature ", name_, " returned ", typeName(result),
                           y.rank > 1 ? cat(" of rank ", y.rank) : "",
                           "; expected y, a number or (d,) numbers, or (y, J)"));
    }
    if (!pair) return {y.values};
    const Eigen::Index rows = y.values.size();
    const bool row = J.rank == 1 && rows == 1 && J.values.size() == dofs;
    if (!row && (J.rank != 2 || Eigen::Index(J.rows) != rows || J.values.size() != rows * dofs)) {
      throw ValueError(cat("feature ", name_, " returned a Jacobian of ",
                           J.rank == 1 ? cat(J.values.size(), " numbers") : cat(J.rows, " x ", J.columns()),
                           "; expected ", rows, " x ", dofs, ", one row per component and one column per dof"));
    }
    return {y.values, Eigen::Map<const FeatureRows>(J.values.data(), rows, dofs)};
  }

  static std::string typeName(const nb::object& object) {
    return nb::cast<std::string>(object.type().attr("__name__"));
  }

  std::shared_ptr<const nb::object> function_;
  std::string name_;
};

/// A custom feature that is evaluated under the interpreter lock.
class PythonFeature final : public Feature {
 public:
  explicit PythonFeature(std::unique_ptr<Feature> feature) : feature_(std::move(feature)) {}

  int rows() const override { return feature_->rows(); }

  void eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const override {
    if (!callUser([&] { feature_->eval(states, tau, y, J); })) throw EvaluationCancelled();
  }

 private:
  std::unique_ptr<Feature> feature_;
};

std::string nameOf(const nb::object& function) {
  return nb::cast<std::string>(nb::str(nb::getattr(function, "__name__", nb::getattr(function.type(), "__name__"))));
}

Array pointJacobian(const FrameView& view, const Numbers& point) {
  if (point.values.size() != 3)
    throw ValueError(cat("getPositionJacobian: point has ", point.values.size(), " numbers; expected 3"));
  FeatureRows J = FeatureRows::Zero(3, view.state->dofs());
  view.state->addPointJacobian(view.frame, view.state->pose(view.frame) * Vector3d(point.values), 1., J);
  return toNumpy(J);
}

Array angularJacobian(const FrameView& view) {
  FeatureRows J = FeatureRows::Zero(3, view.state->dofs());
  view.state->addAngularJacobian(view.frame, 1., J);
  return toNumpy(J);
}

}  // namespace

namespace {

struct PythonFeatureMaker {
  std::shared_ptr<const nb::object> function;
  std::string name;

  std::unique_ptr<Feature> operator()(const std::vector<int>& frames, const State& state) const {
    const nb::gil_scoped_acquire lock;
    return std::make_unique<PythonFeature>(makeCustomFeature(name, PythonFunction(function, name), frames, state));
  }
};

}  // namespace

FeatureSource customFeature(nb::object function) {
  std::string name = nameOf(function);
  return {name, PythonFeatureMaker{sharedObject(std::move(function)), name}};
}

nb::object functionOf(const FeatureSource& source) {
  const FeatureSource::Make* make = source.maker();
  const auto* custom = make ? make->target<PythonFeatureMaker>() : nullptr;
  return custom ? *custom->function : nb::none();
}

void bindCustomFeatures(nb::module_& m) {
  nb::class_<FrameView>(m, "FrameView", "A frame at one configuration, the argument of a custom feature.")
      .def_prop_ro(
          "name", [](const FrameView& v) { return v.state->model().frame_name[v.frame]; }, "The frame's name.")
      .def(
          "getJointState", [](const FrameView& v) { return toNumpy(v.state->q()); },
          "q of the scene, shape (n,), rad or m.")
      .def(
          "getPosition", [](const FrameView& v) { return toNumpy(VectorXd(v.state->position(v.frame))); },
          "World position, shape (3,), m.")
      .def(
          "getQuaternion",
          [](const FrameView& v) { return toNumpy(VectorXd(wxyz(Quaterniond(v.state->pose(v.frame).R)))); },
          "World rotation, shape (4,): w x y z.")
      .def(
          "getPose", [](const FrameView& v) { return toNumpy(VectorXd(Pose(v.state->pose(v.frame)).numbers())); },
          "World pose, shape (7,): x y z (m) qw qx qy qz.")
      .def(
          "getRotationMatrix", [](const FrameView& v) { return toNumpy(MatrixXd(v.state->pose(v.frame).R)); },
          "World rotation, shape (3, 3); its columns are the frame's axes.")
      .def("getPositionJacobian", pointJacobian, "point"_a = nb::make_tuple(0., 0., 0.),
           docs::custom_features::getPositionJacobian)
      .def("getAngularJacobian", angularJacobian,
           "The world angular velocity of the frame per velocity of q, shape (3, n), rad per rad or m.")
      .def("__repr__",
           [](const FrameView& v) { return cat("<FrameView '", v.state->model().frame_name[v.frame], "'>"); });
}

}  // namespace kinegraph::python
