#include "kinegraph/parsers/mjcf/mjcf_height_field.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_file.h"

namespace kinegraph::inline parsers_internal {

namespace {

constexpr int kMaxHeightCells = 2500;  // each becomes two convex parts
constexpr double kMaxHeightPoints = 4e6;

/// Heights in 0..1, rows along y, columns along x.
struct Heights {
  int rows = 0, columns = 0;
  std::vector<double> values;
  double at(int row, int column) const { return values[std::size_t(row) * std::size_t(columns) + std::size_t(column)]; }
};

void normalizeHeights(Heights& heights) {
  if (heights.values.empty()) return;
  const auto [low, high] = std::minmax_element(heights.values.begin(), heights.values.end());
  const double least = *low, range = *high - *low;
  for (double& value : heights.values) value = range > 0. ? (value - least) / range : 0.;
}

/// The first row of a picture, and of `elevation`, has the largest y.
void flipRows(Heights& heights) {
  for (int row = 0; row < heights.rows / 2; ++row) {
    const auto first = heights.values.begin() + row * heights.columns;
    std::swap_ranges(first, first + heights.columns,
                     heights.values.begin() + (heights.rows - 1 - row) * heights.columns);
  }
}

Heights heightsOfPicture(const std::string& path) {
  const Pixels pixels = decodeImage(*readImageFile(path));
  Heights heights{pixels.height, pixels.width, {}};
  for (std::size_t i = 0; i < pixels.rgb.size(); i += 3) heights.values.push_back(pixels.rgb[i]);
  flipRows(heights);
  return heights;
}

Heights heightsOfNumbers(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::stringstream content;
  content << stream.rdbuf();
  const std::string bytes = content.str();
  std::int32_t counts[2] = {};
  if (bytes.size() >= sizeof(counts)) std::memcpy(counts, bytes.data(), sizeof(counts));
  const double expected = 8. + 4. * double(counts[0]) * double(counts[1]);
  if (counts[0] < 2 || counts[1] < 2 || double(bytes.size()) != expected)
    throw FileError(
        cat("height field '", path, "' of ", bytes.size(), " bytes is neither a PNG nor a MuJoCo height field"));
  Heights heights{counts[0], counts[1], {}};
  for (std::size_t at = sizeof(counts); at < bytes.size(); at += 4) {
    float value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    heights.values.push_back(std::isfinite(value) ? value : 0.);
  }
  return heights;
}

/// Builds the convex parts below rectangles or triangles of the grid.
class HeightFieldBuilder {
 public:
  HeightFieldBuilder(const Heights& heights, const std::vector<double>& size) : heights_(heights), size_(size) {}

  using Cell = std::array<int, 2>;  // row, column
  void addPart(const std::vector<std::array<Cell, 3>>& top, const std::vector<Cell>& border) {
    const std::size_t first = mesh.vertices.size() / 3;
    mesh.parts.push_back(double(first));
    std::map<Cell, double> numbers;
    const auto number = [&](const Cell& cell) {
      const auto [place, is_new] = numbers.try_emplace(cell, double(mesh.vertices.size() / 3));
      if (is_new) addVertex(cell, size_[2] * heights_.at(cell[0], cell[1]));
      return place->second;
    };
    for (const auto& corners : top) addTriangle(number(corners[0]), number(corners[1]), number(corners[2]));
    const double bottom = double(mesh.vertices.size() / 3);
    for (const Cell& cell : border) addVertex(cell, -size_[3]);
    for (std::size_t i = 0; i < border.size(); ++i) {  // counterclockwise from above
      const std::size_t next = (i + 1) % border.size();
      const double a = number(border[i]), b = number(border[next]), below_a = bottom + double(i),
                   below_b = bottom + double(next);
      addTriangle(a, below_a, b);
      addTriangle(b, below_a, below_b);
      if (i >= 2) addTriangle(bottom, below_a, bottom + double(i - 1));
    }
  }

  HeightFieldMesh mesh;

 private:
  void addVertex(const Cell& cell, double z) {
    const auto along = [](int i, int count, double half) { return half * (2. * i / (count - 1) - 1.); };
    mesh.vertices.insert(mesh.vertices.end(),
                         {along(cell[1], heights_.columns, size_[0]), along(cell[0], heights_.rows, size_[1]), z});
  }
  void addTriangle(double a, double b, double c) { mesh.triangles.insert(mesh.triangles.end(), {a, b, c}); }

  const Heights& heights_;
  const std::vector<double>& size_;
};

HeightFieldMesh meshOfHeights(const Heights& heights, const std::vector<double>& size, int block) {
  HeightFieldBuilder builder(heights, size);
  for (int row = 0; row + 1 < heights.rows; row += block) {
    for (int column = 0; column + 1 < heights.columns; column += block) {
      const int last_row = std::min(row + block, heights.rows - 1),
                last_column = std::min(column + block, heights.columns - 1);
      if (block == 1) {
        const HeightFieldBuilder::Cell a = {row, column}, b = {row, column + 1}, c = {row + 1, column + 1},
                                       d = {row + 1, column};
        builder.addPart({{a, b, c}}, {a, b, c});
        builder.addPart({{a, c, d}}, {a, c, d});
        continue;
      }
      std::vector<std::array<HeightFieldBuilder::Cell, 3>> top;
      std::vector<HeightFieldBuilder::Cell> border;
      for (int i = row; i < last_row; ++i) {
        for (int j = column; j < last_column; ++j) {
          top.push_back({{{i, j}, {i, j + 1}, {i + 1, j + 1}}});
          top.push_back({{{i, j}, {i + 1, j + 1}, {i + 1, j}}});
        }
      }
      for (int j = column; j < last_column; ++j) border.push_back({row, j});
      for (int i = row; i < last_row; ++i) border.push_back({i, last_column});
      for (int j = last_column; j > column; --j) border.push_back({last_row, j});
      for (int i = last_row; i > row; --i) border.push_back({i, column});
      builder.addPart(top, border);
    }
  }
  return std::move(builder.mesh);
}

/// Throws FileError.
Heights heightsOf(const MjcfElement& asset, const MjcfDocument& document, MjcfValues& values) {
  if (const XmlAttribute* const file = asset.own("file")) {
    const std::string path = document.locateAsset(*file, document.settingsAt(file->where).mesh_folder).path;
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      throw FileError(cat("height field '", file->value, "' does not exist (", path, ")"));
    return lowerExtension(path) == ".png" ? heightsOfPicture(path) : heightsOfNumbers(path);
  }
  Heights heights{int(values.number(asset, "nrow", 0.)), int(values.number(asset, "ncol", 0.)), {}};
  const double count = double(heights.rows) * double(heights.columns);
  if (heights.rows < 2 || heights.columns < 2 || count > kMaxHeightPoints)
    throw FileError("expected 'file', or at least two rows and columns");
  const XmlAttribute* const elevation = asset.own("elevation");
  const auto given = elevation ? numbersIn(elevation->value) : std::vector<double>(std::size_t(count), 0.);
  if (!given || double(given->size()) != count)
    throw FileError(cat("expected ", heights.rows, " x ", heights.columns, " numbers in 'elevation'"));
  heights.values = *given;
  flipRows(heights);
  return heights;
}

}  // namespace

std::optional<HeightFieldMesh> readHeightField(const MjcfElement& asset, const MjcfDocument& document,
                                               MjcfValues& values, Findings& findings) {
  const std::vector<double> size = values.numbers(asset, "size", 4);
  if (size.size() != 4 || std::any_of(size.begin(), size.end(), [](double x) { return !(x > 0.); })) {
    findings.warn(asset.where(), cat(asset.describe(), ": expected a 'size' of 4 positive numbers; it is left out"));
    return std::nullopt;
  }
  Heights heights;
  try {
    heights = heightsOf(asset, document, values);
    if (heights.rows < 2 || heights.columns < 2) throw FileError("it has fewer than two rows or columns");
  } catch (const Error& e) {
    findings.warn(asset.where(), cat(asset.describe(), ": ", e.what(), "; it is left out"));
    return std::nullopt;
  }
  normalizeHeights(heights);
  const auto is_zero = [](double x) { return x == 0.; };
  if (std::all_of(heights.values.begin(), heights.values.end(), is_zero)) heights = {2, 2, {0., 0., 0., 0.}};
  const double cells = double(heights.rows - 1) * double(heights.columns - 1);
  const int block = std::max(1, int(std::ceil(std::sqrt(cells / kMaxHeightCells))));
  if (block > 1) {
    findings.warn(asset.where(),
                  cat(asset.describe(), ": its ", heights.rows - 1, " x ", heights.columns - 1,
                      " cells collide as convex parts of ", block, " x ", block, " cells, which fill its valleys"));
  }
  return meshOfHeights(heights, size, block);
}

}  // namespace kinegraph::inline parsers_internal
