// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The language service with the whole catalogue. Texts are open and in no file; '^' in a text is
// the caret.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "gable/language.h"

namespace gable::language {
namespace {

const std::string kMain = "/nowhere/main.cga";

class Desk {
 public:
  explicit Desk(const std::string& text, const std::map<std::string, std::string>& others = {}) {
    for (const auto& [name, content] : others) workspace.open("/nowhere/" + name, content);
    put(text);
  }
  void put(std::string text) {
    const size_t caret = text.find('^');
    if (caret != std::string::npos) {
      text.erase(caret, 1);
      at = {0, 0};
      for (size_t i = 0; i < caret; ++i) {
        at = text[i] == '\n' ? Position{at.line + 1, 0} : Position{at.line, at.character + 1};
      }
    }
    workspace.open(kMain, text);
  }
  /// The labels that are offered, in their order.
  std::vector<std::string> labels() {
    std::vector<std::string> out;
    Completions c = workspace.complete(kMain, at);
    for (const Completion& i : c.items) out.push_back(i.label);
    return out;
  }
  bool offers(const std::string& label) {
    const std::vector<std::string> all = labels();
    return std::find(all.begin(), all.end(), label) != all.end();
  }
  std::string codes() {
    std::string out;
    for (const FileDiagnostics& f : workspace.diagnostics(kMain)) {
      if (f.path != kMain && !f.diagnostics.empty()) out += f.path + ": ";
      for (const Diagnostic& x : f.diagnostics) out += x.code + " ";
    }
    return out;
  }
  std::string apply(const std::string& path, std::vector<Edit> edits) {
    std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
      return std::tie(a.range.begin.line, a.range.begin.character) >
             std::tie(b.range.begin.line, b.range.begin.character);
    });
    Workspace copy;
    copy.open(path, workspace.text(path));
    for (const Edit& e : edits) copy.change(path, {{e.range, e.text}});
    return copy.text(path);
  }
  /// All texts as they are after a renaming, by name.
  std::map<std::string, std::string> renamed(const std::string& name) {
    const Renaming r = workspace.rename(kMain, at, name);
    std::map<std::string, std::string> out;
    if (!r.ok) out["trouble"] = r.trouble;
    for (const FileEdits& f : r.edits) out[f.path.substr(9)] = apply(f.path, f.edits);
    return out;
  }

  Workspace workspace;
  Position at;
};

// --- Completion ---

TEST(Completion, bodiesTakeOperationsAndRules) {
  Desk d("Lot --> ext^\nextra(a) = 1\nattr extent = 1\nextension Extern --> X.");
  EXPECT_TRUE(d.offers("extrude"));
  EXPECT_TRUE(d.offers("Extern"));
  EXPECT_FALSE(d.offers("extra")) << "a function has no place here";
  EXPECT_FALSE(d.offers("extent"));
}

TEST(Completion, expressionsTakeValues) {
  Desk d("attr height = 1\nconst deep = 2\nLot(wide) --> extrude(^) X.");
  for (const char* name : {"height", "deep", "wide", "scope.sx", "rand"}) {
    EXPECT_TRUE(d.offers(name)) << name;
  }
  EXPECT_FALSE(d.offers("comp"));
  EXPECT_FALSE(d.offers("Lot"));
}

TEST(Completion, parametersTakeTheirWords) {
  Desk d("Lot --> split(^");
  const std::vector<std::string> all = d.labels();
  ASSERT_GE(all.size(), 3u);
  EXPECT_EQ((std::vector<std::string>{all[0], all[1], all[2]}),
            (std::vector<std::string>{"x", "y", "z"}));
  d.put("Lot --> split(y, n^");
  EXPECT_EQ(d.labels()[0], "noAdjust");
}

TEST(Completion, offersNamesOfParameters) {
  Desk d("Lot --> extrude(dis^");
  const Completions c = d.workspace.complete(kMain, d.at);
  const auto item = std::find_if(c.items.begin(), c.items.end(),
                                 [](const Completion& i) { return i.label == "distance ="; });
  ASSERT_NE(item, c.items.end());
  EXPECT_EQ(item->text, "distance = ");
  d.put("Lot --> split(axis = ^");
  EXPECT_EQ(d.labels()[0], "x");
}

TEST(Completion, partsTakeSelectorsOrSizes) {
  Desk d("Lot --> comp(f) { fr^ : X. }");
  EXPECT_TRUE(d.offers("front"));
  EXPECT_FALSE(d.offers("frame"));
  d.put("Lot --> comp(f) { front : X. | to^");
  EXPECT_TRUE(d.offers("top"));
  d.put("attr width = 1\nLot --> split(x) { wi^ : X. }");
  EXPECT_TRUE(d.offers("width"));
  d.put("attr width = 1\nWing --> X.\nLot --> split(x) { width : Wi^");
  EXPECT_TRUE(d.offers("Wing"));
  EXPECT_FALSE(d.offers("width"));
  d.put("attr width = 1\nLot --> split(x) { { ~wi^ : X. }* }");
  EXPECT_TRUE(d.offers("width"));
}

TEST(Completion, selectionsTakeTheirTerms) {
  Desk d("Lot --> peel(ou^, 1) { strip : A. }");
  EXPECT_TRUE(d.offers("outer"));
  d.put("Lot --> peel(outer && !si^, 1) { strip : A. }");
  EXPECT_EQ(d.labels()[0], "side");
  d.put("Lot --> peel(side(we^), 1) { strip : A. }");
  EXPECT_EQ(d.labels()[0], "west");
  d.put("Lot --> peel(width = 1, selection = in^) { strip : A. }");
  EXPECT_EQ(d.labels()[0], "inner");
}

TEST(Completion, setTakesAttributes) {
  Desk d("attr height = 9\nLot --> set(^, 3) X.");
  EXPECT_EQ(d.labels()[0], "height");
  EXPECT_TRUE(d.offers("material.color.r"));
  EXPECT_FALSE(d.offers("geometry.area"));
  EXPECT_FALSE(d.offers("front"));
}

TEST(Completion, textsTakeWhatTheyAreFor) {
  Desk d("Lot --> color(\"#aabbcc\") A.\nB --> color(\"#^\")");
  EXPECT_EQ(d.labels()[0], "#aabbcc");
  EXPECT_TRUE(d.offers("#b5533c"));
  d.put("B --> color(\"^\")");
  EXPECT_TRUE(d.offers("#b5533c"));
  d.put("B --> report(\"^\", 1)");
  EXPECT_TRUE(d.labels().empty());
}

TEST(Completion, keepsNewNames) {
  // Enter takes the first: the word itself, never something that happens to have its letters.
  Desk d("Lot -->\n  30% : Round^\n  else : X.\nRoundTower --> X.");
  const Completions c = d.workspace.complete(kMain, d.at);
  ASSERT_FALSE(c.items.empty());
  EXPECT_EQ(c.items[0].text, "Round");
  EXPECT_TRUE(c.items[0].preselect);
  EXPECT_TRUE(d.offers("RoundTower"));
  EXPECT_FALSE(d.offers("geometry.boundaryLength"));
  d.put("Lot --> X.\nRound^ --> Y.");
  EXPECT_FALSE(d.offers("geometry.boundaryLength"));
}

TEST(Completion, isQuietInCommentsNumbersAndNewDeclarations) {
  for (const char* text : {"Lot --> X. // ext^", "/* ext^ */ Lot --> X.", "Lot --> extrude(3^) X.",
                           "attr hei^", "# a ro^", "/* never closed ro^"}) {
    Desk d(text);
    EXPECT_TRUE(d.labels().empty()) << text << " offers " << d.labels()[0];
  }
}

TEST(Completion, insertsCallsThatAreRight) {
  Desk d("Lot --> roofGa^");
  const Completions c = d.workspace.complete(kMain, d.at);
  const auto item = std::find_if(c.items.begin(), c.items.end(),
                                 [](const Completion& i) { return i.label == "roofGable"; });
  ASSERT_NE(item, c.items.end());
  EXPECT_EQ(item->text, "roofGable(${1:30})");
  EXPECT_EQ(item->range, (Range{{0, 8}, {0, 14}}));
}

// "${1:x}" and "${1|x,y|}" as an editor fills them in: x.
std::string filledIn(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '$') {
      out += text[i];
      continue;
    }
    const size_t end = text.find('}', i);
    const std::string place = text.substr(i + 2, end - i - 2);
    const size_t from = place.find_first_of(":|");
    if (from != std::string::npos) {
      const size_t to = place[from] == '|' ? place.find_first_of(",|", from + 1) : place.size();
      out += place.substr(from + 1, to - from - 1);
    }
    i = end;
  }
  return out;
}

TEST(Completion, setOffersTheValuesThatAnAttributeMayHave) {
  const std::string attributes =
      "@Enum(\"shed\", \"gable\")\nattr kind = \"shed\"\n@Enum(1, 2)\nattr rows = 1\nattr free = "
      "\"a\"\n";
  const std::vector<std::string> kinds{"shed", "gable"};
  EXPECT_EQ(Desk(attributes + "Lot --> set(kind, \"^\")").labels(), kinds);
  EXPECT_EQ(Desk(attributes + "Lot --> set(kind, \"ga^\") X.").labels(),
            std::vector<std::string>{"gable"});
  EXPECT_EQ(
      Desk("import a : \"a.cga\"\nLot --> set(a.kind, \"^\") X.", {{"a.cga", attributes}}).labels(),
      kinds);
  EXPECT_TRUE(Desk(attributes + "Lot --> set(rows, \"^\")").labels().empty());
  EXPECT_FALSE(Desk(attributes + "Lot --> set(free, \"^\")").offers("shed"));
}

TEST(Completion, allOperationsAreRightAtOnce) {
  size_t operations = 0;
  for (char letter = 'a'; letter <= 'z'; ++letter) {
    Desk d(std::string("Lot --> ") + letter + "^");
    for (const Completion& c : d.workspace.complete(kMain, d.at).items) {
      if (c.kind != NameKind::Operation || !c.filter.empty()) continue;
      ++operations;
      Desk tried("attr height = 1\nLot --> " + filledIn(c.text) + " X.");
      for (const FileDiagnostics& f : tried.workspace.diagnostics(kMain)) {
        for (const Diagnostic& x : f.diagnostics) {
          EXPECT_NE(x.severity, gable::Diagnostic::Severity::Error)
              << filledIn(c.text) << ": " << x.message;
        }
      }
    }
  }
  EXPECT_GT(operations, 100u);
}

TEST(Completion, entersImports) {
  Desk d("import w : \"windows.cga\"\nLot --> w.^",
         {{"windows.cga", "Window(a) --> X.\nattr sill = 1"}});
  EXPECT_TRUE(d.offers("w.Window"));
  EXPECT_FALSE(d.offers("w.sill"));
  d.put("import w : \"windows.cga\"\nLot --> extrude(w.s^) X.");
  EXPECT_TRUE(d.offers("w.sill"));
}

TEST(Completion, knowsAnnotationsAndEverydayWords) {
  Desk d("@Ra^\nattr a = 1");
  EXPECT_EQ(d.labels()[0], "Range");
  d.put("Lot --> cut^");
  EXPECT_TRUE(d.offers("split"));
  d.put("Lot --> mans^");
  EXPECT_TRUE(d.offers("roofHip"));
}

TEST(Completion, offersRulesThatAreNotWritten) {
  Desk d("Lot --> Facade\nFa^");
  EXPECT_EQ(d.labels().back(), "Facade");
}

// --- What is beside the text ---

TEST(Signatures, followTheArguments) {
  Desk d("Lot --> t(1, ^");
  SignatureHelp h = d.workspace.signatureHelp(kMain, d.at);
  ASSERT_FALSE(h.signatures.empty());
  EXPECT_EQ(h.activeParameter, 1u);
  d.put("Wall(width, height) --> X.\nLot --> Wall(1, max(2, 3), ^");
  h = d.workspace.signatureHelp(kMain, d.at);
  ASSERT_EQ(h.signatures.size(), 1u);
  EXPECT_EQ(h.signatures[0].label, "Wall(width, height)");
  EXPECT_EQ(h.activeParameter, 2u);
  d.put("Lot --> X.^");
  EXPECT_TRUE(d.workspace.signatureHelp(kMain, d.at).signatures.empty());
}

TEST(Hover, showsThePageOrTheDeclaration) {
  Desk d("Lot --> ext^rude(1) X.");
  EXPECT_NE(d.workspace.hover(kMain, d.at)->text.find("world.up.flatTop"), std::string::npos);
  EXPECT_EQ(d.workspace.hover(kMain, d.at)->text.find("]("), std::string::npos);
  d.put("// How high.\nattr height = 9\nLot --> extrude(hei^ght) X.");
  const std::string text = d.workspace.hover(kMain, d.at)->text;
  EXPECT_NE(text.find("attr height = 9"), std::string::npos);
  EXPECT_NE(text.find("How high."), std::string::npos);
  d.put("Lot --> comp(f) { fro^nt : X. }");
  EXPECT_TRUE(d.workspace.hover(kMain, d.at));
  d.put("^ Lot --> X.");
  EXPECT_FALSE(d.workspace.hover(kMain, d.at));
}

TEST(Hover, everyNameHasAPage) {
  // By search, which knows all that is built in.
  for (const char* word : {"a", "e", "o", "s", "r"}) {
    for (const Entry& e : search(word)) EXPECT_NE(referencePage(e.name), "") << e.name;
  }
}

TEST(Search, findsByEverydayWords) {
  const std::map<std::string, std::string> wanted = {{"divide into floors", "split"},
                                                     {"windows", "split"},
                                                     {"random", "rand"},
                                                     {"mansard", "roofHip"},
                                                     {"cut", "split"},
                                                     {"delete face", "NIL"},
                                                     {"chance", "rand"},
                                                     {"extrude", "extrude"}};
  for (const auto& [words, name] : wanted) {
    const std::vector<Entry> found = search(words);
    const auto end = found.begin() + static_cast<ptrdiff_t>(std::min<size_t>(found.size(), 5));
    EXPECT_TRUE(std::any_of(found.begin(), end, [&](const Entry& e) { return e.name == name; }))
        << words;
  }
  EXPECT_TRUE(search("").empty());
}

TEST(InlayHints, nameWhatNumbersMean) {
  Desk d("Wall(width, height) --> X.\nLot --> Wall(1, scope.sy) t(1, 2, 3)");
  const std::vector<InlayHint> hints = d.workspace.inlayHints(kMain, {{0, 0}, {9, 0}});
  ASSERT_FALSE(hints.empty());
  EXPECT_EQ(hints[0].label, "width:");
  EXPECT_EQ(hints[0].at, (Position{1, 13}));
}

TEST(Highlights, tellWhatWordsAre) {
  Desk d("const h = 1\nLot(a) --> extrude(h + a) split(x) { 1 : Wall | ~1 : Lot(2) }");
  std::string kinds;
  for (const Highlight& m : d.workspace.highlights(kMain)) {
    kinds += std::to_string(static_cast<int>(m.kind)) + (m.declaration ? "d " : " ");
  }
  // const h 1 Lot a --> extrude h a split x 1 Wall ~ 1 Lot 2
  EXPECT_EQ(kinds, "1 9d 3 5d 10d 4 7 9 10 7 11 3 6 4 3 5 3 ");
}

TEST(Colors, readAndWrite) {
  Desk d("Lot --> color(\"#ff8000\") color(1, 0, 0.5) X.");
  const std::vector<Color> colors = d.workspace.colors(kMain);
  ASSERT_EQ(colors.size(), 2u);
  EXPECT_EQ(colors[0].range, (Range{{0, 15}, {0, 22}}));
  EXPECT_EQ(d.workspace.colorTexts(kMain, colors[0]), std::vector<std::string>{"#ff8000"});
  EXPECT_EQ(d.workspace.colorTexts(kMain, colors[1])[0], "1, 0, 0.502");
}

TEST(Folds, coverBlocksAndComments) {
  Desk d("// a\n// b\nLot -->\n  split(x) {\n    1 : X.\n  }\n");
  const std::vector<Fold> folds = d.workspace.folds(kMain);
  ASSERT_EQ(folds.size(), 3u);
  EXPECT_EQ(folds[0].endLine, 1u);
  EXPECT_EQ(folds[1].beginLine, 2u);
  EXPECT_EQ(folds[2].endLine, 5u);
}

TEST(Format, touchesWhiteSpaceAlone) {
  Desk d("Lot-->extrude( 3 )\n   X.   // end\n");
  const std::vector<Edit> edits = d.workspace.format(kMain);
  ASSERT_FALSE(edits.empty());
  for (const Edit& e : edits) EXPECT_EQ(e.text.find_first_not_of(" \n"), std::string::npos);
  const std::string text = d.apply(kMain, edits);
  EXPECT_EQ(text.substr(0, 8), "Lot --> ");
  d.put(text);
  EXPECT_TRUE(d.workspace.format(kMain).empty());
  d.put("Lot --> extrude(");
  EXPECT_TRUE(d.workspace.format(kMain).empty());
}

TEST(Format, laysOutEveryNotation) {
  const std::pair<const char*, const char*> rows[] = {
      {"/nowhere/a.park", "A->Grid(2 ,2){B|C}\nB ->GRAVEL"},
      {"/nowhere/a.grammar", "X ->   I ( Cube )\n      Y\nY -> I ( Cube )"},
      {"/nowhere/a.pg3d", "Start ->  ?( 1 )  I ( CubeZ brick 1 )"},
      {"/nowhere/a.gbbg", "axiom  START size (1,2,3)\nSTART -> Repeat(X) {W}\nterminal W [1,1,1]"}};
  for (const auto& [path, text] : rows) {
    Desk d("");
    d.workspace.open(path, text);
    const std::vector<Edit> edits = d.workspace.format(path);
    ASSERT_FALSE(edits.empty()) << path;
    const std::string laid = d.apply(path, edits);
    d.workspace.open(path, laid);
    EXPECT_TRUE(d.workspace.format(path).empty()) << laid;
  }
}

// --- Names ---

TEST(Definition, crossesImports) {
  Desk d("import w : \"w.cga\"\nLot --> w.Win^dow", {{"w.cga", "\nWindow --> X."}});
  const std::vector<Place> places = d.workspace.definition(kMain, d.at);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places[0], (Place{"/nowhere/w.cga", {{1, 0}, {1, 6}}}));
  d.put("Lot(height) --> extrude(hei^ght) X.\nattr height = 1");
  EXPECT_EQ(d.workspace.definition(kMain, d.at)[0].range, (Range{{0, 4}, {0, 10}}));
  d.put("import w : \"w.c^ga\"");
  EXPECT_EQ(d.workspace.definition(kMain, d.at)[0].path, "/nowhere/w.cga");
}

TEST(References, findAllStylesAndFiles) {
  Desk d("Wall --> X.\nLot --> Wa^ll\nstyle Other\nLot --> Wall Y.",
         {{"user.cga", "import m : \"main.cga\"\nHouse --> m.Wall m.Lot"},
          {"stranger.cga", "House --> Wall"}});
  EXPECT_EQ(d.workspace.references(kMain, d.at, true).size(), 4u);
  EXPECT_EQ(d.workspace.references(kMain, d.at, false).size(), 3u);
}

TEST(Rename, changesWhatIsMeantAndNothingElse) {
  Desk d("attr high = 1\nLot(high) --> extrude(hi^gh) X.\nA --> extrude(high) Y. // high");
  EXPECT_EQ(d.renamed("tall")["main.cga"],
            "attr high = 1\nLot(tall) --> extrude(tall) X.\nA --> extrude(high) Y. // high");
}

TEST(Rename, goesAcrossImports) {
  Desk d("import w : \"w.cga\"\nw.Sill --> Y.\nLot --> w.Win^dow",
         {{"w.cga", "Window --> Sill\nSill --> X."},
          {"other.cga", "import a : \"w.cga\"\nWindow --> a.Window"}});
  std::map<std::string, std::string> texts = d.renamed("Opening");
  EXPECT_EQ(texts["main.cga"], "import w : \"w.cga\"\nw.Sill --> Y.\nLot --> w.Opening");
  EXPECT_EQ(texts["w.cga"], "Opening --> Sill\nSill --> X.");
  EXPECT_EQ(texts["other.cga"], "import a : \"w.cga\"\nWindow --> a.Opening");
  d.put("import w : \"w.cga\"\nw.Si^ll --> Y.\nLot --> w.Window");
  EXPECT_EQ(d.renamed("Ledge")["w.cga"], "Window --> Ledge\nLedge --> X.");
}

TEST(Rename, keepsValuesThatImportsTakeOver) {
  Desk d("import w : \"w.cga\"\nattr hei^ght = 3\nLot --> w.Window",
         {{"w.cga", "attr height = 1\nWindow --> extrude(height) X."}});
  std::map<std::string, std::string> texts = d.renamed("tall");
  EXPECT_EQ(texts["w.cga"], "attr tall = 1\nWindow --> extrude(tall) X.");
}

TEST(Rename, refusesWhatWouldChangeMeanings) {
  Desk d("attr a = 1\nattr b = 2\nLot(c) --> extrude(^a + c) X.");
  EXPECT_NE(d.renamed("b")["trouble"], "") << "taken";
  EXPECT_NE(d.renamed("c")["trouble"], "") << "a parameter would hide it";
  EXPECT_NE(d.renamed("3x")["trouble"], "");
  EXPECT_NE(d.renamed("case")["trouble"], "");
  EXPECT_NE(d.renamed("x y")["trouble"], "");
  d.put("Lot --> W^all(1)\nWall(a) --> X.");
  EXPECT_NE(d.renamed("extrude")["trouble"], "") << "an operation would be called instead";
  d.put("Lot --> ext^rude(1) X.");
  EXPECT_NE(d.renamed("grow")["trouble"], "");
  EXPECT_FALSE(d.workspace.renamable(kMain, d.at));
}

TEST(Rename, takesLeavesAndImports) {
  Desk d("Lot --> split(x) { 1 : Pa^ne | ~1 : Pane. }");
  EXPECT_EQ(d.renamed("Glass")["main.cga"], "Lot --> split(x) { 1 : Glass | ~1 : Glass. }");
  d.put("import w^w : \"w.cga\"\nLot --> ww.Window extrude(ww.a) X.");
  d.workspace.open("/nowhere/w.cga", "Window --> X.\nattr a = 1");
  EXPECT_EQ(d.renamed("v")["main.cga"], "import v : \"w.cga\"\nLot --> v.Window extrude(v.a) X.");
}

// --- Diagnostics ---

TEST(DiagnosticsOfTexts, tellOfImportsToo) {
  Desk d("import w : \"w.cga\"\nLot --> w.Window", {{"w.cga", "Window --> extrude() X."}});
  EXPECT_EQ(d.codes(), "/nowhere/w.cga: wrong-argument-count ");
  d.workspace.change("/nowhere/w.cga", {{Range{{0, 19}, {0, 19}}, "3"}});
  EXPECT_EQ(d.codes(), "");
  d.workspace.close("/nowhere/w.cga");
  EXPECT_EQ(d.codes(), "import-not-found ");
}

TEST(Actions, carryOutHints) {
  Desk d("Lot --> splitt(x) { ~1 : Wall }");
  const std::vector<Action> actions = d.workspace.actions(kMain, {{0, 0}, {0, 40}});
  std::vector<std::string> results;
  for (const Action& a : actions) results.push_back(d.apply(kMain, a.edits[0].edits));
  ASSERT_GE(results.size(), 1u);
  EXPECT_EQ(results[0], "Lot --> split(x) { ~1 : Wall }");
  d.put("Lot --> Wall");
  const std::vector<Action> leaf = d.workspace.actions(kMain, {{0, 9}, {0, 9}});
  ASSERT_EQ(leaf.size(), 2u);
  EXPECT_EQ(d.apply(kMain, leaf[0].edits[0].edits), "Lot --> Wall\n\nWall -->\n  Wall.\n");
  EXPECT_EQ(d.apply(kMain, leaf[1].edits[0].edits), "Lot --> Wall.");
}

// --- Other notations ---

TEST(Dialects, haveFindingsOutlinesAndNames) {
  const std::map<std::string, std::string> texts = {
      {"/nowhere/a.gbbg",
       "axiom START size (10, 10, 10)\nshape START\nshape Wall\nSTART -> Repeat(X) {Wall}\n"},
      {"/nowhere/a.park", "Region -> Grid(2, 2) { Lawn } { } { }\nLawn -> GREEN\n"},
      {"/nowhere/a.grammar", "Start -> T ( 0 0 0 ) Wall\nWall -> I ( Cube )\n"},
  };
  for (const auto& [path, text] : texts) {
    Workspace w;
    w.open(path, text);
    EXPECT_FALSE(w.symbols(path).empty()) << path;
    w.open(path, text + "\n-> ((( oops");
    size_t errors = 0;
    for (const FileDiagnostics& f : w.diagnostics(path)) errors += f.diagnostics.size();
    EXPECT_GT(errors, 0u) << path;
    w.complete(path, {0, 3});
    w.hover(path, {0, 3});
    w.highlights(path);
    w.format(path);
  }
  Workspace w;
  w.open("/nowhere/a.grammar", texts.at("/nowhere/a.grammar"));
  EXPECT_EQ(w.definition("/nowhere/a.grammar", {0, 22})[0].range.begin.line, 1u);
  EXPECT_EQ(w.references("/nowhere/a.grammar", {1, 1}, true).size(), 2u);
}

TEST(Dialects, offerTheirWordsWhereNothingIsTyped) {
  const auto labels = [](const std::string& path, const std::string& text) {
    Workspace w;
    w.open(path, text);
    std::vector<std::string> out;
    for (const Completion& c : w.complete(path, {0, static_cast<uint32_t>(text.size())}).items) {
      EXPECT_NE(c.label, "");
      out.push_back(c.label);
    }
    return out;
  };
  for (const char* path : {"/nowhere/a.gbbg", "/nowhere/a.park", "/nowhere/a.grammar"}) {
    EXPECT_GT(labels(path, "A -> ").size(), 8u) << path;
    EXPECT_TRUE(labels(path, "A -> B.").empty()) << path;
  }
  const std::vector<std::string> places = labels("/nowhere/a.park", "A -> Place(COR");
  EXPECT_NE(std::find(places.begin(), places.end(), "CORNER"), places.end());
}

TEST(Dialects, carryOutHints) {
  const std::vector<std::tuple<std::string, std::string, std::string>> slips = {
      {"a.park", "A -> Grdi(2, 2) { B } { } { }\nB -> GREEN\n", "Grid"},
      {"a.park", "A -> Grid(2, 2) { B } { } { }\nB -> YELOW\n", "YELLOW"},
      {"a.park", "A -> Grid(2, 2) { regoin: B }\nB -> GREEN\n", "region"},
      {"a.park", "A -> Peel(OUTR) { 1: B | A }\nB -> GREEN\n", "outer"},
      {"a.gbbg", "axiom START size (9, 9, 9)\nshape START\nshape W\nSTART -> Repaet(X) {W}\n",
       "Repeat"},
      {"a.gbbg", "axoim START size (9, 9, 9)\nshape START\nterminal START\n", "axiom"},
      {"a.grammar", "Start -> I ( Cubee 0 )\n", "Cube"},
      {"a.grammar", "Start -> Wal\nWall -> I ( Cube 0 )\n", "Wall"},
      {"a.grammar", "Start -> R high ( 1 2 ) S ( hihg 1 1 ) I ( Cube 0 )\n", "high"},
  };
  for (const auto& [file, text, meant] : slips) {
    Workspace w;
    const std::string path = "/nowhere/" + file;
    w.open(path, text);
    const std::vector<Action> actions = w.actions(path, {{0, 0}, {9, 0}});
    const auto action = std::find_if(actions.begin(), actions.end(), [&](const Action& a) {
      return a.title == "Write '" + meant + "'";
    });
    ASSERT_NE(action, actions.end()) << text;
    const Range at = action->edits[0].edits[0].range;
    // One word is replaced, and nothing else.
    EXPECT_EQ(at.begin.line, at.end.line) << text;
    EXPECT_LE(at.end.character - at.begin.character, meant.size() + 1) << text;
  }
}

TEST(Dialects, knowNamesThatAreNoRules) {
  struct Case {
    std::string file, text, word;
    size_t uses;
  };
  const Case cases[] = {
      {"a.grammar", "A -> R floors ( 2 4 ) S ( floors 1 1 ) I ( Cube 0 )\n", "floors", 2},
      {"a.grammar", "A -> R* floors ( 2 4 ) S ( floors 1 1 ) I ( Cube 0 )\n", "floors", 2},
      {"a.park", "Park -> Edge(2)\nfun Edge(d) -> Peel(OUTER, d) { A | B }\nA -> RED\n", "Edge", 2},
      {"a.park", "Wide = 2\nPark -> Peel(OUTER, Wide) { A | B }\nA -> RED\n", "Wide", 2},
      {"a.gbbg", "axiom S size (9, 9, 9)\nshape S\nterminal Wall\nS -> Repeat(X) {Wall}\n", "Wall",
       2},
  };
  for (const auto& [file, text, word, uses] : cases) {
    Workspace w;
    const std::string path = "/nowhere/" + file;
    w.open(path, text);
    const size_t last = text.rfind(word);
    const size_t line = text.rfind('\n', last);
    const auto lines = static_cast<uint32_t>(std::count(text.begin(), text.begin() + last, '\n'));
    const Position at{lines, static_cast<uint32_t>(last - (line == text.npos ? 0 : line + 1))};
    EXPECT_EQ(w.references(path, at, true).size(), uses) << text;
    EXPECT_EQ(w.definition(path, at).size(), 1u) << text;
    const std::optional<Hover> hover = w.hover(path, at);
    ASSERT_TRUE(hover) << text;
    EXPECT_NE(hover->text.find(word), std::string::npos) << text;
    EXPECT_EQ(hover->text.find("a leaf"), std::string::npos) << text;
    EXPECT_TRUE(w.rename(path, at, "Other").ok) << text;
  }
}

TEST(Dialects, foldRulesOfSeveralLines) {
  Workspace w;
  w.open("/nowhere/a.park", "Park ->\n  case (ix == 1): RED\n  else: BLUE\n\nB -> RED\n");
  const std::vector<Fold> folds = w.folds("/nowhere/a.park");
  ASSERT_EQ(folds.size(), 1u);
  EXPECT_EQ(folds[0].endLine, 2u);
}

TEST(Dialects, explainTheirWords) {
  // The sentence of a word is its own, or that of an operation which there is.
  for (const char* path : {"/nowhere/a.gbbg", "/nowhere/a.park", "/nowhere/a.grammar"}) {
    size_t words = 0;
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      Workspace w;
      w.open(path, std::string(1, letter));
      for (const Completion& c : w.complete(path, {0, 1}).items) {
        if (c.kind != NameKind::Operation) continue;
        ++words;
        EXPECT_NE(c.summary, "") << path << " " << c.label;
        w.open(path, c.label + " ");
        EXPECT_TRUE(w.hover(path, {0, 1})) << path << " " << c.label;
        w.open(path, std::string(1, letter));
      }
    }
    EXPECT_GT(words, 8u) << path;
  }
  Workspace w;
  w.open("/nowhere/a.gbbg", "A -> Split(X, ");
  EXPECT_EQ(w.signatureHelp("/nowhere/a.gbbg", {0, 14}).signatures.size(), 1u);
  w.open("/nowhere/a.gbbg", "# Sp");
  EXPECT_TRUE(w.complete("/nowhere/a.gbbg", {0, 4}).items.empty());
}

}  // namespace
}  // namespace gable::language
