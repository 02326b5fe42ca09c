// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Runs programs that tools/random_programs.py makes: run_programs FOLDER, one program a line of
// standard input as `PATH TAB SHAPES`, where SHAPES is a file or `WIDTHxDEPTH`. One line comes back
// for each, as soon as it has ended:
//
//   done            derived, and all that is asked of it holds
//   limited         the same, but a limit on time or memory ended it, so runs were not compared
//   refused CODE    the rules have mistakes
//   failed WHAT     it does not hold
//
// What is asked: a limit ends the work soon; the same bytes and messages for one, two and four
// threads; the same model without sharing; the same model from the formatted text, and from the
// text that `convert` writes; no number in a written file that is not finite. A program that ends
// this one is found by the line that is missing; one that does not end, by its processor time, and
// then this program ends too.

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <sstream>
#include <string>
#include <string_view>

#include "finite_files.h"
#include "gable/gable.h"

namespace {

using gable::Model;
using gable::Rules;
using gable::Shapes;

/// The limit of a derivation in seconds, and the processor time that one thread may take beyond it.
constexpr double kSeconds = 3, kGrace = 4;
/// The processor time after which a step of a trial counts as endless.
constexpr time_t kEndless = 30;

/// What is going on, for the message of onEndless().
char step[40] = "reading";

void onEndless(int) {
  constexpr char kMessage[] = "failed hang: ";
  // Nothing can be done about a reader that is gone.
  if (write(STDOUT_FILENO, kMessage, sizeof kMessage - 1) < 0 ||
      write(STDOUT_FILENO, step, std::strlen(step)) < 0 || write(STDOUT_FILENO, "\n", 1) < 0) {
    _exit(2);
  }
  _exit(3);
}

void beginStep(const std::string& name) {
  std::strncpy(step, name.c_str(), sizeof step - 1);
  const itimerval timer = {{0, 0}, {kEndless, 0}};
  setitimer(ITIMER_PROF, &timer, nullptr);
}

double processorSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::string contentOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

Shapes shapesOf(const std::string& text) {
  double width = 0, depth = 0;
  if (std::sscanf(text.c_str(), "%lfx%lf", &width, &depth) == 2) return Shapes::lot(width, depth);
  return Shapes::load(text);
}

gable::DeriveSettings settingsOf(int jobs, bool sharing) {
  gable::DeriveSettings s;
  s.jobs = jobs;
  s.sharing = sharing;
  s.limits.depth = 100;
  s.limits.width = 3000;
  s.limits.shapes = 2000;
  s.limits.vertices = 50'000;
  s.limits.steps = 100'000;
  s.limits.bytes = uint64_t{1200} << 20;
  s.limits.seconds = kSeconds;
  return s;
}

bool hasAny(const Model& model, std::initializer_list<std::string_view> codes) {
  return std::any_of(model.diagnostics().begin(), model.diagnostics().end(), [&](const auto& m) {
    return std::find(codes.begin(), codes.end(), m.code) != codes.end();
  });
}

/// Where such a limit ends the work depends on the machine.
bool endedByMachine(const Model& model) {
  return hasAny(model, {"out-of-time", "out-of-memory", "too-many-values"});
}

/// Texts, places and order of messages.
std::string textOf(const gable::DiagnosticList& messages) {
  std::string out;
  for (const gable::Diagnostic& m : messages) {
    const gable::TextRange at = m.range.value_or(gable::TextRange{});
    out += m.code + " " + std::to_string(at.line) + ":" + std::to_string(at.column) + " " +
           m.message + " | " + m.hint + " | " + m.shapePath + "\n";
  }
  return out;
}

/// The first line in which two texts differ.
std::string difference(const std::string& a, const std::string& b) {
  std::istringstream left(a), right(b);
  std::string l, r;
  for (;;) {
    const bool more = static_cast<bool>(std::getline(left, l));
    if (!more) l = "(end)";
    if (!std::getline(right, r)) {
      r = "(end)";
      if (!more) return {};
    }
    if (l != r) return ": '" + l.substr(0, 160) + "' and '" + r.substr(0, 160) + "'";
  }
}

class Trial {
 public:
  Trial(std::string folder, std::string path, const std::string& shapes)
      : folder_(std::move(folder)),
        path_(std::move(path)),
        text_(contentOf(path_)),
        shapes_(shapesOf(shapes)) {}

  std::string run() {
    beginStep("checking");
    if (!shapes_.ok()) return "failed shapes cannot be read";
    const Rules rules = Rules::load(path_);
    if (!rules.ok()) return refused(rules);
    const Model one = derived(rules, 1, true);
    files(one);
    if (!endedByMachine(one) && what_.empty()) compare(rules, one);
    if (!what_.empty()) return "failed " + what_;
    return limited_ || endedByMachine(one) ? "limited" : "done";
  }

 private:
  static std::string refused(const Rules& rules) {
    for (const gable::Diagnostic& m : rules.diagnostics()) {
      if (m.isError()) return "refused " + m.code + " " + m.message;
    }
    return "failed refused without an error";
  }

  void fail(const std::string& what) {
    if (!what_.empty()) return;
    what_ = what;
    std::replace(what_.begin(), what_.end(), '\n', ' ');
  }

  Model derived(const Rules& rules, int jobs, bool sharing) {
    beginStep("deriving with " + std::to_string(jobs) + " jobs");
    const double begin = processorSeconds();
    const Model model = gable::derive(rules, shapes_, settingsOf(jobs, sharing));
    const double took = processorSeconds() - begin;
    if (took > jobs * kSeconds + kGrace) {
      fail("slow: " + std::to_string(took) + " s with a limit of " + std::to_string(kSeconds));
    }
    return model;
  }

  std::string written(const Model& model, const char* name) {
    beginStep(std::string("writing ") + name);
    const std::string path = folder_ + "/" + name;
    const gable::WriteResult result = model.write(path, {});
    if (!result.ok) return {};
    const std::string content = contentOf(path);
    std::remove(path.c_str());
    return content;
  }

  void files(const Model& model) {
    glb_ = written(model, "a.glb");
    for (const auto& [name, fault] :
         {std::pair{"glb", gable::faultOfGlb(glb_)},
          std::pair{"obj", gable::faultOfText(written(model, "a.obj"))},
          std::pair{"ply", gable::faultOfPly(written(model, "a.ply"))}}) {
      if (!fault.empty()) fail(std::string("not finite: ") + name + " " + fault);
    }
  }

  void compare(const Rules& rules, const Model& one) {
    const std::string dump = one.dump();
    // Where limits end the work depends on how it is done.
    if (one.end() == gable::End::Done) {
      same(derived(rules, 1, false), dump, "sharing");
      formatted(dump);
      converted(dump);
    }
    threads(rules, dump, textOf(one.diagnostics()));
  }

  void threads(const Rules& rules, const std::string& dump, const std::string& messages) {
    for (const int jobs : {2, 4}) {
      const Model more = derived(rules, jobs, true);
      if (endedByMachine(more)) return void(limited_ = true);
      if (more.dump() != dump) fail("threads model" + difference(dump, more.dump()));
      const std::string said = textOf(more.diagnostics());
      if (said != messages) fail("threads messages" + difference(messages, said));
      if (written(more, "a.glb") != glb_) fail("threads file");
    }
  }

  void same(const Model& other, const std::string& dump, const char* what) {
    if (endedByMachine(other)) return void(limited_ = true);
    if (other.end() != gable::End::Done) return;
    if (other.dump() != dump) fail(std::string(what) + difference(dump, other.dump()));
  }

  void derivedFrom(const std::string& text, const std::string& path, const std::string& dump,
                   const char* what) {
    const Rules rules = Rules::parse(text, path);
    if (!rules.ok()) return fail(std::string(what) + ": " + refused(rules));
    same(derived(rules, 1, true), dump, what);
  }

  void formatted(const std::string& dump) {
    beginStep("formatting");
    const gable::Formatted f = gable::format(text_, path_);
    if (gable::hasErrors(f.diagnostics)) return fail("format: errors");
    const std::string again = gable::format(f.text, path_).text;
    if (again != f.text) return fail("format: unstable" + difference(f.text, again));
    if (f.text != text_) derivedFrom(f.text, path_, dump, "format");
  }

  void converted(const std::string& dump) {
    if (path_.ends_with(".cga")) return;
    beginStep("converting");
    const gable::Converted c = gable::convert(text_, path_);
    if (gable::hasErrors(c.diagnostics)) return fail("convert: errors");
    derivedFrom(c.text, path_ + ".cga", dump, "convert");
  }

  std::string folder_, path_, text_;
  Shapes shapes_;
  std::string what_, glb_;
  bool limited_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: run_programs FOLDER < LIST\n");
    return 2;
  }
  std::signal(SIGPROF, onEndless);
  std::string line;
  while (std::getline(std::cin, line)) {
    const size_t tab = line.find('\t');
    Trial trial(argv[1], line.substr(0, tab),
                tab == std::string::npos ? "10x10" : line.substr(tab + 1));
    std::cout << trial.run() << std::endl;
  }
  return 0;
}
