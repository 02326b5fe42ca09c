// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Random edits: after each of them a workspace that has seen them all says the same as one that has
// only seen the texts as they are, and its text is what an editor that counts in UTF-16 has.
// GABLE_EDITS=N runs so many; GABLE_EDITS_SEED=N begins elsewhere. tools/language_edits.sh runs the
// long form.

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <random>
#include <sstream>

#include "gable/language.h"

namespace gable::language {
namespace {

const char* const kMain = R"(import w : "walls.cga" (height = 3, Wall --> NIL)
import z : "walls.cga"
@Group("Sizes") @Range(min=1, max=20)
attr height = 9  // metres
attr width = case height > 3 : 2 else : height / 2
const depth = rand(1, 2)
share(a, b) with ( c := a + b ) = c * depth
/* The lot: é 🏠. */
Lot(size) --> extrude(height) comp(f) { side : Facade | top : w.Roof(2) | all : z.Wall }
Facade --> split(y) { ~share(1, 2) : Floor | { ~3 : Floor | '0.1 : NIL }* }
Floor --> case scope.sx > 2 : color("#aa8844") i("window.obj") else : [ t(1, 0, 0) Pane. ] Glass
  30% : A 70% : B
w.Roof(n) --> offset(n) X.
style Night
Floor --> color(0.1, 0.2, 0.3) Pane.
)";

const char* const kWalls = R"(attr height = 1
attr sill = height * 2
extension Wall --> extrude(sill) Brick
Roof(slope) --> roofGable(slope) Tiles
Brick --> setback(0.2) { front : A | remainder : B }
)";

const char* const kPieces[] = {"A",         "height",
                               "extrude(",  ")",
                               "{",         "}",
                               "|",         ":",
                               " --> ",     "\n",
                               "\"",        "\r\n",
                               "// ",       "/*",
                               "*/",        "attr ",
                               "import ",   "Lot",
                               "w.",        "w.Roof",
                               ",",         "(",
                               "[",         "]",
                               "case ",     "else",
                               "30%",       "é",
                               "🏠",         " ",
                               "~1",        "'2",
                               "#ff0000",   "@",
                               "Range",     "split(x) { ~1 : Wall }\n",
                               "style X\n", "x = 1\n",
                               "\t",        "comp(f) { front : F. }",
                               "\r",        "with ( q := 1 )",
                               "\xc3",      "color(\"#123456\")"};

uint64_t setting(const char* name, uint64_t fallback) {
  const char* text = std::getenv(name);
  return text ? std::strtoull(text, nullptr, 10) : fallback;
}

std::ostream& operator<<(std::ostream& out, const Position& p) {
  return out << p.line << ":" << p.character << " ";
}
std::ostream& operator<<(std::ostream& out, const Range& r) { return out << r.begin << r.end; }

// All that a workspace says of a text, as a text.
std::string told(Workspace& w, const std::string& path, Position at) {
  std::ostringstream out;
  for (const FileDiagnostics& f : w.diagnostics(path)) {
    out << f.path << "\n";
    for (const Diagnostic& x : f.diagnostics)
      out << x.code << " " << x.range << x.message << x.hint << "\n";
  }
  for (const Symbol& s : w.symbols(path)) out << s.name << s.detail << s.range << s.nameRange;
  for (const Highlight& h : w.highlights(path)) out << h.range << static_cast<int>(h.kind);
  for (const Color& c : w.colors(path)) out << c.range << c.red;
  for (const Fold& f : w.folds(path)) out << f.beginLine << " " << f.endLine << ";";
  for (const InlayHint& h : w.inlayHints(path, {{0, 0}, {9999, 0}})) out << h.at << h.label;
  for (const Edit& e : w.format(path)) out << e.range << e.text;
  out << "\ncomplete ";
  for (const Completion& c : w.complete(path, at).items) out << c.label << c.range << c.text << ";";
  for (const auto& s : w.signatureHelp(path, at).signatures) out << s.label;
  if (const auto h = w.hover(path, at)) out << h->range << h->text;
  for (const Place& p : w.definition(path, at)) out << p.path << p.range;
  for (const Place& p : w.references(path, at, true)) out << p.path << p.range;
  for (const Action& a : w.actions(path, {{0, 0}, {9999, 0}})) {
    out << a.title << a.edits[0].edits[0].range << a.edits[0].edits[0].text;
  }
  return out.str();
}

/// An editor's own text, in units of UTF-16. Bytes that are no UTF-8 do not come here.
class Editor {
 public:
  explicit Editor(const std::string& text) { insert(0, text); }
  size_t size() const { return units_.size(); }
  Position position(size_t at) const {
    Position p;
    for (size_t i = 0; i < at; ++i) {
      const bool pair = units_[i] == '\r' && i + 1 < units_.size() && units_[i + 1] == '\n';
      const bool end = units_[i] == '\n' || (units_[i] == '\r' && !pair);
      p = end ? Position{p.line + 1, 0} : Position{p.line, p.character + 1};
    }
    return p;
  }
  /// No edit begins or ends in the middle of a pair.
  size_t whole(size_t at) const {
    const bool low = at < units_.size() && units_[at] >= 0xdc00 && units_[at] < 0xe000;
    const bool feed = at > 0 && at < units_.size() && units_[at - 1] == '\r' && units_[at] == '\n';
    return low || feed ? at - 1 : at;
  }
  void replace(size_t begin, size_t end, const std::string& text) {
    units_.erase(begin, end - begin);
    insert(begin, text);
  }
  std::string utf8() const {
    std::string out;
    for (size_t i = 0; i < units_.size(); ++i) {
      uint32_t c = units_[i];
      if (c >= 0xd800 && c < 0xdc00) c = 0x10000 + ((c - 0xd800) << 10) + (units_[++i] - 0xdc00u);
      const auto put = [&](uint32_t byte) { out += static_cast<char>(byte); };
      if (c < 0x80) {
        put(c);
      } else if (c < 0x800) {
        put(0xc0 | c >> 6), put(0x80 | (c & 63));
      } else if (c < 0x10000) {
        put(0xe0 | c >> 12), put(0x80 | (c >> 6 & 63)), put(0x80 | (c & 63));
      } else {
        put(0xf0 | c >> 18), put(0x80 | (c >> 12 & 63)), put(0x80 | (c >> 6 & 63));
        put(0x80 | (c & 63));
      }
    }
    return out;
  }

 private:
  void insert(size_t at, const std::string& text) {
    std::u16string units;
    for (size_t i = 0; i < text.size();) {
      const auto lead = static_cast<unsigned char>(text[i]);
      const size_t n = lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
      uint32_t c = n == 1 ? lead : lead & (0xff >> (n + 1));
      for (size_t k = 1; k < n; ++k) c = c << 6 | (static_cast<unsigned char>(text[i + k]) & 63);
      if (c >= 0x10000) {
        units += static_cast<char16_t>(0xd800 + ((c - 0x10000) >> 10));
        units += static_cast<char16_t>(0xdc00 + ((c - 0x10000) & 0x3ff));
      } else {
        units += static_cast<char16_t>(c);
      }
      i += n;
    }
    units_.insert(at, units);
  }
  std::u16string units_;
};

TEST(Edits, leaveNoTrace) {
  const uint64_t count = setting("GABLE_EDITS", 1500);
  const uint64_t seed = setting("GABLE_EDITS_SEED", 1);
  const std::string mainPath = "/nowhere/main.cga", wallsPath = "/nowhere/walls.cga";
  std::map<std::string, Editor> editors{{mainPath, Editor(kMain)}, {wallsPath, Editor(kWalls)}};
  Workspace live;
  for (const auto& [path, e] : editors) live.open(path, e.utf8());
  std::mt19937_64 chance(seed);
  for (uint64_t n = 0; n < count; ++n) {
    const std::string& path = chance() % 4 == 0 ? wallsPath : mainPath;
    Editor& e = editors.at(path);
    const auto restart = [&] {
      e = Editor(path == mainPath ? kMain : kWalls);
      live.change(path, {{std::nullopt, e.utf8()}});
    };
    // What is broken for long says little.
    if (e.size() > 3000 || chance() % 40 == 0) restart();
    const size_t begin = e.whole(chance() % (e.size() + 1));
    const size_t length = chance() % 3 == 0 ? chance() % 12 : 0;
    const size_t end = std::max(begin, e.whole(std::min(e.size(), begin + length)));
    std::string piece = chance() % 5 == 0 ? "" : kPieces[chance() % std::size(kPieces)];
    // A lone byte would be no text of an editor.
    if (piece == "\xc3") piece = "\xc3\xa9";
    const Range range{e.position(begin), e.position(end)};
    e.replace(begin, end, piece);
    ASSERT_TRUE(live.change(path, {{range, piece}}));
    ASSERT_EQ(live.text(path), e.utf8()) << "edit " << n;

    Workspace fresh;
    for (const auto& [name, editor] : editors) fresh.open(name, editor.utf8());
    const Position at = e.position(e.whole(chance() % (e.size() + 1)));
    for (const std::string& which : {mainPath, wallsPath}) {
      const Position place = which == path ? at : Position{1, 7};
      ASSERT_EQ(told(live, which, place), told(fresh, which, place))
          << "edit " << n << " of seed " << seed << " in " << which << "\n"
          << live.text(which);
    }
  }
}

}  // namespace
}  // namespace gable::language
