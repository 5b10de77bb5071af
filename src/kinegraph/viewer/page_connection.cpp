#include "kinegraph/viewer/page_connection.h"

#include "kinegraph/viewer/client_page.h"

namespace kinegraph {

namespace beast = boost::beast;
namespace http = beast::http;

PageConnection::PageConnection(TcpSocket socket, const Access& access, std::shared_ptr<const ViewerState> state,
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
  const bool trusted = access_.allows(request[http::field::host], request[http::field::origin], request.target());
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
  response_.keep_alive(false);
  if (!trusted) {
    response_.result(http::status::forbidden);
    response_.body() = "This viewer answers pages of its own only, at the address that it printed.";
  } else if (request.method() == http::verb::get && (path == "/" || path == "/scene.html")) {
    response_.set(http::field::content_type, "text/html; charset=utf-8");
    response_.body() = path == "/" ? std::string(clientPage()) : state_->recording();
  } else {
    response_.result(http::status::not_found);
    response_.body() = "There is nothing here.";
  }
  response_.prepare_payload();
  http::async_write(stream_, response_, [self = shared_from_this()](beast::error_code, std::size_t) {
    beast::error_code ignored;
    self->stream_.socket().shutdown(TcpSocket::shutdown_send, ignored);
  });
}

}  // namespace kinegraph
