// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Annotations to data. A table says what each name does; a name that is not in it is a warning with
// the nearest name, and is ignored.

#include <algorithm>
#include <functional>

#include "base/number.h"
#include "base/text.h"
#include "lang/sema/analysis.h"

namespace gable::lang {

namespace {

// Reads the arguments of one annotation.
class NoteReader {
 public:
  /// `example`: how it is written.
  NoteReader(const Tree& tree, NodeId node, Diagnostics* diagnostics, std::string_view example)
      : tree_(tree), node_(node), diagnostics_(diagnostics), example_(example) {}

  /// Without a hint of its own the example says what to write.
  void warn(NodeId at, const std::string& message, std::string hint = {}) {
    warned_ = true;
    if (hint.empty() && !example_.empty()) hint = "write '" + std::string(example_) + "'";
    if (diagnostics_) diagnostics_->warning("bad-annotation", tree_.span(at), message, hint);
  }
  /// The same, with the edit that the hint says.
  void warn(NodeId at, const std::string& message, const std::string& hint,
            const std::string& instead) {
    warn(at, message, hint);
    if (diagnostics_) diagnostics_->fixLast(tree_.span(at), instead);
  }

  std::span<const NodeId> arguments() const { return tree_.children(node_); }

  // The number that an argument spells; a sign before it counts.
  std::optional<double> number(NodeId id) const {
    if (tree_.kind(id) == NodeKind::Number) return tree_.number(id);
    if (tree_.kind(id) != NodeKind::Unary || tree_.unaryOp(id) == UnaryOp::Not) return {};
    const std::optional<double> inner = number(tree_.child(id, 0));
    if (!inner) return {};
    return tree_.unaryOp(id) == UnaryOp::Minus ? -*inner : *inner;
  }

  std::optional<std::string> string(NodeId id) const {
    if (tree_.kind(id) != NodeKind::String) return {};
    return std::string(tree_.text(id));
  }

  // A word, or the word in quotes.
  std::optional<std::string> word(NodeId id) const {
    if (tree_.kind(id) == NodeKind::Name) return std::string(tree_.text(id));
    return string(id);
  }

  std::optional<bool> truth(NodeId id) const {
    if (tree_.kind(id) != NodeKind::Bool) return {};
    return tree_.number(id) != 0;
  }

  // The single string in the brackets, or "" with a warning.
  std::string oneString() {
    if (arguments().size() == 1) {
      if (const auto s = string(arguments()[0])) return *s;
    }
    warn(node_, "'@" + std::string(tree_.text(node_)) + "' takes one text, in quotes");
    return {};
  }

  const Tree& tree() const { return tree_; }
  NodeId node() const { return node_; }
  bool warned() const { return warned_; }

 private:
  const Tree& tree_;
  NodeId node_;
  Diagnostics* diagnostics_;
  std::string_view example_;
  bool warned_ = false;
};

void readEnumValues(NoteReader& r, EnumNote& note) {
  for (const NodeId a : r.arguments()) {
    if (r.tree().kind(a) == NodeKind::NamedArg) continue;
    if (const auto n = r.number(a)) {
      note.values.push_back({true, *n, {}});
    } else if (const auto s = r.string(a)) {
      note.values.push_back({false, 0, *s});
    } else if (const auto b = r.truth(a)) {
      note.values.push_back({false, 0, *b ? "true" : "false"});
    } else {
      r.warn(a, "a value of '@Enum' is a number or a text in quotes");
    }
  }
}

void readEnum(NoteReader& r, Annotations& out) {
  EnumNote note;
  for (const NodeId a : r.arguments()) {
    if (r.tree().kind(a) != NodeKind::NamedArg) continue;
    const std::string_view key = r.tree().text(a);
    const NodeId value = r.tree().child(a, 0);
    if (key == "restricted" && r.truth(value)) {
      note.restricted = *r.truth(value);
    } else if (key == "valuesAttr" && r.word(value)) {
      note.valuesAttribute = *r.word(value);
    } else if (key == "restricted" || key == "valuesAttr") {
      r.warn(a, "'" + std::string(key) + "' is not understood in '@Enum'",
             "it takes values, 'valuesAttr=name' and 'restricted=true'");
    }
  }
  readEnumValues(r, note);
  if (!r.warned()) out.choices = note;
}

constexpr std::string_view kRangeNames = "min max stepsize restricted step_size step";

bool isNameOf(std::string_view names, std::string_view name) {
  return (" " + std::string(names) + " ").find(" " + std::string(name) + " ") != std::string::npos;
}

// The old form with a name for each value, as a choice is shown: (Low=0, High=1).
bool hasLabels(const NoteReader& r) {
  bool labels = false;
  for (const NodeId a : r.arguments()) {
    if (r.tree().kind(a) != NodeKind::NamedArg) continue;
    const std::string_view key = r.tree().text(a);
    // Beside a bound every other name is a slip of one.
    if (isNameOf(kRangeNames, key)) return false;
    labels = true;
  }
  return labels;
}

// The values alone: an attribute holds the value, and the label is what an editor would show.
void readLabels(NoteReader& r, Annotations& out) {
  EnumNote choices;
  for (const NodeId a : r.arguments()) {
    const bool named = r.tree().kind(a) == NodeKind::NamedArg;
    const NodeId value = named ? r.tree().child(a, 0) : a;
    if (const auto n = r.number(value)) {
      choices.values.push_back({true, *n, {}});
    } else if (const auto b = r.truth(value)) {
      choices.values.push_back({false, 0, *b ? "true" : "false"});
    } else if (const auto s = r.word(value)) {
      choices.values.push_back({false, 0, *s});
    } else {
      r.warn(a, "a value of '@Range' is a number or a text in quotes");
    }
  }
  out.choices = choices;
}

// Numbers in order (min, max, step) or by name; strings and labels make it an enumeration.
void readRange(NoteReader& r, Annotations& out) {
  if (hasLabels(r)) return readLabels(r, out);
  RangeNote note;
  double* const places[] = {&note.min, &note.max, &note.step};
  size_t next = 0;
  bool hasMost = false;
  for (const NodeId a : r.arguments()) {
    if (r.string(a)) {
      EnumNote choices;
      readEnumValues(r, choices);
      out.choices = choices;
      return;
    }
    const bool isNamed = r.tree().kind(a) == NodeKind::NamedArg;
    const NodeId value = isNamed ? r.tree().child(a, 0) : a;
    const std::string_view key = isNamed ? r.tree().text(a) : std::string_view();
    const auto n = r.number(value);
    if (isNamed && !isNameOf(kRangeNames, key)) continue;
    if (key == "restricted" && r.truth(value)) {
      note.restricted = *r.truth(value);
    } else if (n && (key == "min" || key == "max" || key == "stepsize" || key == "step_size" ||
                     key == "step")) {
      *places[key == "min" ? 0 : key == "max" ? 1 : 2] = *n;
      hasMost = hasMost || key == "max";
    } else if (n && !isNamed && next < 3) {
      *places[next++] = *n;
      hasMost = hasMost || next == 2;
    } else {
      r.warn(a, "this argument of '@Range' is not understood",
             "write '@Range(min=0, max=10, stepsize=1, restricted=true)'");
    }
  }
  if (next == 1 && !hasMost) {
    r.warn(r.node(), "this '@Range' has one number, and needs a least and a greatest one");
    return;
  }
  if (hasMost && note.max < note.min) {
    r.warn(
        r.node(), "the least value of this '@Range' is above the greatest",
        "write '@Range(min=" + shortestText(note.max) + ", max=" + shortestText(note.min) + ")'");
    return;
  }
  out.range = note;
}

void readGroup(NoteReader& r, Annotations& out) {
  out.group = {};
  for (const NodeId a : r.arguments()) {
    if (r.tree().kind(a) == NodeKind::NamedArg) continue;
    if (const auto s = r.word(a)) {
      out.group.path.push_back(*s);
      const std::string text = "\"" + *s + "\"";
      if (!r.string(a)) {
        r.warn(a, "the name of a group stands in quotes", "write " + text, text);
      }
    } else if (const auto n = r.number(a)) {
      out.group.order = *n;
    } else {
      r.warn(a, "'@Group' takes names of groups and a number");
    }
  }
}

void readOrder(NoteReader& r, Annotations& out) {
  if (r.arguments().size() == 1) out.order = r.number(r.arguments()[0]);
  if (!out.order) r.warn(r.node(), "'@Order' takes one number");
}

void readHidden(NoteReader& r, Annotations& out) {
  for (const NodeId a : r.arguments()) {
    if (const auto name = r.word(a)) out.hiddenNames.push_back(*name);
  }
  if (out.hiddenNames.empty()) out.hidden = true;
}

void readFile(NoteReader& r, Annotations& out) {
  out.file = FileNote::File;
  for (const NodeId a : r.arguments()) {
    if (const auto s = r.string(a)) out.extensions.push_back(*s);
  }
}

void readOut(NoteReader& r, Annotations& out) {
  for (const NodeId a : r.arguments()) {
    if (r.tree().kind(a) != NodeKind::NamedArg) continue;
    const auto value = r.word(r.tree().child(a, 0));
    if (r.tree().text(a) == "granularity" && value)
      out.separateShapes = *value == "separatedShapes";
  }
}

void readPreferredSize(NoteReader& r, Annotations& out) {
  std::array<double, 3> size{};
  bool good = r.arguments().size() == 3;
  for (size_t i = 0; good && i < 3; ++i) {
    const auto n = r.number(r.arguments()[i]);
    good = n && *n >= 0 && *n < 1e9;
    if (good) size[i] = *n;
  }
  if (good) {
    out.preferredSize = size;
  } else {
    r.warn(r.node(), "'@PreferredSize' takes three sizes, of which 0 is any size");
  }
}

// A value of a handle as it is written: a word, the name of a rule or an attribute, a text, a
// number, a truth value, a list {a, b}, or a rule with the number of its parameters, Window^2.
std::string handleText(const NoteReader& r, NodeId value) {
  const Tree& t = r.tree();
  if (value == kNoNode) return {};
  if (const auto n = r.number(value)) return shortestText(*n);
  if (const auto b = r.truth(value)) return *b ? "true" : "false";
  if (t.kind(value) == NodeKind::Index) {
    return handleText(r, t.child(value, 0)) + "^" + handleText(r, t.child(value, 1));
  }
  if (t.kind(value) != NodeKind::BraceList) return std::string(t.text(value));
  std::string out;
  for (const NodeId item : t.children(value)) {
    out += (out.empty() ? "" : ",") + handleText(r, item);
  }
  return "{" + out + "}";
}

// A name or a kind close to one that handles have was meant to be that. Others may be known to
// other programs.
void warnOfHandleWords(NoteReader& r, NodeId argument) {
  static const std::vector<std::string_view> kKeys = {"shape",  "type",      "axis", "reference",
                                                      "align",  "slip",      "skin", "occlusion",
                                                      "repeat", "translate", "color"};
  static const std::vector<std::string_view> kTypes = {"linear", "move",     "angular",
                                                       "toggle", "selector", "color"};
  const auto tell = [&](std::string_view word, const std::vector<std::string_view>& known) {
    if (std::find(known.begin(), known.end(), word) != known.end()) return;
    const std::string nearest = nearestName(word, known);
    if (nearest.empty()) return;
    r.warn(argument, "'" + std::string(word) + "' is not understood in '@Handle'",
           "did you mean '" + nearest + "'?");
  };
  const std::string_view key = r.tree().text(argument);
  tell(key, kKeys);
  if (key == "type") tell(r.word(r.tree().child(argument, 0)).value_or(""), kTypes);
}

void readHandle(NoteReader& r, Annotations& out) {
  HandleNote handle;
  for (const NodeId a : r.arguments()) {
    const bool named = r.tree().kind(a) == NodeKind::NamedArg;
    if (named) {
      warnOfHandleWords(r, a);
      handle.emplace_back(r.tree().text(a), handleText(r, r.tree().child(a, 0)));
    } else {
      r.warn(a, "each argument of '@Handle' has a name");
    }
  }
  out.handles.push_back(std::move(handle));
}

struct NoteKind {
  std::string_view name;
  void (*read)(NoteReader&, Annotations&);
  /// How it is written; empty where it takes nothing.
  std::string_view example = "";
  /// What arguments may be called, with blanks between; "*" where the reader looks at the names.
  std::string_view names = "";
};

constexpr NoteKind kNotes[] = {
    {"Angle", [](NoteReader&, Annotations& o) { o.unit = UnitNote::Angle; }},
    {"Color", [](NoteReader&, Annotations& o) { o.color = true; }},
    {"Description", [](NoteReader& r, Annotations& o) { o.description = r.oneString(); },
     "@Description(\"Metres to the eaves\")"},
    {"Directory", [](NoteReader&, Annotations& o) { o.file = FileNote::Directory; }},
    {"DisplayName", [](NoteReader& r, Annotations& o) { o.displayName = r.oneString(); },
     "@DisplayName(\"Height\")"},
    {"Distance", [](NoteReader&, Annotations& o) { o.unit = UnitNote::Distance; }},
    {"Enum", readEnum, "@Enum(\"brick\", \"stone\")", "restricted valuesAttr"},
    {"File", readFile},
    {"Group", readGroup, "@Group(\"Building\", 1)"},
    {"Handle", readHandle, "@Handle(shape = Wall, axis = y)", "*"},
    {"Hidden", readHidden},
    {"InLine", [](NoteReader&, Annotations& o) { o.input = InputNote::Line; }},
    {"InMesh", [](NoteReader&, Annotations& o) { o.input = InputNote::Mesh; }},
    {"InPoint", [](NoteReader&, Annotations& o) { o.input = InputNote::Point; }},
    {"InPointCloud", [](NoteReader&, Annotations& o) { o.input = InputNote::PointCloud; }},
    {"InPolygon", [](NoteReader&, Annotations& o) { o.input = InputNote::Polygon; }},
    {"Label", [](NoteReader& r, Annotations& o) { o.label = r.oneString(); }, "@Label(\"window\")"},
    {"MaterialFile", [](NoteReader&, Annotations& o) { o.file = FileNote::MaterialFile; }},
    {"Order", readOrder, "@Order(1)"},
    {"Out", readOut, "", "granularity"},
    {"Percent", [](NoteReader&, Annotations& o) { o.unit = UnitNote::Percent; }},
    {"PreferredSize", readPreferredSize, "@PreferredSize(4, 3, 0)"},
    {"Range", readRange, "@Range(min=0, max=10)", kRangeNames},
    {"RuleFileDescription", [](NoteReader&, Annotations&) {}},
    {"StartRule", [](NoteReader&, Annotations& o) { o.startRule = true; }},
};

// Arguments with a name that the annotation does not have say nothing.
void warnOfNames(NoteReader& r, const NoteKind& kind) {
  // The labels of the old form are no names of arguments.
  if (kind.names == "*" || (kind.name == "Range" && hasLabels(r))) return;
  std::vector<std::string_view> known;
  for (std::string_view rest = kind.names; !rest.empty();) {
    const size_t end = std::min(rest.find(' '), rest.size());
    known.push_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  for (const NodeId a : r.arguments()) {
    const std::string_view name = r.tree().text(a);
    if (r.tree().kind(a) != NodeKind::NamedArg || isNameOf(kind.names, name)) continue;
    const std::string nearest = didYouMean(name, known);
    std::string list;
    // Other spellings of a name stand behind the last.
    for (size_t i = 0; i < known.size() && i < 4; ++i) {
      list += (i ? ", " : "") + std::string(known[i]);
    }
    r.warn(a, "'@" + std::string(kind.name) + "' has no argument '" + std::string(name) + "'",
           !nearest.empty() ? nearest
           : list.empty()   ? "its arguments have no names"
                            : "the names of its arguments are: " + list);
  }
}

}  // namespace

Annotations readAnnotations(const Tree& tree, NodeId list, GroupNote& group,
                            Diagnostics* diagnostics) {
  Annotations out;
  out.group = group;
  for (const NodeId id : tree.children(list)) {
    const std::string_view name = tree.text(id);
    const auto known = std::find_if(std::begin(kNotes), std::end(kNotes),
                                    [&](const NoteKind& k) { return k.name == name; });
    // Of arguments that could not be read only a part is there, which must not bind anyone.
    if (tree.has(id, kFlagBroken)) continue;
    if (known != std::end(kNotes)) {
      NoteReader reader(tree, id, diagnostics, known->example);
      warnOfNames(reader, *known);
      known->read(reader, out);
    } else if (diagnostics) {
      std::vector<std::string_view> names;
      for (const NoteKind& k : kNotes) names.push_back(k.name);
      const std::string nearest = nearestName(name, names);
      const std::string none = "there is no annotation '@" + std::string(name) + "'";
      if (nearest.empty()) {
        diagnostics->warning("unknown-annotation", tree.span(id), none + "; it has no effect");
        continue;
      }
      diagnostics->error("unknown-annotation", tree.span(id), none,
                         "did you mean '@" + nearest + "'?");
      const uint32_t begin = tree.span(id).begin + 1;
      const auto end = begin + static_cast<uint32_t>(name.size());
      diagnostics->fixLast({tree.file(), begin, end}, nearest);
    }
  }
  group = out.group;
  return out;
}

void addInherited(const Annotations& base, bool withGroup, Annotations& own) {
  if (own.description.empty()) own.description = base.description;
  if (own.displayName.empty()) own.displayName = base.displayName;
  if (!own.order) own.order = base.order;
  if (withGroup) own.group = base.group;
  if (own.unit == UnitNote::None) own.unit = base.unit;
  if (own.handles.empty()) own.handles = base.handles;
  own.hidden = own.hidden || base.hidden;
  if (own.range || own.choices || own.color || own.file != FileNote::None) return;
  own.range = base.range;
  own.choices = base.choices;
  own.color = base.color;
  own.file = base.file;
  own.extensions = base.extensions;
}

}  // namespace gable::lang
