// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "studio/socket.h"

#include <boost/asio/post.hpp>
#include <utility>

namespace gable::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Code = beast::error_code;

Socket::Socket(beast::tcp_stream stream, asio::io_context& io, asio::thread_pool& pool,
               std::unique_ptr<Conversation> conversation, Limits limits,
               std::function<void(Socket*)> ended)
    : stream_(std::move(stream)),
      io_(io),
      pool_(pool),
      timer_(io),
      conversation_(std::move(conversation)),
      limits_(limits),
      ended_(std::move(ended)) {}

Socket::~Socket() { ended_(this); }

void Socket::open(const Request& request, const std::string& protocol) {
  beast::get_lowest_layer(stream_).expires_never();
  stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
  stream_.set_option(websocket::stream_base::decorator([protocol](websocket::response_type& r) {
    if (!protocol.empty()) r.set(http::field::sec_websocket_protocol, protocol);
  }));
  stream_.read_message_max(limits_.maxMessage);
  stream_.async_accept(request, [self = shared_from_this()](Code error) {
    if (!error) self->read();
  });
}

void Socket::close() {
  closed_ = true;
  timer_.cancel();
  Code ignored;
  beast::get_lowest_layer(stream_).socket().close(ignored);
}

void Socket::read() {
  stream_.async_read(buffer_,
                     [self = shared_from_this()](Code error, size_t) { self->onRead(error); });
}

void Socket::onRead(Code error) {
  if (error || closed_) return close();
  waiting_ += buffer_.size();
  if (waiting_ > limits_.maxWaiting) return close();
  inbox_.push_back(beast::buffers_to_string(buffer_.data()));
  buffer_.consume(buffer_.size());
  work();
  read();
}

// One step is under way at a time; what comes meanwhile is taken in before the next.
void Socket::work() {
  if (working_ || closed_) return;
  working_ = true;
  timer_.cancel();
  waiting_ = 0;
  asio::post(pool_, [self = shared_from_this(), messages = std::exchange(inbox_, {})]() mutable {
    step(self, std::move(messages));
  });
}

// On a thread of the pool. The socket goes back whole: it must not end there.
void Socket::step(std::shared_ptr<Socket>& self, std::vector<std::string> messages) {
  std::vector<std::string> out;
  std::optional<double> wait;
  bool failed = false;
  try {
    Conversation& c = *self->conversation_;
    for (const std::string& m : messages) c.receive(m);
    c.step();
    out = c.take();
    wait = c.wait();
  } catch (const std::exception&) {
    failed = true;  // Memory is short: the page connects anew.
  }
  asio::io_context& io = self->io_;
  asio::post(io, [self = std::move(self), out = std::move(out), wait, failed]() mutable {
    self->working_ = false;
    if (failed) return self->close();
    self->onStep(std::move(out), wait);
  });
}

void Socket::onStep(std::vector<std::string> out, std::optional<double> wait) {
  if (closed_) return;
  for (std::string& m : out) outbox_.push_back(std::move(m));
  if (!writing_) write();
  if (!inbox_.empty() || (wait && *wait <= 0)) return work();
  if (!wait) return;
  timer_.expires_after(std::chrono::milliseconds(1 + static_cast<int64_t>(*wait * 1000)));
  timer_.async_wait([self = shared_from_this()](Code error) {
    if (!error) self->work();
  });
}

void Socket::write() {
  writing_ = !outbox_.empty();
  if (!writing_) return;
  stream_.text(true);
  stream_.async_write(asio::buffer(outbox_.front()),
                      [self = shared_from_this()](Code error, size_t) {
                        if (error || self->closed_) return self->close();
                        self->outbox_.pop_front();
                        self->write();
                      });
}

}  // namespace gable::studio
