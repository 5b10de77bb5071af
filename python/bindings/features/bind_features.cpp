#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "features/feature_arguments.h"
#include "features/features_docs.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"

namespace kinegraph::python {

FeatureSource FeatureArgument::source() const {
  return function.is_valid() ? customFeature(function) : FeatureSource(symbol);
}

std::vector<std::string> toNames(const FrameNames& frames) {
  if (const auto* name = std::get_if<std::string>(&frames)) return {*name};
  return std::get<std::vector<std::string>>(frames);
}

MatrixXd toScale(const std::optional<Numbers>& scale) {
  if (!scale) return MatrixXd();
  return scale->rank < 2 ? MatrixXd(scale->values) : scale->matrix();
}

VectorXd toTarget(const std::optional<Numbers>& target) { return target ? target->values : VectorXd(); }

namespace {

/// A feature of named frames, which can be evaluated on any configuration.
struct NamedFeature {
  FeatureSource source;
  std::vector<std::string> frames;
  MatrixXd scale;
  VectorXd target;
  int order = -1;
  mutable ReusedArrays y = {}, J = {};
};

using Evaluated = nb::typed<nb::tuple, Array, Array>;

/// Evaluates directly into the arrays that are returned.
Evaluated evalInto(const PyConfig& config, Residual& residual, ReusedArrays& value, ReusedArrays& derivative) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const std::size_t rows = std::size_t(residual.rows()), columns = std::size_t(config.getJointDimension());
  const NewArray y = value.get(rows), J = derivative.get(rows, columns);
  Eigen::Map<RowMajor> jacobian(J.data, Eigen::Index(rows), Eigen::Index(columns));
  jacobian.setZero();
  JacobianRows view = jacobian;
  eval(config, residual, Eigen::Map<VectorXd>(y.data, Eigen::Index(rows)), view);
  return nb::make_tuple(y.array, J.array);
}

Evaluated evalInto(const PyConfig& config, Residual& residual) {
  ReusedArrays value, derivative;
  return evalInto(config, residual, value, derivative);
}

Evaluated evalFeature(const PyConfig& config, const Unread<FeatureArgument>& feature, const Unread<FrameNames>& frames,
                      const std::optional<Numbers>& scale, const std::optional<Numbers>& target, int order) {
  const State& scene = config.state();
  if (RecentCalls::Call* call = config.calls.find(scene, feature.object, frames.object, order)) {
    Residual& residual = *call->residual;
    if (scale || residual.scale().size() > 0) residual.setScale(toScale(scale));
    if (target || residual.target().size() > 0) residual.setTarget(toTarget(target));
    return evalInto(config, residual, call->y, call->J);
  }
  const FeatureArgument argument = feature.read();
  const std::vector<std::string> names = toNames(frames.read());
  if (argument.function.is_valid()) {
    Residual custom = makeResidual(scene, argument.source(), names, toScale(scale), toTarget(target), order);
    return evalInto(config, custom);
  }
  const auto& residual = config.residuals.get(scene, argument.symbol, names, toScale(scale), toTarget(target), order);
  RecentCalls::Call* call = config.calls.add(scene, feature.object, frames.object, order, residual);
  return call ? evalInto(config, *residual, call->y, call->J) : evalInto(config, *residual);
}

Evaluated evalNamed(const NamedFeature& f, const PyConfig& config) {
  if (const auto symbol = f.source.symbol()) {
    return evalInto(config, *config.residuals.get(config.state(), *symbol, f.frames, f.scale, f.target, f.order), f.y,
                    f.J);
  }
  Residual custom = makeResidual(config.state(), f.source, f.frames, f.scale, f.target, f.order);
  return evalInto(config, custom);
}

std::string describeFeature(const NamedFeature& f) {
  return cat(f.source.name(), "(", join(f.frames), ")", f.order > 0 ? cat(", order ", f.order) : "");
}

}  // namespace

void bindFeatures(nb::module_& m, nb::class_<PyConfig>& config) {
  auto symbols = nb::enum_<FeatureSymbol>(m, "FS", nb::is_arithmetic(), "Feature symbols.");
  for (const auto& [name, symbol] : featureNames()) symbols.value(name.c_str(), symbol, featureInfo(symbol).value);

  bindCustomFeatures(m);
  nb::class_<NamedFeature>(m, "Feature", "A feature of named frames, which can be evaluated on any configuration.")
      .def("eval", evalNamed, "config"_a, docs::features::evalOf)
      .def(
          "setScale",
          [](NamedFeature& f, const Numbers& scale) -> NamedFeature& { return f.scale = toScale(scale), f; }, "scale"_a,
          nb::rv_policy::none, docs::features::setScale)
      .def(
          "setTarget",
          [](NamedFeature& f, const Numbers& target) -> NamedFeature& { return f.target = target.values, f; },
          "target"_a, nb::rv_policy::none, docs::features::setTarget)
      .def(
          "setOrder", [](NamedFeature& f, int order) -> NamedFeature& { return f.order = order, f; }, "order"_a,
          nb::rv_policy::none, docs::features::setOrder)
      .def(
          "dim",
          [](const NamedFeature& f, const PyConfig& c) {
            return makeResidual(c.state(), f.source, f.frames, f.scale, f.target, f.order).rows();
          },
          "config"_a, docs::features::dim)
      .def(
          "description", [](const NamedFeature& f, const PyConfig&) { return describeFeature(f); }, "config"_a,
          docs::features::description)
      .def("__repr__", [](const NamedFeature& f) { return cat("<Feature ", describeFeature(f), ">"); });

  config
      .def("eval", evalFeature, "featureSymbol"_a, "frames"_a = std::vector<std::string>(), "scale"_a = nb::none(),
           "target"_a = nb::none(), "order"_a = -1, docs::features::eval)
      .def(
          "feature",
          [](const PyConfig& c, const FeatureArgument& feature, const FrameNames& frames,
             const std::optional<Numbers>& scale, const std::optional<Numbers>& target, int order) {
            NamedFeature f{feature.source(), toNames(frames), toScale(scale), toTarget(target), order};
            makeResidual(c.state(), f.source, f.frames, f.scale, f.target, f.order);  // reports errors now
            return f;
          },
          "featureSymbol"_a, "frames"_a = std::vector<std::string>(), "scale"_a = nb::none(), "target"_a = nb::none(),
          "order"_a = -1, docs::features::feature);
}

}  // namespace kinegraph::python
