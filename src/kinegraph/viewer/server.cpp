#include "kinegraph/viewer/server.h"

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <mutex>
#include <random>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/input_events.h"
#include "kinegraph/viewer/messages.h"
#include "kinegraph/viewer/recorded_page.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

namespace {

class Session;

/// What the program's threads and the server's thread share.
struct Shared {
  mutable std::mutex mutex;
  std::condition_variable changed;  ///< a key was pressed, a client came
  ShownScene scene;
  int key = 0;
  bool key_releases = false;  ///< it ends the waiting for a key
  int clients = 0;
  InputEvents events;
  std::optional<Cursor> cursor;

  /// The page with all that is shown now.
  std::string recording() const {
    std::vector<Outgoing> messages;
    {
      const std::lock_guard lock(mutex);
      ShownScene::Seen nothing;
      messages = scene.messagesSince(nothing);
    }
    return recordedPage(messages);
  }
};

bool isLoopbackName(std::string_view host) {
  const std::size_t colon = host.starts_with('[') ? host.find("]:") : host.rfind(':');
  std::string_view name = host.substr(0, host.starts_with('[') && colon != host.npos ? colon + 1 : colon);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

/// Who may connect.
struct Access {
  bool loopback_only = true;
  std::string token;  ///< empty: none is asked for

  /// A page from elsewhere must not drive a viewer on this machine: its Origin, or a Host that merely resolves to it, differs.
  bool allows(const http::request<http::string_body>& request) const {
    const std::string_view host = request[http::field::host], origin = request[http::field::origin];
    if (loopback_only && !isLoopbackName(host)) return false;
    if (!origin.empty() && origin != cat("http://", host)) return false;
    const std::string_view target = request.target();
    return token.empty() || isSame(target.substr(std::min(target.find('?'), target.size())), cat("?token=", token));
  }

 private:
  /// In a time that does not tell how much of them is the same.
  static bool isSame(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned>(a[i] ^ b[i]);
    return difference == 0;
  }
};

std::string randomToken() {
  std::random_device random;
  std::string token;
  for (int i = 0; i < 32; ++i) token += "0123456789abcdef"[random() % 16];
  return token;
}

/// One browser tab: sends what has changed since it was last told, one batch after the other.
class Session : public std::enable_shared_from_this<Session> {
 public:
  using OnCommand = std::function<void(const Command&)>;
  Session(tcp::socket socket, std::shared_ptr<Shared> shared, OnCommand on_command)
      : socket_(std::move(socket)), shared_(std::move(shared)), on_command_(std::move(on_command)) {}

  void start(http::request<http::string_body> request) {
    socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    socket_.read_message_max(4096);
    socket_.auto_fragment(false);
    socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->open_ = true;
      {
        const std::lock_guard lock(self->shared_->mutex);
        ++self->shared_->clients;
      }
      self->shared_->changed.notify_all();
      self->read();
      self->wake();
    });
  }

  /// Called on the server's thread when something has changed.
  void wake() {
    if (!open_ || !sending_.empty()) return;  // a busy client gets the latest state when it is done
    {
      const std::lock_guard lock(shared_->mutex);
      for (Outgoing& message : shared_->scene.messagesSince(seen_)) sending_.push_back(std::move(message));
    }
    if (!sending_.empty()) write();
  }

  void close() {
    if (!open_) return;
    beast::error_code ignored;
    beast::get_lowest_layer(socket_).socket().shutdown(tcp::socket::shutdown_both, ignored);
    beast::get_lowest_layer(socket_).socket().close(ignored);
  }

 private:
  void read() {
    socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->leave();
      self->receive();
      self->buffer_.consume(self->buffer_.size());
      self->read();
    });
  }

  /// Anything but a command is ignored.
  void receive() {
    if (!socket_.got_binary()) return;
    if (const auto command = readCommand(beast::buffers_to_string(buffer_.data()))) on_command_(*command);
  }

  void write() {
    socket_.binary(sending_.front().binary);
    socket_.async_write(asio::buffer(*sending_.front().data), [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (error) return self->leave();
      self->sending_.pop_front();
      self->sending_.empty() ? self->wake() : self->write();
    });
  }

  void leave() {
    if (!open_) return;
    open_ = false;
    const std::lock_guard lock(shared_->mutex);
    --shared_->clients;
  }

  websocket::stream<beast::tcp_stream> socket_;
  std::shared_ptr<Shared> shared_;
  OnCommand on_command_;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> sending_;
  ShownScene::Seen seen_;
  bool open_ = false;
};

/// A connection before it is known what it wants: the page, or a websocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  using OnUpgrade = std::function<void(tcp::socket, http::request<http::string_body>)>;
  Connection(tcp::socket socket, const Access& access, std::shared_ptr<const Shared> shared, OnUpgrade on_upgrade)
      : stream_(std::move(socket)), access_(access), shared_(std::move(shared)), on_upgrade_(std::move(on_upgrade)) {
    parser_.body_limit(1024);
    parser_.header_limit(16 * 1024);
  }

  void start() {
    stream_.expires_after(std::chrono::seconds(30));
    http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      if (!error) self->answer();
    });
  }

 private:
  void answer() {
    http::request<http::string_body> request = parser_.release();
    const bool trusted = access_.allows(request);
    const std::string_view path = std::string_view(request.target()).substr(0, request.target().find('?'));
    if (trusted && websocket::is_upgrade(request)) {
      stream_.expires_never();
      on_upgrade_(stream_.release_socket(), std::move(request));
      return;
    }
    response_.version(request.version());
    response_.set(http::field::server, "kinegraph");
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.keep_alive(false);
    if (!trusted) {
      response_.result(http::status::forbidden);
      response_.body() = "This viewer answers pages of its own only, at the address that it printed.";
    } else if (request.method() == http::verb::get && (path == "/" || path == "/scene.html")) {
      response_.set(http::field::content_type, "text/html; charset=utf-8");
      response_.body() = path == "/" ? std::string(clientPage()) : shared_->recording();
    } else {
      response_.result(http::status::not_found);
      response_.body() = "There is nothing here.";
    }
    response_.prepare_payload();
    http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
      beast::error_code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    });
  }

  beast::tcp_stream stream_;
  const Access& access_;
  std::shared_ptr<const Shared> shared_;
  OnUpgrade on_upgrade_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
};

}  // namespace

class ViewerServer::Impl {
 public:
  explicit Impl(const ViewerOptions& options) : acceptor_(context_) {
    shared_->scene.title = options.title;
    beast::error_code error;
    const asio::ip::address address = asio::ip::make_address(options.host, error);
    if (error) throw ValueError(cat("ViewerOptions: host is '", options.host, "'; expected an IP address, for instance 127.0.0.1 or 0.0.0.0"));
    if (options.port < 0 || options.port > 65535) throw ValueError(cat("ViewerOptions: port is ", options.port, "; expected 0 to 65535"));
    access_.loopback_only = address.is_loopback();
    access_.token = options.token.empty() && !access_.loopback_only ? randomToken() : options.token;
    listen(address, options.port);
    url_ = cat("http://", access_.loopback_only ? "localhost" : options.host, ":", acceptor_.local_endpoint().port(), "/");
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
      const std::lock_guard lock(shared_->mutex);
      changed = change(shared_->scene);
    }
    if (changed) wakeSessions();
  }

  void wakeSessions() {
    asio::post(context_, [this] {
      for (const auto& session : sessions_) session->wake();
    });
  }

  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::string url_;
  std::function<std::optional<EditedScene>(const Command&)> answer_;  ///< guarded by `answer_mutex_`
  std::mutex answer_mutex_;

 private:
  /// On the server's thread.
  void receive(const Command& command) {
    if (const auto* key = std::get_if<KeyCommand>(&command)) return press(*key);
    if (const auto* event = std::get_if<EventCommand>(&command)) return takeEvent(*event);
    if (const auto* cursor = std::get_if<CursorCommand>(&command)) return moveCursor(*cursor);
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
    shared_->changed.notify_all();
  }

  void takeEvent(const EventCommand& event) {
    const std::lock_guard lock(shared_->mutex);
    shared_->events.add(event);
  }

  void moveCursor(const CursorCommand& cursor) {
    const std::lock_guard lock(shared_->mutex);
    if (cursor.point.empty() && shared_->cursor) shared_->cursor->frame = -1;  // over the background
    if (cursor.point.size() != 3 || cursor.normal.size() != 3) return;
    shared_->cursor = {cursor.frame, Vector3d(cursor.point.data()), Vector3d(cursor.normal.data())};
  }

  void press(const KeyCommand& key) {
    constexpr int kRight = 262, kLeft = 263;
    if (key.code <= 0 || key.code > 1000) return;
    {
      const std::lock_guard lock(shared_->mutex);
      shared_->key = key.code;
      shared_->key_releases = key.modifiers == 0 && key.code != kRight && key.code != kLeft;
    }
    shared_->changed.notify_all();
  }

  void listen(const asio::ip::address& address, int first_port) {
    beast::error_code error;
    for (int port = first_port; port < first_port + 200 && port <= 65535; ++port) {
      const tcp::endpoint endpoint(address, static_cast<unsigned short>(port));
      acceptor_ = tcp::acceptor(context_);
      acceptor_.open(endpoint.protocol(), error);
      if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);  // a program that is started again gets its port back
      if (!error) acceptor_.bind(endpoint, error);
      if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
      if (!error) return;
    }
    throw Error(cat("the viewer finds no free port from ", first_port, " on at ", address.to_string(), ": ", error.message()));
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) {
        socket.set_option(tcp::no_delay(true), error);
        std::make_shared<Connection>(std::move(socket), access_, shared_, [this](tcp::socket upgraded, http::request<http::string_body> request) {
          auto session = std::make_shared<Session>(std::move(upgraded), shared_, [this](const Command& command) { receive(command); });
          sessions_.remove_if([](const auto& old) { return old.use_count() == 1; });  // those whose browser has gone
          sessions_.push_back(session);
          session->start(std::move(request));
        })->start();
      }
      accept();
    });
  }

  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  Access access_;
  std::list<std::shared_ptr<Session>> sessions_;  ///< touched by the server's thread only
  std::thread thread_;
};

ViewerServer::ViewerServer(const ViewerOptions& options) : impl_(std::make_shared<Impl>(options)) {}

ViewerServer::~ViewerServer() = default;

std::string ViewerServer::url() const { return impl_->url_; }

int ViewerServer::clients() const {
  const std::lock_guard lock(impl_->shared_->mutex);
  return impl_->shared_->clients;
}

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

std::string ViewerServer::recording() const { return impl_->shared_->recording(); }

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

void ViewerServer::setCamera(const Vector3d& position, const Vector3d& target, double focal_length) {
  impl_->changeScene([&](ShownScene& scene) {
    scene.setCamera(position, target, focal_length);
    return true;
  });
}

void ViewerServer::setNear(const std::vector<NearLine>& lines) {
  impl_->changeScene([&](ShownScene& scene) { return scene.setNear(lines); });
}

void ViewerServer::setQuad(const Quad& quad) {
  if (quad.columns <= 0 || quad.rows <= 0 || quad.rgb.size() != 3 * std::size_t(quad.columns) * std::size_t(quad.rows)) {
    throw ValueError(cat("setQuad: ", quad.rgb.size(), " bytes; expected 3 for each of ", quad.rows, " x ", quad.columns, " pixels"));
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

std::vector<std::string> ViewerServer::takeEvents() {
  const std::lock_guard lock(impl_->shared_->mutex);
  return impl_->shared_->events.take();
}

std::optional<Cursor> ViewerServer::cursor() {
  impl_->changeScene([&](ShownScene& scene) { return scene.requestCursor(); });
  const std::lock_guard lock(impl_->shared_->mutex);
  return impl_->shared_->cursor;
}

int ViewerServer::takeKey() {
  const std::lock_guard lock(impl_->shared_->mutex);
  return std::exchange(impl_->shared_->key, 0);
}

int ViewerServer::waitKey(const std::function<bool()>& stop) {
  for (;;) {
    {
      std::unique_lock lock(impl_->shared_->mutex);
      impl_->shared_->changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return impl_->shared_->key != 0 && impl_->shared_->key_releases; });
      if (impl_->shared_->key != 0 && impl_->shared_->key_releases) return std::exchange(impl_->shared_->key, 0);
    }
    if (stop()) return 0;
  }
}

bool ViewerServer::waitForClient(double seconds) {
  std::unique_lock lock(impl_->shared_->mutex);
  return impl_->shared_->changed.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return impl_->shared_->clients > 0; });
}

bool isHeadless() {
  const char* value = std::getenv("KINEGRAPH_HEADLESS");
  return value && *value && std::strcmp(value, "0") != 0;
}

}  // namespace kinegraph
