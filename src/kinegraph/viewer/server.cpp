#include "kinegraph/viewer/server.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <list>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/viewer/page_connection.h"

namespace kinegraph {

namespace asio = boost::asio;
namespace beast = boost::beast;
using tcp = asio::ip::tcp;

class ViewerServer::Impl {
 public:
  explicit Impl(const ViewerOptions& options) : acceptor_(context_) {
    state_->scene.title = options.title;
    beast::error_code error;
    const asio::ip::address address = asio::ip::make_address(options.host, error);
    if (error)
      throw ValueError(cat("ViewerOptions: host is '", options.host,
                           "'; expected an IP address, for instance 127.0.0.1 or 0.0.0.0"));
    if (options.port < 0 || options.port > 65535)
      throw ValueError(cat("ViewerOptions: port is ", options.port, "; expected 0 to 65535"));
    access_.loopback_only = address.is_loopback();
    access_.token = options.token.empty() && !access_.loopback_only ? randomToken() : options.token;
    listen(address, options.port);
    url_ =
        cat("http://", access_.loopback_only ? "localhost" : options.host, ":", acceptor_.local_endpoint().port(), "/");
    if (!access_.token.empty()) url_ += "?token=" + access_.token;
    accept();
    thread_ = std::thread([this] { context_.run(); });
  }

  ~Impl() {
    asio::post(context_, [this] {
      beast::error_code ignored;
      acceptor_.close(ignored);
      for (const auto& session : sessions_) session->close();
      context_.stop();
    });
    thread_.join();
  }

  /// The change is made with the scene locked; all browsers are told if it says that there is something to tell.
  template <class Change>
  void changeScene(const Change& change) {
    bool changed;
    {
      const std::lock_guard lock(state_->mutex);
      changed = change(state_->scene);
    }
    if (changed) wakeSessions();
  }

  void wakeSessions() {
    asio::post(context_, [this] {
      for (const auto& session : sessions_) session->wake();
    });
  }

  std::shared_ptr<ViewerState> state_ = std::make_shared<ViewerState>();
  std::string url_;
  const pid_t process_ = getpid();
  std::function<std::optional<EditedScene>(const Command&)> answer_;  ///< guarded by `answer_mutex_`
  std::mutex answer_mutex_;

 private:
  /// On the server's thread.
  void receive(const Command& command) {
    if (const auto* key = std::get_if<KeyCommand>(&command)) return state_->press(*key);
    if (const auto* event = std::get_if<EventCommand>(&command)) return state_->addEvent(*event);
    if (const auto* cursor = std::get_if<CursorCommand>(&command)) return state_->moveCursor(*cursor);
    if (const auto* viewpoint = std::get_if<ViewpointCommand>(&command)) return state_->moveCamera(*viewpoint);
    std::optional<EditedScene> edited;
    try {
      const std::lock_guard lock(answer_mutex_);
      if (answer_) edited = answer_(command);
    } catch (const Error&) {  // what cannot be done is not done
    }
    if (!edited) return;
    changeScene([&](ShownScene& scene) {
      scene.setEdited(*edited);
      return true;
    });
    state_->changed.notify_all();
  }

  void listen(const asio::ip::address& address, int first_port) {
    beast::error_code error;
    for (int port = first_port; port < first_port + 200 && port <= 65535; ++port) {
      const tcp::endpoint endpoint(address, static_cast<unsigned short>(port));
      acceptor_ = tcp::acceptor(context_);
      acceptor_.open(endpoint.protocol(), error);
      if (!error)
        acceptor_.set_option(asio::socket_base::reuse_address(true),
                             error);  // a program that is started again gets its port back
      if (!error) acceptor_.bind(endpoint, error);
      if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
      if (!error) return;
    }
    throw Error(
        cat("the viewer finds no free port from ", first_port, " on at ", address.to_string(), ": ", error.message()));
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) {
        socket.set_option(tcp::no_delay(true), error);
        std::make_shared<PageConnection>(
            std::move(socket), access_, state_,
            [this](tcp::socket upgraded, HttpRequest request) {
              auto session = std::make_shared<BrowserSession>(std::move(upgraded), state_,
                                                              [this](const Command& command) { receive(command); });
              sessions_.remove_if(
                  [](const auto& old) { return old.use_count() == 1; });  // those whose browser has gone
              sessions_.push_back(session);
              session->start(std::move(request));
            })
            ->start();
      }
      accept();
    });
  }

  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  Access access_;
  std::list<std::shared_ptr<BrowserSession>> sessions_;  ///< touched by the server's thread only
  std::thread thread_;
};

ViewerServer::ViewerServer(const ViewerOptions& options) : impl_(std::make_unique<Impl>(options)) {}

ViewerServer::~ViewerServer() {
  if (!isOurs()) (void)impl_.release();  // its sockets are shared with the process that it belongs to
}

bool ViewerServer::isOurs() const { return impl_->process_ == getpid(); }

std::string ViewerServer::url() const { return impl_->url_; }

int ViewerServer::clients() const {
  const std::lock_guard lock(impl_->state_->mutex);
  return impl_->state_->clients;
}

void ViewerServer::show(const std::function<bool(ShownScene&)>& change) { impl_->changeScene(change); }

void ViewerServer::update(std::span<const ViewItem> items) {
  impl_->changeScene([&](ShownScene& scene) { return scene.update(items); });
}

void ViewerServer::setJoints(int structure, const std::vector<ShownJoint>& joints, const VectorXd& q) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setJoints(structure, joints, q); });
}

void ViewerServer::showMotion(const ShownMotion& motion) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.setMotion(motion);
    return true;
  });
}

void ViewerServer::endMotion() {
  impl_->changeScene([](ShownScene& scene) { return scene.endMotion(); });
}

void ViewerServer::select(int item) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.select(item);
    return true;
  });
}

std::string ViewerServer::recording() const { return impl_->state_->recording(); }

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

void ViewerServer::setLook(const Look& look) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setLook(look); });
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

int ViewerServer::takeKey() {
  const std::lock_guard lock(impl_->state_->mutex);
  return std::exchange(impl_->state_->key, 0);
}

int ViewerServer::waitKey(const std::function<bool()>& stop) {
  for (;;) {
    {
      std::unique_lock lock(impl_->state_->mutex);
      impl_->state_->changed.wait_for(lock, std::chrono::milliseconds(20),
                                      [&] { return impl_->state_->key != 0 && impl_->state_->key_releases; });
      if (impl_->state_->key != 0 && impl_->state_->key_releases) return std::exchange(impl_->state_->key, 0);
    }
    if (stop()) return 0;
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

}  // namespace kinegraph
