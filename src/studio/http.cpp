// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Boost.Beast. One thread runs all input and output, so connections need no locks; handlers run in
// a pool and hand their answers back to that thread.

#include "studio/http.h"

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <numeric>
#include <optional>
#include <set>

#include "base/text.h"
#include "studio/socket.h"

namespace gable::studio {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Code = beast::error_code;

namespace {

std::chrono::milliseconds milliseconds(double seconds) {
  return std::chrono::milliseconds(static_cast<int64_t>(seconds * 1000));
}

bool parseTarget(const std::string& target, HttpRequest& out) {
  const size_t mark = target.find('?');
  if (!decodePercent(target.substr(0, mark), out.path)) return false;
  if (mark == std::string::npos) return true;
  for (size_t from = mark + 1; from <= target.size();) {
    const size_t to = std::min(target.find('&', from), target.size());
    const std::string pair = target.substr(from, to - from);
    const size_t equals = std::min(pair.find('='), pair.size());
    std::string name, value;
    if (!decodePercent(pair.substr(0, equals), name)) return false;
    if (equals < pair.size() && !decodePercent(pair.substr(equals + 1), value)) return false;
    if (!name.empty()) out.query[name] = value;
    from = to + 1;
  }
  return true;
}

/// A body in pieces, for Beast.
struct PiecesBody {
  using value_type = std::vector<std::string>;
  static uint64_t size(const value_type& pieces) {
    return std::accumulate(pieces.begin(), pieces.end(), uint64_t{0},
                           [](uint64_t sum, const std::string& p) { return sum + p.size(); });
  }
  class writer {
   public:
    using const_buffers_type = std::vector<asio::const_buffer>;
    template <bool isRequest, class Fields>
    writer(const http::header<isRequest, Fields>&, const value_type& pieces) : pieces_(pieces) {}
    void init(Code& error) { error = {}; }
    boost::optional<std::pair<const_buffers_type, bool>> get(Code& error) {
      error = {};
      const_buffers_type all;
      for (const std::string& p : pieces_) all.push_back(asio::buffer(p));
      return {{std::move(all), false}};
    }

   private:
    const value_type& pieces_;
  };
};

HttpResponse plain(int status, const char* text) { return {status, "text/plain", text, {}}; }

}  // namespace

struct HttpServer::Impl {
  class Connection;

  Impl(HttpSettings s, Admit a, Handler h, Slow l, Talks t)
      : settings(std::move(s)),
        admit(std::move(a)),
        handler(std::move(h)),
        slow(std::move(l)),
        talks(std::move(t)),
        acceptor(io),
        timer(io),
        pool(settings.workers),
        slowPool(settings.slowWorkers),
        talkPool(settings.talkWorkers),
        arrivals(pool.get_executor()) {}

  void accept();
  void tick(const std::atomic<bool>& stop);

  HttpSettings settings;
  Admit admit;
  Handler handler;
  Slow slow;
  Talks talks;
  /// Before `io`, whose end ends the connections that still wait there.
  std::set<Connection*> connections;
  std::set<Socket*> sockets;
  /// Bytes of the bodies that are being read or answered.
  uint64_t bodies = 0;
  asio::io_context io{1};
  tcp::acceptor acceptor;
  asio::steady_timer timer;
  asio::thread_pool pool, slowPool, talkPool;
  /// Slow requests, one after the other as they come.
  asio::strand<asio::thread_pool::executor_type> arrivals;
  unsigned waiting = 0, slowWaiting = 0;
};

// One client: reads a request, has it answered, writes the answer, and again.
class HttpServer::Impl::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Impl& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    server_.connections.insert(this);
  }
  ~Connection() {
    releaseBody();
    server_.connections.erase(this);
  }

  void read() {
    parser_.emplace();
    parser_->header_limit(server_.settings.maxHead);
    parser_->body_limit(server_.settings.maxBody);
    stream_.expires_after(milliseconds(server_.settings.headSeconds));
    http::async_read_header(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](Code error, size_t) { self->onHead(error); });
  }

  void cancel() {
    if (request_.cancelled) request_.cancelled->store(true);
    Code ignored;
    stream_.socket().close(ignored);
  }

 private:
  void onHead(Code error) {
    if (error == http::error::header_limit) return write(plain(431, "The head is too large.\n"));
    if (error == http::error::body_limit) return write(plain(413, "The body is too large.\n"));
    if (error && parser_->got_some() && error.category() == http::make_error_code({}).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message) {
      return write(plain(400, "This is no request.\n"));
    }
    if (error) return;
    const auto& head = parser_->get();
    request_ = {};
    request_.cancelled = std::make_shared<std::atomic<bool>>(false);
    request_.method = std::string(head.method_string());
    for (const auto& field : head) {
      request_.headers[lowerCase(std::string(field.name_string()))] = std::string(field.value());
    }
    keep_ = head.keep_alive();
    if (!parseTarget(std::string(head.target()), request_)) {
      return write(plain(400, "The address is broken.\n"));
    }
    HttpResponse admitted = server_.admit(request_);
    if (admitted.status != 200) return write(std::move(admitted));
    if (beast::websocket::is_upgrade(head)) return talk();
    const auto length = parser_->content_length();
    if (length && *length > server_.settings.maxBody) {
      return write(plain(413, "The body is too large.\n"));
    }
    // A body in pieces does not say how long it will be.
    const uint64_t unknown = parser_->chunked() ? server_.settings.maxBody : 0;
    const uint64_t bytes = length ? *length : unknown;
    if (bytes > server_.settings.maxBodies - server_.bodies) {
      return write(plain(503, "Too many large requests at once.\n"));
    }
    server_.bodies += bytes;
    body_ = bytes;
    stream_.expires_after(milliseconds(server_.settings.bodySeconds));
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](Code e, size_t) { self->onBody(e); });
  }

  // The connection becomes a conversation.
  void talk() {
    std::unique_ptr<Conversation> conversation;
    if (server_.talks.begin) conversation = server_.talks.begin(request_);
    if (!conversation) return write(plain(404, "There is nothing to talk with here.\n"));
    Impl& server = server_;
    const auto socket = std::make_shared<Socket>(
        std::move(stream_), server.io, server.talkPool, std::move(conversation),
        Socket::Limits{server.settings.maxMessage, server.settings.maxMessages},
        [&server](Socket* s) { server.sockets.erase(s); });
    server.sockets.insert(socket.get());
    socket->open(parser_->get(), server.talks.protocol);
  }

  void onBody(Code error) {
    if (error == http::error::body_limit) return write(plain(413, "The body is too large.\n"));
    if (error) return;
    slow_ = server_.slow.is && server_.slow.is(request_);
    unsigned& waiting = slow_ ? server_.slowWaiting : server_.waiting;
    if (waiting >= server_.settings.maxWaiting) {
      releaseBody();
      return write(plain(503, "Too many requests at once.\n"));
    }
    request_.body = std::move(parser_->get().body());
    ++waiting;
    working_ = true;
    stream_.expires_never();
    watch();
    auto self = shared_from_this();
    if (!slow_) return asio::post(server_.pool, [self = std::move(self)]() mutable { make(self); });
    asio::post(server_.arrivals, [self = std::move(self)]() mutable {
      Impl& server = self->server_;
      if (server.slow.arrived) server.slow.arrived(self->request_);
      asio::post(server.slowPool, [self = std::move(self)]() mutable { make(self); });
    });
  }

  // Makes the answer, on a thread of a pool. The connection goes back whole: it must not end there.
  static void make(std::shared_ptr<Connection>& self) {
    const auto answer =
        std::make_shared<HttpResponse>(answered(self->server_.handler, self->request_));
    asio::io_context& io = self->server_.io;
    const std::function<void()> after = std::move(answer->after);
    asio::post(io, [self = std::move(self), answer] { self->onAnswer(std::move(*answer)); });
    if (after) after();
  }

  // While a request is at work, a readable socket without bytes is a client that has gone.
  void watch() {
    stream_.socket().async_wait(tcp::socket::wait_read, [self = shared_from_this()](Code error) {
      if (error || !self->working_) return;
      char byte = 0;
      Code peeked;
      self->stream_.socket().non_blocking(true, peeked);
      const size_t n =
          self->stream_.socket().receive(asio::buffer(&byte, 1), tcp::socket::message_peek, peeked);
      if (n == 0 && peeked != asio::error::would_block) self->request_.cancelled->store(true);
    });
  }

  void onAnswer(HttpResponse answer) {
    working_ = false;
    --(slow_ ? server_.slowWaiting : server_.waiting);
    releaseBody();
    Code ignored;
    stream_.socket().cancel(ignored);
    answered_ = true;
    write(std::move(answer));
  }

  void releaseBody() {
    request_.body = {};
    server_.bodies -= body_;
    body_ = 0;
  }

  void write(HttpResponse answer) {
    // Of a request that was not read to its end nothing more can be understood.
    const bool keep = keep_ && answered_;
    answered_ = false;
    auto out = std::make_shared<http::response<PiecesBody>>();
    out->version(11);
    out->result(static_cast<unsigned>(answer.status));
    out->set(http::field::content_type, answer.type);
    out->set("X-Content-Type-Options", "nosniff");
    for (const auto& [name, value] : answer.headers) out->set(name, value);
    out->keep_alive(keep);
    out->body() = std::move(answer.rest);
    out->body().insert(out->body().begin(), std::move(answer.body));
    if (request_.method == "HEAD") {
      out->content_length(PiecesBody::size(out->body()));
      out->body().clear();
    } else {
      out->prepare_payload();
    }
    stream_.expires_after(milliseconds(server_.settings.writeSeconds));
    const auto ended = [self = shared_from_this(), out, keep, sent = std::move(answer.sent)](
                           Code error, size_t) {
      if (sent) sent(std::move(out->body()));
      if (!error && keep) return self->read();
      Code ignored;
      self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    };
    http::async_write(stream_, *out, ended);
  }

  Impl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  HttpRequest request_;
  /// Its share of the bytes of all bodies.
  uint64_t body_ = 0;
  bool keep_ = false, working_ = false, answered_ = false, slow_ = false;
};

void HttpServer::Impl::accept() {
  acceptor.async_accept([this](Code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    // Above the limit the connection is closed at once.
    if (!error && connections.size() + sockets.size() < settings.maxConnections) {
      Code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Connection>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void HttpServer::Impl::tick(const std::atomic<bool>& stop) {
  if (stop.load()) {
    io.stop();
    return;
  }
  timer.expires_after(std::chrono::milliseconds(100));
  timer.async_wait([this, &stop](Code error) {
    if (!error) tick(stop);
  });
}

HttpServer::HttpServer(HttpSettings settings, Admit admit, Handler handler, Slow slow, Talks talks)
    : impl_(std::make_unique<Impl>(std::move(settings), std::move(admit), std::move(handler),
                                   std::move(slow), std::move(talks))) {}

HttpServer::~HttpServer() {
  for (Impl::Connection* c : impl_->connections) c->cancel();
  for (Socket* s : impl_->sockets) s->close();
  // The first hands on to the second.
  impl_->pool.join();
  impl_->slowPool.join();
  impl_->talkPool.join();
}

Result<uint16_t> HttpServer::listen() {
  const auto failed = [this](const Code& e) {
    return Error{"address-unusable",
                 impl_->settings.address + ":" + std::to_string(impl_->settings.port) +
                     " cannot be listened on: " + e.message(),
                 "name another with --port, or 0 for any"};
  };
  Code error;
  const auto address = asio::ip::make_address(impl_->settings.address, error);
  if (error) return failed(error);
  const tcp::endpoint end(address, impl_->settings.port);
  tcp::acceptor& a = impl_->acceptor;
  a.open(end.protocol(), error);
  if (!error) a.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) a.bind(end, error);
  if (!error) a.listen(asio::socket_base::max_listen_connections, error);
  if (error) return failed(error);
  const tcp::endpoint bound = a.local_endpoint(error);
  if (error) return failed(error);
  return bound.port();
}

void HttpServer::run(const std::atomic<bool>& stop) {
  impl_->accept();
  impl_->tick(stop);
  impl_->io.run();
}

bool decodePercent(const std::string& text, std::string& out) {
  const auto digit = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  out.clear();
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return false;
    const int high = digit(text[i + 1]), low = digit(text[i + 2]);
    if (high < 0 || low < 0 || (high == 0 && low == 0)) return false;
    out += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return true;
}

}  // namespace gable::studio
