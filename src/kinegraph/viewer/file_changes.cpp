#include "kinegraph/viewer/file_changes.h"

#include <algorithm>

namespace kinegraph::inline viewer_internal {

using std::chrono::milliseconds;

FileStamps stampsOf(const std::vector<std::string>& files) {
  FileStamps stamps;
  for (const std::string& file : files) stamps[file] = stampOf(file);
  return stamps;
}

void FileChanges::setRead(FileStamps stamps) {
  read_ = seen_ = std::move(stamps);
  since_ = {};
}

std::vector<std::string> FileChanges::files() const {
  std::vector<std::string> names;
  for (const auto& [name, stamp] : read_) names.push_back(name);
  return names;
}

bool FileChanges::settled(const FileStamps& now, Time time) {
  if (now != seen_) {
    seen_ = now;
    since_ = time;
    return false;
  }
  if (seen_ == read_) return false;
  const bool emptied = std::any_of(seen_.begin(), seen_.end(), [&](const auto& file) {
    const auto before = read_.find(file.first);
    return file.second.size == 0 && before != read_.end() && before->second.size > 0;
  });
  return time - since_ >= milliseconds(emptied ? 300 : 40);
}

}  // namespace kinegraph::inline viewer_internal
