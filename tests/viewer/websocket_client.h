#pragma once

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "kinegraph/viewer/messages/commands.h"

namespace kinegraph::test {

constexpr int kPatience = 20000;  // ms; much more than a busy machine needs

/// The port in an address such as http://localhost:7000/.
inline int portOf(const std::string& url) { return std::stoi(url.substr(url.rfind(':') + 1)); }

/// A connection to this machine. With `receive_buffer` (bytes), it takes in no more than about that before it is read.
class TcpClient {
 public:
  explicit TcpClient(int port, int receive_buffer = 0) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer) setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      throw std::runtime_error("no connection");
  }
  ~TcpClient() { close(socket_); }
  TcpClient(const TcpClient&) = delete;

  void send(const std::string& data) {
    for (std::size_t sent = 0; sent < data.size();) {
      const ssize_t n = ::send(socket_, data.data() + sent, data.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return;  // the server has hung up; reading tells
      sent += std::size_t(n);
    }
  }

  /// Whether there is something to read, or the end, within so many ms.
  bool hasData(int milliseconds) {
    pollfd entry{socket_, POLLIN, 0};
    return poll(&entry, 1, milliseconds) > 0;
  }

  /// Exactly `size` bytes, or fewer at the end of the connection.
  std::string read(std::size_t size) {
    std::string data;
    char buffer[1 << 16];
    while (data.size() < size) {
      if (!hasData(kPatience)) throw std::runtime_error("the server does not answer");
      const ssize_t n = recv(socket_, buffer, std::min(sizeof buffer, size - data.size()), 0);
      if (n <= 0) break;
      data.append(buffer, std::size_t(n));
    }
    return data;
  }

  std::string readAll() { return read(std::string::npos); }

 private:
  int socket_;
};

struct Received {
  std::string data;
  bool binary = false;

  /// The i-th 32-bit number of a binary message.
  std::uint32_t number(std::size_t i) const {
    std::uint32_t value;
    std::memcpy(&value, data.data() + 4 * i, sizeof value);
    return value;
  }
  bool has(const std::string& text) const { return data.find(text) != std::string::npos; }
};

/// A browser's side of the websocket (RFC 6455), as far as the tests need it.
class WebsocketClient : public TcpClient {
 public:
  static std::string request(const std::string& host, const std::string& origin) {
    return "GET / HTTP/1.1\r\nHost: " + host + "\r\n" + (origin.empty() ? "" : "Origin: " + origin + "\r\n") +
           "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: "
           "AAAAAAAAAAAAAAAAAAAAAA==\r\n\r\n";
  }

  explicit WebsocketClient(int port, int receive_buffer = 0) : TcpClient(port, receive_buffer) {
    TcpClient::send(request("localhost:" + std::to_string(port), ""));
    std::string head;
    while (!head.ends_with("\r\n\r\n")) {
      const std::string next = TcpClient::read(1);
      if (next.empty()) throw std::runtime_error("the server refuses the websocket: " + head);
      head += next;
    }
    if (!head.starts_with("HTTP/1.1 101")) throw std::runtime_error("the server refuses the websocket: " + head);
  }

  void send(const std::string& data, int opcode) {
    std::string frame(1, static_cast<char>(0x80 | opcode));
    if (data.size() < 126) {
      frame += static_cast<char>(0x80 | data.size());
    } else {
      const bool is_short = data.size() < 65536;
      frame += static_cast<char>(is_short ? 0xfe : 0xff);
      for (int shift = is_short ? 8 : 56; shift >= 0; shift -= 8)
        frame += static_cast<char>(std::uint64_t(data.size()) >> shift);
    }
    TcpClient::send(frame + std::string(4, '\0') + data);  // masked with zeros
  }
  void sendText(const std::string& data) { send(data, 1); }
  void sendBinary(const std::string& data) { send(data, 2); }
  void sendKey(std::uint32_t code, std::uint32_t modifiers = 0) {
    const std::uint32_t numbers[] = {KeyCommand::kKind, code, modifiers};
    sendBinary(std::string(reinterpret_cast<const char*>(numbers), sizeof numbers));
  }

  /// The next message; nothing if the server has hung up, or sends nothing for so many ms.
  std::optional<Received> next(int milliseconds = kPatience) {
    Received message;
    for (bool first = true, last = false; !last; first = false) {
      if (!hasData(milliseconds)) return std::nullopt;
      const std::string head = read(2);
      if (head.size() < 2 || (head[0] & 0x0f) == 8) return std::nullopt;
      if (first) message.binary = (head[0] & 0x0f) == 2;
      last = head[0] & 0x80;
      std::size_t size = head[1] & 0x7f;
      if (size >= 126) {
        const std::string length = read(size == 126 ? 2 : 8);
        size = 0;
        for (const char c : length) size = size << 8 | static_cast<unsigned char>(c);
      }
      message.data += read(size);
    }
    return message;
  }
};

}  // namespace kinegraph::test
