#include "pickling.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "features/feature_arguments.h"
#include "kinegraph/features/forces.h"
#include "kinegraph/features/recipe.h"

namespace kinegraph::python {

nb::tuple contactState(const ContactForce& c) {
  return nb::make_tuple(c.object, c.from, c.point, c.dofs, c.unit, c.is_free);
}

ContactForce contactFrom(nb::handle t) {
  return {nb::cast<int>(t[0]), nb::cast<int>(t[1]),    nb::cast<int>(t[2]),
          nb::cast<int>(t[3]), nb::cast<double>(t[4]), nb::cast<bool>(t[5])};
}

nb::object featureState(const FeatureSource& feature) {
  if (feature.symbol()) return nb::int_(int(*feature.symbol()));
  const FeatureRecipe* recipe = feature.recipe();
  if (!recipe) return functionOf(feature);
  const nb::object contact = recipe->contact ? nb::object(contactState(*recipe->contact)) : nb::none();
  return nb::make_tuple(recipe->name, contact, recipe->parameter);
}

FeatureSource featureFrom(nb::object object) {
  if (nb::isinstance<nb::int_>(object)) return FeatureSymbol(nb::cast<int>(object));
  if (!nb::isinstance<nb::tuple>(object)) return customFeature(object);
  FeatureRecipe recipe{nb::cast<std::string>(object[0]), {}, nb::cast<double>(object[2])};
  if (!nb::object(object[1]).is_none()) recipe.contact = contactFrom(object[1]);
  return recipe;
}

MatrixXd matrixFrom(nb::handle array) {
  const auto [rows, columns] = nb::cast<std::pair<Eigen::Index, Eigen::Index>>(array.attr("shape"));
  const Numbers numbers = nb::cast<Numbers>(array);
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(numbers.values.data(),
                                                                                                  rows, columns);
}

}  // namespace kinegraph::python
