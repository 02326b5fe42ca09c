// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Each kind of statement is a function from a table; it returns an empty text when the statement
// holds, and otherwise what was found.

#include "cases/expectation.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "base/text.h"
#include "cases/measure.h"
#include "cases/plan.h"
#include "cases/solid_faults.h"
#include "gable/names.h"
#include "geom/region/boolean.h"
#include "scene/dump.h"
#include "scene/flatten.h"

namespace gable::cases {

namespace {

constexpr double kTolerance = 1e-4;
/// How far a leaf may reach beyond the lot, in metres: results of booleans lie on a grid.
constexpr double kReach = 1e-3;
/// Square metres that are none.
constexpr double kLeastArea = 1e-3;

bool parseNumber(std::string_view text, double& out) {
  const std::string copy(text);
  char* end = nullptr;
  out = std::strtod(copy.c_str(), &end);
  return !copy.empty() && end == copy.c_str() + copy.size();
}

bool closeTo(double found, double wanted) {
  return std::abs(found - wanted) <= kTolerance * std::max(1.0, std::abs(wanted));
}

/// Everything a statement looks at, worked out once a case.
struct Facts {
  const Outcome* outcome = nullptr;
  std::vector<PlacedLeaf> leaves;
  SceneCounts counts;
};

using Words = std::vector<std::string>;
constexpr const char* kNotUnderstood = "the statement is not understood";

/// Whether a word can be the name of a leaf: no sign that only a mistyped number has.
bool isName(const std::string& word) {
  return !word.empty() && word.find_first_of("<>=+-~#%*/") == std::string::npos;
}

bool isNumberWord(const std::string& word) {
  double number = 0;
  return parseNumber(word.substr(0, word.find("..")), number);
}

/// The leaves that a statement speaks of: those of the name at words[1], or all when there is a
/// number or nothing. `at` becomes the index of the first word behind the name.
std::vector<const PlacedLeaf*> spokenOf(const Facts& facts, const Words& words, size_t& at) {
  const bool named = words.size() > 1 && !isNumberWord(words[1]);
  at = named ? 2 : 1;
  std::vector<const PlacedLeaf*> chosen;
  for (const PlacedLeaf& leaf : facts.leaves) {
    if (!named || leaf.name == words[1]) chosen.push_back(&leaf);
  }
  return chosen;
}

std::string compare(double found, const Words& words, size_t at) {
  if (at > 1 && !isName(words[1])) return kNotUnderstood;
  size_t used = 0;
  const bool good = meets(found, words, at, used);
  if (used == 0 || at + used != words.size()) return kNotUnderstood;
  return good ? "" : "found " + roundedText(found);
}

std::string compare(const Vec3& found, const Words& words, size_t at) {
  for (size_t axis = 0; axis < 3; ++axis) {
    double wanted = 0;
    if (at + axis >= words.size() || !parseNumber(words[at + axis], wanted)) return kNotUnderstood;
    if (!closeTo(found[axis], wanted)) {
      return "found " + roundedText(found.x) + " " + roundedText(found.y) + " " +
             roundedText(found.z);
    }
  }
  return "";
}

template <class Measure>
std::string sumOver(const Facts& facts, const Words& words, Measure&& measure) {
  size_t at = 0;
  double sum = 0;
  for (const PlacedLeaf* leaf : spokenOf(facts, words, at)) sum += measure(leaf->mesh);
  return compare(sum, words, at);
}

std::string checkLeaves(const Facts& facts, const Words& words) {
  size_t at = 0;
  const size_t found = spokenOf(facts, words, at).size();
  return compare(static_cast<double>(found), words, at);
}

std::string checkArea(const Facts& facts, const Words& words) {
  return sumOver(facts, words, [](const Mesh& mesh) { return mesh.area(); });
}

std::string checkVolume(const Facts& facts, const Words& words) {
  return sumOver(facts, words, volume);
}

std::string checkBounds(const Facts& facts, const Words& words) {
  size_t at = 0;
  Box3 box;
  for (const PlacedLeaf* leaf : spokenOf(facts, words, at)) box.include(leaf->mesh.bounds());
  if (words.size() != at + 6) return kNotUnderstood;
  if (box.empty()) return "there is no such leaf";
  const std::string low = compare(box.min, words, at);
  const std::string high = compare(box.max, words, at + 3);
  if (low.empty() && high.empty()) return "";
  return "found minimum " + roundedText(box.min.x) + " " + roundedText(box.min.y) + " " +
         roundedText(box.min.z) + ", maximum " + roundedText(box.max.x) + " " +
         roundedText(box.max.y) + " " + roundedText(box.max.z);
}

/// For statements about each leaf: the first complaint, or that there is no leaf at all.
template <class Look>
std::string checkEach(const Facts& facts, const Words& words, size_t wordCount, Look&& look) {
  size_t at = 0;
  const std::vector<const PlacedLeaf*> leaves = spokenOf(facts, words, at);
  if (words.size() != at + wordCount) return kNotUnderstood;
  if (leaves.empty()) return "there is no such leaf";
  for (const PlacedLeaf* leaf : leaves) {
    std::string complaint = look(*leaf, at);
    if (!complaint.empty()) return complaint;
  }
  return "";
}

std::string checkSize(const Facts& facts, const Words& words) {
  return checkEach(facts, words, 3, [&](const PlacedLeaf& leaf, size_t at) {
    return compare(leaf.size, words, at);
  });
}

std::string checkClosed(const Facts& facts, const Words& words) {
  return checkEach(facts, words, 0, [](const PlacedLeaf& leaf, size_t) {
    return isClosed(leaf.mesh) ? std::string() : std::string(leaf.name) + " is open";
  });
}

std::string checkFlat(const Facts& facts, const Words& words) {
  return checkEach(facts, words, 0, [](const PlacedLeaf& leaf, size_t) {
    return isFlat(leaf.mesh) ? std::string() : std::string(leaf.name) + " is not flat";
  });
}

/// Whether a mesh covers a hole of the lot without touching its edge.
bool coversHole(const Mesh& mesh, const Region& lot) {
  const bool holes =
      std::any_of(lot.begin(), lot.end(), [](const Polygon& p) { return !p.holes.empty(); });
  return holes && area(subtract(planOf(mesh), lot)) > kLeastArea;
}

std::string checkWithin(const Facts& facts, const Words& words) {
  if (words.size() < 2 || words[1] != "lot") return kNotUnderstood;
  const Words spoken(words.begin() + 1, words.end());
  return checkEach(facts, spoken, 0, [&](const PlacedLeaf& leaf, size_t) -> std::string {
    const double reach = reachBeyond(leaf.mesh, facts.outcome->lot);
    if (reach > kReach) {
      return std::string(leaf.name) + " reaches " + roundedText(reach) + " m beyond the lot";
    }
    if (coversHole(leaf.mesh, facts.outcome->lot)) {
      return std::string(leaf.name) + " covers a hole of the lot";
    }
    return "";
  });
}

std::string checkApart(const Facts& facts, const Words& words) {
  size_t at = 0;
  const std::vector<const PlacedLeaf*> leaves = spokenOf(facts, words, at);
  if (words.size() != at) return kNotUnderstood;
  for (size_t i = 0; i < leaves.size(); ++i) {
    for (size_t j = i + 1; j < leaves.size(); ++j) {
      const double shared = sharedPlan(*leaves[i], *leaves[j]);
      if (shared <= kLeastArea) continue;
      return std::string(leaves[i]->name) + " and " + std::string(leaves[j]->name) + " share " +
             roundedText(shared) + " square metres";
    }
  }
  return leaves.empty() ? "there is no such leaf" : "";
}

/// Where the first fault is, in words: "Lamp at 1 2.5 0".
std::string faultText(const Parts& parts, const SolidFault& fault, bool pair) {
  return parts.name(fault.first) + (pair ? " and " + parts.name(fault.second) : "") + " at " +
         roundedText(fault.at.x) + " " + roundedText(fault.at.y) + " " + roundedText(fault.at.z);
}

/// How many faults of a kind there are; with a name those that a leaf of the name has part in.
std::string checkSolids(const Facts& facts, const Words& words) {
  size_t at = 0;
  spokenOf(facts, words, at);
  const Parts parts(*facts.outcome->scene);
  const bool pair = words[0] != "floating";
  const std::vector<SolidFault> all =
      words[0] == "coplanar"      ? coplanarFaces(parts, facts.outcome->ground)
      : words[0] == "overlapping" ? overlaps(parts)
                                  : floatingParts(parts, facts.outcome->ground);
  const SolidFault* first = nullptr;
  double found = 0;
  for (const SolidFault& fault : all) {
    const bool spoken = at == 1 || parts.name(fault.first) == words[1] ||
                        (pair && parts.name(fault.second) == words[1]);
    if (spoken && found++ == 0) first = &fault;
  }
  const std::string complaint = compare(found, words, at);
  if (complaint.empty() || complaint == kNotUnderstood || !first) return complaint;
  return complaint + ", such as " + faultText(parts, *first, pair);
}

std::string checkNames(const Facts& facts, const Words& words) {
  Words found{"names"};
  for (const PlacedLeaf& leaf : facts.leaves) found.emplace_back(leaf.name);
  if (found == words) return "";
  std::string text = "found";
  for (size_t i = 1; i < found.size(); ++i) text += " " + found[i];
  return text;
}

std::string plainText(const PlainValue& v) {
  if (v.kind == PlainValue::Kind::Number) return roundedText(v.number);
  if (v.kind == PlainValue::Kind::Bool) return v.number != 0 ? "true" : "false";
  return v.text;
}

std::string checkReportValues(const std::vector<const PlainValue*>& values, const Words& words) {
  std::map<std::string, int> counts;
  for (const PlainValue* v : values) ++counts[plainText(*v)];
  std::vector<std::string> found;
  for (const auto& [text, count] : counts) found.push_back(text + "=" + std::to_string(count));
  std::vector<std::string> wanted(words.begin() + 3, words.end());
  std::sort(wanted.begin(), wanted.end());
  std::sort(found.begin(), found.end());
  if (found == wanted) return "";
  std::string text = "found";
  for (const std::string& f : found) text += " " + f;
  return text;
}

/// The keys that there are reports of.
std::string keysText(const Facts& facts) {
  std::set<std::string> keys;
  for (const Report& report : facts.outcome->scene->reports) keys.insert(report.key);
  std::string text;
  for (const std::string& key : keys) text += (text.empty() ? "; the keys are " : ", ") + key;
  return text;
}

std::string checkReport(const Facts& facts, const Words& words) {
  if (words.size() < 4) return kNotUnderstood;
  std::vector<const PlainValue*> values;
  double sum = 0, low = INFINITY, high = -INFINITY, numbers = 0;
  for (const Report& report : facts.outcome->scene->reports) {
    if (report.key != words[1]) continue;
    values.push_back(&report.value);
    if (report.value.kind != PlainValue::Kind::Number) continue;
    ++numbers;
    sum += report.value.number;
    low = std::min(low, report.value.number);
    high = std::max(high, report.value.number);
  }
  const double n = static_cast<double>(values.size());
  if (words[2] == "values") return checkReportValues(values, words);
  if (words[2] == "n") {
    const std::string complaint = compare(n, words, 3);
    return complaint.empty() || n > 0 ? complaint : complaint + keysText(facts);
  }
  if (values.empty()) return "nothing was reported" + keysText(facts);
  if (numbers == 0) return "no number was reported";
  if (words[2] == "sum") return compare(sum, words, 3);
  if (words[2] == "avg") return compare(sum / numbers, words, 3);
  if (words[2] == "min") return compare(low, words, 3);
  if (words[2] == "max") return compare(high, words, 3);
  return kNotUnderstood;
}

std::string checkAttribute(const Facts& facts, const Words& words) {
  return checkEach(facts, words, 2, [&](const PlacedLeaf& leaf, size_t at) -> std::string {
    const Scene& scene = *facts.outcome->scene;
    const uint32_t set = leaf.leaf->attributes;
    if (set < scene.attributeSets.size()) {
      for (const uint32_t place : scene.attributeSets[set]) {
        const AttributeValue& a = scene.attributeValues[place];
        if (a.name != words[at] || a.values.empty()) continue;
        const PlainValue& v = a.values.front();
        if (v.kind == PlainValue::Kind::Number) return compare(v.number, words, at + 1);
        return plainText(v) == words[at + 1] ? "" : "found " + plainText(v);
      }
    }
    return "it carries no such attribute; rules give it with set(" + words[at] + ", ..)";
  });
}

bool isColor(const std::string& word) {
  return word.size() == 7 && word[0] == '#' &&
         word.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
}

/// The colours of the faces, each once, in the order of the faces: those of an inserted model have
/// the materials of its slots.
std::string colorsOf(const Scene& scene, const PlacedLeaf& leaf) {
  std::string all;
  for (const MeshFace& face : leaf.mesh.faces) {
    const std::string text = colorText(materialOf(scene, *leaf.leaf, face.materialSlot).color);
    if (all.find(text) == std::string::npos) all += (all.empty() ? "" : " ") + text;
  }
  return all.empty() ? "no face" : all;
}

std::string checkColor(const Facts& facts, const Words& words) {
  const Scene& scene = *facts.outcome->scene;
  return checkEach(facts, words, 1, [&](const PlacedLeaf& leaf, size_t at) -> std::string {
    if (!isColor(words[at])) return kNotUnderstood;
    const std::string found = colorsOf(scene, leaf);
    return found == words[at] ? "" : "found " + found;
  });
}

std::string checkCount(const Facts& facts, const Words& words) {
  const SceneCounts& c = facts.counts;
  const std::map<std::string_view, uint64_t> counts = {{"shapes", c.shapes},
                                                       {"faces", c.faces},
                                                       {"vertices", c.vertices},
                                                       {"triangles", c.triangles},
                                                       {"instances", c.instances},
                                                       {"prototypes", c.prototypes},
                                                       {"materials", c.materials},
                                                       {"encoder.faces", c.encoderFaces},
                                                       {"encoder.vertices", c.vertices}};
  return compare(static_cast<double>(counts.at(words[0])), words, 1);
}

/// "line:column" of a message, empty where it has no place.
std::string placeOf(const Diagnostic& m) {
  return m.range ? std::to_string(m.range->line) + ":" + std::to_string(m.range->column) : "";
}

std::string describe(const Outcome& outcome) {
  std::string text = "found";
  for (const Diagnostic& m : outcome.diagnostics) {
    const std::string place = placeOf(m);
    text += (text == "found" ? " " : "; ") + std::string(severityName(m.severity)) + " " + m.code +
            (place.empty() ? "" : " " + place) + ": " + m.message +
            (m.hint.empty() ? "" : " (" + m.hint + ")");
  }
  return outcome.diagnostics.empty() ? "there is no diagnostic" : text;
}

bool isPlace(const std::string& word) {
  return word.find(':') != std::string::npos &&
         word.find_first_not_of("0123456789:") == std::string::npos;
}

bool matches(const Diagnostic& m, const Words& words) {
  if (words.size() < 2 || severityName(m.severity) != words[0] || m.code != words[1]) return false;
  const bool placed = words.size() > 2 && isPlace(words[2]);
  if (placed && placeOf(m) != words[2]) return false;
  const size_t text = placed ? 3 : 2;
  return words.size() <= text || m.message.find(words[text]) != std::string::npos ||
         m.hint.find(words[text]) != std::string::npos;
}

std::string checkDiagnostic(const Facts& facts, const Words& words) {
  const bool placed = words.size() > 2 && isPlace(words[2]);
  if (words.size() < 2 || words.size() > (placed ? 4 : 3)) return kNotUnderstood;
  for (const Diagnostic& m : facts.outcome->diagnostics) {
    if (matches(m, words)) return "";
  }
  return describe(*facts.outcome);
}

// Notes tell how a rule fared, also one of a library: those count that are asked for.
std::string checkDiagnostics(const Facts& facts, const Words& words) {
  if (words.size() < 2) return kNotUnderstood;
  Words found{"diagnostics"};
  for (const Diagnostic& m : facts.outcome->diagnostics) {
    const bool isNamed = std::find(words.begin() + 1, words.end(), m.code) != words.end();
    if (isNamed || m.severity != Diagnostic::Severity::Note) found.push_back(m.code);
  }
  if (found.size() == 1) found.emplace_back("none");
  if (found == words) return "";
  const std::string meant = words.size() == 2 ? didYouMean(words[1], {"none"}) : "";
  return describe(*facts.outcome) + (meant.empty() ? "" : "; " + meant);
}

std::string checkDump(const Facts& facts, const Statement& statement) {
  // The block is indented as the author liked; the dump's own indentation is two blanks a level.
  std::string wanted;
  const std::vector<std::string_view> lines = linesOf(statement.block);
  const size_t indent = lines.empty() ? 0 : lines.front().find_first_not_of(' ');
  for (std::string_view line : lines) {
    if (line.size() > indent) wanted += std::string(line.substr(indent)) + "\n";
  }
  return wanted == facts.outcome->dump ? "" : "found\n" + facts.outcome->dump;
}

std::string checkGolden(const Outcome& outcome, const Statement& statement) {
  if (!outcome.golden || !outcome.model) return "there is no model";
  if (statement.words[0] == "scene") return outcome.golden->checkScene(statement, outcome.dump);
  return outcome.golden->checkPicture(statement, *outcome.model);
}

using Check = std::string (*)(const Facts&, const Words&);

/// A kind of statement: its word, what holds it, and how it is written.
struct Kind {
  const char* word;
  Check check;
  const char* form;
};
constexpr const char* kCountForm = "COUNT";
constexpr const char* kNamedForm = "[LEAF] NUMBER";
constexpr const char* kLeafForm = "[LEAF]";
constexpr const char* kCodeForm = "CODE [LINE:COLUMN] [\"TEXT\"]";
constexpr Kind kKinds[] = {
    {"leaves", checkLeaves, kNamedForm},
    {"area", checkArea, kNamedForm},
    {"volume", checkVolume, kNamedForm},
    {"bounds", checkBounds, "[LEAF] X Y Z  X Y Z"},
    {"size", checkSize, "LEAF X Y Z"},
    {"closed", checkClosed, kLeafForm},
    {"flat", checkFlat, kLeafForm},
    {"within", checkWithin, "lot [LEAF]"},
    {"apart", checkApart, kLeafForm},
    {"coplanar", checkSolids, kNamedForm},
    {"floating", checkSolids, kNamedForm},
    {"overlapping", checkSolids, kNamedForm},
    {"names", checkNames, "LEAF LEAF .."},
    {"report", checkReport, "KEY n|sum|avg|min|max NUMBER, or KEY values TEXT=COUNT .."},
    {"attribute", checkAttribute, "LEAF NAME VALUE"},
    {"color", checkColor, "LEAF #rrggbb"},
    {"shapes", checkCount, kCountForm},
    {"faces", checkCount, kCountForm},
    {"vertices", checkCount, kCountForm},
    {"triangles", checkCount, kCountForm},
    {"instances", checkCount, kCountForm},
    {"prototypes", checkCount, kCountForm},
    {"materials", checkCount, kCountForm},
    {"encoder.faces", checkCount, kCountForm},
    {"encoder.vertices", checkCount, kCountForm},
    {"error", checkDiagnostic, kCodeForm},
    {"warning", checkDiagnostic, kCodeForm},
    {"note", checkDiagnostic, kCodeForm},
    {"diagnostics", checkDiagnostics, "none, or CODE CODE .."},
};

/// Of statements that have no entry above: how they are written.
constexpr const char* kOtherForms[][2] = {{"dump", ""},
                                          {"scene", "FILE"},
                                          {"picture", "FILE [VIEW] [WIDTHxHEIGHT]"},
                                          {"print", "\"TEXT\", or none"}};

std::string formOf(const Words& words) {
  std::vector<std::string_view> all;
  for (const Kind& k : kKinds) {
    if (words[0] == k.word) return "expected: " + words[0] + " " + k.form;
    all.emplace_back(k.word);
  }
  for (const auto& [word, form] : kOtherForms) {
    if (words[0] == word) return "expected: " + words[0] + " " + form;
    all.emplace_back(word);
  }
  std::string meant = didYouMean(words[0], all);
  // "leaf", "overlap": begun like one of them.
  constexpr size_t kBegun = 3;
  for (size_t i = 0; meant.empty() && words[0].size() >= kBegun && i < all.size(); ++i) {
    if (!all[i].starts_with(words[0].substr(0, kBegun))) continue;
    meant = "did you mean '" + std::string(all[i]) + "'?";
  }
  return std::string("there is no such statement") + (meant.empty() ? "" : "; " + meant);
}

/// What to add to a failure where a statement names leaves that there are none of.
std::string unknownLeaf(const Facts& facts, const Words& words) {
  const bool speaks = std::any_of(std::begin(kKinds), std::end(kKinds), [&](const Kind& k) {
    return words[0] == k.word && std::string_view(k.form).find("LEAF") != std::string_view::npos;
  });
  const size_t at = words[0] == "within" ? 2 : 1;
  if (!speaks || words[0] == "names" || words.size() <= at || isNumberWord(words[at])) return "";
  std::vector<std::string_view> names;
  for (const PlacedLeaf& leaf : facts.leaves) {
    if (leaf.name == words[at]) return "";
    if (std::find(names.begin(), names.end(), leaf.name) == names.end()) {
      names.push_back(leaf.name);
    }
  }
  const std::string meant = didYouMean(words[at], names);
  return "; there is no leaf '" + words[at] + "'" + (meant.empty() ? "" : ", " + meant);
}

std::string evaluate(const Facts& facts, const Statement& statement) {
  if (statement.words[0] == "dump") return checkDump(facts, statement);
  if (statement.words[0] == "scene" || statement.words[0] == "picture") {
    return checkGolden(*facts.outcome, statement);
  }
  if (const std::string stray = strayLines(statement); !stray.empty()) return stray;
  for (const Kind& k : kKinds) {
    if (statement.words[0] != k.word) continue;
    const std::string complaint = k.check(facts, statement.words);
    if (complaint == kNotUnderstood) break;
    return complaint.empty() ? "" : complaint + unknownLeaf(facts, statement.words);
  }
  return formOf(statement.words);
}

/// A statement as it was written, but for its blanks.
std::string textOf(const Statement& s) {
  std::string text;
  for (const std::string& word : s.words) {
    const bool quoted = word.empty() || word.find(' ') != std::string::npos;
    text += (text.empty() ? "" : " ") + (quoted ? '"' + word + '"' : word);
  }
  return text;
}

/// The `print` statements of a case are one expectation together.
void checkPrints(const std::vector<Statement>& expected, const Outcome& outcome,
                 std::vector<CaseFailure>& failed) {
  std::vector<std::string> wanted;
  size_t line = 0;
  bool none = false;
  for (const Statement& s : expected) {
    if (s.words[0] != "print") continue;
    line = s.line;
    if (const std::string stray = strayLines(s); !stray.empty())
      failed.push_back({static_cast<uint32_t>(s.line), stray});
    if (s.words.size() != 2)
      failed.push_back({static_cast<uint32_t>(s.line), "print: " + formOf(s.words)});
    else if (s.words[1] == "none" && !s.quoted[1])
      none = true;
    else
      wanted.push_back(s.words[1]);
  }
  if (line == 0 || (wanted.empty() && !none) || wanted == outcome.scene->prints) return;
  std::string text = "found";
  for (const std::string& p : outcome.scene->prints) text += " \"" + p + "\"";
  failed.push_back(
      {static_cast<uint32_t>(line), outcome.scene->prints.empty() ? "nothing was printed" : text});
}

std::vector<CaseFailure> unexpectedErrors(const std::vector<Statement>& expected,
                                          const Outcome& outcome) {
  std::vector<CaseFailure> failed;
  const auto nameIt = [&](const Diagnostic& m) {
    return std::any_of(expected.begin(), expected.end(), [&](const Statement& s) {
      return matches(m, s.words) ||
             (s.words[0] == "diagnostics" && s.words.size() > 1 &&
              std::find(s.words.begin() + 1, s.words.end(), m.code) != s.words.end());
    });
  };
  for (const Diagnostic& m : outcome.diagnostics) {
    if (m.isError() && !nameIt(m)) {
      failed.push_back({0, "an error that no statement expects: " + m.rendered});
    }
  }
  return failed;
}

}  // namespace

bool meets(double found, const std::vector<std::string>& words, size_t at, size_t& used) {
  used = 0;
  if (at >= words.size()) return false;
  double a = 0, b = 0;
  const size_t dots = words[at].find("..");
  if (dots != std::string::npos) {
    if (!parseNumber(words[at].substr(0, dots), a) || !parseNumber(words[at].substr(dots + 2), b)) {
      return false;
    }
    used = 1;
    return found >= a && found <= b;
  }
  if (!parseNumber(words[at], a)) return false;
  if (at + 2 < words.size() && words[at + 1] == "+-" && parseNumber(words[at + 2], b)) {
    used = 3;
    return std::abs(found - a) <= b;
  }
  used = 1;
  return closeTo(found, a);
}

std::vector<CaseFailure> failures(const std::vector<Statement>& expected, const Outcome& outcome) {
  // Rules that cannot be derived are told first, and what would follow from it is not told.
  std::vector<CaseFailure> failed = unexpectedErrors(expected, outcome);
  if (!failed.empty() && !outcome.model) return failed;
  Facts facts{&outcome, placedLeaves(*outcome.scene), count(*outcome.scene)};
  for (const Statement& s : expected) {
    if (s.words[0] == "print") continue;
    const std::string complaint = evaluate(facts, s);
    if (complaint.empty()) continue;
    failed.push_back({static_cast<uint32_t>(s.line), textOf(s) + ": " + complaint});
  }
  checkPrints(expected, outcome, failed);
  return failed;
}

}  // namespace gable::cases
