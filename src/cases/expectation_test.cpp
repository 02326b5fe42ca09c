// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// A scene made by hand: a box Tower of 2 x 3 x 4 metres at (1, 0, 0) and a red square Roof of
// side 2.

#include "cases/expectation.h"

#include <gtest/gtest.h>

#include "scene/dump.h"

namespace gable::cases {
namespace {

struct Made {
  Scene scene;
  DiagnosticList diagnostics;

  Made() {
    scene.names = {"Lot", "Tower", "Roof"};
    Material red;
    red.color = {1, 0, 0};
    scene.materials = {Material{}, red};
    scene.materialLists = {{0}, {1}};
    scene.attributeValues = {{"height", {{PlainValue::Kind::Number, 3, ""}}, 0, 0}};
    scene.attributeSets = {{}, {0}};
    Leaf tower;
    tower.frame = Frame::moved({1, 0, 0});
    tower.scale = {2, 3, 4};
    tower.name = 1;
    tower.attributes = 1;
    Leaf roof;
    roof.mesh = kUnitQuadXz;
    roof.scale = {2, 1, 2};
    roof.name = 2;
    roof.materials = 1;
    scene.leaves = {tower, roof};
    Prototype prototype;
    prototype.leafCount = 2;
    prototype.shapes = 3;
    scene.prototypes = {prototype};
    scene.roots = {Root{}};
    scene.reports = {{"Area", {PlainValue::Kind::Number, 2, ""}},
                     {"Area", {PlainValue::Kind::Number, 4, ""}},
                     {"Kind", {PlainValue::Kind::Text, 0, "a"}}};
    scene.prints = {"two words"};
    Diagnostic undefined;
    undefined.severity = Diagnostic::Severity::Warning;
    undefined.code = "undefined-rule";
    undefined.range = TextRange{"rules.cga", 2, 3, 2, 4};
    diagnostics = {undefined};
  }

  std::string complaints(const std::string& text) const {
    Section section;
    section.text = text + "\n";
    section.textLine = 1;
    std::string all;
    for (const CaseFailure& f :
         failures(statements(section), {&scene, diagnostics, dumpText(scene)})) {
      all += std::to_string(f.line) + ": " + f.message + "\n";
    }
    return all;
  }
};

TEST(Expectation, acceptsWhatHolds) {
  const Made made;
  for (const char* text : {"leaves 2",
                           "leaves Roof 1",
                           "leaves Wall 0",
                           "leaves 1..3",
                           "area Roof 4",
                           "area 56",
                           "area Roof 4.1 +- 0.2",
                           "volume Tower 24",
                           "bounds 0 0 0 3 3 4",
                           "bounds Tower 1 0 0 3 3 4",
                           "size Tower 2 3 4",
                           "closed Tower",
                           "flat Roof",
                           "coplanar 0",
                           "floating 0",
                           "floating Roof 0",
                           "overlapping Tower 0..1",
                           "names Tower Roof",
                           "report Area sum 6",
                           "report Area n 2",
                           "report Area avg 3",
                           "report Area min 2",
                           "report Area max 4",
                           "report Kind values a=1",
                           "report None n 0",
                           "print \"two words\"",
                           "attribute Tower height 3",
                           "color Roof #ff0000",
                           "color Tower #ffffff",
                           "shapes 3",
                           "faces 7",
                           "warning undefined-rule",
                           "warning undefined-rule 2:3",
                           "diagnostics undefined-rule"}) {
    EXPECT_EQ(made.complaints(text), "") << text;
  }
}

TEST(Expectation, rejectsWhatDoesNotHold) {
  const Made made;
  for (const char* text : {"leaves 3",
                           "leaves Roof 2",
                           "coplanar 1",
                           "floating Roof 1",
                           "overlapping Tower",
                           "leaves 3..4",
                           "area Roof 4.1",
                           "area Roof 4.5 +- 0.2",
                           "volume Tower 25",
                           "bounds Tower 1 0 0 3 3 5",
                           "bounds Wall 0 0 0 1 1 1",
                           "size Tower 2 3 5",
                           "closed Roof",
                           "closed Wall",
                           "flat Tower",
                           "names Roof Tower",
                           "report Area sum 7",
                           "report Area n 3",
                           "report None sum 0",
                           "report Kind values a=2",
                           "report Kind values b=1",
                           "print \"two\"",
                           "print none",
                           "attribute Tower height 4",
                           "attribute Tower width 3",
                           "color Roof #fe0000",
                           "shapes 4",
                           "faces 8",
                           "error undefined-rule",
                           "warning other",
                           "warning undefined-rule 2:4",
                           "diagnostics none",
                           "dump",
                           "leafs 2",
                           "leaves",
                           "leaves 2 3",
                           "area Roof four",
                           "bounds 0 0 0",
                           "area >= 3",
                           "color Roof red",
                           "within town",
                           "encoder.faces 6",
                           "print"}) {
    EXPECT_NE(made.complaints(text), "") << text;
  }
}

TEST(Expectation, reportsAnErrorThatNobodyExpects) {
  Made made;
  Diagnostic unknown;
  unknown.code = "unknown-operation";
  made.diagnostics.push_back(unknown);
  EXPECT_NE(made.complaints("leaves 2"), "");
  EXPECT_EQ(made.complaints("leaves 2\nerror unknown-operation"), "");
}

TEST(Expectation, saysHowStatementsAreWritten) {
  const Made made;
  const std::pair<const char*, const char*> said[] = {
      {"leafs 2", "did you mean 'leaves'?"},
      {"leaf 2", "did you mean 'leaves'?"},
      {"diagnostics non", "did you mean 'none'?"},
      {"leaves Roof four", "expected: leaves [LEAF] NUMBER"},
      {"color Roof red", "expected: color LEAF #rrggbb"},
      {"leaves Rof 1", "there is no leaf 'Rof', did you mean 'Roof'?"},
      {"report Aera n 2", "the keys are Area, Kind"},
      {"diagnostics none", "warning undefined-rule 2:3: "},
      {"attribute Tower width 3", "set(width, ..)"},
  };
  for (const auto& [statement, says] : said) {
    EXPECT_NE(made.complaints(statement).find(says), std::string::npos)
        << made.complaints(statement);
  }
}

TEST(Expectation, tellsWhatStopsACaseAndNothingElse) {
  Made made;
  Diagnostic unknown;
  unknown.code = "unknown-operation";
  unknown.rendered = "rules.cga:1:1: error";
  Diagnostic note = unknown;
  note.severity = Diagnostic::Severity::Note;
  note.code = "no-room";
  made.diagnostics = {note};
  EXPECT_EQ(made.complaints("leaves 7\nprint none\ndiagnostics none"),
            made.complaints("leaves 7\nprint none\ndiagnostics no-room"));
  EXPECT_NE(made.complaints("leaves 7\nprint none\ndiagnostics undefined-rule"),
            made.complaints("leaves 7\nprint none\ndiagnostics none"));
  made.diagnostics = {unknown};
  EXPECT_EQ(made.complaints("leaves 7\nprint none\ndiagnostics none"),
            "0: an error that no statement expects: rules.cga:1:1: error\n");
}

TEST(Expectation, comparesDumps) {
  const Made made;
  const std::string dump = dumpText(made.scene);
  std::string text = "dump\n";
  for (std::string_view line : linesOf(dump)) text += "    " + std::string(line) + "\n";
  EXPECT_EQ(made.complaints(text), "");
  EXPECT_NE(made.complaints(text + "    Roof at 0 0 0 size 1 1 1\n"), "");
}

}  // namespace
}  // namespace gable::cases
