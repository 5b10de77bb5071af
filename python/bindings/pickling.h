#pragma once

#include "arrays.h"
#include "kinegraph/features/feature_source.h"
#include "kinegraph/features/forces.h"

namespace kinegraph::python {

/// Converts a feature to a picklable object: a number for a symbol, a tuple for a recipe, or a Python function.
nb::object featureState(const FeatureSource& feature);
FeatureSource featureFrom(nb::object state);

nb::tuple contactState(const ContactForce& contact);
ContactForce contactFrom(nb::handle state);

/// An array of shape (rows, columns); rows or columns may be 0.
MatrixXd matrixFrom(nb::handle array);

}  // namespace kinegraph::python
