#include "kinegraph/viewer/server.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/shown_scene.h"
#include "kinegraph/viewer/web_server.h"

namespace kinegraph::inline viewer_internal {

class ViewerServer::Impl {
 public:
  explicit Impl(const ViewerOptions& options)
      : state_(stateTitled(options.title)),
        web_(options, state_, [this](const Command& command) { receive(command); }) {}

  const std::string& url() const { return web_.url(); }

  /// Changes the locked scene; if the change returns true, all browsers are updated.
  template <class Change>
  void changeScene(const Change& change) {
    bool changed;
    {
      const std::lock_guard lock(state_->mutex);
      changed = change(state_->scene);
      if (changed && state_->recorder) state_->recorder->add(state_->scene);
    }
    if (changed) web_.wake();
  }

  std::shared_ptr<ViewerState> state_;
  const pid_t process_ = getpid();
  std::function<std::optional<EditedScene>(const Command&)> answer_;  ///< guarded by `answer_mutex_`
  std::mutex answer_mutex_;

 private:
  static std::shared_ptr<ViewerState> stateTitled(const std::string& title) {
    auto state = std::make_shared<ViewerState>();
    state->scene.title = title;
    return state;
  }

  /// Runs on the server's thread.
  void receive(const Command& command) {
    if (const auto* key = std::get_if<KeyCommand>(&command)) return state_->press(*key);
    if (const auto* event = std::get_if<EventCommand>(&command)) return state_->addEvent(*event);
    if (const auto* cursor = std::get_if<CursorCommand>(&command)) return state_->moveCursor(*cursor);
    if (const auto* viewpoint = std::get_if<ViewpointCommand>(&command)) return state_->moveCamera(*viewpoint);
    if (const auto* run = std::get_if<RunCommand>(&command)) return state_->steerRun(*run);
    if (const auto* perturb = std::get_if<PerturbCommand>(&command)) return state_->perturb(*perturb);
    if (const auto* control = std::get_if<ControlCommand>(&command)) return receiveControl(*control);
    if (const auto* click = std::get_if<ClickCommand>(&command)) return state_->click(*click);
    std::optional<EditedScene> edited;
    try {
      const std::lock_guard lock(answer_mutex_);
      if (answer_) edited = answer_(command);
    } catch (const Error&) {  // an impossible command is ignored
    }
    if (!edited) return;
    changeScene([&](ShownScene& scene) {
      scene.setEdited(*edited);
      return true;
    });
    state_->changed.notify_all();
  }

  void receiveControl(const ControlCommand& command) {
    changeScene([&](ShownScene& scene) { return scene.content && scene.content->apply(command); });
    state_->changed.notify_all();
  }

  WebServer web_;  ///< declared last, because its thread uses the other members
};

ViewerServer::ViewerServer(const ViewerOptions& options) : impl_(std::make_unique<Impl>(options)) {}

ViewerServer::~ViewerServer() {
  if (!isOurs()) (void)impl_.release();  // its sockets are shared with the parent process
}

bool ViewerServer::isOurs() const { return impl_->process_ == getpid(); }

std::string ViewerServer::url() const { return impl_->url(); }

int ViewerServer::clients() const {
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->clients;
}

void ViewerServer::show(const std::function<bool(ShownScene&)>& change) { impl_->changeScene(change); }

void ViewerServer::update(std::span<const ViewItem> items) {
  impl_->changeScene([&](ShownScene& scene) { return scene.update(items); });
}

void ViewerServer::update(std::span<const ViewItem> items, std::span<const int> changed) {
  impl_->changeScene([&](ShownScene& scene) { return scene.update(items, changed); });
}

void ViewerServer::setJoints(int structure, const ShownJoints& joints, const VectorXd& q) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setJoints(structure, joints, q); });
}

void ViewerServer::showMotion(const ShownMotion& motion) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.setMotion(motion);
    return true;
  });
  const std::lock_guard lock(impl_->state_->mutex);
  if (impl_->state_->recorder) impl_->state_->recorder->addMotion(impl_->state_->scene, motion.seconds);
}

void ViewerServer::endMotion() {
  impl_->changeScene([](ShownScene& scene) { return scene.endMotion(); });
}

void ViewerServer::showRun(const ShownRun& run) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.setRun(run);
    return true;
  });
}

void ViewerServer::endRun() {
  impl_->changeScene([](ShownScene& scene) { return scene.endRun(); });
}

void ViewerServer::select(int item) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.select(item);
    return true;
  });
}

std::string ViewerServer::recording(std::size_t largest) const { return impl_->state_->recording(largest); }

void ViewerServer::startRecording(const std::string& path) {
  const std::lock_guard lock(impl_->state_->mutex);
  if (impl_->state_->recorder) throw ValueError("record: a recording of this viewer runs already; end it first");
  impl_->state_->recorder = std::make_unique<RunRecorder>(path, impl_->state_->scene);
}

void ViewerServer::stopRecording() {
  const std::lock_guard lock(impl_->state_->mutex);
  if (const std::unique_ptr<RunRecorder> recorder = std::move(impl_->state_->recorder))
    recorder->write(impl_->state_->scene);
}

void ViewerServer::onCommand(std::function<std::optional<EditedScene>(const Command&)> answer) {
  const std::lock_guard lock(impl_->answer_mutex_);
  impl_->answer_ = std::move(answer);
}

void ViewerServer::setMessage(const std::string& text) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setText(&ShownScene::message, text); });
}

void ViewerServer::setError(const std::string& text) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setText(&ShownScene::error, text); });
}

void ViewerServer::setTitle(const std::string& text) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setText(&ShownScene::title, text); });
}

void ViewerServer::setCamera(const PageCamera& camera) {
  impl_->changeScene([&](ShownScene& scene) {
    impl_->state_->camera = camera;
    impl_->state_->camera_moved = false;
    scene.setCamera(camera);
    return true;
  });
}

std::optional<PageCamera> ViewerServer::takeViewpoint() {
  const std::lock_guard lock(impl_->state_->mutex);
  return std::exchange(impl_->state_->camera_moved, false) ? impl_->state_->camera : std::nullopt;
}

std::optional<PageCamera> ViewerServer::camera() const {
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->camera;
}

void ViewerServer::setNear(const std::vector<NearLine>& lines) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setNear(lines); });
}

void ViewerServer::setWarnings(const std::vector<SceneWarning>& warnings) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setWarnings(warnings); });
}

void ViewerServer::setQuad(const Quad& quad) {
  if (quad.columns <= 0 || quad.rows <= 0 ||
      quad.rgb.size() != 3 * std::size_t(quad.columns) * std::size_t(quad.rows)) {
    throw ValueError(cat("setQuad: ", quad.rgb.size(), " bytes; expected 3 for each of ", quad.rows, " x ",
                         quad.columns, " pixels"));
  }
  impl_->changeScene([&](ShownScene& scene) {
    scene.setQuad(quad);
    return true;
  });
}

void ViewerServer::setAppearance(const Appearance& appearance) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setAppearance(appearance); });
}

void ViewerServer::requestEvents(bool instead) {
  impl_->changeScene([&](ShownScene& scene) { return scene.requestEvents(instead ? 2 : 1); });
}

void ViewerServer::requestDigits(bool yes) {
  impl_->changeScene([&](ShownScene& scene) { return scene.requestDigits(yes); });
}

std::vector<std::string> ViewerServer::takeEvents() {
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->events.take();
}

std::optional<Cursor> ViewerServer::cursor() {
  impl_->changeScene([&](ShownScene& scene) { return scene.requestCursor(); });
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->cursor;
}

RunRequests ViewerServer::takeRunRequests() {
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->run.take();
}

void ViewerServer::waitRunRequest(double seconds) {
  std::unique_lock lock(impl_->state_->mutex);
  impl_->state_->changed.wait_for(lock, std::chrono::duration<double>(seconds));
}

void ViewerServer::endRunRequests() {
  const std::lock_guard lock(impl_->state_->mutex);
  impl_->state_->run = {};
}

int ViewerServer::takeKey() {
  const std::lock_guard lock(impl_->state_->mutex);
  return std::exchange(impl_->state_->key, 0);
}

int ViewerServer::waitKey(const CancellationToken& cancellation) {
  for (;;) {
    {
      std::unique_lock lock(impl_->state_->mutex);
      impl_->state_->changed.wait_for(lock, std::chrono::milliseconds(20),
                                      [&] { return impl_->state_->key != 0 && impl_->state_->key_releases; });
      if (impl_->state_->key != 0 && impl_->state_->key_releases) return std::exchange(impl_->state_->key, 0);
    }
    if (cancellation()) return 0;
  }
}

bool ViewerServer::waitForClient(double seconds) {
  std::unique_lock lock(impl_->state_->mutex);
  return impl_->state_->changed.wait_for(lock, std::chrono::duration<double>(seconds),
                                         [&] { return impl_->state_->clients > 0; });
}

bool isHeadless() {
  const char* value = std::getenv("KINEGRAPH_HEADLESS");
  return value && *value && std::strcmp(value, "0") != 0;
}

}  // namespace kinegraph::inline viewer_internal
