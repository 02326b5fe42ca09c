// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rules as forms: what is read, and that what a form writes changes what it is about alone.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "gable/language.h"
#include "gable/lsp.h"

namespace gable::language {
namespace {

const std::string kCga = "/nowhere/main.cga";
const std::string kGbbg = "/nowhere/main.gbbg";

const std::string kHouse = R"(import w : "window.cga"
attr height = 9   // metres

// Where it begins.
@StartRule
Lot -->
    extrude(height)   // up
    comp(f) { side : Wall(height) /* all round */ | top : Roof }

Wall(h) -->
    split(y) { ~h : w.Frame | { ~1 : Wall(1) }* }
Roof --> 30% : color("#777777") Slab. 20% : [ t(0, 1, 0) Tiles ] else : NIL
Sometimes --> case height > 3 : Lot else : Roof
)";

class Form {
 public:
  explicit Form(std::string text, const std::string& rule = {}, std::string path = kCga)
      : path_(std::move(path)) {
    workspace.open(path_, std::move(text));
    form = workspace.form(path_, rule);
  }
  std::string text() { return workspace.text(path_); }
  std::string at(const Range& r) {
    Workspace copy;
    copy.open(path_, text());
    copy.change(path_, {{Range{r.end, {100000, 0}}, ""}, {Range{{0, 0}, r.begin}, ""}});
    return copy.text(path_);
  }
  std::string after(std::vector<Edit> edits) {
    std::sort(edits.begin(), edits.end(), [](const Edit& a, const Edit& b) {
      return std::tie(b.range.begin.line, b.range.begin.character) <
             std::tie(a.range.begin.line, a.range.begin.character);
    });
    Workspace copy;
    copy.open(path_, text());
    for (const Edit& e : edits) copy.change(path_, {{e.range, e.text}});
    return copy.text(path_);
  }
  std::string without(const Piece& p) {
    std::vector<Edit> edits;
    for (const Range& r : p.removal) edits.push_back({r, ""});
    return after(edits);
  }
  std::string with(const Insertion& i, const std::string& more) {
    return after({{{i.at, i.at}, i.before + more + i.after}});
  }
  const Piece& branch(size_t i = 0) { return form.rule->body->parts.at(i); }
  /// The rules by what they begin with.
  std::string rows() const {
    std::string out;
    for (const FormRow& r : form.rules) out += r.name + ":" + r.type + " ";
    return out;
  }

  Workspace workspace;
  TextForm form;

 private:
  std::string path_;
};

const Piece& first(const Piece& p, Piece::Kind kind) {
  const auto at =
      std::find_if(p.parts.begin(), p.parts.end(), [&](const Piece& q) { return q.kind == kind; });
  EXPECT_NE(at, p.parts.end());
  return *at;
}

TEST(Forms, listTheRulesOfEveryNotation) {
  EXPECT_EQ(Form(kHouse).rows(), "Lot:extrude Wall:split Roof:chance Sometimes:case ");
  EXPECT_EQ(Form("axiom START size (1, 2, 3)\nterminal Wall 2D [3, 3, 0]\n"
                 "START -> Split(Y, {1}) {A | B}\n\"front\" A -> Repeat(X)\n   {Wall 1}\n",
                 "", kGbbg)
                .rows(),
            "START:Split A:Repeat ");
  EXPECT_EQ(Form("Row n -> House # here\nHouse -> I ( Cube 0 )\n", "", "/nowhere/a.grammar").rows(),
            "Row:House House:I ");
  EXPECT_EQ(Form("", "").rows(), "");
}

TEST(Forms, readTheBodyOfARuleWithItsPlaces) {
  Form f(kHouse, "Lot");
  ASSERT_TRUE(f.form.rule);
  EXPECT_EQ(f.at(f.form.rule->nameRange), "Lot");
  EXPECT_EQ(f.at(f.form.rule->body->range).substr(0, 7), "extrude");
  ASSERT_EQ(f.form.rule->body->parts.size(), 1u);
  const Piece& extrude = f.branch().parts.at(0);
  EXPECT_EQ(extrude.text, "extrude");
  EXPECT_EQ(first(extrude, Piece::Kind::Argument).text, "height");
  const Piece& block = first(f.branch().parts.at(1), Piece::Kind::Block);
  ASSERT_EQ(block.parts.size(), 2u);
  EXPECT_EQ(first(block.parts[0], Piece::Kind::Head).text, "side");
  EXPECT_EQ(f.at(Form(kHouse, "Wall").form.rule->parametersRange), "(h)");
}

TEST(Forms, takeAPartAwayAndKeepTheComments) {
  Form f(kHouse, "Lot");
  EXPECT_NE(f.without(f.branch().parts.at(0)).find("Lot -->\n   // up\n    comp(f)"),
            std::string::npos);
  const Piece& block = first(f.branch().parts.at(1), Piece::Kind::Block);
  EXPECT_NE(f.without(block.parts[1]).find("{ side : Wall(height) /* all round */ }"),
            std::string::npos);
  EXPECT_NE(f.without(block.parts[0]).find("{  /* all round */ top : Roof }"), std::string::npos)
      << f.without(block.parts[0]);
  // A line that only it stood on goes too.
  EXPECT_NE(f.without(f.branch().parts.at(1)).find("extrude(height)   // up\n\nWall"),
            std::string::npos);
}

TEST(Forms, putAFurtherPartWhereItBelongs) {
  Form f(kHouse, "Lot");
  EXPECT_NE(f.with(*f.branch().insertion, "Yard").find("top : Roof }\n    Yard\n"),
            std::string::npos);
  const Piece& block = first(f.branch().parts.at(1), Piece::Kind::Block);
  EXPECT_NE(f.with(*block.insertion, "all : NIL").find("| top : Roof | all : NIL }"),
            std::string::npos);
  EXPECT_NE(f.with(f.form.newRule, "New --> NIL").find("}\n\nNew --> NIL\n\nWall(h)"),
            std::string::npos);
  Form none("Lot -->\n");
  EXPECT_NE(none.with(*none.branch().insertion, "X").find("--> X"), std::string::npos)
      << none.with(*none.branch().insertion, "X");
}

TEST(Forms, readChoices) {
  Form f(kHouse, "Roof");
  ASSERT_EQ(f.form.rule->body->parts.size(), 3u);
  EXPECT_EQ(f.branch(0).kind, Piece::Kind::Chance);
  EXPECT_EQ(first(f.branch(0), Piece::Kind::Head).text, "30");
  EXPECT_EQ(first(f.branch(1), Piece::Kind::Scoped).parts.size(), 1u);
  EXPECT_EQ(f.branch(2).kind, Piece::Kind::Else);
  EXPECT_NE(f.with(*f.form.rule->body->insertion, "10% : NIL").find("] 10% : NIL else : NIL"),
            std::string::npos);
  Form g(kHouse, "Sometimes");
  EXPECT_EQ(g.branch(0).kind, Piece::Kind::Case);
  EXPECT_EQ(first(g.branch(0), Piece::Kind::Head).text, "height > 3");
}

TEST(Forms, takeARuleAwayWithWhatIsAboveIt) {
  Form f(kHouse, "Lot");
  const std::string text = f.after({{f.form.rule->removal, ""}});
  EXPECT_EQ(text.find("Where it begins"), std::string::npos);
  EXPECT_EQ(text.find("@StartRule"), std::string::npos);
  EXPECT_NE(text.find("// metres\n\nWall(h) -->"), std::string::npos) << text;
}

TEST(Forms, takeTextThatIsBeingWritten) {
  for (size_t end = 0; end <= kHouse.size(); end += 3) {
    Form f(kHouse.substr(0, end));
    for (const FormRow& r : f.form.rules) Form(kHouse.substr(0, end), r.name);
  }
}

// --- GBBG ---

const std::string kBoxes = R"(# A small house.
axiom START size (12, 10, 9)
terminal Wall 2D [3, 3, 0], Slab

START  -> Split(Y, {1},  # the plinth
                ToRoot) {Slab | Floors}
"the floors" Floors -> Repeat(Y) {Wall 1, Slab 2} weight 2
Roof -> Scope(T(0, 1, 0, Add, World), S(2, 2, 2, Set)) {Slab}

postprocess {
  Wall : "wall.glb"
}
)";

TEST(BoxForms, writeWhatHasChangedAndKeepTheRest) {
  Form f(kBoxes, "START", kGbbg);
  ASSERT_TRUE(f.form.rule->box) << f.form.rule->trouble;
  BoxRule box = *f.form.rule->box;
  EXPECT_EQ(box.slotNames, (std::vector<std::string>{"1 m", "the rest"}));
  box.toRoot = false;
  box.points = {2.5};
  const auto edits = f.workspace.formEdits(kGbbg, "START", box);
  ASSERT_TRUE(edits);
  const std::string now = f.after(*edits);
  EXPECT_EQ(now.substr(0, now.find("\"the floors")),
            kBoxes.substr(0, kBoxes.find("START  ->")) +
                "START  -> Split(Y, {2.5},  # the plinth\n                FromRoot) "
                "{Slab | Floors}\n");
  EXPECT_TRUE(f.workspace.formEdits(kGbbg, "START", *f.form.rule->box)->empty());
}

TEST(BoxForms, giveARuleAsManySuccessorsAsItNeeds) {
  Form f(kBoxes, "Floors", kGbbg);
  BoxRule box = f.form.rule->box.value();
  EXPECT_EQ(box.title, "the floors");
  EXPECT_EQ(box.weight, 2);
  EXPECT_EQ(box.slots.at(0).at(1).chance, 2);
  box.op = "Margin";
  const std::string text = f.after(f.workspace.formEdits(kGbbg, "Floors", box).value());
  EXPECT_NE(text.find("\"the floors\" Floors -> Margin(Y, Absolute, 1, Default, Center) "
                      "{Wall 1, Slab 2 | EMPTY | EMPTY} weight 2\nRoof"),
            std::string::npos)
      << text;
  BoxRule fresh;
  fresh.predecessor = "New";
  EXPECT_EQ(boxRuleText(fresh), "New -> Split(Y, {1}, FromRoot) {EMPTY | EMPTY}");
}

TEST(BoxForms, readAndWriteEveryOperation) {
  for (const char* rule : {"Scope(T(1, 2, 3, Add, World), R(0, 90, 0, Set, Local, Off), S(2, 2, 2, "
                           "Add, Relative)) {Q}",
                           "Split(X, {1, 2}, ToRoot) {A | B | C}", "Repeat(Z) {A}", "Grid(Y) {A}",
                           "Margin(Y, Relative, 0.25, FacingOut, NoCenter) {A | B}",
                           "Component(Y, SidesPlusTop) {A 1, B 2 | C}"}) {
    const std::string text = "axiom X size (1, 1, 1)\nX -> " + std::string(rule) + "\n";
    Form f(text, "X", kGbbg);
    ASSERT_TRUE(f.form.rule && f.form.rule->box) << rule;
    EXPECT_EQ(boxRuleText(*f.form.rule->box), "X -> " + std::string(rule));
  }
}

TEST(BoxForms, sayWhyARuleHasNoForm) {
  Form f("A -> Split(Y, {1, 2}) {B | C}\nB -> Repeat(X) {C}\n", "A", kGbbg);
  EXPECT_EQ(f.rows(), "A:Split B:Repeat ");
  EXPECT_FALSE(f.form.rule->box);
  EXPECT_NE(f.form.rule->trouble.find("needs 3 successors"), std::string::npos)
      << f.form.rule->trouble;
  EXPECT_FALSE(f.workspace.formEdits(kGbbg, "A", BoxRule()));
}

TEST(BoxForms, putSymbolsAndAssetsWhereTheyBelong) {
  Form f(kBoxes, "START", kGbbg);
  EXPECT_NE(f.with(*f.form.newSymbol, "shape Sill").find("Slab\nshape Sill\n\nSTART"),
            std::string::npos);
  EXPECT_NE(
      f.with(*f.form.newAsset, "Slab : \"s.glb\"").find("\"wall.glb\"\n  Slab : \"s.glb\"\n}"),
      std::string::npos);
  ASSERT_EQ(f.form.assets.size(), 1u);
  EXPECT_EQ(f.at(f.form.assets[0].pathRange), "wall.glb");
  EXPECT_NE(f.after({{f.form.assets[0].removal, ""}}).find("postprocess {\n}"), std::string::npos);
  Form none("axiom A size (1, 1, 1)\n", "", kGbbg);
  EXPECT_EQ(none.with(*none.form.newAsset, "A : \"a.glb\""),
            "axiom A size (1, 1, 1)\n\npostprocess {\n  A : \"a.glb\"\n}\n");
}

// --- Values and words ---

TEST(Values, standBehindWhatIsWritten) {
  Workspace w;
  w.open(kCga, "attr height = 9\nattr deep = rand(1, 2)\nattr paint = \"red\"\nLot --> X.\n");
  w.setValues(kCga, {{"height", "9"}, {"deep", "1.5"}, {"paint", "red"}, {"other", "1"}});
  const auto hints = [&] {
    std::string out;
    for (const InlayHint& h : w.inlayHints(kCga, {{0, 0}, {9, 0}})) {
      if (h.value) out += std::to_string(h.at.line) + h.label + " ";
    }
    return out;
  };
  EXPECT_EQ(hints(), "1= 1.5 ");
  w.setValues(kCga, {{"height", "12"}});
  EXPECT_EQ(hints(), "0= 12 ");
  w.close(kCga);
  w.open(kCga, "attr height = 9\n");
  EXPECT_EQ(hints(), "");
}

TEST(Values, areFoundByTheirNamesInImports) {
  Workspace w;
  w.open("/nowhere/window.cga", "attr sill = 0.9\nFrame --> NIL\n");
  w.open(kCga, "import w : \"window.cga\"\nattr height = 9 // metres\nLot --> X.\n");
  EXPECT_EQ(w.attributeValue(kCga, "height")->range, (Range{{1, 14}, {1, 15}}));
  EXPECT_EQ(w.attributeValue(kCga, "w.sill")->path, "/nowhere/window.cga");
  EXPECT_FALSE(w.attributeValue(kCga, "w.none"));
  EXPECT_FALSE(w.attributeValue(kCga, "x.sill"));
}

TEST(Highlights, tellTheWordsOfEveryNotation) {
  const auto kinds = [](const std::string& path, const std::string& text) {
    Workspace w;
    w.open(path, text);
    std::string out;
    for (const Highlight& h : w.highlights(path)) {
      out += std::to_string(static_cast<int>(h.kind)) + (h.declaration ? "d " : " ");
    }
    return out;
  };
  using K = Highlight::Kind;
  const auto expected = [](std::initializer_list<std::pair<K, bool>> list) {
    std::string out;
    for (const auto& [k, d] : list) {
      out += std::to_string(static_cast<int>(k)) + (d ? "d " : " ");
    }
    return out;
  };
  EXPECT_EQ(kinds("/nowhere/a.gbbg", "# c\naxiom A size (1, 1, 1)\nA -> Repeat(X) {\"B\"}\n"),
            expected({{K::Comment, false},
                      {K::Keyword, false},
                      {K::Rule, true},
                      {K::Leaf, false},
                      {K::Number, false},
                      {K::Number, false},
                      {K::Number, false},
                      {K::Rule, true},
                      {K::Operation, false},
                      {K::Selector, false},
                      {K::String, false}}));
  EXPECT_EQ(kinds("/nowhere/a.grammar", "Row -> House\n"),
            expected({{K::Rule, true}, {K::Leaf, false}}));
  EXPECT_NE(kinds("/nowhere/a.park", "Region -> Grid(2, 2) { A } { B } { }\n"), "");
}

TEST(Requests, answerWithForms) {
  LanguageServer server;
  const auto ask = [&](const std::string& method, const std::string& params) {
    static int id = 0;
    server.receive(R"({"jsonrpc":"2.0","id":)" + std::to_string(++id) + R"(,"method":")" + method +
                   R"(","params":)" + params + "}");
    while (server.step()) {
    }
    std::string out;
    for (const std::string& m : server.take()) out += m;
    return out;
  };
  ask("initialize", "{}");
  const std::string uri = R"({"textDocument":{"uri":"file:///nowhere/a.gbbg")";
  server.receive(R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":)" + uri +
                 R"(,"version":1,"text":"A -> Repeat(X) {B}\n"}}})");
  EXPECT_NE(ask("gable/form", uri + "}}").find(R"("operator":"Repeat")"), std::string::npos);
  EXPECT_NE(
      ask("gable/formEdits", uri + R"(},"rule":"A","box":{"predecessor":"A",)" +
                                 R"("operator":"Repeat","axis":"Z","slots":[[{"symbol":"B"}]]}})")
          .find(R"("newText":"Z")"),
      std::string::npos);
  EXPECT_NE(ask("gable/formEdits", uri + R"(},"rule":"C","box":{}})").find("error"),
            std::string::npos);
  EXPECT_NE(ask("gable/ruleText", R"({"box":{"predecessor":"N","operator":"Grid"}})")
                .find("N -> Grid(Y) {EMPTY}"),
            std::string::npos);
}

}  // namespace
}  // namespace gable::language
