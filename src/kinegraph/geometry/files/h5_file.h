#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinegraph::inline geometry_internal {

/// A table of numbers from an HDF5 file, row-major, as doubles.
struct H5Dataset {
  std::vector<std::uint64_t> dims;
  std::vector<double> numbers;
  std::uint64_t rows() const { return dims.empty() ? 1 : dims[0]; }
};

/// Reads datasets of HDF5 files in the default format of h5py and the C library: superblock version 0 or 1, groups with
/// symbol tables, uncompressed contiguous or compact integers and floats. Checks every address against the length of
/// the file. Throws FileError for other formats, and names the unsupported feature. Source: HDF5 File Format
/// Specification, version 3.0, sections II.A, III.A to III.D, IV.A.
class H5File {
 public:
  explicit H5File(std::string path);

  bool contains(std::string_view name) const;
  H5Dataset dataset(std::string_view name) const;  ///< `name` is a path such as "mesh/vertices"

  /// Paths of the groups and datasets of `group` ("" is the root).
  std::vector<std::string> entries(std::string_view group = "") const;

 private:
  struct Link {
    std::string name;
    std::uint64_t header;  ///< address of the object header
  };
  struct Message {
    int type;
    std::uint64_t at, size;
  };

  [[noreturn]] void fail(const std::string& what) const;
  std::uint64_t number(std::uint64_t at, int bytes) const;  ///< little-endian, unsigned
  double element(std::uint64_t at, int bytes, bool floating, bool is_signed) const;
  void expectMark(std::uint64_t at, std::string_view mark) const;
  std::vector<Message> messages(std::uint64_t header) const;
  std::vector<Link> links(std::uint64_t header) const;
  void collectLinks(std::uint64_t node, std::uint64_t names, std::size_t& visits, std::vector<Link>& links) const;
  std::uint64_t find(std::string_view name) const;  ///< address of an object header, or 0

  std::string path_;
  std::string bytes_;
  std::uint64_t root_ = 0;
};

}  // namespace kinegraph::inline geometry_internal
