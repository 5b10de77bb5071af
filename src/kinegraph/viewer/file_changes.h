#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace kinegraph {

/// When a file was last written, and its size; a missing one has neither.
struct FileStamp {
  std::filesystem::file_time_type written = std::filesystem::file_time_type::min();
  std::uintmax_t size = 0;
  bool operator==(const FileStamp&) const = default;
};

using FileStamps = std::map<std::string, FileStamp>;

FileStamps stampsOf(const std::vector<std::string>& files);

/// Says when files that somebody edits are worth reading again. Editors empty or remove a file before they write it, so
/// a change counts when it has been steady for 40 ms, and one that leaves a file empty or missing after 300 ms.
class FileChanges {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// These are the files as they were read.
  void setRead(FileStamps stamps);

  std::vector<std::string> files() const;  ///< those of setRead

  /// Looks at these files, as they are at `time`: true if they have changed, and may be read.
  bool settled(const FileStamps& now, Time time);

 private:
  FileStamps read_, seen_;
  Time since_{};  ///< when `seen_` was first seen
};

}  // namespace kinegraph
