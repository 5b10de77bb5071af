#include "kinegraph/viewer/config_viewer.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

namespace {

bool isOverSsh() { return std::getenv("SSH_CONNECTION") != nullptr; }

/// Logs the address of the page.
void announce(const ViewerServer& server) {
  const std::string url = server.url();
  constexpr std::string_view kLocal = "http://localhost:";
  std::string hint;
  if (isOverSsh() && url.starts_with(kLocal)) {
    const std::string port = url.substr(kLocal.size(), url.find('/', kLocal.size()) - kLocal.size());
    hint = cat(" (on your own machine, after: ssh -L ", port, ":localhost:", port, " and the name of this machine)");
  }
  logMessage(LogLevel::notice, cat("Viewer: ", url, hint));
}

}  // namespace

bool isPatient() { return isatty(STDIN_FILENO) || isOverSsh(); }

ViewerServer& ConfigViewer::server() {
  if (server_ && !server_->isOurs()) server_.reset();
  if (!server_) {
    knows_items_ = false;
    server_ = std::make_unique<ViewerServer>(options_);
    server_->onCommand([edits = edits_](const Command& command) { return edits->apply(command); });
    server_->show([&](ShownScene& scene) {
      scene.content = content();
      return true;
    });
    server_->setMessage(message());
    if (!isHeadless()) announce(*server_);
    openBrowser(server_->url());
  }
  return *server_;
}

void ConfigViewer::serveAt(const std::string& host, int port, const std::string& token) {
  const bool is_same = options_.host == host && options_.port == port && options_.token == token;
  if (server_ && server_->isOurs() && is_same) return;
  if (!std::all_of(token.begin(), token.end(), [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; }))
    throw ValueError(cat("viewer: the token is '", token, "'; expected letters, digits, '-' and '_'"));
  ViewerOptions options = options_;
  options.host = host;
  options.port = port;
  options.token = token;
  const ViewerOptions before = std::exchange(options_, std::move(options));
  server_.reset();
  try {
    server();
  } catch (...) {
    options_ = before;
    throw;
  }
}

void ConfigViewer::setTitle(const std::string& text) {
  options_.title = text;
  if (server_) server_->setTitle(text);
}

void ConfigViewer::remember(const std::string& text) {
  const std::lock_guard lock(message_mutex_);
  message_ = text;
}

std::string ConfigViewer::message() const {
  const std::lock_guard lock(message_mutex_);
  return message_;
}

void ConfigViewer::setMessage(const std::string& text) {
  remember(text);
  server().setMessage(text);
}

void ConfigViewer::storeMessage(const std::string& text) {
  remember(text);
  if (isOpen()) server_->setMessage(text);
}

std::string ConfigViewer::recording(std::size_t largest) {
  server().setWarnings(edits_->warnings());
  return server().recording(largest);
}

ViewerRecording ConfigViewer::record(const std::string& path) {
  server().startRecording(path);
  return ViewerRecording(*this);
}

ViewerRecording::~ViewerRecording() {
  try {
    stop();
  } catch (const Error& error) {
    logMessage(LogLevel::notice, error.what());
  }
}

void ViewerRecording::stop() {
  if (ConfigViewer* viewer = std::exchange(viewer_, nullptr); viewer && viewer->isOpen())
    viewer->server().stopRecording();
}

void ConfigViewer::contentChanged() {
  if (isOpen()) server_->show([](ShownScene&) { return true; });
}

int ConfigViewer::takeKey() {
  poll();
  return isOpen() ? server_->takeKey() : 0;
}

void ConfigViewer::close() {
  if (isOpen()) server_->stopRecording();
  server_.reset();
  remember("");
}

void ConfigViewer::update(const Config& config) {
  ViewerServer& to = server();
  items_.read(config);
  to.endMotion();
  std::exchange(knows_items_, true) ? to.update(items_.items(), items_.changed()) : to.update(items_.items());
  to.setJoints(items_.structure(), items_.joints(), config.getJointState());
  edits_->setScene(config.scene()->snapshot(), items_.structure());
  if (clients() == 0) edits_->forgetMargin();
  const double margin = edits_->margin();
  to.setNear(margin > 0. ? nearLines(config, margin) : std::vector<NearLine>{});
}

bool ConfigViewer::takeEdits(Config& config) { return items_.isOf(config) && edits_->takeInto(config); }

int ConfigViewer::view(Config& config, bool pause, const std::optional<std::string>& message,
                       const CancellationToken& cancellation) {
  takeEdits(config);
  poll();
  update(config);
  const int key = wait(pause, message, cancellation);
  if (pause && takeEdits(config)) update(config);
  return key;
}

int ConfigViewer::wait(bool pause, const std::optional<std::string>& message, const CancellationToken& cancellation) {
  if (pause) return promptKey(message, cancellation);
  if (message) setMessage(*message);
  return server().takeKey();
}

int ConfigViewer::showMotion(const Config& config, const ShownMotion& motion, bool pause,
                             const std::optional<std::string>& message, const CancellationToken& cancellation) {
  update(config);
  server().showMotion(motion);
  if (message) setMessage(*message);
  int key = server().takeKey();
  if (!waits()) return key;
  if (motion.start == ShownMotion::Start::play) {
    using Clock = std::chrono::steady_clock;
    const auto end =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(motion.seconds));
    key = waitKey(message.value_or(""), [&] { return Clock::now() >= end || cancellation(); });
  }
  return pause && key == 0 ? promptKey(message, cancellation) : key;
}

int ConfigViewer::promptKey(const std::optional<std::string>& message, const CancellationToken& cancellation) {
  std::string text = message.value_or("");
  if (!text.ends_with("]")) text += text.empty() ? "[press key to continue]" : "\n[press key to continue]";
  int key = server().takeKey();
  setMessage(text);
  if (waits()) key = waitKey(text, cancellation);
  setMessage(message.value_or(""));
  return key;
}

int ConfigViewer::waitKey(const std::string& prompt, const CancellationToken& cancellation) {
  constexpr auto kPatience = std::chrono::seconds(5);  // a reloaded page is back sooner
  const bool patient = isPatient();
  if (isatty(STDIN_FILENO)) logMessage(LogLevel::notice, cat(prompt, " (in the browser, or Enter here)"));
  bool entered = false, seen = false;
  auto last_seen = std::chrono::steady_clock::now();
  const int key = server().waitKey([&] {
    poll();
    const auto now = std::chrono::steady_clock::now();
    if (clients() > 0) {
      last_seen = now;
      seen = true;
    }
    return (entered = enterWasPressed()) || ((!patient || seen) && now - last_seen > kPatience) || cancellation();
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
