#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace kinegraph::inline common_internal {

/// Time of the last write and size of a file; a missing file has neither. Equal stamps: the file is likely unchanged.
struct FileStamp {
  std::filesystem::file_time_type written = std::filesystem::file_time_type::min();
  std::uintmax_t size = 0;
  bool operator==(const FileStamp&) const = default;
};

/// Returns the present stamp of a file.
FileStamp stampOf(const std::string& file);

}  // namespace kinegraph::inline common_internal
