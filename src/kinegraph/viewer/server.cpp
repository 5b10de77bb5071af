#include "kinegraph/viewer/server.h"

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <list>
#include <mutex>
#include <thread>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/messages.h"
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
  int clients = 0;
};

bool isLoopbackName(std::string_view host) {
  const std::size_t colon = host.starts_with('[') ? host.find("]:") : host.rfind(':');
  std::string_view name = host.substr(0, host.starts_with('[') && colon != host.npos ? colon + 1 : colon);
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

/// One browser tab: sends what has changed since it was last told, one batch after the other.
class Session : public std::enable_shared_from_this<Session> {
 public:
  Session(tcp::socket socket, std::shared_ptr<Shared> shared) : socket_(std::move(socket)), shared_(std::move(shared)) {}

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

  /// A binary message of 8 bytes: kind and key code. Anything else is ignored.
  void receive() {
    const std::string data = beast::buffers_to_string(buffer_.data());
    std::uint32_t kind, code;
    if (!socket_.got_binary() || data.size() != sizeof kind + sizeof code) return;
    std::memcpy(&kind, data.data(), sizeof kind);
    std::memcpy(&code, data.data() + sizeof kind, sizeof code);
    if (kind != std::uint32_t(BinaryKind::key) || code == 0 || code > 1000) return;
    {
      const std::lock_guard lock(shared_->mutex);
      shared_->key = int(code);
    }
    shared_->changed.notify_all();
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
  beast::flat_buffer buffer_;
  std::deque<Outgoing> sending_;
  ShownScene::Seen seen_;
  bool open_ = false;
};

/// A connection before it is known what it wants: the page, or a websocket.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  using OnUpgrade = std::function<void(tcp::socket, http::request<http::string_body>)>;
  Connection(tcp::socket socket, bool loopback_only, OnUpgrade on_upgrade)
      : stream_(std::move(socket)), loopback_only_(loopback_only), on_upgrade_(std::move(on_upgrade)) {
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
  /// A page from elsewhere must not drive a viewer on this machine: its Origin, or a Host that merely resolves to it, differs.
  bool isTrusted(const http::request<http::string_body>& request) const {
    const std::string_view host = request[http::field::host], origin = request[http::field::origin];
    if (loopback_only_ && !isLoopbackName(host)) return false;
    return origin.empty() || origin == cat("http://", host);
  }

  void answer() {
    http::request<http::string_body> request = parser_.release();
    const bool trusted = isTrusted(request);
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
      response_.body() = "This viewer answers pages of its own only.";
    } else if (request.method() == http::verb::get && (request.target() == "/" || request.target().starts_with("/?"))) {
      response_.set(http::field::content_type, "text/html; charset=utf-8");
      response_.body() = std::string(clientPage());
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
  bool loopback_only_;
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
    loopback_only_ = address.is_loopback();
    listen(address, options.port);
    url_ = cat("http://", loopback_only_ ? "localhost" : options.host, ":", acceptor_.local_endpoint().port(), "/");
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

  void wakeSessions() {
    asio::post(context_, [this] {
      for (const auto& session : sessions_) session->wake();
    });
  }

  std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
  std::string url_;

 private:
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
        std::make_shared<Connection>(std::move(socket), loopback_only_, [this](tcp::socket upgraded, http::request<http::string_body> request) {
          auto session = std::make_shared<Session>(std::move(upgraded), shared_);
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
  bool loopback_only_ = true;
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
  bool changed;
  {
    const std::lock_guard lock(impl_->shared_->mutex);
    changed = impl_->shared_->scene.update(items);
  }
  if (changed) impl_->wakeSessions();
}

namespace {

/// Sets one of the texts; true if it differs from before.
bool setText(Shared& shared, std::string ShownScene::*field, const std::string& text) {
  const std::lock_guard lock(shared.mutex);
  return shared.scene.setText(field, text);
}

}  // namespace

void ViewerServer::setMessage(const std::string& text) {
  if (setText(*impl_->shared_, &ShownScene::message, text)) impl_->wakeSessions();
}

void ViewerServer::setError(const std::string& text) {
  if (setText(*impl_->shared_, &ShownScene::error, text)) impl_->wakeSessions();
}

void ViewerServer::setTitle(const std::string& text) {
  if (setText(*impl_->shared_, &ShownScene::title, text)) impl_->wakeSessions();
}

void ViewerServer::setCamera(const Vector3d& position, const Vector3d& target) {
  {
    const std::lock_guard lock(impl_->shared_->mutex);
    impl_->shared_->scene.setCamera(position, target);
  }
  impl_->wakeSessions();
}

int ViewerServer::takeKey() {
  const std::lock_guard lock(impl_->shared_->mutex);
  return std::exchange(impl_->shared_->key, 0);
}

int ViewerServer::waitKey(const std::function<bool()>& stop) {
  for (;;) {
    {
      std::unique_lock lock(impl_->shared_->mutex);
      impl_->shared_->changed.wait_for(lock, std::chrono::milliseconds(20), [&] { return impl_->shared_->key != 0; });
      if (impl_->shared_->key != 0) return std::exchange(impl_->shared_->key, 0);
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
