#pragma once

#include <nanobind/stl/string.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/option_table.h"

namespace kinegraph::python {

/// Converts a field's value from Python. Accepts 1e3 and 1.0 as integers, and 0 and 1 as booleans.
template <class T>
T optionValue(const std::string& where, nb::handle value) {
  T out{};
  if (nb::try_cast(value, out)) return out;
  if constexpr (!std::is_same_v<T, double> && !std::is_same_v<T, std::string>) {
    double number = 0.;
    constexpr double kLargest = std::is_same_v<T, bool> ? 1. : 1e9;
    const bool is_whole = nb::try_cast(value, number) && number == std::floor(number) && std::abs(number) <= kLargest;
    if (is_whole) return T(int(number));
  }
  const char* expected = std::is_same_v<T, bool>          ? "True or False"
                         : std::is_same_v<T, double>      ? "a number"
                         : std::is_same_v<T, std::string> ? "a text"
                                                          : "a whole number";
  if constexpr (std::is_enum_v<T>)
    throw ValueError(cat(where, " is ", nb::cast<std::string>(nb::repr(value)), "; expected one of ",
                         nb::cast<std::string>(nb::type<T>().attr("__name__")), ": ",
                         nb::cast<std::string>(nb::str(", ").attr("join")(nb::type<T>().attr("__members__")))));
  throw ValueError(cat(where, " is ", nb::cast<std::string>(nb::repr(value)), "; expected ", expected));
}

/// Python interface of an options struct, derived from its table of fields.
template <class Options, class... More>
class OptionClass {
 public:
  using Table = OptionTable<Options, More...>;

  /// Names beyond the table, and their setter.
  struct MoreNames {
    std::vector<std::string> names = {};
    std::function<void(const OptionClass&, Options&, const std::string& name, nb::handle value)> set = {};
  };

  explicit OptionClass(const Table& table, MoreNames more = {}) : table_(table), more_(std::move(more)) {}

  /// Sets a field without validation.
  void setField(Options& options, const std::string& name, nb::handle value) const {
    if (std::find(more_.names.begin(), more_.names.end(), name) != more_.names.end())
      return more_.set(*this, options, name, value);
    requireKnown(name);
    const auto& row = table_.row(name, more_.names);
    std::visit(
        [&](auto member) {
          using Value = std::decay_t<decltype(options.*member)>;
          options.*member = optionValue<Value>(cat(table_.place(), ": option ", name), value);
        },
        row.member);
  }

  /// Throws ValueError with all names for an unknown option that is similar to none.
  void requireKnown(const std::string& name) const {
    std::vector<std::string> names = more_.names;
    for (const auto& row : table_.rows()) names.push_back(row.name);
    if (std::find(names.begin(), names.end(), name) == names.end() && similarNames(name, names).empty())
      throw ValueError(cat(table_.place(), ": there is no option '", name, "'; expected one of ", join(names)));
  }

  /// Sets all fields, or none if one is invalid.
  void setFields(Options& options, nb::dict given) const {
    Options changed = options;
    for (const auto& [name, value] : given) setField(changed, nb::cast<std::string>(name), value);
    changed.validate();
    options = std::move(changed);
  }

  nb::dict dict(const Options& options) const {
    nb::dict all;
    for (const auto& row : table_.rows())
      std::visit([&](auto member) { all[row.name] = nb::cast(options.*member); }, row.member);
    return all;
  }

  /// "Name(field=value, ...)"
  std::string text(const char* name, const Options& options) const {
    std::vector<std::string> words;
    for (const auto& [field, value] : dict(options))
      words.push_back(cat(nb::cast<std::string>(field), "=", nb::cast<std::string>(nb::repr(value))));
    return cat(name, "(", join(words), ")");
  }

  /// Describes the fields, one line each: name, default, unit and meaning.
  std::string docs(const char* indent = "    ") const {
    std::string text;
    for (const auto& row : table_.rows()) text += cat(indent, row.name, ": ", doc(row), "\n");
    return text;
  }

  /// Adds the common interface of options classes: fields by name, dict(), ==, repr, pickling. `start` creates the
  /// initial values.
  void bind(nb::class_<Options>& options, const char* name, std::function<Options()> start) const {
    const OptionClass self = *this;
    options
        .def(
            "__init__",
            [self, start](Options* made, nb::kwargs given) {
              Options filled = start();
              self.setFields(filled, given);
              new (made) Options(std::move(filled));
            },
            "fields"_a,
            "Creates the defaults with some fields changed.\n\nArgs:\n    fields: Values by name.\nRaises:\n    "
            "ArgumentError: A field does not exist or cannot have its value.")
        .def(
            "dict", [self](const Options& o) { return Attributes(self.dict(o)); }, "Returns all fields as a dict.")
        .def(
            "__eq__",
            [self](const Options& a, nb::handle b) {
              return nb::isinstance<Options>(b) && self.dict(a).equal(self.dict(nb::cast<const Options&>(b)));
            },
            "other"_a)
        .def("__repr__", [self, name](const Options& o) { return self.text(name, o); })
        .def("__getstate__", [self](const Options& o) { return self.dict(o); })
        .def(
            "__setstate__",
            [self](Options& o, nb::dict state) {
              new (&o) Options();
              self.setFields(o, state);
            },
            "state"_a);
    for (const auto& row : table_.rows()) {
      std::visit(
          [&](auto member) {
            options.def_prop_rw(
                row.name, [member](const Options& o) { return o.*member; },
                [self, field = row.name](Options& o, nb::object value) {
                  nb::dict one;
                  one[field] = value;
                  self.setFields(o, one);
                },
                doc(row).c_str());
          },
          row.member);
    }
  }

 private:
  static std::string doc(const typename Table::Row& row) {
    const Options defaults;
    std::string value;
    std::visit([&](auto member) { value = nb::cast<std::string>(nb::str(nb::cast(defaults.*member))); }, row.member);
    return cat(row.doc, " Default ", value, *row.unit ? cat(", in ", row.unit) : "", ".");
  }

  const Table& table_;
  MoreNames more_;
};

template <class Options, class... More, class... Rest>
OptionClass(const OptionTable<Options, More...>&, Rest...) -> OptionClass<Options, More...>;

}  // namespace kinegraph::python
