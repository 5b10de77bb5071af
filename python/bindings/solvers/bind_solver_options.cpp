#include "defaults.h"
#include "solvers/solver_options.h"

namespace kinegraph::python {

const OptionClass<SolverOptions, OptMethod>& solverOptions() {
  using Class = OptionClass<SolverOptions, OptMethod>;
  static const Class options(solverOptionTable(),
                             {{"stepInit", "stepMin", "stopLineSteps", "stopTinySteps"},
                              [](const Class&, SolverOptions&, const std::string&, nb::handle) {}});
  return options;
}

Defaults& defaults() {
  static Defaults values;
  return values;
}

SolverOptions startingOptions() {
  static const nb::handle given =
      nb::object(nb::module_::import_("kinegraph.compatibility.parameters").attr("solver_options")).release();
  SolverOptions options;
  if (nb::len(given) > 0) solverOptions().setFields(options, nb::borrow<nb::dict>(given));
  return options;
}

void bindSolverOptions(nb::module_& m) {
  nb::enum_<OptMethod> methods(
      m, "OptMethod", nb::is_arithmetic(),
      "Solution methods. Those of older scripts that are not there are an error where they are used.");
  for (const OptMethodName& row : kOptMethods) methods.value(row.name, row.method, row.doc);

  const std::string doc =
      "Settings of a solver. Every field can be given by name, and is a property:\n\n" + solverOptions().docs();
  nb::class_<SolverOptions> options(m, "NLP_SolverOptions", doc.c_str());
  solverOptions().bind(options, "NLP_SolverOptions", startingOptions);
  for (const auto& row : solverOptionTable().rows()) {
    options.def(
        cat("set_", row.name).c_str(),
        [name = row.name](SolverOptions& o, nb::object value) -> SolverOptions& {
          solverOptions().setField(o, name, value);
          return o;
        },
        "value"_a, nb::rv_policy::none,
        cat("Sets ", row.name, ".\n\nArgs:\n    value: ", row.doc,
            "\nReturns:\n    The options themselves.\nRaises:\n    ArgumentError: It cannot have this value.")
            .c_str());
  }
}

}  // namespace kinegraph::python
