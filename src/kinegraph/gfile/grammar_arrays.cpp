#include <limits>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/grammar.h"
#include "kinegraph/gfile/typed_array.h"

namespace kinegraph::inline gfile_internal {

/// The elements read from an array: as numbers, as strings, and as values.
struct Grammar::ArrayParts {
  NumberArray numbers;
  StringArray strings;
  ValueList list;
  std::size_t row_length = 0, row_start = 0;
  bool nested = false;

  Value value() && {
    Value value;
    if (nested) {
      value.data = std::move(list);
    } else if (!strings.empty()) {
      value.data = std::move(strings);
    } else {
      if (row_length > 0) numbers.rows = int(numbers.numbers.size() / row_length);
      value.data = std::move(numbers);
    }
    return value;
  }
};

Value Grammar::parseArray() {
  const Level level(*this);
  const std::size_t opened_at = at_++;
  ArrayParts parts;
  skipInArray();
  if (peek() == '<') parseAngle();  // a type and dimensions, as exporters write; redundant
  for (;;) {
    skipInArray();
    if (atEnd()) fail(opened_at, "this '[' is never closed");
    if (peek() == ']') break;
    if (peek() == ';') {
      ++at_;
      if (parts.numbers.numbers.size() > parts.row_start) endRow(parts, opened_at);
      continue;
    }
    const std::size_t start = at_;
    Value element = parseElement(parts);
    if (const std::string* word = element.as<std::string>()) {
      if (!parts.numbers.numbers.empty() && !parts.nested) fail(start, cat("'", *word, "' in an array of numbers"));
      parts.strings.push_back(*word);
    } else if (const double* number = element.as<double>()) {
      if (!parts.strings.empty() && !parts.nested) fail(start, "a number in an array of strings");
      parts.numbers.numbers.push_back(*number);
    } else {
      parts.nested = true;
    }
    parts.list.push_back(std::move(element));
  }
  ++at_;
  if (parts.row_length > 0 && parts.numbers.numbers.size() > parts.row_start) endRow(parts, opened_at);
  Value value = std::move(parts).value();
  try {
    decodeTypedArray(value);
  } catch (const ValueError& error) {
    fail(opened_at, error.what());
  }
  return value;
}

Value Grammar::parseElement(ArrayParts& parts) {
  static constexpr CharSet kWordEnds(" \t\r\n,;]"), kNumberEnds(" \t\r\n,;]#");
  const char c = peek();
  const std::size_t start = at_;
  Value element;
  element.where = position(at_);
  const bool textual = !parts.strings.empty();
  if (c == '[' || c == '{') {
    element.data = parseValue().data;
  } else if (c == '"' || c == '\'') {
    element.data = parseQuoted(c);
  } else if (textual && !parts.nested && !isOneOf(c, "}()<>:=")) {
    element.data = parseWord(kWordEnds);
  } else if (startsNumber(c)) {
    element.data = parseNumber(kNumberEnds);
  } else if (startsWord(c)) {
    const std::string word = parseWord(kWordEnds);
    const bool among_numbers = !parts.list.empty() && !textual;
    if (among_numbers && word == "inf") {
      element.data = std::numeric_limits<double>::infinity();
    } else if (among_numbers && word == "nan") {
      element.data = std::numeric_limits<double>::quiet_NaN();
    } else {
      element.data = word;
    }
  } else {
    fail(start, cat("'", c, "' in an array; expected numbers or strings up to ']'"));
  }
  return element;
}

void Grammar::endRow(ArrayParts& parts, std::size_t opened_at) const {
  const std::size_t length = parts.numbers.numbers.size() - parts.row_start;
  if (parts.row_length > 0 && length != parts.row_length) {
    fail(opened_at, cat("rows of different length in an array: ", parts.row_length, " and ", length));
  }
  parts.row_length = length;
  parts.row_start = parts.numbers.numbers.size();
}

}  // namespace kinegraph::inline gfile_internal
