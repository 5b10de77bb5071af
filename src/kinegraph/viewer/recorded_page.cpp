#include "kinegraph/viewer/recorded_page.h"

#include "kinegraph/common/json.h"
#include "kinegraph/viewer/client_page.h"
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

boost::json::value recorded(const Outgoing& message) {
  if (message.binary) return boost::json::object{{"binary", base64(*message.data)}};
  return boost::json::object{{"text", jsonOf(*message.data)}};
}

/// Escapes text for a script element: "<" occurs in strings only, and strings may escape it.
std::string insideScript(const std::string& json) {
  std::string text;
  for (const char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

}  // namespace

std::string recordedPage(const std::vector<Outgoing>& messages) {
  constexpr std::string_view kPlace = "<!-- RECORDING -->";
  boost::json::array list;
  for (const Outgoing& message : messages) list.push_back(recorded(message));
  const std::string recording = insideScript(boost::json::serialize(list));
  std::string page(clientPage());
  page.replace(page.find(kPlace), kPlace.size(),
               "<script type=\"application/json\" id=\"recording\">" + recording + "</script>");
  return page;
}

std::string recordedScene(const Config& config, const ShownMotion* motion, const std::string& title,
                          std::shared_ptr<PageContent> content) {
  SceneItems items;
  items.read(config);
  ShownScene scene;
  scene.title = title;
  scene.content = std::move(content);
  scene.update(items.items());
  scene.setJoints(items.structure(), items.joints(), config.getJointState());
  scene.setWarnings(sceneWarnings(config));
  if (motion) scene.setMotion(*motion);
  ShownScene::Seen nothing;
  return recordedPage(scene.messagesSince(nothing));
}

}  // namespace kinegraph
