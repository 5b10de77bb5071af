#pragma once

#include "kinegraph/common/file_stamp.h"

#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace kinegraph::inline viewer_internal {

using FileStamps = std::map<std::string, FileStamp>;

FileStamps stampsOf(const std::vector<std::string>& files);

/// Detects completed changes of files. Editors empty or remove a file before they write it. Therefore a change counts
/// after 40 ms without another one, and a change to an empty or missing file after 300 ms.
class FileChanges {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Sets the stamps of the files when they were read.
  void setRead(FileStamps stamps);

  std::vector<std::string> files() const;  ///< those of setRead

  /// Compares with the present stamps at `time`. Returns whether the files have changed and are complete.
  bool settled(const FileStamps& now, Time time);

 private:
  FileStamps read_, seen_;
  Time since_{};  ///< time of the first observation of `seen_`
};

}  // namespace kinegraph::inline viewer_internal
