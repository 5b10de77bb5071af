#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/tool_paths/tool_path.h"

namespace kinegraph {

namespace {

constexpr const char* kRowKinds = "expected 3 numbers (x y z), 6 (with a normal) or 7 (x y z qw qx qy qz)";

/// Reads the numbers of a line; none if it has other words. `column` is where the first of these begins.
std::optional<std::vector<double>> numbersOf(const std::string& line, std::size_t& column) {
  std::vector<double> numbers;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t,;\r", at)) != std::string::npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t,;\r", at), line.size());
    const std::string word = line.substr(at, end - at);
    const char* rest = nullptr;
    const double number = readNumber(word.c_str(), &rest);
    column = at + 1;
    if (*rest != '\0' || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

}  // namespace

ToolPath ToolPath::read(const std::string& file, std::string frame, std::string relative_to) {
  static const std::array<const char*, 6> programs = {".nc", ".ngc", ".gcode", ".gc", ".tap", ".cnc"};
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (std::find(programs.begin(), programs.end(), extension) != programs.end())
    return readGcode(file, std::move(frame), std::move(relative_to));
  std::ifstream in(file);
  if (!in) throw FileError(cat(file, ": cannot open the file"));
  std::vector<std::vector<double>> rows;
  std::string line;
  bool has_names = false;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    std::size_t column = 1;
    std::optional<std::vector<double>> numbers = numbersOf(line, column);
    if (!numbers && rows.empty() && !has_names) {
      has_names = true;
      continue;
    }
    const SourcePosition place{file, number, int(column)};
    if (!numbers) throw ParseError(place, cat("not a number; ", kRowKinds));
    if (numbers->size() != 3 && numbers->size() != 6 && numbers->size() != 7)
      throw ParseError(place, cat("the row has ", numbers->size(), " numbers; ", kRowKinds));
    if (!rows.empty() && numbers->size() != rows[0].size())
      throw ParseError(place, cat("the row has ", numbers->size(), " numbers; the rows before have ", rows[0].size()));
    rows.push_back(std::move(*numbers));
  }
  if (rows.size() < 2) throw ParseError({file, 1, 1}, cat("there are ", rows.size(), " rows; expected at least 2"));
  MatrixXd all(Eigen::Index(rows.size()), Eigen::Index(rows[0].size()));
  for (Eigen::Index k = 0; k < all.rows(); ++k)
    all.row(k) = Eigen::Map<const VectorXd>(rows[std::size_t(k)].data(), all.cols()).transpose();
  return all.cols() == 6 ? along(std::move(frame), all.leftCols(3), all.rightCols(3), std::move(relative_to))
                         : along(std::move(frame), all, {}, std::move(relative_to));
}

}  // namespace kinegraph
