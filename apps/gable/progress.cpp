// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The work tells two numbers; a thread of its own draws them, so that the work never waits for a
// terminal. The time left is that of the work so far in proportion.

#include "progress.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "common.h"
#include "terminal.h"

namespace {

constexpr double kFirstSeconds = 1.0;
/// What is counted after less has no rate yet.
constexpr double kLeastSeconds = 0.2;
constexpr std::chrono::milliseconds kBetween{200};
constexpr const char* kErase = "\r\033[K";

/// Whether a bar stands on the terminal, and that one writes there at a time.
std::mutex& screen() {
  static std::mutex lock;
  return lock;
}
bool drawn = false;

void eraseLocked() {
  if (!drawn) return;
  std::fputs(kErase, stderr);
  std::fflush(stderr);
  drawn = false;
}

std::string bar(double share) {
  constexpr size_t kCells = 20;
  const auto full = static_cast<size_t>(share * kCells);
  return "[" + std::string(full, '#') + std::string(kCells - full, '-') + "]";
}

std::string rateText(double rate, const std::string& unit) {
  char text[64];
  std::snprintf(text, sizeof text, rate < 10 ? "%.1f " : "%.0f ", rate);
  return text + unit + "/s";
}

}  // namespace

std::string durationText(double seconds) {
  char text[64];
  const auto all = static_cast<long long>(std::min(seconds + 0.5, 1e12));
  if (all < 60) {
    std::snprintf(text, sizeof text, "%lld s", all);
  } else if (all < 3600) {
    std::snprintf(text, sizeof text, "%lld min %02lld s", all / 60, all % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld h %02lld min", all / 3600, all / 60 % 60);
  }
  return text;
}

std::string progressText(const std::string& what, const std::string& unit, size_t done,
                         size_t total, double seconds, int columns) {
  std::string out = what + "  ";
  if (total <= 1) {
    out += durationText(seconds);
  } else {
    done = std::min(done, total);
    const double share = static_cast<double>(done) / static_cast<double>(total);
    char percent[16];
    std::snprintf(percent, sizeof percent, "  %3d %%", static_cast<int>(share * 100));
    out += bar(share) + percent;
    if (!unit.empty()) out += "  " + rateText(static_cast<double>(done) / seconds, unit);
    if (done > 0) out += "  " + durationText(seconds / share - seconds) + " left";
  }
  // The last column stays free: some terminals wrap behind it.
  if (columns > 1 && out.size() >= static_cast<size_t>(columns)) out.resize(columns - 1);
  return out;
}

Progress::Progress(std::string what, std::string unit)
    : what_(std::move(what)), unit_(std::move(unit)), begin_(secondsNow()) {
  if (isShown()) drawer_ = std::thread([this] { draw(); });
}

Progress::~Progress() {
  if (drawer_.joinable()) {
    {
      const std::lock_guard hold(lock_);
      ended_ = true;
    }
    end_.notify_one();
    drawer_.join();
  }
  const Pause pause;
  if (terminal().verbose && !terminal().quiet) {
    std::fprintf(stderr, "%s: %.2f s\n", what_.c_str(), secondsNow() - begin_);
  }
}

void Progress::tellStep(const char* step, double seconds) {
  const Pause pause;
  if (terminal().verbose && !terminal().quiet) {
    std::fprintf(stderr, "  %s: %.2f s\n", step, seconds);
  }
}

bool Progress::isShown() { return !terminal().quiet && isScreen(stderr); }

std::function<void(size_t, size_t)> Progress::callback() {
  if (!isShown()) return {};
  return [this](size_t done, size_t total) {
    double never = 0;
    countedFrom_.compare_exchange_strong(never, secondsNow());
    total_.store(total, std::memory_order_relaxed);
    done_.store(done, std::memory_order_relaxed);
  };
}

Progress::Pause::Pause() : hold_(screen()) { eraseLocked(); }

void Progress::draw() {
  std::unique_lock hold(lock_);
  while (!end_.wait_for(hold, kBetween, [this] { return ended_; })) {
    if (secondsNow() - begin_ >= kFirstSeconds) show();
  }
}

void Progress::show() {
  const double from = countedFrom_.load();
  const double seconds = std::max(kLeastSeconds, secondsNow() - (from > 0 ? from : begin_));
  const std::string text =
      progressText(what_, unit_, done_.load(), total_.load(), seconds, terminalColumns());
  const std::lock_guard hold(screen());
  std::fprintf(stderr, "%s%s", kErase, text.c_str());
  std::fflush(stderr);
  drawn = true;
}
