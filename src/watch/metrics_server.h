// SPDX-License-Identifier: Apache-2.0
// Answers HTTP requests on a port of this machine alone (127.0.0.1) with one text, from a thread of its own.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace skysweep::watch {

class MetricsServer {
 public:
  // `text` is asked for at every request, in the server's thread. Port 0: any that is free. Throws Error(failed) when
  // the port is taken.
  MetricsServer(int port, std::function<std::string()> text);
  ~MetricsServer();
  MetricsServer(const MetricsServer&) = delete;
  MetricsServer& operator=(const MetricsServer&) = delete;

  int port() const { return port_; }

 private:
  void serve();
  void answer(int connection) const;

  std::function<std::string()> text_;
  int socket_ = -1;
  int port_ = 0;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace skysweep::watch
