#include "kinegraph/viewer/recorded_page.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/messages/merged_lines.h"

using namespace kinegraph;

namespace {

Outgoing message(const std::string& data, bool binary) { return {std::make_shared<std::string>(data), binary}; }

/// Returns the content of the recording's script element; the browser's tests read it.
std::string recordingOf(const std::vector<Outgoing>& messages) {
  const std::string page = recordedPage(messages), start = "id=\"recording\">";
  const std::size_t first = page.find(start) + start.size();
  return page.substr(first, page.find("</script", first) - first);
}

std::string contentOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

Mesh ball(int n) {
  Mesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double a = M_PI * i / (n - 1), b = 2. * M_PI * j / n;
      mesh.vertices.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    }
  }
  const auto at = [&](int i, int j) { return std::uint32_t(i * n + j % n); };
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

}  // namespace

TEST(RecordedPage, IsTheClientPacked) {
  const std::string page = recordedPage(std::vector<Outgoing>{});
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_LT(page.size(), clientPage().size() / 2);
  EXPECT_EQ(page.find("WebGLRenderer"), std::string::npos);
}

TEST(RecordedPage, MessagesAreInBase64) {
  EXPECT_TRUE(recordingOf({message("{\"a\":1}", false)}).starts_with("H4sI"));  // 1f 8b 08: gzip
  for (std::size_t size = 0; size < 9; ++size) {
    const std::string text = recordingOf({message(std::string(size, '\xff'), true)});
    EXPECT_EQ(text.size() % 4, 0u);
    EXPECT_EQ(text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/="),
              std::string::npos);
  }
}

TEST(RecordedPage, MeshesGetCoarserUntilThePageIsSmallEnough) {
  Config config;
  config.addFrame("ball").setMesh(ball(300));
  const std::size_t empty = recordedPage(std::vector<Outgoing>{}).size(), whole = recordedScene(config).size();
  ASSERT_GT(whole, empty + 60000);
  const std::size_t largest = empty + 40000;
  const std::string page = recordedScene(config, nullptr, "a ball", nullptr, largest);
  EXPECT_LE(page.size(), largest);
  EXPECT_GT(page.size(), empty + 5000);
  EXPECT_EQ(recordedScene(config, nullptr, "a ball", nullptr, whole + 1000).size(),
            recordedScene(config, nullptr, "a ball").size());
}

TEST(RecordedPage, LinesAreMergedUntilThePageIsSmallEnough) {
  Config config;
  Rng rng(0);
  std::vector<Vector3d> points;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d from(rng.uniform(), rng.uniform(), rng.uniform());
    for (const double step : {0., .01}) points.push_back(from + Vector3d::Constant(step));
  }
  Frame frame = config.addFrame("roadmap");
  setLines(frame, points);
  const std::size_t whole = recordedScene(config, nullptr, "lines").size(), largest = whole - 50000;
  EXPECT_LE(recordedScene(config, nullptr, "lines", nullptr, largest).size(), largest);
}

TEST(RecordedPage, MergedLinesHaveMeansOfEndsAndAreThereOnce) {
  Mesh lines;
  lines.vertices = {{0., 0., 0.}, {.9, 0., 0.}, {1.1, 0., 0.}, {.1, 0., 0.}, {0., 2., 0.}, {.1, 2., 0.}};
  const Mesh merged = mergedLines(lines, 1.);
  ASSERT_EQ(merged.vertices.size(), 2u);
  EXPECT_NEAR(merged.vertices[0].x(), .05, 1e-12);
  EXPECT_NEAR(merged.vertices[1].x(), 1., 1e-12);
}

TEST(RecordedPage, PagesShareTheScriptOfAFile) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "shared client";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "pages");
  const std::string page = recordedPage({message("{}", false)}), client = folder / "viewer.js";
  savePage(page, folder / "pages/first.html", client);
  savePage(page, folder / "second.html", client);
  EXPECT_NE(std::string(clientPage()).find(contentOf(client)), std::string::npos);
  EXPECT_GT(contentOf(client).size(), 100000u);
  const std::string first = contentOf(folder / "pages/first.html"), second = contentOf(folder / "second.html");
  EXPECT_NE(first.find(recordingOf({message("{}", false)})), std::string::npos);
  EXPECT_NE(first.find("<script src=\"../viewer.js\"></script>"), std::string::npos);
  EXPECT_NE(second.find("<script src=\"viewer.js\"></script>"), std::string::npos);
  EXPECT_LT(first.size(), 100000u);
  std::ofstream(client) << "of another version";
  EXPECT_THROW(savePage(page, folder / "second.html", client), FileError);
  savePage(page, folder / "second.html", "");
  EXPECT_EQ(contentOf(folder / "second.html"), page);
}
