#include "kinegraph/common/dynamic_library.h"

#include <gtest/gtest.h>

#include <functional>

#include "kinegraph/common/errors.h"

using namespace kinegraph;

namespace {

std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(DynamicLibrary, GivesFunctionsByTheirNames) {
  double (*cosine)(double) = nullptr;
  DynamicLibrary("libm.so.6", "a cosine", "cos").load(cosine, "cos");
  EXPECT_EQ(cosine(0.), 1.);
}

TEST(DynamicLibrary, AMissingLibraryIsNamedWithWhatItIsNeededFor) {
  const std::string message = messageOf([] { DynamicLibrary("libnowhere.so.7", "a camera image", "mj_step"); });
  EXPECT_TRUE(message.starts_with("a camera image needs the library libnowhere.so.7, which cannot be loaded: "))
      << message;
}

TEST(DynamicLibrary, AMissingFunctionIsNamed) {
  void (*function)() = nullptr;
  const std::string message =
      messageOf([&] { DynamicLibrary("libm.so.6", "a cosine", "cos").load(function, "kosinus"); });
  EXPECT_EQ(message, "a cosine needs another version of libm.so.6: this one has no kosinus");
}
