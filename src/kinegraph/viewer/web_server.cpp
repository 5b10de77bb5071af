#include "kinegraph/viewer/web_server.h"

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <deque>
#include <list>
#include <thread>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/access.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/gzip.h"

namespace kinegraph::inline viewer_internal {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;

namespace {

constexpr auto kPause = std::chrono::milliseconds(12);  ///< after each batch; a higher rate is not visible

constexpr std::size_t kWorthCompressing = 16384;  ///< size of a message, bytes

using HttpRequest = http::request<http::string_body>;

/// The session of one browser tab: sends all changes since its last update in batches, with a pause between them, so
/// that many changes do not flood it. Runs on the server's thread.
class BrowserSession : public std::enable_shared_from_this<BrowserSession> {
 public:
  BrowserSession(tcp::socket socket, std::shared_ptr<ViewerState> state, WebServer::OnCommand on_command)
      : socket_(std::move(socket)),
        pause_(socket_.get_executor()),
        state_(std::move(state)),
        on_command_(std::move(on_command)) {}

  void start(HttpRequest request);

  /// Call after each change.
  void wake();
  void close();

 private:
  void read();
  void receive();
  void write();
  void pause();
  void leave();

  websocket::stream<beast::tcp_stream> socket_;
  asio::steady_timer pause_;
  std::shared_ptr<ViewerState> state_;
  WebServer::OnCommand on_command_;
  beast::flat_buffer buffer_;
  std::deque<Outgoing> sending_;
  ShownScene::Seen seen_;
  bool open_ = false, pauses_ = false;
};

void BrowserSession::start(HttpRequest request) {
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(4096);
  websocket::permessage_deflate compression;  // meshes shrink by half, and poses are sent as they are
  compression.server_enable = true;
  compression.compLevel = 3;
  compression.memLevel = 8;
  compression.msg_size_threshold = kWorthCompressing;
  socket_.set_option(compression);
  socket_.auto_fragment(false);
  socket_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
    if (error) return;
    self->open_ = true;
    self->state_->addClient();
    self->read();
    self->wake();
  });
}

void BrowserSession::wake() {
  if (!open_ || pauses_ || !sending_.empty()) return;  // the next batch contains the latest state
  for (Outgoing& message : state_->messagesSince(seen_)) sending_.push_back(std::move(message));
  if (!sending_.empty()) write();
}

void BrowserSession::close() {
  if (!open_) return;
  beast::error_code ignored;
  beast::get_lowest_layer(socket_).socket().shutdown(tcp::socket::shutdown_both, ignored);
  beast::get_lowest_layer(socket_).socket().close(ignored);
}

void BrowserSession::read() {
  socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    self->receive();
    self->buffer_.consume(self->buffer_.size());
    self->read();
  });
}

/// Receives commands; anything else is ignored.
void BrowserSession::receive() {
  if (!socket_.got_binary()) return;
  if (const auto command = readCommand(beast::buffers_to_string(buffer_.data()))) on_command_(*command);
}

void BrowserSession::write() {
  socket_.binary(sending_.front().binary);
  const auto sent = [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    self->sending_.pop_front();
    self->sending_.empty() ? self->pause() : self->write();
  };
  socket_.async_write(asio::buffer(*sending_.front().data), sent);
}

void BrowserSession::pause() {
  pauses_ = true;
  pause_.expires_after(kPause);
  pause_.async_wait([self = shared_from_this()](beast::error_code error) {
    self->pauses_ = false;
    if (!error) self->wake();
  });
}

void BrowserSession::leave() {
  if (std::exchange(open_, false)) state_->removeClient();
}

/// A connection before its kind is known: the page, or a websocket.
class PageConnection : public std::enable_shared_from_this<PageConnection> {
 public:
  using OnUpgrade = std::function<void(tcp::socket, HttpRequest)>;
  PageConnection(tcp::socket socket, const Access& access, std::shared_ptr<const ViewerState> state,
                 OnUpgrade on_upgrade);

  void start();

 private:
  void answer();

  beast::tcp_stream stream_;
  const Access& access_;
  std::shared_ptr<const ViewerState> state_;
  OnUpgrade on_upgrade_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
};

PageConnection::PageConnection(tcp::socket socket, const Access& access, std::shared_ptr<const ViewerState> state,
                               OnUpgrade on_upgrade)
    : stream_(std::move(socket)), access_(access), state_(std::move(state)), on_upgrade_(std::move(on_upgrade)) {
  parser_.body_limit(1024);
  parser_.header_limit(16 * 1024);
}

void PageConnection::start() {
  stream_.expires_after(std::chrono::seconds(30));
  http::async_read(stream_, buffer_, parser_, [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (!error) self->answer();
  });
}

void PageConnection::answer() {
  HttpRequest request = parser_.release();
  const bool trusted = access_.allows({.host = request[http::field::host],
                                       .forwarded_host = request["X-Forwarded-Host"],
                                       .origin = request[http::field::origin],
                                       .target = request.target()});
  const std::string_view path = std::string_view(request.target()).substr(0, request.target().find('?'));
  if (trusted && beast::websocket::is_upgrade(request)) {
    stream_.expires_never();
    on_upgrade_(stream_.release_socket(), std::move(request));
    return;
  }
  response_.version(request.version());
  response_.set(http::field::server, "kinegraph");
  response_.set(http::field::cache_control, "no-store");
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set("Referrer-Policy", "no-referrer");          // addresses may contain a token
  response_.set("Content-Security-Policy", framePolicy());  // the page itself restricts its sources
  response_.keep_alive(false);
  if (!trusted) {
    response_.result(http::status::forbidden);
    response_.body() = "This viewer accepts requests of its own pages only, at the address that it printed.";
  } else if (request.method() == http::verb::get && (path == "/" || path == "/scene.html")) {
    response_.set(http::field::content_type, "text/html; charset=utf-8");
    response_.body() = path == "/" ? std::string(clientPage()) : state_->recording();
    if (std::string_view(request[http::field::accept_encoding]).find("gzip") != std::string_view::npos) {
      response_.set(http::field::content_encoding, "gzip");
      response_.body() = gzipped(response_.body());
    }
  } else {
    response_.result(http::status::not_found);
    response_.body() = "Page not found.";
  }
  response_.prepare_payload();
  http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
    beast::error_code ignored;
    self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  });
}

/// Returns the name of this machine for other ones if the server listens on all addresses: the source address of
/// packets to the outside (none is sent), else the machine's name.
std::string nameElsewhere(const asio::ip::address& listening) {
  if (!listening.is_unspecified()) return listening.to_string();
  asio::io_context context;
  beast::error_code error;
  asio::ip::udp::socket socket(context);
  const asio::ip::address outside = asio::ip::make_address(listening.is_v6() ? "2001:db8::1" : "192.0.2.1");
  socket.open(listening.is_v6() ? asio::ip::udp::v6() : asio::ip::udp::v4(), error);
  if (!error) socket.connect({outside, 9}, error);
  if (!error) return socket.local_endpoint().address().to_string();
  const std::string name = asio::ip::host_name(error);
  return error || name.empty() ? "localhost" : name;
}

/// Formats a host for a URL.
std::string hostInUrl(const asio::ip::address& listening) {
  if (listening.is_loopback()) return "localhost";
  const std::string name = nameElsewhere(listening);
  return name.find(':') == name.npos ? name : cat("[", name, "]");
}

}  // namespace

class WebServer::Impl {
 public:
  Impl(const ViewerOptions& options, std::shared_ptr<ViewerState> state, OnCommand on_command)
      : state_(std::move(state)), on_command_(std::move(on_command)), acceptor_(context_) {
    beast::error_code error;
    const asio::ip::address address = asio::ip::make_address(options.host, error);
    if (error)
      throw ValueError(
          cat("viewer: host is '", options.host, "'; expected an IP address, for instance 127.0.0.1 or 0.0.0.0"));
    if (options.port < 0 || options.port > 65535)
      throw ValueError(cat("viewer: port is ", options.port, "; expected 0 to 65535"));
    access_.loopback_only = address.is_loopback();
    access_.token = options.token.empty() && !access_.loopback_only ? randomToken() : options.token;
    listen(address, options.port);
    url_ = cat("http://", hostInUrl(address), ":", acceptor_.local_endpoint().port(), "/");
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

  const std::string& url() const { return url_; }

  void wake() {
    asio::post(context_, [this] {
      for (const auto& session : sessions_) session->wake();
    });
  }

 private:
  void listen(const asio::ip::address& address, int first_port) {
    beast::error_code error;
    for (int port = first_port; port < first_port + 200 && port <= 65535; ++port) {
      const tcp::endpoint endpoint(address, static_cast<unsigned short>(port));
      acceptor_ = tcp::acceptor(context_);
      acceptor_.open(endpoint.protocol(), error);
      if (!error)
        acceptor_.set_option(asio::socket_base::reuse_address(true),
                             error);  // a restarted program gets its port back
      if (!error) acceptor_.bind(endpoint, error);
      if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
      if (!error) return;
    }
    throw Error(
        cat("viewer: no free port from ", first_port, " upwards at ", address.to_string(), ": ", error.message()));
  }

  void accept() {
    acceptor_.async_accept([this](beast::error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (!error) {
        socket.set_option(tcp::no_delay(true), error);
        std::make_shared<PageConnection>(
            std::move(socket), access_, state_,
            [this](tcp::socket upgraded, HttpRequest request) {
              auto session = std::make_shared<BrowserSession>(std::move(upgraded), state_, on_command_);
              sessions_.remove_if([](const auto& old) { return old.use_count() == 1; });  // sessions of closed browsers
              sessions_.push_back(session);
              session->start(std::move(request));
            })
            ->start();
      }
      accept();
    });
  }

  std::shared_ptr<ViewerState> state_;
  OnCommand on_command_;
  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  Access access_;
  std::string url_;
  std::list<std::shared_ptr<BrowserSession>> sessions_;  ///< accessed by the server's thread only
  std::thread thread_;
};

WebServer::WebServer(const ViewerOptions& options, std::shared_ptr<ViewerState> state, OnCommand on_command)
    : impl_(std::make_unique<Impl>(options, std::move(state), std::move(on_command))) {}
WebServer::~WebServer() = default;

const std::string& WebServer::url() const { return impl_->url(); }

void WebServer::wake() { impl_->wake(); }

}  // namespace kinegraph::inline viewer_internal
