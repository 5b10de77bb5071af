#include "kinegraph/viewer/server.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/messages/input_events.h"
#include "kinegraph/viewer/messages/messages.h"
#include "tests/viewer/server_fixture.h"

using namespace kinegraph;
using namespace kinegraph::test;

TEST_F(ViewerServerTest, ServesThePage) {
  const std::string answer = answerTo(port, get("/", host));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 OK\r\n"));
  EXPECT_TRUE(answer.ends_with(std::string("\r\n\r\n").append(clientPage())));
  EXPECT_NE(clientPage().find("<!doctype html>"), std::string_view::npos);
  EXPECT_TRUE(answerTo(port, get("/?a=b", "127.0.0.1:" + std::to_string(port))).starts_with("HTTP/1.1 200 "));
}

TEST_F(ViewerServerTest, KnowsNoOtherPathAndNoOtherMethod) {
  EXPECT_TRUE(answerTo(port, get("/etc/passwd", host)).starts_with("HTTP/1.1 404 "));
  EXPECT_TRUE(answerTo(port, get("/../../x", host)).starts_with("HTTP/1.1 404 "));
  EXPECT_TRUE(answerTo(port, "POST / HTTP/1.1\r\nHost: " + host + "\r\nContent-Length: 0\r\n\r\n")
                  .starts_with("HTTP/1.1 404 "));
}

TEST_F(ViewerServerTest, ListensOnLoopbackOnly) {
  EXPECT_TRUE(server.url().starts_with("http://localhost:"));
  const int other = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK + 1);  // 127.0.0.2: this machine, but not the address listened on
  EXPECT_NE(connect(other, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  close(other);
}

TEST_F(ViewerServerTest, RefusesAForeignHost) {
  for (const std::string foreign :
       {"example.com", "localhost.example.com", "127.0.0.1.example.com:80", "192.168.1.5:7000", ""}) {
    EXPECT_TRUE(answerTo(port, get("/", foreign)).starts_with("HTTP/1.1 403 ")) << foreign;
    EXPECT_TRUE(answerTo(port, WebsocketClient::request(foreign, "")).starts_with("HTTP/1.1 403 ")) << foreign;
  }
}

TEST_F(ViewerServerTest, RefusesAForeignOrigin) {
  for (const std::string& origin : std::vector<std::string>{"http://example.com", "null", "https://example.com",
                                                            "http://localhost", "http://localhost:1"}) {
    EXPECT_TRUE(answerTo(port, WebsocketClient::request(host, origin)).starts_with("HTTP/1.1 403 ")) << origin;
    EXPECT_TRUE(answerTo(port, get("/", host, "Origin: " + origin + "\r\n")).starts_with("HTTP/1.1 403 ")) << origin;
  }
  for (const std::string& own : {"http://" + host, "https://" + host}) {  // https: behind a proxy
    TcpClient client(port);
    client.send(WebsocketClient::request(host, own));
    EXPECT_EQ(client.read(12), "HTTP/1.1 101") << own;
  }
}

TEST_F(ViewerServerTest, OnlyPagesOfThisMachineMayFrameIt) {
  const std::string answer = answerTo(port, get("/", host));
  EXPECT_NE(answer.find("\r\nContent-Security-Policy: frame-ancestors 'self' http://localhost:*"), std::string::npos);
  EXPECT_NE(clientPage().find("content=\"default-src 'none'; script-src 'sha256-"), std::string_view::npos);
}

TEST(ViewerServer, ReportsAnAddressForOtherMachines) {
  ViewerOptions options = anyPort();
  options.host = "0.0.0.0";
  EXPECT_FALSE(ViewerServer(options).url().starts_with("http://0.0.0.0"));
}

TEST_F(ViewerServerTest, APortInUseIsPassedOver) {
  ViewerOptions options;
  options.port = port;
  const ViewerServer second(options);
  EXPECT_GT(portOf(second.url()), port);
  EXPECT_LT(portOf(second.url()), port + 200);
  EXPECT_TRUE(answerTo(portOf(second.url()), get("/", host)).starts_with("HTTP/1.1 200 "));
}

TEST(ViewerServer, GetsItsPortBackWhenItIsStartedAgain) {
  ViewerOptions options = anyPort();
  auto server = std::make_unique<ViewerServer>(options);
  options.port = portOf(server->url());
  WebsocketClient client(options.port);
  ASSERT_TRUE(server->waitForClient(20.));
  server.reset();  // hangs up first: the system keeps the port in TIME_WAIT
  while (client.next()) {
  }
  EXPECT_EQ(portOf(ViewerServer(options).url()), options.port);
}

TEST(ViewerServer, HostAndPortThatCannotBeAreErrors) {
  ViewerOptions options;
  options.host = "not an address";
  EXPECT_THROW(ViewerServer{options}, ValueError);
  options = {};
  options.port = 70000;
  EXPECT_THROW(ViewerServer{options}, ValueError);
  options = {};
  options.host = "192.0.2.1";  // for documentation: no machine has it
  EXPECT_THROW(ViewerServer{options}, Error);
}

TEST(ViewerServer, RequiresATokenFromOtherMachines) {
  ViewerOptions options = anyPort();
  options.host = "0.0.0.0";
  const ViewerServer open(options), other(options);
  const std::string url = open.url();
  const std::size_t question = url.find("?token=");
  ASSERT_NE(question, std::string::npos) << url;
  const std::string token = url.substr(question);
  EXPECT_EQ(token.size(), 7u + 32u);
  EXPECT_NE(other.url().substr(other.url().find('?')), token);
  const int port = portOf(url.substr(0, question));
  const std::string host = "localhost:" + std::to_string(port);
  EXPECT_TRUE(answerTo(port, get("/" + token, host)).starts_with("HTTP/1.1 200 "));
  for (const std::string& wrong :
       std::vector<std::string>{"", "?token=", "?token=" + std::string(32, '0'), token + "0", token.substr(0, 38)}) {
    EXPECT_TRUE(answerTo(port, get("/" + wrong, host)).starts_with("HTTP/1.1 403 ")) << wrong;
    EXPECT_TRUE(answerTo(port, get("/scene.html" + wrong, host)).starts_with("HTTP/1.1 403 ")) << wrong;
  }
  EXPECT_TRUE(answerTo(port, WebsocketClient::request(host, "")).starts_with("HTTP/1.1 403 "));
}

TEST_F(ViewerServerTest, GivesThePageWithAllThatIsShown) {
  server.update(frames(2));
  const std::string before = server.recording();
  server.update(frames(3));
  server.setMessage("hello");
  const std::string answer = answerTo(port, get("/scene.html", host));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 "));
  EXPECT_NE(server.recording(), before);  // the frames are in its compressed messages
  EXPECT_TRUE(answer.ends_with(server.recording()));
}

TEST_F(ViewerServerTest, AllBrowsersShowTheChangesOfOne) {
  server.update(frames(2));
  server.onCommand([](const Command& command) -> std::optional<EditedScene> {
    const auto* set = std::get_if<SetJointCommand>(&command);
    if (!set) throw Error("not this one");
    return EditedScene{{Pose(), Pose(Vector3d(set->value, 0., 0.), Quaterniond::Identity())},
                       VectorXd::Constant(1, set->value)};
  });
  WebsocketClient one(port), two(port);
  for (WebsocketClient* client : {&one, &two}) {
    while (!client->next()->binary) {
    }
  }
  one.sendBinary(std::string("\3\0\0\0\1\0\0\0", 8));  // throws
  std::string data("\2\0\0\0\1\0\0\0\0\0\0\0", 12);
  const double value = .5;
  one.sendBinary(data.append(reinterpret_cast<const char*>(&value), sizeof value));
  for (WebsocketClient* client : {&one, &two}) {
    const auto poses = client->next(), q = client->next();
    ASSERT_TRUE(poses && q);
    EXPECT_EQ(poses->number(1), 1u);  // frame
    EXPECT_EQ(poses->number(2), 1u);  // its id
    double received;
    std::memcpy(&received, q->data.data() + 8, sizeof received);
    EXPECT_EQ(received, value);
  }
}

TEST_F(ViewerServerTest, AMotionIsSentAsAWholeAndEnds) {
  server.update(frames(2));
  ShownMotion motion;
  motion.seconds = 1.5;
  motion.poses.assign(3, std::vector<Pose>(2));
  motion.q = MatrixXd::Constant(3, 1, .25);
  motion.texts = {"a", "b", "c"};
  server.showMotion(motion);
  WebsocketClient late(port);
  readUntil(late, R"("kind":"motion","slices":3,"seconds":1.5E0,"start":"all")");
  const auto data = late.next();
  ASSERT_TRUE(data && data->binary);
  EXPECT_EQ(data->data.size(), 4u * (4 + 3 * 2 * 7 + 3));
  EXPECT_EQ(data->number(0), std::uint32_t(BinaryKind::motion));
  server.endMotion();
  readUntil(late, R"("kind":"motion","slices":0)");
  server.endMotion();
  EXPECT_FALSE(late.next(kQuiet));
}

TEST_F(ViewerServerTest, AMovedFrameSendsOnePoseAndAnUnchangedSceneNothing) {
  auto items = frames(5);
  server.update(items);
  WebsocketClient client(port);
  while (!client.next()->binary) {
  }
  items[3].pose.p.x() = 1.;
  server.update(items);
  const auto poses = client.next();
  ASSERT_TRUE(poses && poses->binary);
  EXPECT_EQ(poses->data.size(), 40u);
  EXPECT_EQ(poses->number(0), 1u);  // poses
  EXPECT_EQ(poses->number(1), 1u);  // one
  EXPECT_EQ(poses->number(2), 3u);  // of frame 3
  server.update(items);
  server.setMessage("");
  EXPECT_FALSE(client.next(kQuiet));
}

TEST_F(ViewerServerTest, ALateBrowserGetsTheWholeScene) {
  auto items = frames(3);
  server.update(items);
  server.setMessage("hello");
  items.pop_back();
  server.update(items);
  WebsocketClient client(port);
  const auto text = client.next(), scene = client.next(), poses = client.next();
  ASSERT_TRUE(text && scene && poses);
  EXPECT_TRUE(text->has(R"("message":"hello")"));
  EXPECT_TRUE(scene->has(R"("count":2)") && scene->has("frame0") && scene->has("frame1") && !scene->has("frame2"))
      << scene->data;
  EXPECT_EQ(poses->number(1), 2u);
  EXPECT_FALSE(client.next(kQuiet));
}

TEST_F(ViewerServerTest, ServesSeveralBrowsersAndCountsThem) {
  auto first = std::make_unique<WebsocketClient>(port);
  WebsocketClient second(port);
  EXPECT_TRUE(eventually([&] { return server.clients() == 2; }));
  server.setMessage("to both");
  readUntil(*first, "to both");
  readUntil(second, "to both");
  first.reset();
  EXPECT_TRUE(eventually([&] { return server.clients() == 1; }));
  server.setMessage("to one");
  readUntil(second, "to one");
}

TEST_F(ViewerServerTest, KeysArriveOnceAndTheLastOneCounts) {
  WebsocketClient client(port);
  EXPECT_EQ(server.takeKey(), 0);
  client.sendKey('q');
  EXPECT_EQ(waitKey(), 'q');
  EXPECT_EQ(server.takeKey(), 0);
  client.sendKey('a');
  client.sendKey('b');
  EXPECT_TRUE(eventually([&] { return server.takeKey() == 'b'; }));
}

TEST_F(ViewerServerTest, KeysWithModifiersAndArrowsToTheSideDoNotEndTheWaiting) {
  WebsocketClient client(port);
  client.sendKey('a', 1);
  client.sendKey(262);
  int asked = 0;
  EXPECT_EQ(server.waitKey([&] {
    if (++asked == 3) client.sendKey('b');
    return false;
  }),
            'b');
  EXPECT_GE(asked, 3);
  client.sendKey('C', 2);
  int key = 0;
  while (key == 0) key = server.takeKey();
  EXPECT_EQ(key, 'C');
}

TEST(EventName, IsThatOfTheReference) {
  EXPECT_EQ(eventName({1, 'a', 0}), "key down a");
  EXPECT_EQ(eventName({2, 259, 0}), "key up backspace");
  EXPECT_EQ(eventName({1, 290, 0}), "key down 290");
  EXPECT_EQ(eventName({3, 0, 0}), "click down left");
  EXPECT_EQ(eventName({4, 2, 0}), "click up right");
  EXPECT_EQ(eventName({5, 1, 0}), "scroll up");
  EXPECT_EQ(eventName({6, 0, 5}), "mod shift alt");
  EXPECT_EQ(eventName({6, 0, 0}), "mod");
  for (const EventCommand& nonsense : {EventCommand{1, -5, 0}, EventCommand{3, 7, 0}, EventCommand{99, 1, 0}})
    EXPECT_EQ(eventName(nonsense), "");
}

TEST(InputEvents, KeepTheLastThousand) {
  InputEvents events;
  for (int i = 0; i < 1500; ++i) events.add({1, i < 1499 ? 'a' : 'z', 0});
  const std::vector<std::string> names = events.take();
  ASSERT_EQ(names.size(), 1000u);
  EXPECT_EQ(names.back(), "key down z");
  EXPECT_TRUE(events.take().empty());
}

TEST_F(ViewerServerTest, WaitingForAKeyEndsWhenStopSaysSo) {
  int asked = 0;
  EXPECT_EQ(server.waitKey([&] { return ++asked == 2; }), 0);
  EXPECT_EQ(asked, 2);
}
