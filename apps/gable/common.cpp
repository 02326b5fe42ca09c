// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "common.h"

#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <mutex>
#include <random>

bool parsePair(const std::string& text, double& a, double& b) {
  char* end = nullptr;
  a = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || (*end != 'x' && *end != 'X')) return false;
  const char* second = end + 1;
  b = std::strtod(second, &end);
  return end != second && *end == '\0' && a > 0 && b > 0 && a < 1e7 && b < 1e7;
}

bool parseNumbers(const std::string& text, double* out, int count) {
  const char* at = text.c_str();
  for (int i = 0; i < count; ++i) {
    char* end = nullptr;
    out[i] = std::strtod(at, &end);
    if (end == at || *end != (i + 1 < count ? ',' : '\0')) return false;
    at = end + 1;
  }
  return true;
}

bool parseSeed(const std::string& text, double& seed) {
  if (text == "random") {
    seed = static_cast<int32_t>(std::random_device{}());
    std::fprintf(stderr, "seed %.0f\n", seed);
    return true;
  }
  return parseNumbers(text, &seed, 1);
}

size_t printMessages(const gable::Messages& messages) {
  size_t errors = 0;
  for (const gable::Message& m : messages) {
    if (m.level == gable::Level::Error) ++errors;
    std::fputs(m.pretty.c_str(), stderr);
  }
  return errors;
}

int readInputs(const DeriveArguments& arguments, Inputs& inputs) {
  inputs.rules =
      gable::Rules::load(arguments.rules, {arguments.project, arguments.dialect, arguments.style});
  printMessages(inputs.rules.messages());
  if (!inputs.rules.found()) return kExitFile;
  if (!inputs.rules.ok()) return kExitWrong;
  if (!arguments.shapes.empty()) {
    inputs.shapes = gable::Shapes::load(arguments.shapes);
  } else {
    double width = 20, depth = 20;
    if (!arguments.lot.empty() && !parsePair(arguments.lot, width, depth)) {
      std::fprintf(stderr, "gable: --lot takes width x depth in metres, such as 30x40, not '%s'\n",
                   arguments.lot.c_str());
      return kExitUsage;
    }
    inputs.shapes = gable::Shapes::lot(width, depth);
  }
  printMessages(inputs.shapes.messages());
  if (arguments.cutNested) inputs.shapes = inputs.shapes.withNestedCut();
  if (!inputs.shapes.found()) return kExitFile;
  if (!inputs.shapes.ok() && inputs.shapes.size() == 0) return kExitWrong;
  gable::DeriveSettings& s = inputs.settings;
  s.startRule = arguments.start;
  if (!parseSeed(arguments.seed, s.seed)) {
    std::fprintf(stderr, "gable: --seed takes a number or the word random, not '%s'\n",
                 arguments.seed.c_str());
    return kExitUsage;
  }
  s.sharing = !arguments.noSharing;
  s.jobs = arguments.jobs;
  s.budget.seconds = arguments.maxSeconds;
  s.budget.shapes = arguments.maxShapes;
  s.budget.depth = arguments.maxDepth;
  s.budget.steps = arguments.maxSteps;
  s.budget.bytes = arguments.maxMegabytes << 20;
  s.cancel = cancelFlag();
  for (const std::string& pair : arguments.set) {
    const size_t equals = pair.find('=');
    if (equals == std::string::npos || equals == 0) {
      std::fprintf(stderr, "gable: --set takes NAME=VALUE, not '%s'\n", pair.c_str());
      return kExitUsage;
    }
    s.attributes.emplace_back(pair.substr(0, equals), pair.substr(equals + 1));
  }
  return kExitDone;
}

int statusOf(const gable::Model& model) {
  if (gable::hasErrors(model.messages())) return kExitWrong;
  return model.end() == gable::End::Done ? kExitDone : kExitLimit;
}

ProgressLine::ProgressLine(const char* what) : what_(what), terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

std::function<void(size_t, size_t)> ProgressLine::callback() {
  if (!terminal_) return {};
  const auto last = std::make_shared<std::atomic<int>>(-1);
  const char* what = what_;
  return [last, what](size_t done, size_t total) {
    const int percent = total ? static_cast<int>(done * 100 / total) : 100;
    if (last->exchange(percent) != percent) std::fprintf(stderr, "\r%s %3d %%", what, percent);
  };
}

int64_t peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<int64_t>(usage.ru_maxrss) * 1024;
}

double secondsNow() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool readText(const std::string& path, std::string& text) {
  std::ifstream in(path, std::ios::binary);
  if (in) {
    text.assign((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    return true;
  }
  std::fprintf(stderr, "gable: '%s' could not be read\n", path.c_str());
  return false;
}

int writeText(const std::string& path, const std::string& text) {
  if (path == "-") {
    std::fwrite(text.data(), 1, text.size(), stdout);
    return std::fflush(stdout) == 0 ? kExitDone : kExitFile;
  }
  std::FILE* file = std::fopen(path.c_str(), "wb");
  const bool written = file && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const bool closed = file && std::fclose(file) == 0;
  if (written && closed) return kExitDone;
  std::fprintf(stderr, "gable: '%s' could not be written\n", path.c_str());
  return kExitFile;
}

std::atomic<bool>* cancelFlag() {
  static std::atomic<bool> flag{false};
  static std::once_flag once;
  std::call_once(once, [] {
    std::signal(SIGINT, [](int) {
      // A second Ctrl-C ends the program at once.
      if (flag.exchange(true)) std::_Exit(130);
    });
  });
  return &flag;
}
