#pragma once

#include <boost/asio.hpp>
#include <boost/beast.hpp>
#include <deque>
#include <functional>
#include <memory>

#include "kinegraph/viewer/viewer_state.h"

namespace kinegraph {

using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;
using TcpSocket = boost::asio::ip::tcp::socket;

/// One browser tab: sends what has changed since it was last told, one batch after the other. On the server's thread.
class BrowserSession : public std::enable_shared_from_this<BrowserSession> {
 public:
  using OnCommand = std::function<void(const Command&)>;
  BrowserSession(TcpSocket socket, std::shared_ptr<ViewerState> state, OnCommand on_command)
      : socket_(std::move(socket)), state_(std::move(state)), on_command_(std::move(on_command)) {}

  void start(HttpRequest request);

  /// Call when something has changed.
  void wake();
  void close();

 private:
  void read();
  void receive();
  void write();
  void leave();

  boost::beast::websocket::stream<boost::beast::tcp_stream> socket_;
  std::shared_ptr<ViewerState> state_;
  OnCommand on_command_;
  boost::beast::flat_buffer buffer_;
  std::deque<Outgoing> sending_;
  ShownScene::Seen seen_;
  bool open_ = false;
};

}  // namespace kinegraph
