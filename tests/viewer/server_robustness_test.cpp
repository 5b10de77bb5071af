#include <gtest/gtest.h>

#include <chrono>

#include "kinegraph/common/random.h"
#include "kinegraph/viewer/messages/messages.h"
#include "tests/viewer/server_fixture.h"

using namespace kinegraph;
using namespace kinegraph::test;

TEST_F(ViewerServerTest, RandomMessagesAreIgnored) {
  Rng rng(0);
  WebsocketClient client(port);
  for (int i = 0; i < 300; ++i) {
    std::string data(std::size_t(rng.uniform(0., 200.)), '\0');
    for (char& c : data) c = static_cast<char>(rng.uniform(0., 256.));
    data.size() == 8 ? client.sendBinary(data + "x") : client.sendBinary(data);
    client.sendText("{\"kind\": \"scene\"}");
  }
  client.sendKey(0);
  client.sendKey(0xffffffff);
  client.sendKey(7);
  EXPECT_EQ(waitKey(), 7);
}

TEST_F(ViewerServerTest, AnOversizedMessageEndsThatConnectionOnly) {
  WebsocketClient good(port), bad(port);
  ASSERT_TRUE(eventually([&] { return server.clients() == 2; }));
  bad.sendBinary(std::string(1 << 20, 'x'));
  while (bad.next()) {
  }
  EXPECT_TRUE(eventually([&] { return server.clients() == 1; }));
  server.setMessage("still here");
  readUntil(good, "still here");
}

TEST_F(ViewerServerTest, GarbageInPlaceOfFramesEndsThatConnectionOnly) {
  Rng rng(1);
  for (int i = 0; i < 30; ++i) {
    std::string data(1000, '\0');
    for (char& c : data) c = static_cast<char>(rng.uniform(0., 256.));
    WebsocketClient framed(port);
    framed.TcpClient::send(data);
    TcpClient raw(port);
    raw.send(data + "\r\n\r\n");
  }
  EXPECT_TRUE(eventually([&] { return server.clients() == 0; }));
  EXPECT_TRUE(answerTo(port, get("/", host)).starts_with("HTTP/1.1 200 "));
}

TEST_F(ViewerServerTest, AnOversizedRequestIsRefused) {
  const std::string answer = answerTo(port, get("/" + std::string(100000, 'x'), host));
  EXPECT_FALSE(answer.starts_with("HTTP/1.1 200 "));
  EXPECT_TRUE(answerTo(port, get("/", host)).starts_with("HTTP/1.1 200 "));
}

TEST_F(ViewerServerTest, ASlowBrowserMissesIntermediateStatesAndNeverBlocks) {
  auto items = largeScene();
  server.update(items);
  WebsocketClient slow(port, 4096);  // gets stuck in the point cloud
  ASSERT_TRUE(server.waitForClient(20.));
  const auto start = std::chrono::steady_clock::now();
  for (int i = 1; i <= 2000; ++i) {
    items[0].pose.p.x() = i;
    server.update(items);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  server.setMessage("the end");
  const auto messages = readUntil(slow, "the end");
  EXPECT_LT(messages.size(), 100u);
  auto last = slow.next();
  ASSERT_TRUE(last && last->binary);
  float x;
  std::memcpy(&x, last->data.data() + 12, sizeof x);
  EXPECT_EQ(x, 2000.f);
}

TEST_F(ViewerServerTest, ASlowBrowserDoesNotHoldUpAnother) {
  server.update(largeScene());
  WebsocketClient stuck(port, 4096), quick(port);
  ASSERT_TRUE(eventually([&] { return server.clients() == 2; }));
  server.setMessage("news");
  readUntil(quick, "news");
}

TEST(ViewerServer, EndsWhileABrowserIsStuck) {
  auto server = std::make_unique<ViewerServer>(anyPort());
  server->update(largeScene());
  WebsocketClient stuck(portOf(server->url()), 4096);
  ASSERT_TRUE(server->waitForClient(20.));
  const auto start = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST_F(ViewerServerTest, AForkedChildThatEndsDoesNotDisturbIt) {
  WebsocketClient client(port);
  ASSERT_TRUE(server.waitForClient(20.));
  EXPECT_EXIT(
      {
        server.~ViewerServer();
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
  server.setMessage("still here");
  readUntil(client, "still here");
  EXPECT_TRUE(answerTo(port, get("/", host)).starts_with("HTTP/1.1 200 "));
}
