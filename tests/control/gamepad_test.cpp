#include "kinegraph/control/target_file.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

void writeEvent(std::ofstream& file, std::int16_t value, std::uint8_t type, std::uint8_t number) {
  const std::uint32_t milliseconds = 1;
  file.write(reinterpret_cast<const char*>(&milliseconds), 4);
  file.write(reinterpret_cast<const char*>(&value), 2);
  file.put(char(type)).put(char(number));
}

}  // namespace

TEST(Gamepad, SticksPush) {
  const TemporaryFolder folder;
  const std::string device = folder.path() / "js0";
  {
    std::ofstream file(device, std::ios::binary);
    writeEvent(file, 32767, 0x82, 0);  // x
    writeEvent(file, 16384, 2, 4);     // z
    writeEvent(file, 1000, 2, 1);      // y, hardly touched
    writeEvent(file, 1, 1, 4);         // a button
  }
  Gamepad pad(device, .1);
  EXPECT_TRUE(pad.velocity().isApprox(Vector3d(.1, 0., -.05), 1e-4));
  EXPECT_TRUE(pad.velocity().isApprox(Vector3d(.1, 0., -.05), 1e-4));  // they are where they were
  expectError<FileError>([&] { Gamepad(folder.path() / "js7"); }, {"js7", "is a gamepad connected"});
}
