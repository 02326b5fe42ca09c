// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// What can be written at a caret. What stands there decides what is proposed at all: operations and
// rules in the body of a rule, values in an expression, the words that a parameter knows in its
// place. Of these only what begins as the typed word does, or whose capitals do, is offered, and a
// new name that is being written is offered as well, first, so that Enter keeps it.

#include <algorithm>
#include <set>

#include "base/text.h"
#include "language/forms.h"
#include "language/service.h"
#include "language/words.h"

namespace gable::language {

using lang::kNoNode;
using lang::NodeId;
using lang::NodeKind;
using lang::Tree;

namespace {

/// More than a person looks through.
constexpr size_t kMostItems = 400;
constexpr size_t kMostFiles = 300;

bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }

bool beginsWith(std::string_view name, std::string_view typed) {
  if (typed.size() > name.size()) return false;
  for (size_t i = 0; i < typed.size(); ++i) {
    if (lowerCase(name[i]) != lowerCase(typed[i])) return false;
  }
  return true;
}

// "rG" for roofGable, "sx" for scope.sx: the beginnings of the parts of a name.
bool humps(std::string_view name, std::string_view typed) {
  size_t at = 0;
  for (size_t i = 0; i < name.size() && at < typed.size(); ++i) {
    const bool part = i == 0 || isUpper(name[i]) || name[i - 1] == '.' || name[i - 1] == '_';
    if (part && beginsWith(name.substr(i), typed.substr(at))) return true;
    if (part && lowerCase(name[i]) == lowerCase(typed[at])) ++at;
  }
  return at == typed.size();
}

struct KnownNote {
  const char* name;
  const char* text;
  const char* summary;
};

constexpr KnownNote kNotes[] = {
    {"StartRule", "StartRule", "A derivation begins with this rule."},
    {"Range", "Range(min=${1:0}, max=${2:10})", "A slider; values outside are moved inside."},
    {"Enum", "Enum(\"${1:one}\", \"${2:two}\")", "One of a list."},
    {"Color", "Color", "A colour."},
    {"File", "File(\"${1:obj}\")", "A file of the project."},
    {"Directory", "Directory", "A folder of the project."},
    {"MaterialFile", "MaterialFile", "A material file of the project."},
    {"Group", "Group(\"${1:Name}\")", "The group in forms, for what follows too."},
    {"Order", "Order(${1:1})", "The place within the group."},
    {"Hidden", "Hidden", "Not shown in forms."},
    {"Description", "Description(\"${1:text}\")", "Shown beside the name."},
    {"DisplayName", "DisplayName(\"${1:Name}\")", "The name that forms show."},
    {"Label", "Label(\"${1:window}\")", "What shapes of this rule are, in data sets."},
    {"Handle", "Handle", "A handle in the view."},
    {"Angle", "Angle", "In degrees."},
    {"Distance", "Distance", "In metres."},
    {"Percent", "Percent", "A share."},
    {"PreferredSize", "PreferredSize(${1:4}, ${2:3}, ${3:0})",
     "What splitRepeat, splitGrid and margin fit shapes of this rule to; 0: any size."},
    {"InPolygon", "InPolygon", "The start shape is a polygon."},
    {"InMesh", "InMesh", "The start shape is a mesh."},
    {"InLine", "InLine", "The start shape is a line."},
    {"InPoint", "InPoint", "The start shape is a point."},
    {"Out", "Out(granularity=separatedShapes)", "Each shape stands alone in the result."},
};

struct KnownColour {
  const char* hex;
  const char* of;
};

constexpr KnownColour kColours[] = {
    {"#f2f0ea", "white plaster"}, {"#d8c7a4", "sandstone"}, {"#b5533c", "brick"},
    {"#8f8f8a", "concrete"},      {"#4a4f55", "slate"},     {"#b86f50", "roof tiles"},
    {"#7c5a3a", "wood"},          {"#9fb8c8", "glass"},     {"#2f2f2f", "iron"},
    {"#cfc0a0", "gravel"},        {"#6fa854", "grass"},     {"#6f9fc0", "water"},
};

bool isPicture(std::string_view path) {
  for (const char* const end : {".png", ".jpg", ".jpeg", ".gif", ".webp", ".bmp"}) {
    if (lowerCase(path).ends_with(end)) return true;
  }
  return false;
}

// What a parameter of texts is asked for, by its name: files of the project.
bool namesFiles(std::string_view parameter) {
  return parameter == "filePath" || parameter == "filePathList" || parameter == "path" ||
         parameter == "searchQuery";
}

class Completer {
 public:
  Completer(Library& library, const std::string& path, const Lexed& lexed, uint32_t offset)
      : library_(library),
        path_(path),
        lexed_(lexed),
        catalogue_(library.catalogue()),
        cursor_(cursorAt(lexed, offset, library.catalogue())) {}

  Completions run() {
    switch (cursor_.spot) {
      case Spot::Nothing: break;
      case Spot::Declaration: declarations(); break;
      case Spot::Successor: successors(); break;
      case Spot::Value: values(); break;
      case Spot::Size: sizes(); break;
      case Spot::Selector: selectors(); break;
      case Spot::Annotation: annotations(); break;
      case Spot::AnnotationArgument: annotationArguments(); break;
      case Spot::String: strings(); break;
    }
    std::stable_sort(out_.items.begin(), out_.items.end(),
                     [](const Completion& a, const Completion& b) { return a.order < b.order; });
    if (out_.items.size() > kMostItems) {
      out_.items.resize(kMostItems);
      out_.partial = true;
    }
    const Range range = lexed_.text.range(cursor_.wordBegin, cursor_.wordEnd);
    for (Completion& c : out_.items) c.range = range;
    return std::move(out_);
  }

 private:
  Completion* add(std::string_view label, NameKind kind, std::string_view detail,
                  std::string_view summary, uint32_t order) {
    const std::string_view typed = cursor_.typed;
    const bool direct = beginsWith(label, typed);
    if (!direct && !humps(label, typed)) return nullptr;
    if (!seen_.emplace(label).second) return nullptr;
    Completion c;
    c.label = c.text = label;
    c.kind = kind;
    c.detail = detail;
    c.summary = summary;
    c.order = order + (direct ? 0 : 100);
    out_.items.push_back(std::move(c));
    return &out_.items.back();
  }

  void addSnippet(std::string_view label, NameKind kind, std::string_view detail,
                  std::string_view summary, uint32_t order, std::string text) {
    Completion* c = add(label, kind, detail, summary, order);
    if (!c) return;
    c->text = std::move(text);
    c->snippet = c->text.find('$') != std::string::npos;
  }

  const Snapshot* snapshot() {
    if (!snapshot_) snapshot_ = library_.latest(path_);
    return snapshot_.get();
  }

  // --- Names of the file and of its imports ---

  // What `wanted` takes of the text's own declarations, as they were last analysed.
  template <class Wanted>
  void own(Wanted wanted) {
    if (const Snapshot* s = snapshot()) declared(s->tree(0), "", 10, wanted);
  }

  // What `wanted` takes of a file's declarations, under a prefix.
  template <class Wanted>
  void declared(const Tree& tree, const std::string& prefix, uint32_t order, Wanted wanted) {
    for (const Declared& d : declaredIn(tree)) {
      if (!wanted(d.kind) || d.word == cursor_.typed) continue;
      const std::string name = prefix + std::string(d.word);
      Completion* c = add(name, d.kind, "", "", order);
      if (c) c->detail = headText(tree, d.node);
      const size_t parameters = tree.children(paramsOf(tree, d.node)).size();
      if (!c || parameters == 0 || d.kind == NameKind::Attribute) continue;
      c->text = name + "(";
      for (size_t i = 0; i < parameters; ++i) {
        const NodeId p = tree.children(paramsOf(tree, d.node))[i];
        c->text +=
            (i > 0 ? ", ${" : "${") + std::to_string(i + 1) + ":" + std::string(tree.text(p)) + "}";
      }
      c->text += ")";
      c->snippet = true;
    }
  }

  // "imp.": what the imports offer, as deep as the typed word goes.
  template <class Wanted>
  void imported(Wanted wanted) {
    const Snapshot* s = snapshot();
    if (!s) return;
    std::string prefix;
    uint32_t unit = 0;
    std::string_view rest = cursor_.typed;
    for (size_t dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
      unit = importedUnit(*s, unit, rest.substr(0, dot));
      if (unit == lang::kNone) return;
      prefix += std::string(rest.substr(0, dot + 1));
      rest.remove_prefix(dot + 1);
    }
    if (unit != 0) declared(s->tree(unit), prefix, 10, wanted);
    const Tree& t = s->tree(unit);
    for (const NodeId d : t.children(t.root())) {
      if (t.kind(d) != NodeKind::Import) continue;
      const NodeId file = t.child(d, 1);
      add(prefix + std::string(t.text(d)), NameKind::Import,
          file == kNoNode ? std::string_view() : t.text(file), "", 30);
    }
  }

  void keyword(const char* word, const char* summary, uint32_t order, const char* text = nullptr) {
    addSnippet(word, NameKind::Keyword, "", summary, order, text ? text : word);
  }

  // --- Spots ---

  void declarations() {
    keyword("attr", "An attribute, which people set.", 20, "attr ${1:name} = ${2:1}");
    keyword("const", "A value that is drawn or computed once.", 20, "const ${1:name} = ${2:1}");
    keyword("import", "The rules of another file.", 20, "import ${1:name} : \"${2}\"");
    keyword("style", "A variant of the rules above.", 20, "style ${1:Name}");
    // Rules that are called and not yet written.
    std::set<std::string_view> missing;
    if (const Snapshot* s = snapshot()) {
      for (const Name& n : namesOf(*s, 0, catalogue_)) {
        if (n.space == Space::Rule && n.unit == 0 && !n.declaration) missing.insert(n.word);
      }
      for (const Declared& d : declaredIn(s->tree(0))) missing.erase(d.word);
    }
    for (const std::string_view word : missing) {
      if (word == cursor_.typed) continue;
      addSnippet(word, NameKind::Rule, "a rule that is not written yet", "", 10,
                 std::string(word) + " -->\n  ${1:NIL}");
    }
    keep();
  }

  // A name that is being made stays what it is when Enter takes the first proposal.
  void keep() {
    const std::string_view typed = cursor_.typed;
    if (typed.empty() || !(isUpper(typed[0]) || cursor_.spot == Spot::Declaration)) return;
    const bool exact = std::any_of(out_.items.begin(), out_.items.end(),
                                   [&](const Completion& c) { return c.label == typed; });
    if (exact || out_.items.empty()) return;
    Completion c;
    c.label = c.text = typed;
    c.kind = NameKind::Leaf;
    c.detail = cursor_.spot == Spot::Declaration ? "as it is written" : "a new name";
    c.order = 0;
    c.preselect = true;
    out_.items.push_back(std::move(c));
  }

  void operation(const OpSpec& op, uint32_t order) {
    const std::optional<Callable> c = callableOf(catalogue_, op.name, true);
    addSnippet(op.name, NameKind::Operation, label(*c), op.summary, order, example(*c));
  }

  void successors() {
    own([](NameKind k) { return k == NameKind::Rule; });
    imported([](NameKind k) { return k == NameKind::Rule; });
    if (cursor_.typed.find('.') == std::string_view::npos) {
      for (const OpSpec* op : catalogue_.operations) operation(*op, 20);
      keyword("case", "One of several, by a condition.", 40,
              "case ${1:true} : ${2:NIL}\nelse : NIL");
      keyword("else", "What is left.", 40);
      leaves();
      everyday();
    }
    keep();
  }

  // Leaves that the file names elsewhere.
  void leaves() {
    const Snapshot* s = snapshot();
    if (!s || s->program.modules.empty()) return;
    const Tree& t = s->tree(0);
    const lang::Module& m = s->program.modules[0];
    for (NodeId n = 1; n < t.size(); ++n) {
      if (t.kind(n) != NodeKind::Apply || m.at(n).kind != lang::RefKind::Leaf) continue;
      // What is being typed was a leaf to the last analysis.
      if (t[n].begin <= cursor_.wordBegin && cursor_.wordBegin <= t[n].end) continue;
      if (t.text(n) == cursor_.typed) continue;
      add(t.text(n), NameKind::Leaf, "a leaf", "", 60);
    }
  }

  // "cut" proposes split.
  void everyday() {
    const std::string_view typed = cursor_.typed;
    if (typed.size() < 3) return;
    for (const Alias& a : aliases()) {
      const std::optional<Callable> c = callableOf(catalogue_, a.name, true);
      if (!c || !beginsWith(a.word, typed) || beginsWith(a.name, typed)) continue;
      Completion item;
      item.label = a.name;
      item.kind = NameKind::Operation;
      item.detail = "for '" + std::string(a.word) + "': " + label(*c);
      item.summary = c->summary;
      item.text = example(*c);
      item.snippet = item.text.find('$') != std::string::npos;
      item.filter = a.word;
      item.order = 70;
      out_.items.push_back(std::move(item));
    }
  }

  void values() {
    const bool named = cursor_.call.callee == "set" && cursor_.call.successor;
    if (cursor_.atArgument && named && cursor_.call.argument == 0) return settable();
    if (cursor_.atArgument) arguments();
    expression();
  }

  // What set() can give a value.
  void settable() {
    const auto attribute = [](NameKind k) { return k == NameKind::Attribute; };
    own(attribute);
    imported(attribute);
    for (const AttributeSpec* a : catalogue_.attributes) {
      if (a->set) add(a->name, NameKind::ShapeAttribute, typeName(a->type), a->doc, 30);
    }
  }

  void expression() {
    if (cursor_.typed.find('.') == std::string_view::npos) {
      for (const std::string_view slot : cursor_.slots) {
        add(slot, NameKind::Parameter, "parameter", "", 5);
      }
    }
    const auto value = [](NameKind k) {
      return k == NameKind::Attribute || k == NameKind::Constant || k == NameKind::Function;
    };
    own(value);
    imported(value);
    for (const AttributeSpec* a : catalogue_.attributes) {
      add(a->name, NameKind::ShapeAttribute, typeName(a->type), a->doc, 30);
    }
    for (const FunctionSpec* f : catalogue_.functions) {
      const std::optional<Callable> c = callableOf(catalogue_, f->name, false);
      addSnippet(f->name, NameKind::BuiltinFunction, label(*c), f->summary, 20,
                 f->bare || f->signatures.empty() ? std::string(f->name) : example(*c));
    }
    keyword("true", "", 40);
    keyword("false", "", 40);
    if (!cursor_.inCall) keyword("case", "One of several, by a condition.", 40);
    if (!cursor_.inCall) keyword("else", "What is left.", 40);
  }

  // What the parameter in this place is asked for.
  void arguments() {
    const std::optional<Callable> c =
        callableOf(catalogue_, cursor_.call.callee, cursor_.call.successor);
    if (!c) return termArguments();
    for (const ParamSpec* p : parametersAt(*c, cursor_.call)) parameter(*p);
    if (!cursor_.call.named.empty()) return;
    for (const Signature& s : c->signatures) {
      for (size_t i = cursor_.call.argument; i < s.params.size(); ++i) {
        const std::string name = s.params[i].name;
        Completion* item = add(name + " =", NameKind::Parameter, typeText(s.params[i].type),
                               docText(s.params[i]), 7);
        if (item) item->text = name + " = ";
      }
    }
  }

  void parameter(const ParamSpec& p) {
    for (const std::string_view w : listed(p.words)) {
      add(w, NameKind::Selector, p.name, p.doc, 1);
    }
    for (const TermSpec& t : p.terms) add(t.name, NameKind::Selector, p.name, t.doc, 1);
    if (p.type == ParamType::Selector && !p.words) selectorWords(2);
  }

  // A call within a selection: side(west).
  void termArguments() {
    for (const OpSpec* op : catalogue_.operations) {
      for (const Signature& s : op->signatures) {
        for (const ParamSpec& p : s.params) {
          for (const TermSpec& t : p.terms) {
            if (t.name != cursor_.call.callee || cursor_.call.argument >= t.paramCount) continue;
            return parameter(t.params[cursor_.call.argument]);
          }
        }
      }
    }
  }

  void selectorWords(uint32_t order) {
    for (const SelectorSpec& s : catalogue_.selectors) {
      add(s.name, NameKind::Selector, "", s.doc, order);
    }
  }

  void selectors() {
    if (const OpSpec* op = catalogue_.operation(cursor_.blockOf)) {
      for (const PartSpec& p : op->parts) add(p.name, NameKind::Selector, op->name, p.doc, 1);
      if (op->isOnlyParts()) return;
    }
    selectorWords(5);
    for (const char* name : {"isTagged"}) {
      if (const std::optional<Callable> c = callableOf(catalogue_, name, false)) {
        addSnippet(name, NameKind::BuiltinFunction, label(*c), c->summary, 6, example(*c));
      }
    }
  }

  void sizes() {
    if (const OpSpec* op = catalogue_.operation(cursor_.blockOf)) {
      for (const PartSpec& p : op->parts) add(p.name, NameKind::Selector, op->name, p.doc, 1);
    }
    expression();
  }

  void annotations() {
    for (const KnownNote& n : kNotes) {
      addSnippet(n.name, NameKind::Annotation, "", n.summary, 10, n.text);
    }
  }

  void annotationArguments() {
    for (const char* word : {"min", "max", "stepsize", "restricted"}) {
      if (cursor_.owner == "Range") {
        addSnippet(word, NameKind::Parameter, "", "", 10, std::string(word) + "=");
      }
    }
    if (cursor_.owner == "Enum") {
      addSnippet("valuesAttr", NameKind::Parameter, "", "Values come from this attribute.", 10,
                 "valuesAttr=");
    }
    own([](NameKind k) { return k == NameKind::Attribute; });
  }

  // --- Files and colours ---

  void strings() {
    if (cursor_.owner == "import") return rulePaths();
    if (cursor_.typed.starts_with("#")) return colors();
    if (cursor_.atArgument && !asksForFile()) return;
    if (cursor_.atArgument && cursor_.call.callee == "set" && cursor_.call.successor && choices())
      return;
    const Picked wanted = wantedFiles();
    size_t count = 0;
    for (const std::string& asset : library_.files().assets(path_)) {
      if (wanted != Picked::Any && isPicture(asset) != (wanted == Picked::Pictures)) continue;
      if (count++ >= kMostFiles) out_.partial = true;
      if (count > kMostFiles) break;
      file(asset);
    }
  }

  enum class Picked { Any, Pictures, Models };

  // texture() and material maps take pictures, i() takes models.
  Picked wantedFiles() const {
    if (!cursor_.atArgument) return Picked::Any;
    const std::string_view callee = cursor_.call.callee;
    if (callee == "texture") return Picked::Pictures;
    if (callee == "set" && cursor_.call.first.ends_with("map")) return Picked::Pictures;
    return callee == "i" ? Picked::Models : Picked::Any;
  }

  // Offers the values of @Enum of the attribute that set() gives a value; false where it has none.
  bool choices() {
    const Snapshot* s = snapshot();
    if (!s || cursor_.call.argument == 0) return false;
    for (const lang::AttributeInfo& a : s->program.attributes) {
      if (a.qualifiedName != cursor_.call.first || !a.annotations.choices) continue;
      for (const lang::EnumValue& v : a.annotations.choices->values) {
        if (!v.isNumber) add(v.text, NameKind::Parameter, a.name, "", 5);
      }
      return true;
    }
    return false;
  }

  // Offers the words of the parameter where it has some; true where any file may stand.
  bool asksForFile() {
    const std::optional<Callable> c =
        callableOf(catalogue_, cursor_.call.callee, cursor_.call.successor);
    if (!c || std::string_view(c->name) == "set") return true;
    bool files = false;
    for (const ParamSpec* p : parametersAt(*c, cursor_.call)) {
      files = files || namesFiles(p->name);
      if (std::string_view(p->name) == "hexValue") colors();
      if (!files) parameter(*p);
    }
    return files;
  }

  void file(const std::string& name) {
    // A file is found by any part of its path.
    const std::string_view typed = cursor_.typed;
    const size_t slash = name.rfind('/');
    const std::string_view last =
        std::string_view(name).substr(slash == std::string::npos ? 0 : slash + 1);
    if (!beginsWith(name, typed) && !beginsWith(last, typed)) return;
    Completion c;
    c.label = c.text = name;
    c.kind = NameKind::File;
    c.filter = beginsWith(name, typed) ? name : std::string(last);
    c.order = 10;
    if (isPicture(name)) c.picture = pathOf(name);
    out_.items.push_back(std::move(c));
  }

  // Where an asset lies, whose name begins at the assets folder or at the root of the project.
  std::string pathOf(const std::string& asset) {
    const std::string root = library_.files().root(path_);
    const std::string within = root + "/assets/" + asset;
    return library_.files().readable(within, path_) ? within : root + "/" + asset;
  }

  void rulePaths() {
    const std::string root = library_.files().root(path_);
    for (const std::string& f : library_.files().ruleFiles(root)) {
      if (f == path_ || f.size() <= root.size() + 1 || out_.items.size() >= kMostFiles) continue;
      file(f.substr(root.size() + 1));
    }
  }

  // Colours that the file uses already, and those of common materials.
  void colors() {
    std::set<std::string> known;
    for (const lang::Token& t : lexed_.tokens.tokens) {
      if (t.kind != lang::TokenKind::String || t.end - t.begin != 9) continue;
      const std::string text = lexed_.text.content().substr(t.begin + 1, 7);
      if (text[0] == '#' && text != cursor_.typed) known.insert(text);
    }
    for (const std::string& c : known) add(c, NameKind::Color, c, "", 10);
    for (const KnownColour& c : kColours) add(c.hex, NameKind::Color, c.hex, c.of, 20);
  }

  Library& library_;
  const std::string& path_;
  const Lexed& lexed_;
  const Catalogue& catalogue_;
  Cursor cursor_;
  std::shared_ptr<const Snapshot> snapshot_;
  std::set<std::string, std::less<>> seen_;
  Completions out_;
};

// Another notation: its words and the names that the text declares; nothing in comments, strings
// and numbers.
class DialectCompleter {
 public:
  DialectCompleter(const Parsed& parsed, uint32_t offset, const Catalogue& catalogue)
      : parsed_(parsed), catalogue_(catalogue), text_(parsed.text.content()), begin_(offset) {
    for (const Word& w : wordsOf(text_)) {
      if (w.begin >= offset) break;
      if (offset > w.end) continue;
      const bool inString = w.kind == WordKind::String && offset < w.end;
      quiet_ = quiet_ || w.kind == WordKind::Comment || w.kind == WordKind::Number || inString;
      if (w.kind == WordKind::Name) begin_ = w.begin;
    }
    typed_ = text_.substr(begin_, offset - begin_);
    range_ = parsed.text.range(begin_, offset);
  }

  Completions run() {
    // What calls for proposals in rule files is part of words here.
    const char before = begin_ > 0 ? text_[begin_ - 1] : ' ';
    if (quiet_ || (typed_.empty() && std::string_view(".\"#@").find(before) != std::string::npos)) {
      return {};
    }
    for (const Declared& d : declaredIn(parsed_.tree)) {
      // What the parser has made up is not written.
      const std::string_view there =
          text_.substr(std::min<size_t>(parsed_.tree[d.node].begin, text_.size()));
      if (there.substr(0, d.word.size() + 1).find(d.word) == std::string_view::npos) continue;
      if (d.word != typed_) add(d.word, d.kind);
    }
    if (parsed_.dialect->words) {
      for (const DialectWord& w : parsed_.dialect->words()) word(w);
    }
    if (out_.items.empty()) return std::move(out_);
    const bool exact = std::any_of(out_.items.begin(), out_.items.end(),
                                   [&](const Completion& c) { return c.label == typed_; });
    if (!exact && !typed_.empty()) {
      Completion own;
      own.label = own.text = typed_;
      own.kind = NameKind::Leaf;
      own.detail = "as it is written";
      own.preselect = true;
      own.range = range_;
      out_.items.insert(out_.items.begin(), std::move(own));
    }
    return std::move(out_);
  }

 private:
  Completion* add(std::string_view label, NameKind kind) {
    if (!beginsWith(label, typed_) || !seen_.insert(label).second) return nullptr;
    Completion c;
    c.label = c.text = label;
    c.kind = kind;
    c.order = kind == NameKind::Operation ? 20 : 10;
    c.range = range_;
    out_.items.push_back(std::move(c));
    return &out_.items.back();
  }

  void word(const DialectWord& w) {
    Completion* c = add(w.name, NameKind::Operation);
    if (!c) return;
    c->detail = w.call;
    c->summary = wordText(w, catalogue_);
    if (w.snippet[0] != '\0') {
      c->text = w.snippet;
      c->snippet = true;
    }
  }

  const Parsed& parsed_;
  const Catalogue& catalogue_;
  std::string_view text_, typed_;
  uint32_t begin_;
  bool quiet_ = false;
  Range range_;
  std::set<std::string_view> seen_;
  Completions out_;
};

}  // namespace

Completions completionsAt(Library& library, const std::string& path, const Lexed& lexed,
                          uint32_t offset) {
  if (!lexed.dialect) return Completer(library, path, lexed, offset).run();
  const std::shared_ptr<const Parsed> parsed = library.parsed(path);
  if (!parsed) return {};
  return DialectCompleter(*parsed, offset, library.catalogue()).run();
}

}  // namespace gable::language
