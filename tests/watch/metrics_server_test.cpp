// SPDX-License-Identifier: Apache-2.0
#include "watch/metrics_server.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "core/error.h"
#include "raster/temp_folder.h"

namespace skysweep::watch {
namespace {

// The whole answer to a request; empty if nobody answers at this address.
std::string ask(std::uint32_t address, int port) {
  const int connection = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(address);
  std::string answer;
  if (::connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0) {
    const std::string request = "GET /metrics HTTP/1.1\r\nHost: localhost\r\n\r\n";
    EXPECT_EQ(::send(connection, request.data(), request.size(), MSG_NOSIGNAL), static_cast<ssize_t>(request.size()));
    std::array<char, 1024> part;
    for (ssize_t size; (size = ::recv(connection, part.data(), part.size(), 0)) > 0;)
      answer.append(part.data(), static_cast<std::size_t>(size));
  }
  ::close(connection);
  return answer;
}

TEST(MetricsServer, answers_with_the_text_of_the_moment) {
  int asked = 0;
  const MetricsServer server(0, [&] { return "asked " + std::to_string(++asked) + "\n"; });
  const std::string first = ask(INADDR_LOOPBACK, server.port());
  EXPECT_TRUE(first.starts_with("HTTP/1.0 200 OK\r\n")) << first;
  EXPECT_NE(first.find("Content-Type: text/plain; version=0.0.4"), std::string::npos) << first;
  EXPECT_TRUE(first.ends_with("\r\n\r\nasked 1\n")) << first;
  EXPECT_TRUE(ask(INADDR_LOOPBACK, server.port()).ends_with("asked 2\n"));
}

TEST(MetricsServer, answers_this_machine_alone) {
  const MetricsServer server(0, [] { return "text"; });
  EXPECT_EQ(ask(INADDR_LOOPBACK + 1, server.port()), "") << "127.0.0.2 is not the address it listens on";
}

TEST(MetricsServer, a_port_that_is_taken_is_named) {
  const MetricsServer server(0, [] { return "text"; });
  const std::string sentence =
      testing_support::message_of<Error>([&] { const MetricsServer second(server.port(), [] { return "text"; }); });
  EXPECT_NE(sentence.find("port " + std::to_string(server.port())), std::string::npos) << sentence;
}

}  // namespace
}  // namespace skysweep::watch
