#include "kinegraph/geometry/files/grid_file.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/h5_file.h"
#include "kinegraph/geometry/shapes/isosurface.h"

namespace kinegraph::inline geometry_internal {

namespace {

struct Table {
  std::vector<double> dims, numbers;
};

/// Reads consecutive named tables of numbers.
class TableReader {
 public:
  explicit TableReader(const std::string& path) : path_(path) {
    std::ifstream stream(path, std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }

  std::map<std::string, Table> read() {
    std::map<std::string, Table> tables;
    skip(kSeparators);
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find_first_of(":<[\n\r\t {}", at_), text_.size());
      const std::string name = text_.substr(at_, end - at_);
      at_ = end;
      skip(" \t\r\n:");
      tables[name] = table(name);
      skip(kSeparators);
    }
    return tables;
  }

 private:
  static constexpr const char* kSeparators = " \t\r\n,;{}";

  void skip(const char* characters) { at_ = std::min(text_.find_first_not_of(characters, at_), text_.size()); }
  char next() const { return at_ < text_.size() ? text_[at_] : '\n'; }

  [[noreturn]] void fail(const std::string& name, const std::string& what) const {
    throw FileError(cat("grid file '", path_, "': '", name, "' ", what));
  }

  Table table(const std::string& name) {
    Table table;
    if (next() == '<') table.dims = numbers(name, '<', '>');
    skip(" \t\r\n");
    if (at_ < text_.size() && next() == '\0') {
      table.numbers = floats(name, table.dims);
    } else if (next() == '[') {
      ++at_;
      skip(" \t\r\n");
      if (next() == '<') table.dims = numbers(name, '<', '>');
      --at_;
      table.numbers = numbers(name, text_[at_], ']');
    } else {
      fail(name, "is not followed by numbers in [ ]");
    }
    return table;
  }

  /// Reads the numbers up to `close`; the character at the current position is skipped.
  std::vector<double> numbers(const std::string& name, char open, char close) {
    std::vector<double> list;
    for (++at_; skip(" \t\r\n,;"), next() != close;) {
      double number;
      const char* from = text_.data() + at_;
      const auto [end, status] = std::from_chars(from, text_.data() + text_.size(), number);
      if (status != std::errc())
        fail(name, cat("has a non-number after ", list.size(), " numbers in ", open, " ", close));
      list.push_back(number);
      at_ += std::size_t(end - from);
    }
    ++at_;
    return list;
  }

  std::vector<double> floats(const std::string& name, const std::vector<double>& dims) {
    double count = dims.empty() ? 0. : 1.;
    for (const double n : dims) count *= n;
    if (!(count >= 1. && double(text_.size() - at_) >= 4. * count + 2.))
      fail(name, cat("is shorter than the ", count, " floats in its header"));
    std::vector<double> list(static_cast<std::size_t>(count));
    const char* from = text_.data() + at_ + 1;
    for (double& number : list) {
      float value;
      std::memcpy(&value, from, sizeof(value));
      number = value;
      from += sizeof(value);
    }
    at_ += 4 * list.size() + 1;
    if (next() != '\0') fail(name, cat("does not end after the ", count, " floats in its header"));
    ++at_;
    return list;
  }

  const std::string& path_;
  std::string text_;
  std::size_t at_ = 0;
};

std::string listed(const std::vector<double>& numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(cat(number));
  return join(texts, " ");
}

std::map<std::string, Table> readH5Tables(const std::string& path) {
  const H5File file(path);
  std::map<std::string, Table> tables;
  for (const char* name : {"lo", "up", "bounds", "field"}) {
    if (!file.contains(name)) continue;
    const H5Dataset data = file.dataset(name);
    tables[name] = {{data.dims.begin(), data.dims.end()}, data.numbers};
  }
  return tables;
}

}  // namespace

GridFile readGridFile(const std::string& path) {
  const auto fail = [&](const std::string& what) { throw FileError(cat("grid file '", path, "'", what)); };
  if (!std::filesystem::is_regular_file(path)) fail(" does not exist");
  std::map<std::string, Table> tables = path.ends_with(".h5") ? readH5Tables(path) : TableReader(path).read();
  if (tables.contains("sdf") && !tables.contains("field")) tables["field"] = tables["sdf"];
  std::vector<double> low = tables["lo"].numbers, high = tables["up"].numbers;
  if (const auto& bounds = tables["bounds"].numbers; bounds.size() == 6) {
    low.assign(bounds.begin(), bounds.begin() + 3);
    high.assign(bounds.begin() + 3, bounds.end());
  }
  const Table& field = tables["field"];
  if (low.size() != 3 || high.size() != 3 || field.numbers.empty()) {
    std::vector<std::string> found;
    for (const auto& [name, table] : tables) {
      if (!table.numbers.empty()) found.push_back(name);
    }
    fail(cat(": expected lo: [x y z], up: [x y z] and field: <nx ny nz> [...]; found ",
             found.empty() ? "nothing" : join(found)));
  }
  GridFile file;
  if (field.dims.size() != 3) fail(cat(": field has ", field.dims.size(), " dimensions; expected <nx ny nz>"));
  double expected = 1.;
  for (int axis = 0; axis < 3; ++axis) {
    const double n = field.dims[std::size_t(axis)], side = high[std::size_t(axis)] - low[std::size_t(axis)];
    if (!(n >= 2. && n <= 1e6 && n == std::floor(n)))
      fail(cat(": field has ", n, " numbers along an axis; expected at least 2"));
    if (!(side > 0.) || std::abs(high[std::size_t(axis)] + low[std::size_t(axis)]) > 1e-6 * side) {
      fail(cat(": the box from ", listed(low), " to ", listed(high),
               " is not centered at the origin; move the frame and its box instead"));
    }
    file.grid.cells[std::size_t(axis)] = int(n);
    file.size[axis] = side;
    expected *= n;
  }
  if (expected != double(field.numbers.size()))
    fail(cat(": field has ", field.numbers.size(), " numbers; <", listed(field.dims), "> announces ", expected));
  file.grid.values.assign(field.numbers.begin(), field.numbers.end());
  try {
    checkGrid(file.grid);
  } catch (const ValueError& error) {
    fail(cat(": ", error.what()));
  }
  return file;
}

}  // namespace kinegraph::inline geometry_internal
