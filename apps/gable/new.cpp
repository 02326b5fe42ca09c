// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// gable new: a project to begin with. Its rules are small enough to read at once, and its test
// holds.

#include <algorithm>
#include <filesystem>

#include "answer.h"
#include "commands.h"
#include "completion.h"
#include "gable/files.h"

namespace fs = std::filesystem;

namespace {

constexpr const char* kRules = R"(/* A house on any lot. */
@Description("From the ground to the eaves")
@Range(min=3, max=60)
attr height = 9

@Color
attr wallColor = "#e8dcc4"

@Color
attr roofColor = "#9c4a32"

@StartRule
Lot -->
  setback(3) { remainder : House | all : Garden }

House -->
  report("built area", geometry.area)
  extrude(height)
  comp(f) { side : Facade | top : Roof }

Facade -->
  split(y) { ~3 : Floor }*

Floor -->
  split(x) { ~0.8 : Wall | { ~2.6 : Bay }* | ~0.8 : Wall }

Bay -->
  split(x) { ~1 : Wall | 1.2 : Opening | ~1 : Wall }

Opening -->
  split(y) { 0.9 : Wall | ~1.5 : Window | 0.4 : Wall }

Window -->
  setback(0.08) { all : Frame | remainder : Glass }

Frame -->
  color("#f4f1ea")

Glass -->
  color("#3f5a70")

Wall -->
  color(wallColor)

Roof -->
  roofHip(30, 0.5)
  color(roofColor)

Garden -->
  color("#6f8f4e")
)";

constexpr const char* kTest = R"(== theHouseStandsWithinItsLot
rules: ../rules/NAME.cga
shape: lot 24x18
expect:
  area Garden 216
  report "built area" sum 216
  diagnostics none
)";

constexpr const char* kReadme = R"(# NAME

Rules for Gable, the open engine for shape grammars.

    gable generate rules/NAME.cga --lot 24x18 -o NAME.glb
    gable render rules/NAME.cga --lot 24x18 -o NAME.png --watch
    gable test
    gable studio .

- `rules/` has the rules. `gable check rules/NAME.cga` tells all their mistakes, `gable format` writes them neatly.
- `tests/` says what must stay true.
- `assets/` is for models and pictures that rules name, as `i("door.glb")` or `texture("brick.jpg")`.
)";

std::string named(std::string text, const std::string& name) {
  constexpr std::string_view kName = "NAME";
  for (size_t at = 0; (at = text.find(kName, at)) != std::string::npos; at += name.size())
    text.replace(at, kName.size(), name);
  return text;
}

// The name of the rule file and of what is made: letters, digits, '-' and '_'.
bool isName(const std::string& name) {
  return !name.empty() && name[0] != '-' && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  });
}

// As a shell reads it as one word.
std::string asWord(const std::string& path) {
  const bool plain = std::all_of(path.begin(), path.end(), [](char c) {
    return c == '/' || c == '.' || isName({'x', c});
  });
  return plain ? path : shellQuoted(path);
}

}  // namespace

int runNew(const NewArguments& arguments) {
  std::error_code error;
  fs::path folder = fs::absolute(arguments.folder, error).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  const std::string name = folder.filename().string();
  if (!isName(name)) {
    return fail(kExitUsage, "'" + name + "' is no name of a project",
                "use letters, digits, '-' and '_'");
  }
  if (fs::exists(folder, error) &&
      (!fs::is_directory(folder, error) || !fs::is_empty(folder, error))) {
    return fail(kExitUsage, "'" + arguments.folder + "' is there already, and is no empty folder",
                "name another one; nothing was written");
  }
  for (const char* part : {"rules", "tests", "assets"}) {
    fs::create_directories(folder / part, error);
    if (error) {
      return fail(
          kExitFile,
          "the folder '" + (folder / part).string() + "' cannot be made: " + error.message(),
          "see that the folder around it may be written");
    }
  }
  const std::pair<fs::path, std::string> files[] = {
      {folder / "rules" / (name + ".cga"), kRules},
      {folder / "tests" / (name + ".test"), named(kTest, name)},
      {folder / "README.md", named(kReadme, name)}};
  for (const auto& [path, text] : files) {
    if (const int status = writeText(path.string(), text)) return status;
  }
  tell(arguments.folder + ": a project\n\n  cd " + asWord(arguments.folder) +
       "\n  gable render rules/" + name + ".cga --lot 24x18 -o " + name +
       ".png\n  gable studio .\n");
  return kExitDone;
}
