#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
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

/// A number or a name in a row.
struct RowWord {
  std::string text;
  int column;  ///< of its first character, from 1
};

std::optional<double> rowNumber(const RowWord& word) {
  const char* rest = nullptr;
  const double number = readNumber(word.text.c_str(), &rest);
  return *rest == '\0' ? std::optional(number) : std::nullopt;
}

/// Splits a line, without a comment behind #, at commas or semicolons, and at spaces.
std::vector<RowWord> rowWords(const std::string& all, const std::string& file, int number) {
  const std::string line = all.substr(0, all.find('#'));
  const bool has_commas = line.find(',') != std::string::npos, has_semicolons = line.find(';') != std::string::npos;
  if (has_commas && has_semicolons)
    throw ParseError({file, number, int(line.find(',')) + 1},
                     "the row has commas and semicolons; expected one separator, and points before decimals");
  const char separator = has_semicolons ? ';' : ',';
  std::vector<RowWord> words;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    std::size_t at = line.find_first_not_of(" \t\r", begin);
    const bool is_empty = at == std::string::npos || at >= end;
    if (is_empty && line.find_first_not_of(" \t\r,;", begin) != std::string::npos)
      throw ParseError({file, number, int(begin) + 1}, "the field is empty; expected a number");
    while (at < end) {
      const std::size_t after = std::min(line.find_first_of(" \t\r", at), end);
      const RowWord word{line.substr(at, after - at), int(at) + 1};
      const bool is_second = (has_commas || has_semicolons) && !words.empty() && words.back().column > int(begin);
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

/// Which column has each of the numbers x y z, and nx ny nz or qw qx qy qz; none if a name is not one of these.
std::vector<std::size_t> namedColumns(const std::vector<RowWord>& names, const std::string& file, int number) {
  static const std::vector<std::vector<std::string>> orders = {
      {"x", "y", "z", "qw", "qx", "qy", "qz"}, {"x", "y", "z", "nx", "ny", "nz"}, {"x", "y", "z"}};
  static const std::vector<std::string> angles = {"a", "b", "c", "rx", "ry", "rz", "roll", "pitch", "yaw"};
  std::vector<std::string> plain;
  for (const RowWord& name : names) {
    std::string text;
    for (const char c : name.text)
      if (c != '"' && c != '\'') text += char(std::tolower(static_cast<unsigned char>(c)));
    if (std::find(angles.begin(), angles.end(), text) != angles.end())
      throw ParseError(
          {file, number, name.column},
          cat("the column '", text, "' is an angle; expected a normal (nx ny nz) or a quaternion (qw qx ", "qy qz)"));
    plain.push_back(text);
  }
  for (const std::vector<std::string>& order : orders)
    if (order.size() == plain.size() && std::is_permutation(order.begin(), order.end(), plain.begin())) {
      std::vector<std::size_t> columns;
      for (const std::string& name : order)
        columns.push_back(std::size_t(std::find(plain.begin(), plain.end(), name) - plain.begin()));
      return columns;
    }
  return {};
}

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
  std::vector<std::vector<double>> rows;
  std::vector<RowWord> names;
  std::vector<std::size_t> columns;
  std::string line;
  int line_of_names = 0;
  std::size_t fields = 0;  // of the names: a name such as "x (mm)" is several words
  for (int number = 1; std::getline(text, line); ++number) {
    const std::vector<RowWord> words = rowWords(line, file, number);
    if (words.empty()) continue;
    const bool is_names =
        rows.empty() && names.empty() &&
        std::none_of(words.begin(), words.end(), [](const RowWord& word) { return rowNumber(word).has_value(); });
    if (is_names) {
      names = words;
      line_of_names = number;
      fields = 1 + std::size_t(std::count_if(line.begin(), line.end(), [](char c) { return c == ',' || c == ';'; }));
      columns = namedColumns(words, file, number);
      continue;
    }
    std::vector<double> row;
    for (const RowWord& word : words) {
      const std::optional<double> value = rowNumber(word);
      if (!value || !std::isfinite(*value))
        throw ParseError({file, number, word.column}, cat("'", word.text, "' is not a number; ", kRowKinds));
      row.push_back(*value);
    }
    const SourcePosition end{file, number, words.back().column};
    if (row.size() != 3 && row.size() != 6 && row.size() != 7)
      throw ParseError(end, cat("the row has ", row.size(), " numbers; ", kRowKinds));
    if (!rows.empty() && row.size() != rows[0].size())
      throw ParseError(end, cat("the row has ", row.size(), " numbers; the rows before have ", rows[0].size()));
    if (!columns.empty() && row.size() != columns.size())
      throw ParseError(end, cat("the row has ", row.size(), " numbers; there are ", columns.size(), " names"));
    if (columns.empty() && !names.empty() && (row.size() == names.size() || row.size() == fields))
      throw ParseError({file, line_of_names, names[0].column},
                       "the names of the columns are not x y z, and nx ny nz or qw qx qy qz, in any order; a line of "
                       "text begins with #");
    rows.push_back(row);
    for (std::size_t k = 0; k < columns.size(); ++k) rows.back()[k] = row[columns[k]];
  }
  if (rows.size() < 2) throw ParseError({file, 1, 1}, cat("there are ", rows.size(), " rows; expected at least 2"));
  MatrixXd all(Eigen::Index(rows.size()), Eigen::Index(rows[0].size()));
  for (Eigen::Index k = 0; k < all.rows(); ++k)
    all.row(k) = Eigen::Map<const VectorXd>(rows[std::size_t(k)].data(), all.cols()).transpose();
  return all.cols() == 6 ? along(std::move(frame), all.leftCols(3), all.rightCols(3), std::move(relative_to))
                         : along(std::move(frame), all, {}, std::move(relative_to));
}

}  // namespace kinegraph
