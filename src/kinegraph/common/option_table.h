#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

/// The valid numbers of an option.
struct OptionRange {
  bool (*contains)(double value);
  const char* expected;  ///< description for messages

  static constexpr OptionRange any(const char* expected = "a number") {
    return {[](double v) { return !std::isnan(v); }, expected};
  }
  static constexpr OptionRange finite(const char* expected = "a finite number") {
    return {[](double v) { return std::isfinite(v); }, expected};
  }
  static constexpr OptionRange positive(const char* expected = "a positive number") {
    return {[](double v) { return v > 0. && std::isfinite(v); }, expected};
  }
  static constexpr OptionRange notNegative(const char* expected = "a number >= 0") {
    return {[](double v) { return v >= 0. && std::isfinite(v); }, expected};
  }
  static constexpr OptionRange atLeastOne(const char* expected = "at least 1") {
    return {[](double v) { return v >= 1. && std::isfinite(v); }, expected};
  }
  static constexpr OptionRange aboveOne(const char* expected = "a number > 1") {
    return {[](double v) { return v > 1. && std::isfinite(v); }, expected};
  }
  static constexpr OptionRange belowOne(const char* expected = "a number >= 0 and < 1") {
    return {[](double v) { return v >= 0. && v < 1.; }, expected};
  }
  static constexpr OptionRange betweenZeroAndOne(const char* expected = "a number > 0 and < 1") {
    return {[](double v) { return v > 0. && v < 1.; }, expected};
  }
};

/// A table of the fields of an options struct, which C++ and Python use to check, document, print and store them. The
/// struct has the defaults. `More` are types of fields other than numbers, bools and strings.
template <class Options, class... More>
class OptionTable {
 public:
  using Member = std::variant<double Options::*, int Options::*, bool Options::*, std::uint64_t Options::*,
                              std::string Options::*, More Options::*...>;

  struct Row {
    Row(const char* name, Member member, const char* unit, const char* doc, OptionRange range = OptionRange::any())
        : name(name), member(member), unit(unit), doc(doc), range(range) {}

    /// A string field with the values `choices`.
    Row(const char* name, std::string Options::*member, const char* unit, const char* doc,
        std::vector<std::string> choices)
        : Row(name, Member(member), unit, doc) {
      this->choices = std::move(choices);
    }

    const char* name;
    Member member;
    const char* unit;   ///< "" for none
    const char* doc;    ///< a sentence
    OptionRange range;  ///< of numbers
    std::vector<std::string> choices;
  };

  /// `place` is the start of messages.
  OptionTable(const char* place, std::vector<Row> rows) : place_(place), rows_(std::move(rows)) {}

  const char* place() const { return place_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// Returns a field. Throws ValueError for an unknown option, with similar names from the table and `others`.
  const Row& row(const std::string& name, const std::vector<std::string>& others = {}) const {
    std::vector<std::string> names = others;
    for (const Row& row : rows_) {
      if (row.name == name) return row;
      names.push_back(row.name);
    }
    throw ValueError(cat(place_, ": there is no option '", name, "'", similarHint(name, names)));
  }

  /// Throws ValueError with the first invalid field, in the order of the table.
  void validate(const Options& options) const {
    for (const Row& row : rows_) std::visit([&](auto member) { check(row, options.*member); }, row.member);
  }

 private:
  template <class Value>
  void check(const Row& row, const Value& value) const {
    if constexpr (std::is_same_v<Value, std::string>) {
      if (std::find(row.choices.begin(), row.choices.end(), value) == row.choices.end())
        throw ValueError(cat(place_, ": option ", row.name, " is '", value, "'; expected one of ", join(row.choices)));
    } else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, int>) {
      if (!row.range.contains(double(value)))
        throw ValueError(cat(place_, ": option ", row.name, " is ", value, "; expected ", row.range.expected,
                             *row.unit ? cat(", in ", row.unit) : ""));
    }
  }

  const char* place_;
  std::vector<Row> rows_;
};

}  // namespace kinegraph
