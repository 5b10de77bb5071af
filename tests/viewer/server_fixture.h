#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "kinegraph/viewer/server.h"
#include "tests/viewer/websocket_client.h"

namespace kinegraph::test {

constexpr int kQuiet = 100;  // ms: long enough for a message on this machine to arrive

inline ViewerOptions anyPort() {
  ViewerOptions options;
  options.port = 0;
  return options;
}

inline std::vector<ViewItem> frames(int count) {
  std::vector<ViewItem> items(count);
  for (int i = 0; i < count; ++i) items[i].name = "frame" + std::to_string(i);
  return items;
}

/// A scene that is some megabytes to send.
inline std::vector<ViewItem> largeScene() {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices.resize(400000);
  auto geometry = std::make_shared<Geometry>();
  geometry->type = ShapeType::pointCloud;
  geometry->mesh = mesh;
  auto items = frames(1);
  items[0].geometry = geometry;
  return items;
}

/// Reads messages until one contains `text`; all of them.
inline std::vector<Received> readUntil(WebsocketClient& client, const std::string& text) {
  std::vector<Received> messages;
  while (auto message = client.next()) {
    messages.push_back(std::move(*message));
    if (messages.back().has(text)) return messages;
  }
  ADD_FAILURE() << "no message with " << text;
  return messages;
}

inline std::string answerTo(int port, const std::string& request) {
  TcpClient client(port);
  client.send(request);
  return client.readAll();
}

inline std::string get(const std::string& path, const std::string& host, const std::string& more = "") {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n" + more + "\r\n";
}

template <class Condition>
bool eventually(const Condition& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatience);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

class ViewerServerTest : public ::testing::Test {
 protected:
  ViewerServer server{anyPort()};
  const int port = portOf(server.url());
  const std::string host = "localhost:" + std::to_string(port);

  /// The next key; 0 if none comes.
  int waitKey() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(kPatience);
    return server.waitKey([deadline] { return std::chrono::steady_clock::now() > deadline; });
  }
};

}  // namespace kinegraph::test
