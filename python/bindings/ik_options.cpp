#include <nanobind/stl/string.h>

#include <variant>

#include "arguments.h"
#include "docs/ik.h"
#include "ik_objects.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph::python {

namespace {

using Field = std::variant<double IkOptions::*, int IkOptions::*, bool IkOptions::*, std::uint64_t IkOptions::*>;

struct NamedField {
  const char* name;
  Field field;
  const char* doc;
};

const std::vector<NamedField>& fields() {
  using O = IkOptions;
  static const std::vector<NamedField> list = {
      {"position_tolerance", &O::position_tolerance, "Error of a position that is allowed, m."},
      {"rotation_tolerance", &O::rotation_tolerance, "Error of a rotation that is allowed, rad."},
      {"attempts", &O::attempts,
       "Most starting points that are tried: the present q, then points spread evenly within the limits."},
      {"steps", &O::steps, "Most steps of an attempt towards its targets, and again out of collisions."},
      {"best", &O::best, "Makes all attempts and gives the answer nearest to the present q, instead of the first one."},
      {"collisions", &O::collisions, "True: the collidable pairs are kept apart."},
      {"margin", &O::margin, "Distance that these pairs keep, m."},
      {"start_weight", &O::start_weight, "Weight of the squared distance |q - start|^2, where answers are compared."},
      {"home_weight", &O::home_weight, "Weight of the squared distance |q - home|^2, where answers are compared."},
      {"seed", &O::seed, "Shifts the sequence of starting points."}};
  return list;
}

void setField(IkOptions& options, const std::string& name, nb::handle value) {
  std::vector<std::string> names = {"tolerance"};
  for (const NamedField& known : fields()) {
    names.push_back(known.name);
    if (name != known.name) continue;
    std::visit(
        [&](auto member) {
          using Type = std::decay_t<decltype(options.*member)>;
          if (!nb::try_cast(value, options.*member)) {
            const char* expected = std::is_same_v<Type, bool>     ? "True or False"
                                   : std::is_same_v<Type, double> ? "a number"
                                                                  : "a whole number";
            throw ValueError(
                cat("solveIk: ", name, " is ", nb::cast<std::string>(nb::repr(value)), "; expected ", expected));
          }
        },
        known.field);
    return;
  }
  if (name != "tolerance")
    throw ValueError(
        cat("solveIk: there is no option '", name, "'; expected one of ", join(names), similarHint(name, names)));
  setField(options, "position_tolerance", value);
  setField(options, "rotation_tolerance", value);
}

Attributes toDict(const IkOptions& options) {
  Attributes dict;
  for (const NamedField& known : fields()) {
    std::visit([&](auto member) { dict[known.name] = nb::cast(options.*member); }, known.field);
  }
  return dict;
}

std::string optionsText(const IkOptions& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : toDict(options)) {
    words.push_back(cat(nb::cast<std::string>(name), "=", nb::cast<std::string>(nb::repr(value))));
  }
  return cat("IkOptions(", join(words), ")");
}

}  // namespace

void setFields(IkOptions& options, nb::dict given) {
  for (const auto& [name, value] : given) setField(options, nb::cast<std::string>(name), value);
  options.validate();
}

void bindIkOptions(nb::module_& m) {
  nb::class_<IkOptions> options(
      m, "IkOptions", "Settings of solveIk; every field can be given by name. tolerance sets both tolerances.");
  options
      .def(
          "__init__",
          [](IkOptions* self, nb::kwargs given) {
            IkOptions made;
            setFields(made, given);
            new (self) IkOptions(made);
          },
          "fields"_a, docs::ik::make)
      .def("dict", toDict, "All settings as a dict.")
      .def(
          "__eq__",
          [](const IkOptions& a, nb::handle b) {
            return nb::isinstance<IkOptions>(b) && toDict(a).equal(toDict(nb::cast<const IkOptions&>(b)));
          },
          "other"_a)
      .def("__repr__", optionsText)
      .def("__getstate__", toDict)
      .def(
          "__setstate__",
          [](IkOptions& self, nb::dict state) {
            new (&self) IkOptions();
            setFields(self, state);
          },
          "state"_a);
  for (const NamedField& known : fields()) {
    const auto set = [name = known.name](IkOptions& o, nb::any value) {
      IkOptions changed = o;
      setField(changed, name, value);
      changed.validate();
      o = changed;
    };
    std::visit(
        [&](auto member) {
          options.def_prop_rw(
              known.name, [member](const IkOptions& o) { return o.*member; }, set, known.doc);
        },
        known.field);
  }
}

}  // namespace kinegraph::python
