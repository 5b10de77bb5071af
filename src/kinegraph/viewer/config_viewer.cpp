#include "kinegraph/viewer/config_viewer.h"

#include <poll.h>
#include <unistd.h>

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

bool ConfigViewer::canWait() const { return !isHeadless() && (clients() > 0 || isatty(STDIN_FILENO)); }

int ConfigViewer::view(const Config& config, bool pause, const std::optional<std::string>& message, const std::function<bool()>& stop) {
  update(config);
  if (!pause) {
    if (message) server().setMessage(*message);
    return server().takeKey();
  }
  std::string text = message.value_or("");
  if (!text.ends_with("]")) text += text.empty() ? "[press key to continue]" : "\n[press key to continue]";
  server().setMessage(text);
  int key = server().takeKey();
  if (key == 0 && !isHeadless()) {
    if (clients() == 0) server().waitForClient(isatty(STDIN_FILENO) ? 0. : 5.);
    if (canWait()) {
      if (isatty(STDIN_FILENO)) {
        std::printf("%s (in the browser, or Enter here)\n", text.c_str());
        std::fflush(stdout);
      }
      bool entered = false;
      key = server().waitKey([&] { return (entered = enterWasPressed()) || stop(); });
      if (entered) key = 13;
    }
  }
  server().setMessage(message.value_or(""));
  return key;
}

bool enterWasPressed() {
  if (!isatty(STDIN_FILENO)) return false;
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (poll(&input, 1, 0) <= 0 || !(input.revents & POLLIN)) return false;
  char line[256];
  return read(STDIN_FILENO, line, sizeof line) > 0;
}

}  // namespace kinegraph
