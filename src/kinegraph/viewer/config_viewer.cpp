#include "kinegraph/viewer/config_viewer.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <map>
#include <mutex>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/recorded_page.h"
#include "kinegraph/viewer/scene_edits.h"
#include "kinegraph/viewer/scene_items.h"
#include "kinegraph/viewer/server.h"
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

struct ConfigViewer::Impl {
  ViewerOptions options;
  std::mutex message_mutex{};  ///< a picture may be rendered while another thread waits for a key
  std::string message{};
  bool waits = true;
  std::unique_ptr<ViewerServer> server{};
  SceneItems items{};
  bool knows_items = false;  ///< the page has those of the last update
  Appearance appearance{};
  std::optional<PageCamera> camera{};  ///< last camera set by the program
  std::map<int, Quad> quads{};
  std::weak_ptr<SceneTree> scene{};
  std::shared_ptr<SceneTree> kept_scene{};  ///< the same, unless it owns this viewer
  std::shared_ptr<SceneEdits> edits = std::make_shared<SceneEdits>();
};

ConfigViewer::ConfigViewer() : ConfigViewer(ViewerOptions{}) {}
ConfigViewer::ConfigViewer(ViewerOptions options) : impl_(new Impl{std::move(options)}) {
  content()->onChange([this] { contentChanged(); });
}
ConfigViewer::~ConfigViewer() { content()->onChange({}); }  // controls may outlive it

int ConfigViewer::structure() const { return impl_->items.structure(); }
bool ConfigViewer::hasEdits() const { return impl_->edits->hasAny(); }
bool ConfigViewer::isOpen() const { return impl_->server && impl_->server->isOurs(); }
std::string ConfigViewer::url() { return server().url(); }
int ConfigViewer::clients() const { return isOpen() ? impl_->server->clients() : 0; }
void ConfigViewer::setWaits(bool waits) { impl_->waits = waits; }
bool ConfigViewer::waits() const { return impl_->waits && !isHeadless(); }
void ConfigViewer::setError(const std::string& text) { server().setError(text); }
void ConfigViewer::select(int frame) { server().select(frame); }
const std::map<int, Quad>& ConfigViewer::quads() const { return impl_->quads; }
std::shared_ptr<SceneTree> ConfigViewer::pictured() const { return impl_->scene.lock(); }
void ConfigViewer::setupEventHandler(bool instead) { server().requestEvents(instead); }
std::vector<std::string> ConfigViewer::getEvents() { return server().takeEvents(); }
std::optional<Cursor> ConfigViewer::getEventCursor() { return server().cursor(); }
std::optional<PageCamera> ConfigViewer::takeViewpoint() {
  return isOpen() ? impl_->server->takeViewpoint() : std::nullopt;
}

bool isPatient() { return isatty(STDIN_FILENO) || isOverSsh(); }

ViewerServer& ConfigViewer::server() {
  if (impl_->server && !impl_->server->isOurs()) impl_->server.reset();
  if (!impl_->server) {
    impl_->knows_items = false;
    impl_->server = std::make_unique<ViewerServer>(impl_->options);
    impl_->server->onCommand([edits = impl_->edits](const Command& command) { return edits->apply(command); });
    impl_->server->show([&](ShownScene& scene) {
      scene.content = content();
      return true;
    });
    impl_->server->setMessage(message());
    impl_->server->setAppearance(impl_->appearance);
    if (impl_->camera) impl_->server->setCamera(*impl_->camera);
    for (const auto& [id, quad] : impl_->quads) impl_->server->setQuad(quad);
    if (!isHeadless()) announce(*impl_->server);
    openBrowser(impl_->server->url());
  }
  return *impl_->server;
}

void ConfigViewer::serveAt(const std::string& host, int port, const std::string& token) {
  const bool is_same = impl_->options.host == host && impl_->options.port == port && impl_->options.token == token;
  if (impl_->server && impl_->server->isOurs() && is_same) return;
  if (!std::all_of(token.begin(), token.end(), [](unsigned char c) { return std::isalnum(c) || c == '-' || c == '_'; }))
    throw ValueError(cat("viewer: the token is '", token, "'; expected letters, digits, '-' and '_'"));
  ViewerOptions options = impl_->options;
  options.host = host;
  options.port = port;
  options.token = token;
  const ViewerOptions before = std::exchange(impl_->options, std::move(options));
  impl_->server.reset();
  try {
    server();
  } catch (...) {
    impl_->options = before;
    throw;
  }
}

void ConfigViewer::setScene(const std::shared_ptr<SceneTree>& scene) {
  impl_->scene = scene;
  impl_->kept_scene = scene->viewer.get() == this ? nullptr : scene;
}

void ConfigViewer::setCamera(const PageCamera& camera) {
  impl_->camera = camera;
  if (isOpen()) impl_->server->setCamera(camera);
}

const Appearance& ConfigViewer::appearance() const { return impl_->appearance; }

void ConfigViewer::setAppearance(const Appearance& appearance) {
  impl_->appearance = appearance;
  if (isOpen()) impl_->server->setAppearance(appearance);
}

void ConfigViewer::visualsOnly(bool yes) {
  Appearance appearance = impl_->appearance;
  appearance.visuals_only = yes;
  setAppearance(appearance);
}

int ConfigViewer::setQuad(int id, const PageImage& image, double x, double y, double height) {
  if (id < -1) throw ValueError(cat("setQuad: id is ", id, "; expected -1 for a new image, or an existing id"));
  if (!(std::isfinite(x) && std::isfinite(y) && std::isfinite(height) && height > 0.)) {
    throw ValueError(
        cat("setQuad: x, y, h are ", x, ", ", y, ", ", height, "; expected fractions of the window's height, h > 0"));
  }
  if (image.rgb.empty() || image.rgb.size() != 3 * std::size_t(image.columns) * std::size_t(image.rows)) {
    throw ValueError(cat("setQuad: ", image.rgb.size(), " bytes; expected 3 for each of ", image.rows, " x ",
                         image.columns, " pixels"));
  }
  auto& quads = impl_->quads;
  const int chosen = id >= 0 ? id : quads.empty() ? 0 : quads.rbegin()->first + 1;
  quads[chosen] = {chosen, x, y, height, 0., image.columns, image.rows, image.rgb};
  if (isOpen()) impl_->server->setQuad(quads[chosen]);
  return chosen;
}

void ConfigViewer::setTitle(const std::string& text) {
  impl_->options.title = text;
  if (impl_->server) impl_->server->setTitle(text);
}

void ConfigViewer::remember(const std::string& text) {
  const std::lock_guard lock(impl_->message_mutex);
  impl_->message = text;
}

std::string ConfigViewer::message() const {
  const std::lock_guard lock(impl_->message_mutex);
  return impl_->message;
}

void ConfigViewer::setMessage(const std::string& text) {
  remember(text);
  server().setMessage(text);
}

void ConfigViewer::storeMessage(const std::string& text) {
  remember(text);
  if (isOpen()) impl_->server->setMessage(text);
}

std::string ConfigViewer::recording(std::size_t largest) {
  server().setWarnings(impl_->edits->warnings());
  return server().recording(largest);
}

void ConfigViewer::saveHtml(const std::string& path, const std::string& client) { savePage(recording(), path, client); }

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
  if (isOpen()) impl_->server->show([](ShownScene&) { return true; });
}

int ConfigViewer::takeKey() {
  poll();
  return isOpen() ? impl_->server->takeKey() : 0;
}

void ConfigViewer::close() {
  if (isOpen()) impl_->server->stopRecording();
  impl_->server.reset();
  impl_->appearance = {};
  impl_->camera.reset();
  impl_->quads.clear();
  if (reset_pictures_) reset_pictures_();
  remember("");
}

void ConfigViewer::update(const Config& config) {
  ViewerServer& to = server();
  setScene(config.scene());
  impl_->items.read(config);
  to.endMotion();
  std::exchange(impl_->knows_items, true) ? to.update(impl_->items.items(), impl_->items.changed())
                                          : to.update(impl_->items.items());
  to.setJoints(impl_->items.structure(), impl_->items.joints(), config.getJointState());
  impl_->edits->setScene(config.scene()->snapshot(), impl_->items.structure());
  if (clients() == 0) impl_->edits->forgetMargin();
  const double margin = impl_->edits->margin();
  to.setNear(margin > 0. ? nearLines(config, margin) : std::vector<NearLine>{});
}

bool ConfigViewer::takeEdits(Config& config) { return impl_->items.isOf(config) && impl_->edits->takeInto(config); }

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
