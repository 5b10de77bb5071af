#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/common/utf8.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph {

namespace {

constexpr const char* kRowKinds = "expected 3 numbers (x y z), 6 (with a normal) or 7 (x y z qw qx qy qz)";
constexpr const char* kBlanks = " \t\r";
constexpr double kLeastNorm = 1e-9;

/// A number or a name in a row.
struct RowWord {
  std::string text;
  int column;  ///< of its first character, from 1
};

std::optional<double> rowNumber(const RowWord& word) {
  const char* rest = nullptr;
  const double number = readNumber(word.text.c_str(), &rest);
  return !word.text.empty() && *rest == '\0' ? std::optional(number) : std::nullopt;
}

/// Without the quotes that some programs put around all fields.
std::string unquoted(const std::string& text) {
  const bool is_quoted = text.size() >= 2 && text.front() == text.back() && (text[0] == '"' || text[0] == '\'');
  return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// The comma, semicolon or tab between the fields of a line; 0 without one.
char separatorOf(const std::string& line, const std::string& file, int number) {
  const bool has_commas = line.find(',') != std::string::npos, has_semicolons = line.find(';') != std::string::npos;
  if (has_commas && has_semicolons)
    throw ParseError({file, number, int(line.find(',')) + 1},
                     "the row has commas and semicolons; expected one separator, and points before decimals");
  if (has_commas || has_semicolons) return has_commas ? ',' : ';';
  const std::size_t tab = line.find('\t', std::min(line.find_first_not_of(kBlanks), line.size()));
  return line.find_first_not_of(kBlanks, std::min(tab, line.size())) != std::string::npos ? '\t' : '\0';
}

/// Splits a line at a separator only. A field in quotes may contain it.
std::vector<RowWord> rowFields(const std::string& line, char separator) {
  std::vector<RowWord> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t first = std::min(line.find_first_not_of(" \r", begin), line.size());
    const std::size_t quote = first < line.size() && line[first] == '"' ? line.find('"', first + 1) : begin;
    const std::size_t end = std::min(line.find(separator, quote == std::string::npos ? begin : quote), line.size());
    const std::string field = line.substr(begin, end - begin);
    const std::size_t from = field.find_first_not_of(kBlanks), to = field.find_last_not_of(kBlanks);
    if (from == std::string::npos)
      fields.push_back({"", int(begin) + 1});
    else
      fields.push_back({unquoted(field.substr(from, to + 1 - from)), int(begin + from) + 1});
    begin = end + 1;
  }
  return fields;
}

/// Splits a line at commas or semicolons, and at spaces.
std::vector<RowWord> rowWords(const std::string& line, const std::string& file, int number) {
  const char found = separatorOf(line, file, number);
  const bool has_separator = found == ',' || found == ';';
  const char separator = has_separator ? found : ',';
  std::vector<RowWord> words;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    std::size_t at = line.find_first_not_of(" \t\r", begin);
    const bool is_empty = at == std::string::npos || at >= end;
    if (is_empty && line.find_first_not_of(" \t\r,;", begin) != std::string::npos)
      throw ParseError({file, number, int(begin) + 1}, "the field is empty; expected a number");
    while (at < end) {
      const std::size_t after = std::min(line.find_first_of(" \t\r", at), end);
      const RowWord word{unquoted(line.substr(at, after - at)), int(at) + 1};
      const bool is_second = has_separator && !words.empty() && words.back().column > int(begin);
      if (is_second && rowNumber(word) && rowNumber(words.back()))
        throw ParseError({file, number, word.column},
                         "the field has two numbers; expected one separator, and points before decimals");
      words.push_back(word);
      at = line.find_first_not_of(" \t\r", after);
    }
    begin = end + 1;
  }
  return words;
}

/// A name of a column with its unit: "x_mm", "X [mm]" and "x (m)" are x.
struct ColumnName {
  std::string name;
  double unit = 0.;  ///< m; 0 without one
};

ColumnName columnName(const std::string& text) {
  static const std::pair<const char*, double> units[] = {{"mm", 1e-3}, {"cm", 1e-2}, {"m", 1.}};
  std::string plain;
  for (const char c : text)
    if (!std::isspace(static_cast<unsigned char>(c)) && !std::strchr("()[]_/", c))
      plain += char(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [unit, meters] : units)
    if (plain.size() > std::strlen(unit) && plain.ends_with(unit) && plain.size() < text.size())
      return {plain.substr(0, plain.size() - std::strlen(unit)), meters};
  return {plain};
}

/// The columns of a table with names.
struct NamedColumns {
  std::vector<std::size_t> columns;  ///< of x y z, and nx ny nz or qw qx qy qz; none: the names say nothing
  double unit = 1.;                  ///< of x y z, m
  std::vector<RowWord> ignored;
};

/// Throws ParseError for different units, parts of a normal or a quaternion, and angles without these.
class ColumnFinder {
 public:
  ColumnFinder(const std::vector<RowWord>& fields, const std::string& file, int number)
      : fields_(fields), file_(file), number_(number), is_used_(fields.size(), false) {
    for (const RowWord& field : fields) names_.push_back(columnName(field.text));
  }

  NamedColumns find() {
    for (const char* name : {"x", "y", "z"})
      if (count(name) != 1) return {};
    take({"x", "y", "z"});
    readUnit();
    if (!take({"qw", "qx", "qy", "qz"}) && !take({"nx", "ny", "nz"})) requireNoAngles();
    for (std::size_t k = 0; k < fields_.size(); ++k)
      if (!is_used_[k]) found_.ignored.push_back(fields_[k]);
    return std::move(found_);
  }

 private:
  std::ptrdiff_t count(const std::string& name) const {
    return std::count_if(names_.begin(), names_.end(), [&](const ColumnName& other) { return other.name == name; });
  }

  [[noreturn]] void fail(std::size_t column, const std::string& message) const {
    throw ParseError({file_, number_, fields_[column].column}, message);
  }

  /// Whether the table has these columns.
  bool take(const std::vector<std::string>& wanted) {
    std::vector<std::size_t> columns;
    for (const std::string& name : wanted)
      for (std::size_t k = 0; k < names_.size(); ++k)
        if (names_[k].name == name) columns.push_back(k);
    if (columns.empty()) return false;
    for (const std::string& name : wanted)
      if (count(name) != 1) fail(columns[0], cat("expected each of the columns ", join(wanted), " once"));
    for (const std::size_t k : columns) is_used_[k] = true;
    found_.columns.insert(found_.columns.end(), columns.begin(), columns.end());
    return true;
  }

  void readUnit() {
    const double unit = names_[found_.columns[0]].unit;
    for (const std::size_t k : found_.columns)
      if (names_[k].unit != unit) fail(k, "x, y and z have different units; expected one");
    if (unit > 0.) found_.unit = unit;
  }

  void requireNoAngles() const {
    static const std::vector<std::string> angles = {"a", "b", "c", "rx", "ry", "rz", "roll", "pitch", "yaw"};
    for (std::size_t k = 0; k < names_.size(); ++k)
      if (std::find(angles.begin(), angles.end(), names_[k].name) != angles.end())
        fail(k, cat("the column '", names_[k].name,
                    "' is an angle; expected a normal (nx ny nz) or a quaternion (qw qx qy qz)"));
  }

  const std::vector<RowWord>& fields_;
  const std::string& file_;
  const int number_;
  std::vector<ColumnName> names_;
  std::vector<char> is_used_;
  NamedColumns found_;
};

/// Reads the lines of a table.
class TableReader {
 public:
  explicit TableReader(const std::string& file) : file_(file) {}

  void addLine(const std::string& all) {
    ++number_;
    const std::string line = all.substr(0, all.find('#'));
    const bool may_be_names = rows_.empty() && names_.empty();
    if (may_be_names) separator_ = separatorOf(line, file_, number_);
    const bool has_fields = separator_ && (may_be_names || !named_.columns.empty());
    std::vector<RowWord> words = has_fields ? rowFields(line, separator_) : rowWords(line, file_, number_);
    if (std::all_of(words.begin(), words.end(), [](const RowWord& word) { return word.text.empty(); })) return;
    const auto is_number = [](const RowWord& word) { return rowNumber(word).has_value(); };
    if (may_be_names && std::none_of(words.begin(), words.end(), is_number)) return readNames(std::move(words));
    const bool has_names = !named_.columns.empty();
    if (!has_names && has_fields) words = rowWords(line, file_, number_);
    rows_.push_back(has_names ? namedRow(words) : plainRow(words));
    requireDirection(words);
  }

  MatrixXd rows() const {
    if (rows_.size() < 2)
      throw ParseError({file_, 1, 1}, cat("there are ", rows_.size(), " rows; expected at least 2"));
    MatrixXd all(Eigen::Index(rows_.size()), rows_[0].size());
    for (Eigen::Index k = 0; k < all.rows(); ++k) all.row(k) = rows_[std::size_t(k)].transpose();
    return all;
  }

  std::vector<std::string> warnings() const {
    std::vector<std::string> all;
    for (const RowWord& field : named_.ignored)
      all.push_back(SourcePosition{file_, line_of_names_, field.column}.str() +
                    (field.text.empty() ? ": a column without a name is ignored"
                                        : cat(": the column '", field.text, "' is ignored")));
    return all;
  }

 private:
  void readNames(std::vector<RowWord> names) {
    if (names.back().text.empty()) names.pop_back();  // lines may end with a separator
    names_ = std::move(names);
    line_of_names_ = number_;
    named_ = ColumnFinder(names_, file_, number_).find();
  }

  double numberOf(const RowWord& word) const {
    if (word.text.empty()) throw ParseError({file_, number_, word.column}, "the field is empty; expected a number");
    const std::optional<double> value = rowNumber(word);
    if (!value || !std::isfinite(*value))
      throw ParseError({file_, number_, word.column}, cat("'", word.text, "' is not a number; ", kRowKinds));
    return *value;
  }

  VectorXd plainRow(const std::vector<RowWord>& words) const {
    VectorXd row(Eigen::Index(words.size()));
    for (std::size_t k = 0; k < words.size(); ++k) row[Eigen::Index(k)] = numberOf(words[k]);
    const SourcePosition end{file_, number_, words.back().column};
    if (row.size() != 3 && row.size() != 6 && row.size() != 7)
      throw ParseError(end, cat("the row has ", row.size(), " numbers; ", kRowKinds));
    if (!rows_.empty() && row.size() != rows_[0].size())
      throw ParseError(end, cat("the row has ", row.size(), " numbers; the rows before have ", rows_[0].size()));
    if (words.size() == names_.size())
      throw ParseError({file_, line_of_names_, names_[0].column},
                       "the names of the columns are not x y z, and nx ny nz or qw qx qy qz, in any order; a line of "
                       "text begins with #");
    return row;
  }

  VectorXd namedRow(std::vector<RowWord>& words) const {
    if (words.size() == names_.size() + 1 && words.back().text.empty()) words.pop_back();
    if (words.size() != names_.size())
      throw ParseError({file_, number_, words.back().column},
                       cat("the row has ", words.size(), " fields; there are ", names_.size(), " names"));
    VectorXd row(Eigen::Index(named_.columns.size()));
    for (std::size_t k = 0; k < named_.columns.size(); ++k) row[Eigen::Index(k)] = numberOf(words[named_.columns[k]]);
    row.head<3>() *= named_.unit;
    return row;
  }

  /// Throws for a normal or a quaternion of zeros in the last row.
  void requireDirection(const std::vector<RowWord>& words) const {
    const VectorXd& row = rows_.back();
    if (row.size() == 3 || row.tail(row.size() - 3).norm() >= kLeastNorm) return;
    const std::size_t column = named_.columns.empty() ? 3 : named_.columns[3];
    throw ParseError({file_, number_, words[column].column},
                     row.size() == 6 ? "the normal is zero; expected a direction"
                                     : "the quaternion is zero; expected a rotation, such as 1 0 0 0");
  }

  const std::string file_;
  int number_ = 0, line_of_names_ = 0;
  char separator_ = '\0';  ///< of the names
  std::vector<RowWord> names_;
  NamedColumns named_;
  std::vector<VectorXd> rows_;
};

}  // namespace

ToolPath ToolPath::read(const std::string& file, std::string frame, std::string relative_to) {
  static const std::array<const char*, 6> programs = {".nc", ".ngc", ".gcode", ".gc", ".tap", ".cnc"};
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (std::find(programs.begin(), programs.end(), extension) != programs.end())
    return readGcode(file, std::move(frame), std::move(relative_to));
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(cat(file, ": cannot open the file"));
  std::istringstream text(toUtf8(std::string(std::istreambuf_iterator<char>(in), {})));
  TableReader table(file);
  for (std::string line; std::getline(text, line);) table.addLine(line);
  const MatrixXd all = table.rows();
  ToolPath path = all.cols() == 6 ? along(std::move(frame), all.leftCols(3), all.rightCols(3), std::move(relative_to))
                                  : along(std::move(frame), all, {}, std::move(relative_to));
  path.parts_.warnings = table.warnings();
  return path;
}

}  // namespace kinegraph
