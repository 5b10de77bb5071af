#pragma once

#include "kinegraph/viewer/access.h"
#include "kinegraph/viewer/browser_session.h"

namespace kinegraph {

/// A connection before it is known what it wants: the page, or a websocket.
class PageConnection : public std::enable_shared_from_this<PageConnection> {
 public:
  using OnUpgrade = std::function<void(TcpSocket, HttpRequest)>;
  PageConnection(TcpSocket socket, const Access& access, std::shared_ptr<const ViewerState> state,
                 OnUpgrade on_upgrade);

  void start();

 private:
  void answer();

  boost::beast::tcp_stream stream_;
  const Access& access_;
  std::shared_ptr<const ViewerState> state_;
  OnUpgrade on_upgrade_;
  boost::beast::flat_buffer buffer_;
  boost::beast::http::request_parser<boost::beast::http::string_body> parser_;
  boost::beast::http::response<boost::beast::http::string_body> response_;
};

}  // namespace kinegraph
