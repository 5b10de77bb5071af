#include "kinegraph/geometry/files/grid_file.h"

#include <gtest/gtest.h>

#include <cstring>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

class GridFileTest : public ::testing::Test {
 protected:
  GridFile read(const std::string& text, const std::string& name = "field.txt") {
    return readGridFile(folder_.write(name, text));
  }
  void expectRefused(const std::string& text, std::initializer_list<const char*> words) {
    expectError<FileError>([&] { read(text); }, words);
  }

  TemporaryFolder folder_;
};

const std::vector<float> kNumbers = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

}  // namespace

TEST_F(GridFileTest, TextGivesBoxAndNumbersWithTheLastIndexFastest) {
  for (const char* text : {"lo: [-1 -.5 -2]\nup: [1 .5 2]\nfield: <2 2 3> [1 2 3 4 5 6 7 8 9 10 11 12]\n",
                           "lo: [ <3> -1 -.5 -2]\nup: [1, .5, 2]\nsdf: [ <2 2 3> \n1 2 3\n4 5 6\n\n7 8 9\n10 11 12]",
                           "{ bounds: [-1 -.5 -2; 1 .5 2], field <2 2 3>[1 2 3 4 5 6 7 8 9 10 11 12] }"}) {
    const GridFile file = read(text);
    EXPECT_EQ(file.grid.cells, (std::array<int, 3>{2, 2, 3})) << text;
    EXPECT_EQ(file.grid.values, kNumbers) << text;
    EXPECT_EQ(file.size, Vector3d(2, 1, 4)) << text;
    EXPECT_EQ(file.grid.at(1, 0, 2), 9.f) << text;
  }
}

TEST_F(GridFileTest, NumbersMayBeFloatsBetweenZeroBytes) {
  std::string bytes(4 * kNumbers.size(), ' ');
  std::memcpy(bytes.data(), kNumbers.data(), bytes.size());
  const std::string zero(1, '\0'), head = "lo: [-1 -1 -1]\nup: [1 1 1]\nfield: <2 2 3>\n" + zero;
  EXPECT_EQ(read(head + bytes + zero + "\n").grid.values, kNumbers);
  expectRefused(head + bytes.substr(8) + zero, {"field.txt", "'field'", "shorter than the 12"});
  expectRefused(head + bytes + "1234" + zero, {"'field'", "does not end after the 12 floats"});
}

TEST_F(GridFileTest, MistakesSayWhatWasExpected) {
  const std::string box = "lo: [-1 -1 -1] up: [1 1 1] ";
  expectError<FileError>([&] { readGridFile((folder_ / "none.txt").string()); }, {"none.txt", "does not exist"});
  expectRefused("", {"field.txt", "expected lo", "nothing"});
  expectRefused(box, {"expected lo", "field", "found lo, up"});
  expectRefused(box + "field: 3", {"'field'", "[ ]"});
  expectRefused(box + "field: <2 2 2> [1 2 3", {"'field'", "a non-number after 3"});
  expectRefused(box + "field: <2 2 2> [1 2 x]", {"'field'", "a non-number after 2"});
  expectRefused(box + "field: <2 2 2> [1 2 3]", {"3 numbers", "<2 2 2>", "8"});
  expectRefused(box + "field: [1 2 3 4]", {"0 dimensions"});
  expectRefused(box + "field: <1 2 2> [1 2 3 4]", {"1 numbers along an axis"});
  expectRefused(box + "field: <2 2 1e300> [1]", {"numbers along an axis"});
  expectRefused(box + "field: <2 2 2> [1 2 3 4 5 6 7 nan]", {"field.txt", "finite"});
  expectRefused("lo: [0 0 0] up: [1 1 1] field: <2 2 2> [1 2 3 4 5 6 7 8]", {"from 0 0 0 to 1 1 1", "not centered"});
  expectRefused("lo: [1 1 1] up: [-1 -1 -1] field: <2 2 2> [1 2 3 4 5 6 7 8]", {"from 1 1 1"});
}
