#include <nanobind/stl/string.h>

#include "bindings.h"
#include "features/custom_features_docs.h"
#include "features/feature_arguments.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

using FeatureRows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A frame as a function of one's own sees it. It shares a State that nobody changes, so it may be kept.
struct FrameView {
  std::shared_ptr<const State> state;
  int frame;
};

/// A Python object that is released under the interpreter lock, wherever the last owner lets go of it.
std::shared_ptr<const nb::object> sharedObject(nb::object object) {
  return {new nb::object(std::move(object)), [](const nb::object* held) {
            const nb::gil_scoped_acquire lock;
            delete held;
          }};
}

/// A feature that a Python function of frames computes. Its Jacobian is what the function returns beside the value, or
/// that of central differences over the dofs that move the frames.
class CustomFeature final : public Feature {
 public:
  CustomFeature(std::shared_ptr<const nb::object> function, std::string name, std::vector<int> frames,
                const State& scene)
      : function_(std::move(function)), name_(std::move(name)), frames_(std::move(frames)) {
    rows_ = int(call(scene).y.size());
  }

  int rows() const override { return rows_; }

  void eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const override {
    if (!callUser([&] { compute(*states[0], y, J); })) throw EvaluationCancelled();
  }

 private:
  struct Returned {
    VectorXd y;
    Numbers J;  ///< rank 0: left out
  };

  void compute(const State& state, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
    const Returned returned = checked(call(state));
    y = returned.y;
    if (!J) return;
    if (returned.J.rank == 0) {
      addDifferences(state, *J);
    } else {
      *J += Eigen::Map<const FeatureRows>(returned.J.values.data(), rows_, state.dofs());
    }
  }

  Returned call(const State& state) const {
    const auto shared = std::make_shared<const State>(state);
    nb::list arguments;
    for (int frame : frames_) arguments.append(nb::cast(FrameView{shared, frame}));
    if (frames_.empty()) arguments.append(toNumpy(state.q()));
    return read((*function_)(*arguments), state.dofs());
  }

  /// y or (y, J). Two numbers in a tuple are a y.
  Returned read(nb::object result, int dofs) const {
    Numbers y, J;
    const bool two = nb::isinstance<nb::tuple>(result) && nb::len(result) == 2;
    const bool pair = two && readNumbers(result[1], J) && J.rank > 0;
    if (!readNumbers(pair ? nb::object(result[0]) : result, y) || y.rank > 1) {
      throw ValueError(cat("feature ", name_, " returned ", typeName(result),
                           y.rank > 1 ? cat(" of rank ", y.rank) : "",
                           "; expected y, a number or (d,) numbers, or (y, J)"));
    }
    if (!pair) return {y.values, {}};
    const Eigen::Index rows = y.values.size();
    const bool row = J.rank == 1 && rows == 1 && J.values.size() == dofs;
    if (!row && (J.rank != 2 || Eigen::Index(J.rows) != rows || J.values.size() != rows * dofs)) {
      throw ValueError(cat("feature ", name_, " returned a Jacobian of ",
                           J.rank == 1 ? cat(J.values.size(), " numbers") : cat(J.rows, " x ", J.columns()),
                           "; expected ", rows, " x ", dofs, ", a row per entry of y and a column per dof"));
    }
    return {y.values, J};
  }

  static std::string typeName(const nb::object& object) {
    return nb::cast<std::string>(object.type().attr("__name__"));
  }

  Returned checked(Returned returned) const {
    if (returned.y.size() == rows_) return returned;
    throw ValueError(cat("feature ", name_, " returned ", returned.y.size(), " numbers; the first time ", rows_));
  }

  void addDifferences(const State& state, JacobianRows& J) const {
    State moved = state;
    VectorXd q = state.q();
    for (int dof : movingDofs(state)) {
      const double at = q[dof], step = 1e-5 * std::max(1., std::abs(at));
      const auto value = [&](double to) {
        q[dof] = to;
        moved.setJoints(q.data());
        return checked(call(moved)).y;
      };
      const VectorXd plus = value(at + step), minus = value(at - step);
      q[dof] = at;
      J.col(dof) += (plus - minus) / (2. * step);
    }
  }

  std::vector<int> movingDofs(const State& state) const {
    const KinematicModel& model = state.model();
    std::vector<bool> moves(std::size_t(model.dofs), frames_.empty());
    for (int frame : frames_) {
      for (int c = model.last_column[state.link(frame)]; c >= 0; c = model.column_before[c])
        moves[model.column_dof[c]] = true;
    }
    std::vector<int> dofs;
    for (int dof = 0; dof < model.dofs; ++dof) {
      if (moves[dof]) dofs.push_back(dof);
    }
    return dofs;
  }

  std::shared_ptr<const nb::object> function_;
  std::string name_;
  std::vector<int> frames_;
  int rows_ = 0;
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

struct OwnFeatureMaker {
  std::shared_ptr<const nb::object> function;
  std::string name;

  std::unique_ptr<Feature> operator()(const std::vector<int>& frames, const State& state) const {
    const nb::gil_scoped_acquire lock;
    return std::make_unique<CustomFeature>(function, name, frames, state);
  }
};

}  // namespace

FeatureSource ownFeature(nb::object function) {
  std::string name = nameOf(function);
  return {name, OwnFeatureMaker{sharedObject(std::move(function)), name}};
}

nb::object functionOf(const FeatureSource& source) {
  const FeatureSource::Make* make = source.maker();
  const auto* own = make ? make->target<OwnFeatureMaker>() : nullptr;
  return own ? *own->function : nb::none();
}

void bindOwnFeatures(nb::module_& m) {
  nb::class_<FrameView>(m, "FrameView", "A frame at one configuration, as a feature of your own sees it.")
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
           docs::own_features::getPositionJacobian)
      .def("getAngularJacobian", angularJacobian,
           "The world angular velocity of the frame per velocity of q, shape (3, n), rad per rad or m.")
      .def("__repr__",
           [](const FrameView& v) { return cat("<FrameView '", v.state->model().frame_name[v.frame], "'>"); });
}

}  // namespace kinegraph::python
