#include "kinegraph/common/file_stamp.h"

namespace kinegraph::inline common_internal {

FileStamp stampOf(const std::string& file) {
  FileStamp stamp;
  std::error_code error;
  const auto written = std::filesystem::last_write_time(file, error);
  if (!error) stamp.written = written;
  const auto size = std::filesystem::file_size(file, error);
  if (!error) stamp.size = size;
  return stamp;
}

}  // namespace kinegraph::inline common_internal
