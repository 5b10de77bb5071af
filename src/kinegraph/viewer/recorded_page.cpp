#include "kinegraph/viewer/recorded_page.h"

#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/gzip.h"
#include "kinegraph/viewer/messages/binary_messages.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph {

namespace {

std::string base64(std::string_view data) {
  constexpr char kLetters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(data.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < data.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return k < data.size() ? std::uint32_t(static_cast<unsigned char>(data[k])) : 0u;
    };
    const std::uint32_t bits = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 0; k < 4; ++k) text += i + std::size_t(k) > data.size() ? '=' : kLetters[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

/// The first bytes of the file of a run; gzipped messages follow.
constexpr std::string_view kRunMark = "kinegraph run 1\n";

/// An element with compressed data.
std::string element(const std::string& id, std::string_view compressed) {
  return "<script type=\"text/plain\" id=\"" + id + "\">" + base64(compressed) + "</script>";
}

struct PagePart {
  std::size_t begin, end;
  std::string_view in(std::string_view page) const { return page.substr(begin, end - begin); }
};

/// Returns what is between two texts; the last occurrence of `start` counts.
PagePart partBetween(std::string_view page, std::string_view start, std::string_view end) {
  const std::size_t begin = page.rfind(start) + start.size();
  return {begin, page.find(end, begin)};
}

/// The page before and behind its recording. A small script, which the page brings along, unpacks the client's.
const std::array<std::string, 2>& emptyPage() {
  static const std::array<std::string, 2> parts = [] {
    constexpr std::string_view kPlace = "<!-- RECORDING -->", kScript = "<script>", kEnd = "</script>";
    const std::string_view page = clientPage();
    const std::size_t place = page.find(kPlace);
    const PagePart unpack = partBetween(page, "<script type=\"text/plain\" id=\"unpack\">", kEnd);
    const PagePart script{page.rfind(kScript) + kScript.size(), page.rfind(kEnd)};
    return std::array{std::string(page.substr(0, place)), element("client", gzipped(script.in(page))) + "<script>" +
                                                              std::string(unpack.in(page)) +
                                                              std::string(page.substr(script.end))};
  }();
  return parts;
}

}  // namespace

void appendMessage(std::string& stream, double time, const Outgoing& message) {
  appendBytes(stream, time);
  appendBytes(stream, std::uint32_t(message.binary));
  appendBytes(stream, std::uint32_t(message.data->size()));
  stream += *message.data;
  stream.resize((stream.size() + 3) / 4 * 4, '\0');
}

void appendEnd(std::string& stream, double time) {
  appendMessage(stream, time, {std::make_shared<std::string>(), true});
}

std::string runFile(const std::string& stream) { return std::string(kRunMark) + gzipped(stream); }

std::string runPage(std::string_view file) {
  if (!file.starts_with(kRunMark))
    throw ValueError("run: the file is not a recorded run of this version; viewer.record writes such files");
  return emptyPage()[0] + element("recording", file.substr(kRunMark.size())) + emptyPage()[1];
}

std::string recordedPage(const std::vector<Outgoing>& messages) {
  std::string stream;
  for (const Outgoing& message : messages) appendMessage(stream, 0., message);
  return emptyPage()[0] + element("recording", gzipped(stream)) + emptyPage()[1];
}

std::string recordedPage(const ShownScene& scene, std::size_t largest) {
  constexpr double kFinest = 2048.;  // cells along the largest mesh at the first merging of vertices
  constexpr int kCoarsenings = 7;    // each by a factor of two
  const double size = scene.largestMesh();
  std::string page = recordedPage(scene.messages());
  for (int i = 0; i <= kCoarsenings && largest > 0 && page.size() > largest && size > 0.; ++i)
    page = recordedPage(scene.messages(size / kFinest * std::exp2(i)));
  return page;
}

std::string recordedScene(const Config& config, const ShownMotion* motion, const std::string& title,
                          std::shared_ptr<PageContent> content, std::size_t largest) {
  SceneItems items;
  items.read(config);
  ShownScene scene;
  scene.title = title;
  scene.content = std::move(content);
  scene.update(items.items());
  scene.setJoints(items.structure(), items.joints(), config.getJointState());
  scene.setWarnings(sceneWarnings(config));
  if (motion) scene.setMotion(*motion);
  return recordedPage(scene, largest);
}

}  // namespace kinegraph
