// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Random edits: after each of them a workspace that has seen them all says the same as one that has
// only seen the texts as they are, and its text is what an editor that counts in UTF-16 has.
// GABLE_EDITS=N runs so many; GABLE_EDITS_SEED=N begins elsewhere. tools/language_edits.sh runs the
// long form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <sstream>
#include <vector>

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

struct Document {
  std::string path, text;
};

// A text of the catalogue, or a few signs of the document itself, which are of its notation.
std::string somePiece(std::mt19937_64& chance, const std::string& text) {
  const uint64_t kind = chance() % 10;
  if (kind < 2) return "";
  if (kind < 7) {
    const std::string piece = kPieces[chance() % std::size(kPieces)];
    // A lone byte would be no text of an editor.
    return piece == "\xc3" ? "\xc3\xa9" : piece;
  }
  const size_t begin = chance() % text.size();
  const std::string slice = text.substr(begin, 1 + chance() % 12);
  const bool plain = std::ranges::all_of(slice, [](char c) { return c > 0; });
  return plain ? slice : "";
}

// Edits the first document mostly, and the others where there are some.
void edit(const std::vector<Document>& documents, uint64_t count, uint64_t seed) {
  std::vector<Editor> editors;
  Workspace live;
  for (const Document& d : documents) {
    editors.emplace_back(d.text);
    live.open(d.path, d.text);
  }
  std::mt19937_64 chance(seed);
  for (uint64_t n = 0; n < count; ++n) {
    const size_t edited = chance() % 4 == 0 ? chance() % documents.size() : 0;
    const Document& document = documents[edited];
    Editor& e = editors[edited];
    // What is broken for long says little.
    if (e.size() > document.text.size() + 1500 || chance() % 40 == 0) {
      e = Editor(document.text);
      live.change(document.path, {{std::nullopt, document.text}});
    }
    const size_t begin = e.whole(chance() % (e.size() + 1));
    const size_t length = chance() % 3 == 0 ? chance() % 12 : 0;
    const size_t end = std::max(begin, e.whole(std::min(e.size(), begin + length)));
    const std::string piece = somePiece(chance, document.text);
    const Range range{e.position(begin), e.position(end)};
    e.replace(begin, end, piece);
    ASSERT_TRUE(live.change(document.path, {{range, piece}}));
    ASSERT_EQ(live.text(document.path), e.utf8()) << "edit " << n;

    Workspace fresh;
    for (size_t i = 0; i < documents.size(); ++i) fresh.open(documents[i].path, editors[i].utf8());
    const Position at = e.position(e.whole(chance() % (e.size() + 1)));
    for (size_t i = 0; i < documents.size(); ++i) {
      const std::string& path = documents[i].path;
      const Position place = i == edited ? at : Position{1, 7};
      ASSERT_EQ(told(live, path, place), told(fresh, path, place))
          << "edit " << n << " of seed " << seed << " in " << path << "\n"
          << live.text(path);
    }
  }
}

TEST(Edits, leaveNoTrace) {
  edit({{"/nowhere/main.cga", kMain}, {"/nowhere/walls.cga", kWalls}}, setting("GABLE_EDITS", 1500),
       setting("GABLE_EDITS_SEED", 1));
}

class EditsOf : public testing::TestWithParam<Document> {};

TEST_P(EditsOf, theNotationLeaveNoTrace) {
  edit({GetParam()}, setting("GABLE_EDITS", 300), setting("GABLE_EDITS_SEED", 1));
}

const Document kNotations[] = {
    {"/nowhere/garden.park", R"(PathWidth = 3 // metres
KerbWidth = 0.25
Square -> Grid(2, 2) { Quarter } { Walk } { Circle(7, 64) Plaza }
Walk -> GRAVEL
Plaza -> Peel(all, 0.5) { Rim | Round }
Quarter -> Peel(INNER, KerbWidth) { Kerbstone | Garden }
Kerbstone -> KERB Extrude(0.12)
Garden ->
  case (ix == iy): Pond
  else: Beds
Beds -> Distribute(PI : 0.9, [: 5.0 :]) { Bench }
  Place(CENTRE) { Tree }
)"},
    {"/nowhere/house.gbbg", R"(axiom START size (12, 9, 10)
shape Storey [0, 3.6, 0]
terminal Window [3.3, 3.6, 0], Balcony [3.3, 3.6, 0], Corner, Tiles [2, 0.1, 2]
START -> Split(Y, {1, 4.6}, FromRoot) {PLINTH | STOREYS | ROOF}
PLINTH -> Scope(T(-0.3, 0, -0.3, Add, Local), S(0.6, 0, 0.6, Add, Absolute)) {Corner}
STOREYS -> Repeat(Y) {Storey}
Storey -> Component(Y, Sides) {Facade}
Facade -> Repeat(X) {Window 3, Balcony 1} # drawn
ROOF -> Grid(Y) {Tiles}
)"},
    {"/nowhere/row.grammar", R"(# A row of houses.
X -> R* n ( 2 4 ) R h ( 2 3 ) Row | Tower
Row n h ; 0.7 -> [ S ( 4 h 5 ) I ( Cube 2 0 1 ) ] T ( 4 0 0 ) -> Tower
Tower 2 -> [ A ( 45 1 ) D ( 1 0.5 1 ) I ( CubeY redbrick ) ] T ( 0 1 0 )
)"},
    {"/nowhere/web.pg3d", R"(Start -> R h ( 2 4 ) [ Part( h 3 ) ] T ( 4 0 0 ) Part( h*2 1 )
Part( a b ) -> ?( a > b ) GDSX ( 1.2 1 1 ) I ( CubeY brick 0.5 )
Part( a b ) -> [ S ( a 1 b ) I ( CubeZ grayStone 0.5 ) ]
)"},
};

INSTANTIATE_TEST_SUITE_P(All, EditsOf, testing::ValuesIn(kNotations), [](const auto& t) {
  return t.param.path.substr(t.param.path.rfind('.') + 1);
});

}  // namespace
}  // namespace gable::language
