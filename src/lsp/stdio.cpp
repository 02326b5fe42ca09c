// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One client over two file descriptors. What has come is read before each step, so that a request
// which the client takes back is not worked on.

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>

#include "gable/lsp.h"
#include "lsp/framing.h"

namespace gable {

namespace {

constexpr size_t kPiece = 256 << 10;

bool writeAll(int out, const std::string& bytes) {
  for (size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::write(out, bytes.data() + at, bytes.size() - at);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += static_cast<size_t>(n);
  }
  return true;
}

/// Reads what is there; waits for it so many milliseconds (-1: for ever). False at the end.
bool readSome(int in, int milliseconds, lsp::Framing& framing) {
  pollfd p{in, POLLIN, 0};
  const int ready = ::poll(&p, 1, milliseconds);
  if (ready < 0) return errno == EINTR;
  if (ready == 0) return true;
  std::string piece(kPiece, '\0');
  const ssize_t n = ::read(in, piece.data(), piece.size());
  if (n < 0) return errno == EINTR || errno == EAGAIN;
  if (n == 0) return false;
  framing.feed(std::string_view(piece).substr(0, static_cast<size_t>(n)));
  return true;
}

}  // namespace

int runLanguageServer(int in, int out, const SearchSettings& search) {
  LanguageServer server({}, {}, search);
  lsp::Framing framing;
  bool open = true;
  while (!server.ended()) {
    // Wait only when there is nothing to do; when the input has ended, do what has come.
    const std::optional<double> wait = server.wait();
    int milliseconds = wait ? static_cast<int>(std::ceil(*wait * 1000)) : -1;
    if (open) {
      open = readSome(in, milliseconds, framing);
    } else if (!wait || *wait > 0) {
      break;
    }
    while (std::optional<lsp::Framing::Frame> frame = framing.next()) {
      if (frame->trouble.empty()) {
        server.receive(frame->body);
      } else {
        server.receiveBroken(frame->trouble);
      }
    }
    server.step();
    for (const std::string& message : server.take()) {
      if (!writeAll(out, lsp::framed(message))) return 1;
    }
  }
  return server.exitStatus();
}

}  // namespace gable
