// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A connection that stays: a WebSocket, over which a client and a Conversation send each other
// texts. Input and output run on one thread; the conversation works on a pool, a step at a time,
// and what has come is handed to it before each step.
//
// Promises: a conversation is used by one thread at a time, and ends when its client goes away. A
// message that is too large, or more messages than may wait, end the connection.
#pragma once

#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "studio/http.h"

namespace gable::studio {

class Socket : public std::enable_shared_from_this<Socket> {
 public:
  struct Limits {
    uint64_t maxMessage, maxWaiting;
  };
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  /// `ended` is called when the socket is destroyed, on the thread of input and output.
  Socket(boost::beast::tcp_stream stream, boost::asio::io_context& io,
         boost::asio::thread_pool& pool, std::unique_ptr<Conversation> conversation, Limits limits,
         std::function<void(Socket*)> ended);
  ~Socket();

  /// Answers the request that asked for it; `protocol` is the one of those asked for that is
  /// spoken.
  void open(const Request& request, const std::string& protocol);
  void close();

 private:
  void read();
  void onRead(boost::beast::error_code error);
  void work();
  static void step(std::shared_ptr<Socket>& self, std::vector<std::string> messages);
  void onStep(std::vector<std::string> out, std::optional<double> wait);
  void write();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::asio::io_context& io_;
  boost::asio::thread_pool& pool_;
  boost::asio::steady_timer timer_;
  std::unique_ptr<Conversation> conversation_;
  Limits limits_;
  std::function<void(Socket*)> ended_;
  boost::beast::flat_buffer buffer_;
  /// Messages that the conversation has not had yet, and their bytes.
  std::vector<std::string> inbox_;
  uint64_t waiting_ = 0;
  std::deque<std::string> outbox_;
  bool working_ = false, writing_ = false, closed_ = false;
};

}  // namespace gable::studio
