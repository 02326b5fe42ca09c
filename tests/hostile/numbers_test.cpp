// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Numbers that nobody means. The rules of all text cases of the operations are run with one of
// their numbers replaced by a hostile one, under a short limit on time: none may end the program,
// and none may go on when its time is over, whatever loop of whatever kernel it is in. So a new
// operation is tested here by its own cases.
//
// By default every tenth of these programs runs, always the same; GABLE_HOSTILE_EACH=1 runs all of
// them. GABLE_HOSTILE_SHOW=1 prints each before it runs, which names the one that crashes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/hash.h"
#include "cases/case_file.h"
#include "gable/gable.h"

namespace gable {
namespace {

namespace fs = std::filesystem;

// How long a derivation may take, and how much processor time it may need to notice. Merging and
// what else comes after the derivation of shapes is in it.
constexpr double kSeconds = 0.1;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kLate = 4;
#else
constexpr double kLate = 0.25;
#endif
constexpr uint64_t kBytes = uint64_t{300} << 20;

const char* const kHostile[] = {"0",      "-1",  "1e-12", "1e-5", "0.003", "97",
                                "4999",   "1e7", "1e12",  "1e30", "1e308", "-1e308",
                                "1e-308", "0.5", "-0.01", "1e19", "65537"};

bool isSet(const char* name) {
  const char* value = std::getenv(name);
  return value && *value && *value != '0';
}

double processorSeconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

struct Number {
  size_t at, length;
};

// The numbers of a text, those within quotes as well: they may be options of an operation.
std::vector<Number> numbersOf(const std::string& text) {
  std::vector<Number> out;
  const auto isWord = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '#' || c == '.';
  };
  for (size_t i = 0; i < text.size();) {
    if (!isWord(text[i])) {
      ++i;
      continue;
    }
    size_t end = i;
    while (end < text.size() && isWord(text[end])) ++end;
    const bool number = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (number) out.push_back({i, end - i});
    i = end;
  }
  return out;
}

void run(const std::string& rules, const std::string& name) {
  if (isSet("GABLE_HOSTILE_SHOW"))
    std::fprintf(stderr, "--- %s\n%s\n", name.c_str(), rules.c_str());
  const Rules parsed = Rules::parse(rules, "hostile.cga");
  if (!parsed.ok()) return;
  DeriveSettings settings;
  settings.jobs = 1;
  settings.limits.seconds = kSeconds;
  settings.limits.bytes = kBytes;
  settings.limits.shapes = 20'000;
  const double before = processorSeconds();
  derive(parsed, Shapes::lot(60, 40), settings);
  const double took = processorSeconds() - before;
  EXPECT_LT(took, kSeconds + kLate) << name << "\n" << rules;
}

class HostileNumbers : public testing::TestWithParam<std::string> {};

TEST_P(HostileNumbers, endInTime) {
  const bool each = isSet("GABLE_HOSTILE_EACH");
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(GetParam())) {
    if (entry.path().extension() == ".test") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());
  for (const fs::path& file : files) {
    for (const cases::Case& c : cases::parseCases(textOf(file)).cases) {
      const std::string rules(c.textOf("rule"));
      const std::vector<Number> numbers = numbersOf(rules);
      for (size_t n = 0; n < numbers.size(); ++n) {
        for (const char* value : kHostile) {
          std::string changed = rules;
          changed.replace(numbers[n].at, numbers[n].length, value);
          if (!each && hashBytes(changed) % 10 != 0) continue;
          run(changed, file.stem().string() + "/" + c.name);
        }
      }
    }
  }
}

std::vector<std::string> folders() {
  std::vector<std::string> out;
  const fs::path root = fs::path(GABLE_SOURCE_DIR) / "src/builtins";
  for (const auto& entry : fs::directory_iterator(root / "ops")) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name != "shared") out.push_back(entry.path().string());
  }
  out.push_back((root / "functions").string());
  std::sort(out.begin(), out.end());
  return out;
}

INSTANTIATE_TEST_SUITE_P(Operations, HostileNumbers, testing::ValuesIn(folders()),
                         [](const auto& folder) {
                           return fs::path(folder.param).filename().string();
                         });

}  // namespace
}  // namespace gable
