// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "version.h"

#include "common.h"
#include "folders.h"

namespace {

struct Meaning {
  ExitStatus status;
  const char* text;
};

constexpr Meaning kMeanings[] = {
    {kExitDone, "done"},
    {kExitWrong, "the rules, the inputs or a test are wrong; of diff: the models differ"},
    {kExitUsage, "the command line is wrong"},
    {kExitFile, "a file could not be read or written"},
    {kExitLimit,
     "a limit or Ctrl-C ended it; after a limit what was made until then is written, after Ctrl-C "
     "only the files that were complete"},
};

std::string compilerText() {
#ifdef __clang__
  return __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

std::string partsText() {
  std::string out;
  const auto add = [&](const char* part) { out += std::string(out.empty() ? "" : ", ") + part; };
#ifdef GABLE_WITH_EMBREE
  add("Embree");
#endif
#ifdef GABLE_WITH_MESHOPTIMIZER
  add("meshoptimizer");
#endif
#ifdef GABLE_WITH_MIMALLOC
  add("mimalloc");
#endif
#ifdef GABLE_DCHECKS
  add("all checks");
#endif
  return out.empty() ? "nothing optional" : out;
}

std::string besideText(const char* program, const char* what) {
  const bool there = !folderWith(program, {"."}).empty();
  return std::string(program) + (there ? " reads " : ", which reads ") + what +
         (there ? "" : ", is not there");
}

}  // namespace

std::string versionText() {
  const std::string examples = examplesFolder(), page = studioPage();
  return std::string("gable ") + gable::version() + "\nbuilt by " + compilerText() + " with " +
         partsText() + "\n" +
         besideText("gable-convert", "FBX, COLLADA and compressed glTF, as far as built") + "\n" +
         besideText("gable-maps", "OpenStreetMap") +
         "\nexamples: " + (examples.empty() ? "not there" : examples) +
         "\npage of the studio: " + (page.empty() ? "not there" : page);
}

std::string exitText() {
  std::string out = "Exit status:";
  for (const Meaning& meaning : kMeanings) {
    out += "\n  " + std::to_string(meaning.status) + "  " + meaning.text;
  }
  return out;
}
