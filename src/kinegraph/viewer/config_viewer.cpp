#include "kinegraph/viewer/config_viewer.h"

#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace kinegraph {

ViewerServer& ConfigViewer::server() {
  if (!server_) {
    server_ = std::make_unique<ViewerServer>(options_);
    std::printf("Viewer: %s\n", server_->url().c_str());
    std::fflush(stdout);
    openBrowser(server_->url());
  }
  return *server_;
}

void ConfigViewer::update(const Config& config) {
  ViewerServer& to = server();
  const auto& frames = config.scene()->frames();
  const State& state = config.state();
  items_.resize(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameData& frame = *frames[i];
    ViewItem& item = items_[i];
    if (item.name != frame.name) item.name = frame.name;
    item.parent = frame.parent ? frame.parent->id : -1;
    item.pose = Pose(state.pose(int(i)));
    item.geometry = nullptr;
    if (!frame.shape) continue;
    const std::shared_ptr<const Geometry> visual = visual_meshes_.of(*frame.shape);
    item.geometry = visual ? visual : frame.shape->geometry;
    item.color = frame.shape->color.value_or(Vector4d(.8, .8, .8, 1.));
  }
  to.update(items_);
}

int ConfigViewer::view(const Config& config, bool pause, const std::optional<std::string>& message, const std::function<bool()>& stop) {
  update(config);
  if (!pause) {
    if (message) server().setMessage(*message);
    return server().takeKey();
  }
  std::string text = message.value_or("");
  if (!text.ends_with("]")) text += text.empty() ? "[press key to continue]" : "\n[press key to continue]";
  int key = server().takeKey();
  server().setMessage(text);
  if (!isHeadless()) key = waitKey(text, stop);
  server().setMessage(message.value_or(""));
  return key;
}

int ConfigViewer::waitKey(const std::string& prompt, const std::function<bool()>& stop) {
  constexpr auto kPatience = std::chrono::seconds(5);  // a page that is loaded again is back sooner
  const bool terminal = isatty(STDIN_FILENO);
  if (terminal) {
    std::printf("%s (in the browser, or Enter here)\n", prompt.c_str());
    std::fflush(stdout);
  }
  bool entered = false;
  auto last_seen = std::chrono::steady_clock::now();
  const int key = server().waitKey([&] {
    const auto now = std::chrono::steady_clock::now();
    if (clients() > 0) last_seen = now;
    return (entered = enterWasPressed()) || (!terminal && now - last_seen > kPatience) || stop();
  });
  return entered ? 13 : key;
}

bool enterWasPressed() {
  if (!isatty(STDIN_FILENO)) return false;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) <= 0 || !(input.revents & POLLIN)) return false;
  char line[256];
  return read(STDIN_FILENO, line, sizeof line) > 0;
}

}  // namespace kinegraph
