#include "kinegraph/geometry/files/image_file.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/text.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

std::string dataFile(const std::string& name) { return cat(KINEGRAPH_SOURCE_DIR, "/tests/data/images/", name); }

/// Content of the pictures in tests/data/images: 8 x, 10 y, 255 - 4 (x + y).
std::array<int, 3> gradient(int x, int y) { return {8 * x, 10 * y, 255 - 4 * (x + y)}; }

/// The largest deviation of a channel from the gradient; of gray pictures, from its red.
int worst(const std::string& name, bool gray = false) {
  const Pixels pixels = decodeImage(*readImageFile(dataFile(name)));
  EXPECT_EQ(pixels.width, 32);
  EXPECT_EQ(pixels.height, 24);
  int worst = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 32; ++x) {
      const auto expected = gradient(x, y);
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::max(worst, std::abs(int(pixels.rgb[3 * std::size_t(32 * y + x) + k]) - expected[gray ? 0 : k]));
      }
    }
  }
  return worst;
}

std::string messageOfImage(const std::string& bytes) {
  try {
    decodeImage({bytes, "x"});
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Image, PngFilesAreReadExactly) {
  for (const char* name : {"colors.png", "alpha.png", "interlaced.png"}) EXPECT_EQ(worst(name), 0) << name;
  for (const char* name : {"gray.png", "sixteen.png"}) EXPECT_EQ(worst(name, true), 0) << name;
}

TEST(Image, APaletteHasItsColors) {
  const Pixels pixels = decodeImage(*readImageFile(dataFile("palette.png")));
  const std::vector<std::uint8_t> expected = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 0};
  for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(pixels.rgb[3 * (8 * (i / 3) + 5) + i % 3], expected[i]);
}

TEST(Image, JpegFilesAreReadAsWellAsTheyWereWritten) {
  EXPECT_LE(worst("colors.jpg"), 6);
  EXPECT_LE(worst("progressive.jpg"), 6);
  EXPECT_LE(worst("gray.jpg", true), 4);
  EXPECT_LE(worst("restart.jpg"), 16);  // its colors are half as fine
}

TEST(Image, SequentialAndProgressiveFilesGiveTheSame) {
  EXPECT_EQ(decodeImage(*readImageFile(dataFile("colors.jpg"))).rgb,
            decodeImage(*readImageFile(dataFile("progressive.jpg"))).rgb);
}

TEST(Image, WhatIsWrittenIsReadAgain) {
  Pixels pixels{200, 150, {}};  // more than one block of bytes
  for (int i = 0; i < 3 * 200 * 150; ++i) pixels.rgb.push_back(std::uint8_t(i * 7));
  const Image image = encodePng(pixels);
  EXPECT_EQ(mediaType(image), "image/png");
  EXPECT_EQ(decodeImage(image).rgb, pixels.rgb);
}

TEST(Image, EveryShortenedFileIsAnErrorOrAPicture) {
  for (const char* name :
       {"colors.png", "interlaced.png", "palette.png", "colors.jpg", "progressive.jpg", "restart.jpg"}) {
    const std::string bytes = readImageFile(dataFile(name))->bytes;
    for (std::size_t size = 3; size < bytes.size(); size += 7) messageOfImage(bytes.substr(0, size));
    EXPECT_NE(messageOfImage(bytes.substr(0, bytes.size() / 3)), "") << name;
  }
}

TEST(Image, PromisesThatTheBytesCannotKeepAreRefused) {
  std::string png = readImageFile(dataFile("colors.png"))->bytes;
  png.replace(16, 8, std::string("\0\0\x70\0\0\0\x70\0", 8));
  EXPECT_NE(messageOfImage(png).find("announces 28672 x 28672 pixels"), std::string::npos) << messageOfImage(png);
  std::string jpeg = readImageFile(dataFile("colors.jpg"))->bytes;
  jpeg.replace(jpeg.find("\xff\xc0") + 5, 4, "\x70\x70\x70\x70");
  EXPECT_NE(messageOfImage(jpeg).find("announces 28784 x 28784 pixels"), std::string::npos) << messageOfImage(jpeg);
}

TEST(Image, OtherFilesAreRefused) {
  TemporaryFolder folder;
  expectError<FileError>([&] { readImageFile(folder.write("a.png", "P6 1 1 255 abc")); },
                         {"a.png", "neither a PNG nor a JPEG"});
  expectError<FileError>([&] { readImageFile((folder / "b.png").string()); }, {"b.png", "does not exist"});
}
