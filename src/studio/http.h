// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A small HTTP server for one machine. Requests are read on one thread and answered on a few
// others; those that take long have threads of their own.
//
// Promises, each with a test:
// 1. Listens on the loopback address unless told otherwise.
// 2. A request that `admit` refuses is answered before its body is read.
// 3. Heads, bodies, connections, waiting requests and the time to send a request are bounded, and
//    so are the bytes of the bodies of all connections together.
// 4. When a client goes away, `cancelled` of its request becomes true.
// 5. No request waits for one that takes long, unless it is such a one itself.
// 6. Conversations over WebSockets (socket.h) have threads of their own, and count as connections.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.h"
#include "studio/message.h"

namespace gable::studio {

/// The server's end of a connection that stays. One thread at a time uses it.
class Conversation {
 public:
  virtual ~Conversation() = default;
  virtual void receive(std::string_view message) = 0;
  /// Does a piece of what there is to do; false when there is nothing now.
  virtual bool step() = 0;
  /// What is to be sent, in order.
  virtual std::vector<std::string> take() = 0;
  /// Seconds until step() has something to do by itself; none: only when a message comes.
  virtual std::optional<double> wait() const = 0;
};

struct HttpSettings {
  std::string address = "127.0.0.1";
  /// 0: any that is free.
  uint16_t port = 0;
  uint64_t maxBody = 64u << 20;
  /// Of all requests that are being read or answered.
  uint64_t maxBodies = 160u << 20;
  uint32_t maxHead = 16u << 10;
  /// For requests that take long, and for the others.
  unsigned slowWorkers = 4, workers = 4, talkWorkers = 2;
  unsigned maxConnections = 128;
  unsigned maxWaiting = 64;
  /// Of a conversation: bytes of a message, and of all that it has not had yet.
  uint64_t maxMessage = 32u << 20, maxMessages = 64u << 20;
  double headSeconds = 20, bodySeconds = 30, writeSeconds = 60;
};

class HttpServer {
 public:
  /// Requests that take long.
  struct Slow {
    std::function<bool(const HttpRequest&)> is;
    /// Told of each in the order of their coming, before it waits for a thread. It is quick itself.
    std::function<void(const HttpRequest&)> arrived;
  };
  /// A conversation for a request to begin one; null where there is none to be had.
  struct Talks {
    std::function<std::unique_ptr<Conversation>(const HttpRequest&)> begin;
    /// The name of what is spoken, one of the request's own.
    std::string protocol;
  };
  /// The answer to a request.
  using Handler = std::function<HttpResponse(const HttpRequest&)>;
  /// Status 200: the request may go on. Sees the head only.
  using Admit = std::function<HttpResponse(const HttpRequest&)>;

  HttpServer(HttpSettings settings, Admit admit, Handler handler, Slow slow = {}, Talks talks = {});
  /// Waits for requests at work, which see themselves cancelled.
  ~HttpServer();

  /// The port. Codes: address-unusable.
  Result<uint16_t> listen();
  /// Serves until `stop` is true; looks ten times a second. After listen().
  void run(const std::atomic<bool>& stop);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// "a%20b" to "a b"; false where the escape is broken or stands for a zero byte.
bool decodePercent(const std::string& text, std::string& out);

}  // namespace gable::studio
