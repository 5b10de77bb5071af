#include "kinegraph/viewer/recorded_page.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/gzip.h"
#include "kinegraph/viewer/messages/binary_messages.h"
#include "kinegraph/viewer/scene_items.h"

namespace kinegraph::inline viewer_internal {

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

/// The page around its recording.
struct EmptyPage {
  std::string before;         ///< the recording
  std::string packed_client;  ///< the client's script, and a small one that unpacks it
  std::string_view client;    ///< the client's script
  std::string after;
};

const EmptyPage& emptyPage() {
  static const EmptyPage page = [] {
    constexpr std::string_view kPlace = "<!-- RECORDING -->", kScript = "<script>", kEnd = "</script>";
    const std::string_view whole = clientPage();
    const PagePart unpack = partBetween(whole, "<script type=\"text/plain\" id=\"unpack\">", kEnd);
    const PagePart script{whole.rfind(kScript) + kScript.size(), whole.rfind(kEnd)};
    return EmptyPage{
        std::string(whole.substr(0, whole.find(kPlace))),
        element("client", gzipped(script.in(whole))) + "<script>" + std::string(unpack.in(whole)) + std::string(kEnd),
        script.in(whole), std::string(whole.substr(script.end + kEnd.size()))};
  }();
  return page;
}

std::string pageOf(std::string_view compressed) {
  return emptyPage().before + element("recording", compressed) + emptyPage().packed_client + emptyPage().after;
}

/// Links are not followed: a server has them where they are.
std::filesystem::path wholePath(const std::string& path) { return std::filesystem::absolute(path).lexically_normal(); }

/// Returns the address of a file relative to the folder of another one.
std::string addressOf(const std::string& file, const std::string& page) {
  const std::string path = wholePath(file).lexically_relative(wholePath(page).parent_path()).generic_string();
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string address;
  for (const unsigned char c : path) {
    if (kPlain.find(char(c)) != std::string_view::npos) {
      address += char(c);
    } else {
      address += {'%', kDigits[c >> 4], kDigits[c & 15]};
    }
  }
  return address;
}

/// Returns the page with the script of a file in place of its own.
std::string withClientAt(const std::string& page, const std::string& address) {
  constexpr std::string_view kRule = "script-src ", kEnds = ";\"";
  const EmptyPage& empty = emptyPage();
  std::string before = empty.before;
  const std::size_t rule = before.find(kRule) + kRule.size();
  before.replace(rule, before.find_first_of(kEnds, rule) - rule, "'self' file:");
  const std::size_t rest = empty.packed_client.size() + empty.after.size();
  return before + page.substr(empty.before.size(), page.size() - empty.before.size() - rest) + "<script src=\"" +
         address + "\"></script>" + empty.after;
}

void writeFile(const std::string& path, std::string_view content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  if (!file.flush()) throw FileError(cat("saveHtml: '", path, "' cannot be written"));
}

/// Writes the script of the pages, unless it is there.
void provideClient(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const std::string part = cat(path, ".", getpid(), ".part");  // other programs may write it, too
    writeFile(part, emptyPage().client);
    std::error_code failed;
    std::filesystem::rename(part, path, failed);
    if (failed) throw FileError(cat("saveHtml: '", path, "' cannot be written"));
    return;
  }
  const std::string content(std::istreambuf_iterator<char>(file), {});
  if (content == emptyPage().client) return;
  throw FileError(cat("saveHtml: the client '", path, "' is another file than the script of this version's pages; ",
                      "delete it, or name a file that does not exist"));
}

}  // namespace

void savePage(const std::string& page, const std::string& path, const std::string& client) {
  if (client.empty()) return writeFile(path, page);
  if (wholePath(client) == wholePath(path))
    throw ValueError(cat("saveHtml: the client '", client, "' is the page itself; expected another file, .js"));
  provideClient(client);
  writeFile(path, withClientAt(page, addressOf(client, path)));
}

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
  return pageOf(file.substr(kRunMark.size()));
}

std::string recordedPage(const std::vector<Outgoing>& messages) {
  std::string stream;
  for (const Outgoing& message : messages) appendMessage(stream, 0., message);
  return pageOf(gzipped(stream));
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

}  // namespace kinegraph::inline viewer_internal
