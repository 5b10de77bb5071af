#include "kinegraph/geometry/files/mesh_header.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline geometry_internal {

namespace {

namespace fs = std::filesystem;

constexpr double kAlways = 1e5;  // always accepted: cheap to allocate

/// The text between `at` and the next of `ends`, without leading blanks and quotes.
std::string_view valueBehind(std::string_view text, std::size_t at, std::string_view ends) {
  at = std::min(text.find_first_not_of(" \t\r\n:=\"'", at), text.size());
  return text.substr(at, std::min(text.find_first_of(ends, at), text.size()) - at);
}

/// Calls visit(value) for the value after every `key`.
template <class Visit>
void forValues(std::string_view text, std::string_view key, std::string_view ends, const Visit& visit) {
  for (std::size_t at = text.find(key); at != std::string_view::npos; at = text.find(key, at + key.size())) {
    visit(valueBehind(text, at + key.size(), ends));
  }
}

double numberOf(std::string_view text) { return readNumber(std::string(text.substr(0, 40)).c_str()); }

/// Sums the element counts in the header of a PLY file.
double elementsInPlyHeader(std::string_view text) {
  double promised = 0.;
  const std::string_view header = text.substr(0, std::min(text.find("end_header"), text.size()));
  forValues(header, "\nelement ", "\r\n",
            [&](std::string_view line) { promised += numberOf(line.substr(std::min(line.find(' '), line.size()))); });
  return promised;
}

}  // namespace

void checkMeshHeader(const std::string& path) {
  const std::string extension = lowerExtension(path);
  const bool ply = extension == ".ply", dae = extension == ".dae", gltf = extension == ".gltf" || extension == ".glb";
  if (!ply && !dae && !gltf) return;
  std::ifstream stream(path, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  const std::string text = bytes.str();
  double promised = 0., held = double(text.size());
  const auto add = [&](std::string_view count) { promised += std::max(numberOf(count), 0.); };
  if (ply) promised = elementsInPlyHeader(text);
  if (dae) forValues(text, " count=", "\"'", add);
  if (gltf) {
    forValues(text, "\"count\"", ",}", add);
    forValues(text, "\"uri\"", "\"", [&](std::string_view file) {
      std::error_code error;
      const auto size = file.size() < 1000 ? fs::file_size(fs::path(path).parent_path() / std::string(file), error) : 0;
      if (!error) held += double(size);
    });
  }
  if (promised <= kAlways + held) return;
  throw FileError(cat("mesh file '", path, "' announces ", exact(promised), " elements, more than its ", exact(held),
                      " bytes can hold"));
}

}  // namespace kinegraph::inline geometry_internal
