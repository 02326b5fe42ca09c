// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A bar for what takes more than a second, with rate and time left. It is there on a terminal alone
// and erased at the end; with --verbose the step and its time remain as a line.
//
//   deriving  [########------------]  41 %  812 shapes/s  9 s left
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

class Progress {
 public:
  /// `unit` is what is counted, in the plural; empty where the counts mean nothing to people.
  explicit Progress(std::string what, std::string unit = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// May be called from any thread, as often as one likes: it keeps two numbers. Rate and time left
  /// are those since the first call, for what goes before it says nothing of them. Absent where
  /// nothing is drawn.
  std::function<void(size_t done, size_t total)> callback();
  /// Whether a bar may be drawn.
  static bool isShown();
  /// With --verbose a line for a part of what is being done.
  static void tellStep(const char* step, double seconds);

  /// Erases the bar and keeps it away while lines are written; it comes again below them. One at a
  /// time in a thread.
  class Pause {
   public:
    Pause();

   private:
    std::lock_guard<std::mutex> hold_;
  };

 private:
  void draw();
  void show();

  std::string what_, unit_;
  double begin_;
  std::atomic<size_t> done_{0}, total_{0};
  /// When it was first told of them; 0 before.
  std::atomic<double> countedFrom_{0};
  std::mutex lock_;
  std::condition_variable end_;
  bool ended_ = false;
  /// Draws the bar, several times a second; there only where it is shown.
  std::thread drawer_;
};

/// The bar after so many seconds, in at most `columns` columns. With an unknown total (0), or one
/// of 1, of which nothing can be told before its end, it has the time alone.
std::string progressText(const std::string& what, const std::string& unit, size_t done,
                         size_t total, double seconds, int columns);
/// "9 s", "3 min 05 s", "2 h 10 min".
std::string durationText(double seconds);
