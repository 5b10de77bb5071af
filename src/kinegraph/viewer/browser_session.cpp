#include "kinegraph/viewer/browser_session.h"

namespace kinegraph {

namespace beast = boost::beast;
namespace websocket = beast::websocket;

void BrowserSession::start(HttpRequest request) {
  socket_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  socket_.read_message_max(4096);
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
  if (!open_ || !sending_.empty()) return;  // a busy client gets the latest state when it is done
  for (Outgoing& message : state_->messagesSince(seen_)) sending_.push_back(std::move(message));
  if (!sending_.empty()) write();
}

void BrowserSession::close() {
  if (!open_) return;
  beast::error_code ignored;
  beast::get_lowest_layer(socket_).socket().shutdown(TcpSocket::shutdown_both, ignored);
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

/// Anything but a command is ignored.
void BrowserSession::receive() {
  if (!socket_.got_binary()) return;
  if (const auto command = readCommand(beast::buffers_to_string(buffer_.data()))) on_command_(*command);
}

void BrowserSession::write() {
  socket_.binary(sending_.front().binary);
  const auto sent = [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (error) return self->leave();
    self->sending_.pop_front();
    self->sending_.empty() ? self->wake() : self->write();
  };
  socket_.async_write(boost::asio::buffer(*sending_.front().data), sent);
}

void BrowserSession::leave() {
  if (std::exchange(open_, false)) state_->removeClient();
}

}  // namespace kinegraph
