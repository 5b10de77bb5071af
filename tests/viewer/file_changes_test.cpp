#include "kinegraph/viewer/file_changes.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

using namespace kinegraph;
using std::chrono::milliseconds;

namespace {

FileStamp stamp(int written, std::uintmax_t size) {
  return {std::filesystem::file_time_type(std::chrono::seconds(written)), size};
}

/// Checks one file every 20 ms of its own clock.
class Watched {
 public:
  explicit Watched(FileStamp first) { changes_.setRead({{"scene.g", first}}); }

  /// How long (ms) the file has to be `now` until it may be read; -1: never.
  int delay(FileStamp now) {
    for (int waited = 0; waited <= 1000; waited += 20) {
      if (look(now)) return waited;
    }
    return -1;
  }
  bool look(FileStamp now) { return changes_.settled({{"scene.g", now}}, time_ += milliseconds(20)); }
  void read(FileStamp now) { changes_.setRead({{"scene.g", now}}); }

 private:
  FileChanges changes_;
  FileChanges::Time time_{};
};

}  // namespace

TEST(FileChanges, AFileThatStaysIsNeverReadAgain) {
  Watched file(stamp(1, 10));
  EXPECT_EQ(file.delay(stamp(1, 10)), -1);
}

TEST(FileChanges, AnEditCountsWhenItHasBeenSteady) {
  Watched file(stamp(1, 10));
  EXPECT_EQ(file.delay(stamp(2, 12)), 40);
  file.read(stamp(2, 12));
  EXPECT_EQ(file.delay(stamp(2, 12)), -1);
  EXPECT_EQ(file.delay(stamp(3, 12)), 40);
}

TEST(FileChanges, AFileThatIsBeingWrittenIsLeftAlone) {
  Watched file(stamp(1, 10));
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(file.look(stamp(2 + i, 20 + i)));
  EXPECT_EQ(file.delay(stamp(51, 69)), 20);  // seen once already
}

TEST(FileChanges, AFileThatIsEmptyOrMissingForAMomentIsLeftAlone) {
  Watched file(stamp(1, 10));
  for (const FileStamp& moment : {stamp(2, 0), FileStamp{}}) {
    for (int i = 0; i < 12; ++i) EXPECT_FALSE(file.look(moment));
    EXPECT_FALSE(file.look(stamp(3, 10)));
  }
  EXPECT_EQ(file.delay(stamp(3, 10)), 20);
}

TEST(FileChanges, AFileThatStaysEmptyOrMissingCountsLater) {
  Watched emptied(stamp(1, 10)), removed(stamp(1, 10));
  EXPECT_EQ(emptied.delay(stamp(2, 0)), 300);
  EXPECT_EQ(removed.delay({}), 300);
  removed.read({});
  EXPECT_EQ(removed.delay(stamp(3, 10)), 40);
}

TEST(FileChanges, AnUndoneEditIsNoChange) {
  Watched file(stamp(1, 10));
  EXPECT_FALSE(file.look(stamp(2, 12)));
  EXPECT_EQ(file.delay(stamp(1, 10)), -1);
}

TEST(FileChanges, StampsDistinguishExistingAndMissingFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.write("stamped.g", "a: {}");
  const FileStamps stamps = stampsOf({path, path + ".missing"});
  EXPECT_EQ(stamps.at(path).size, 5u);
  EXPECT_EQ(stamps.at(path + ".missing"), FileStamp{});
  std::filesystem::remove(path);
  EXPECT_EQ(stampsOf({path}).at(path), FileStamp{});
}
