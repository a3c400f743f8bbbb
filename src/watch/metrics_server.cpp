// SPDX-License-Identifier: Apache-2.0
#include "watch/metrics_server.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "core/error.h"

namespace skysweep::watch {
namespace {

constexpr int kLookForStop_ms = 200;
constexpr int kPatience_s = 2;  // with one who asks and does not go on
constexpr int kMostWaiting = 8;

}  // namespace

MetricsServer::MetricsServer(int port, std::function<std::string()> text) : text_(std::move(text)) {
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (socket_ < 0 || ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(socket_, any, size) != 0 || ::listen(socket_, kMostWaiting) != 0 ||
      ::getsockname(socket_, any, &size) != 0) {
    const std::string reason = std::generic_category().message(errno);
    if (socket_ >= 0) ::close(socket_);
    throw failure("The port " + std::to_string(port) + " for --metrics cannot be opened: " + reason +
                  "; choose another.");
  }
  port_ = ntohs(address.sin_port);
  // Signals are for the thread that looks after them.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { serve(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

MetricsServer::~MetricsServer() {
  stop_ = true;
  thread_.join();
  ::close(socket_);
}

void MetricsServer::serve() {
  while (!stop_) {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, kLookForStop_ms) <= 0) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) continue;
    answer(connection);
    ::close(connection);
  }
}

void MetricsServer::answer(int connection) const {
  const timeval patience{kPatience_s, 0};
  ::setsockopt(connection, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  ::setsockopt(connection, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  std::array<char, 4096> request;  // whatever is asked, the answer is the same
  if (::recv(connection, request.data(), request.size(), 0) <= 0) return;
  const std::string body = text_();
  const std::string reply =
      "HTTP/1.0 200 OK\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\nContent-Length: " +
      std::to_string(body.size()) + "\r\nConnection: close\r\n\r\n" + body;
  for (std::size_t sent = 0; sent < reply.size();) {
    const ssize_t now = ::send(connection, reply.data() + sent, reply.size() - sent, MSG_NOSIGNAL);
    if (now <= 0) return;
    sent += static_cast<std::size_t>(now);
  }
  ::shutdown(connection, SHUT_WR);
}

}  // namespace skysweep::watch
