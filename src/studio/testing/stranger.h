// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// For tests: a studio that runs beside them, and plain sockets to ask it.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>

#include "gable/studio.h"

namespace gable::studio::testing {

inline int connectTo(int port) {
  const int s = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(s, reinterpret_cast<sockaddr*>(&to), sizeof to), 0) << "no server";
  return s;
}

/// False when the other side has closed.
inline bool send(int s, const std::string& text) {
  for (size_t sent = 0; sent < text.size();) {
    const ssize_t n = ::send(s, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<size_t>(n);
  }
  return true;
}

/// All that comes until the other side closes.
inline std::string receive(int s) {
  std::string out;
  char buffer[4096];
  for (ssize_t n = 0; (n = recv(s, buffer, sizeof buffer, 0)) > 0;) {
    out.append(buffer, static_cast<size_t>(n));
  }
  return out;
}

inline int status(const std::string& answer) {
  return answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
}

/// A studio on a port of its own, from start() to stop().
class RunningStudio {
 public:
  void start(const StudioSettings& settings) {
    thread_ = std::thread([this, settings] {
      runStudio(settings, stop_, [this](const std::string& url) {
        port_ = std::stoi(url.substr(url.find(':', 7) + 1));
      });
    });
    while (port_ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  int port() const { return port_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<int> port_{0};
  std::thread thread_;
};

}  // namespace gable::studio::testing
