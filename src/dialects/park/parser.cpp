// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Recursive descent over characters. A rule ends where the next begins: at a name that an arrow or
// an equals sign follows, with parameters or without.
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>

#include "base/number.h"
#include "base/text.h"
#include "dialects/park/grammar.h"

namespace gable::park {

const Rule* Grammar::rule(std::string_view name) const {
  for (const Rule& r : rules) {
    if (r.name == name) return &r;
  }
  return nullptr;
}

namespace {

constexpr int kDeepest = 200;

bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Typographic quotes become plain ones; spans stay right because blanks fill up.
std::string plainQuotes(std::string_view text) {
  std::string out(text);
  for (size_t i = 0; i + 2 < out.size(); ++i) {
    const bool quote = out[i] == '\xe2' && out[i + 1] == '\x80' &&
                       (out[i + 2] == '\x9c' || out[i + 2] == '\x9d' || out[i + 2] == '\x9e');
    if (!quote) continue;
    const bool opens = out[i + 2] != '\x9d';
    out[i] = opens ? ' ' : '"';
    out[i + 1] = ' ';
    out[i + 2] = opens ? '"' : ' ';
  }
  return out;
}

constexpr const char* kRuleForm = "rules are written 'Name -> operations', constants 'name = 3'";

class Parser {
 public:
  Parser(std::string text, uint32_t file, Diagnostics& diagnostics)
      : text_(std::move(text)), file_(file), diagnostics_(diagnostics) {
    blankComments();
  }

  Grammar run() {
    while (!atEnd()) {
      const size_t start = at_;
      declaration();
      if (at_ == start) ++at_;
    }
    return std::move(grammar_);
  }

 private:
  // --- Characters ---

  void blankComments() {
    bool quoted = false;
    for (size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '"') quoted = !quoted;
      if (quoted) {
        if (text_[i] == '\n') quoted = false;
        continue;
      }
      const bool line = text_[i] == '#' || text_.compare(i, 2, "//") == 0,
                 block = text_.compare(i, 2, "/*") == 0;
      if (!line && !block) continue;
      size_t end = text_.find(line ? "\n" : "*/", i + (line ? 1 : 2));
      if (end == std::string::npos) {
        if (block) error("unclosed-comment", span(i, i + 2), "this comment has no end", "write */");
        end = text_.size();
      } else if (block) {
        end += 2;
      }
      for (size_t k = i; k < end; ++k) {
        if (text_[k] != '\n') text_[k] = ' ';
      }
      i = end - 1;
    }
  }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool atEnd() {
    skip();
    return at_ >= text_.size();
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool accept(std::string_view sign) {
    skip();
    if (text_.compare(at_, sign.size(), sign) != 0) return false;
    at_ += sign.size();
    return true;
  }
  std::string name() {
    skip();
    size_t end = at_;
    if (end < text_.size() && isLetter(text_[end])) {
      while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]))) ++end;
    }
    std::string out = text_.substr(at_, end - at_);
    at_ = end;
    return out;
  }
  Span span(size_t begin, size_t end) const {
    return {file_, static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
  }
  void error(const char* code, Span where, std::string message, std::string hint) {
    diagnostics_.error(code, where, std::move(message), std::move(hint));
  }
  // Where a bracket was opened that the text at hand does not close; of several the innermost.
  void unclosed(size_t open, char closer) {
    if (unclosedAt_ == at_) return;
    unclosedAt_ = at_;
    const bool ends = atEnd();
    const bool same = std::count(text_.begin() + static_cast<ptrdiff_t>(open),
                                 text_.begin() + static_cast<ptrdiff_t>(at_), '\n') == 0;
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + static_cast<ptrdiff_t>(at_), '\n');
    error(closer == '}' ? "unclosed-block" : "unclosed-bracket", span(open, open + 1),
          std::string("this '") + text_[open] + "' is never closed",
          std::string("add '") + closer + "'" +
              (ends   ? " before the end of the file"
               : same ? ""
                      : " before line " + std::to_string(line)));
  }
  void unexpected(const char* wanted, const char* hint) {
    const size_t end = std::min(at_ + 1, text_.size());
    error("unexpected-text", span(std::min(at_, end), end),
          std::string(wanted) + " was expected here", hint);
  }

  // Up to one of the signs outside of brackets and quotes; the sign is not taken.
  std::string until(std::string_view signs) {
    skip();
    const size_t start = at_;
    int depth = 0;
    bool quoted = false;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '"') quoted = !quoted;
      if (quoted) continue;
      if (depth == 0 && signs.find(c) != std::string_view::npos) break;
      if (c == '(' || c == '[' || c == '{') ++depth;
      if (c == ')' || c == ']' || c == '}') {
        if (depth == 0) break;
        --depth;
      }
    }
    size_t end = at_;
    while (end > start && std::isspace(static_cast<unsigned char>(text_[end - 1]))) --end;
    return text_.substr(start, end - start);
  }

  // --- Declarations ---

  // Whether a rule, a constant or a function begins here.
  bool declarationHere() {
    const size_t start = at_;
    const std::string first = name();
    bool is = first == "fun" && isLetter(peek());
    if (!is && !first.empty()) {
      is = accept("->") || accept("-->") || (peek() == '=' && text_.compare(at_, 2, "==") != 0);
      if (!is && accept("(")) {
        until("");
        is = accept(")") && (accept("->") || accept("-->"));
      }
    }
    at_ = start;
    return is;
  }

  void declaration() {
    const size_t start = at_;
    Rule r;
    std::string first = name();
    if (first == "fun" && isLetter(peek())) {
      r.function = true;
      first = name();
    }
    if (first.empty()) {
      unexpected("the name of a rule", kRuleForm);
      while (!atEnd() && !declarationHere()) ++at_;
      return;
    }
    r.name = first;
    r.nameSpan = span(at_ - first.size(), at_);
    if (!r.function && peek() == '=') {
      accept("=");
      return constant(r.name, r.nameSpan);
    }
    skip();
    const size_t open = at_;
    if (accept("(")) {
      while (peek() != ')' && !atEnd()) {
        parameter(r);
        if (!accept(",")) break;
      }
      if (!accept(")")) unclosed(open, ')');
    }
    if (!accept("-->") && !accept("->")) {
      unexpected("'->'", kRuleForm);
      while (!atEnd() && !declarationHere()) ++at_;
      return;
    }
    branches(r);
    r.span = span(start, at_);
    if (grammar_.rule(r.name)) {
      error("duplicate-rule", r.nameSpan, "the rule '" + r.name + "' stands here a second time",
            "give one of them another name");
      return;
    }
    grammar_.rules.push_back(std::move(r));
  }

  void parameter(Rule& r) {
    std::string parameter = name();
    if (!parameter.empty() && (peek() == ',' || peek() == ')')) {
      r.parameters.push_back(std::move(parameter));
      return;
    }
    unexpected("the name of a parameter", "parameters are names: 'Lane(width, side) -> ...'");
    until(",)");
  }

  void constant(const std::string& what, Span where) {
    skip();
    const size_t start = at_;
    // To the end of the line.
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    double v = 0;
    if (constantValue(grammar_, std::string_view(text_).substr(start, at_ - start), v)) {
      if (grammar_.constants.count(what) != 0) {
        error("bad-constant", where, "the constant '" + what + "' stands here a second time",
              "give one of them another name");
        return;
      }
      grammar_.constants[what] = v;
      std::string text = text_.substr(start, at_ - start);
      const size_t comment = std::min({text.find("//"), text.find("/*"), text.find('#')});
      if (comment != std::string::npos) text.resize(comment);
      grammar_.written.push_back({what, std::move(text), where});
    } else {
      error("bad-constant", where, "the constant '" + what + "' is no number",
            "write a number, or + - * / of numbers and constants above");
    }
  }

  void branches(Rule& r) {
    for (;;) {
      const size_t start = at_;
      Branch b;
      const std::string word = name();
      const bool isCase = word == "case", isElse = word == "else" && !r.branches.empty();
      if (!isCase && !isElse) {
        at_ = start;
        if (r.branches.empty()) {
          b.body = sequence(0);
          b.span = span(start, at_);
          r.branches.push_back(std::move(b));
        }
        return;
      }
      if (isCase) b.condition = until(":");
      if (!accept(":"))
        unexpected("':'", "write 'case condition : operations', and 'else : operations' last");
      b.body = sequence(0);
      b.span = span(start, at_);
      r.branches.push_back(std::move(b));
      if (isElse) return;
    }
  }

  // --- Sequences ---

  Sequence sequence(int depth) {
    Sequence out;
    if (depth > kDeepest) {
      if (!tooDeep_) error("nesting-too-deep", span(at_, at_), "braces are nested too deep", "");
      tooDeep_ = true;
      return out;
    }
    while (isLetter(peek()) && !declarationHere()) {
      const size_t start = at_;
      const std::string word = name();
      if (word == "case" || word == "else") {
        at_ = start;
        break;
      }
      out.push_back(operation(word, start, depth));
    }
    return out;
  }

  Op operation(const std::string& word, size_t start, int depth) {
    Op op;
    op.name = word;
    skip();
    const size_t open = at_;
    if (accept("(")) {
      op.called = true;
      while (peek() != ')' && !atEnd()) {
        skip();
        const size_t begin = at_;
        op.arguments.push_back({until(","), span(begin, at_)});
        if (!accept(",")) break;
      }
      if (!accept(")")) unclosed(open, ')');
    } else if (accept("[")) {
      op.size = until("]");
      if (!accept("]")) unclosed(open, ']');
    }
    const std::string what = lowerCase(word);
    const Parts parts = what == "choose"   ? Parts::Choices
                        : what == "select" ? Parts::Selections
                                           : Parts::Plain;
    while (peek() == '{') op.blocks.push_back(block(depth, parts));
    const size_t before = at_;
    if ((!op.blocks.empty() || op.called) && name() == "else" && peek() == '{') {
      op.hasElse = true;
      for (Part& p : block(depth, Parts::Plain).parts) {
        op.otherwise.insert(op.otherwise.end(), p.body.begin(), p.body.end());
      }
    } else {
      at_ = before;
    }
    op.span = span(start, at_);
    return op;
  }

  // Of Choose parts are divided by commas, of Select they begin with any selection.
  enum class Parts { Plain, Choices, Selections };

  Block block(int depth, Parts parts) {
    const bool choose = parts == Parts::Choices;
    Block b;
    skip();
    const size_t start = at_;
    accept("{");
    while (peek() != '}' && !atEnd()) {
      const size_t begin = at_;
      Part p;
      p.label = parts == Parts::Selections ? selectionLabel() : label();
      p.body = sequence(depth + 1);
      p.span = span(begin, at_);
      b.parts.push_back(std::move(p));
      if (!accept(choose ? "," : "|")) break;
      // An empty part at the end counts, but for a comma that is left over.
      if (peek() == '}' && !choose) b.parts.push_back({});
    }
    if (!accept("}")) {
      const bool divided = peek() == (choose ? '|' : ',');
      if (divided) {
        unexpected("'}'",
                   choose ? "parts of Choose are divided by commas" : "parts are divided by '|'");
      } else {
        unclosed(start, '}');
      }
      while (!atEnd() && peek() != '}' && !declarationHere()) ++at_;
      accept("}");
    }
    b.span = span(start, at_);
    return b;
  }

  // What stands before a colon; empty where the part has none.
  std::string selectionLabel() {
    skip();
    const size_t start = at_;
    std::string out = until(":");
    if (accept(":")) return out;
    at_ = start;
    return {};
  }

  // `0.75 :`, `25% :`, `region :`; empty where there is none.
  std::string label() {
    skip();
    const size_t start = at_;
    while (at_ < text_.size() &&
           (isLetter(text_[at_]) || isDigit(text_[at_]) ||
            std::string_view(".'% ").find(text_[at_]) != std::string_view::npos)) {
      ++at_;
    }
    std::string out = text_.substr(start, at_ - start);
    if (accept(":")) {
      while (!out.empty() && out.back() == ' ') out.pop_back();
      return out;
    }
    at_ = start;
    return {};
  }

  std::string text_;
  uint32_t file_;
  Diagnostics& diagnostics_;
  Grammar grammar_;
  size_t at_ = 0;
  size_t unclosedAt_ = SIZE_MAX;
  bool tooDeep_ = false;
};

// Numbers, constants, + - * / and brackets.
class Constant {
 public:
  Constant(const Grammar& g, std::string_view text) : g_(g), text_(text) {}
  bool run(double& v) {
    v = sum(0);
    skip();
    return ok_ && at_ == text_.size() && at_ > 0;
  }

 private:
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool accept(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  double sum(int depth) {
    double v = product(depth);
    for (;;) {
      if (accept('+')) {
        v += product(depth);
      } else if (accept('-')) {
        v -= product(depth);
      } else {
        return v;
      }
    }
  }
  double product(int depth) {
    double v = value(depth);
    for (;;) {
      if (accept('*')) {
        v *= value(depth);
      } else if (accept('/')) {
        const double by = value(depth);
        ok_ = ok_ && by != 0;
        v = by != 0 ? v / by : 0;
      } else {
        return v;
      }
    }
  }
  double value(int depth) {
    if (depth > kDeepest) ok_ = false;
    if (!ok_) return 0;
    if (accept('-')) return -value(depth + 1);
    if (accept('(')) {
      const double v = sum(depth + 1);
      ok_ = accept(')') && ok_;
      return v;
    }
    skip();
    double v = 0;
    const char* begin = text_.data() + at_;
    const char* after = readNumber(begin, text_.data() + text_.size(), v);
    if (after != begin) {
      at_ += static_cast<size_t>(after - begin);
      return v;
    }
    size_t end = at_;
    while (end < text_.size() && (isLetter(text_[end]) || isDigit(text_[end]))) ++end;
    const auto found = g_.constants.find(std::string(text_.substr(at_, end - at_)));
    ok_ = end > at_ && found != g_.constants.end();
    at_ = end;
    return ok_ ? found->second : 0;
  }

  const Grammar& g_;
  std::string_view text_;
  size_t at_ = 0;
  bool ok_ = true;
};

}  // namespace

Grammar parseGrammar(std::string_view text, uint32_t file, Diagnostics& diagnostics) {
  return Parser(plainQuotes(text), file, diagnostics).run();
}

bool constantValue(const Grammar& g, std::string_view text, double& value) {
  return Constant(g, text).run(value);
}

std::string withWords(std::string_view text, const std::map<std::string, std::string>& words) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    if (!isLetter(text[i])) {
      // What begins with a digit is no name: 3a stays.
      out += text[i++];
      continue;
    }
    size_t end = i;
    while (end < text.size() && (isLetter(text[end]) || isDigit(text[end]))) ++end;
    const std::string word(text.substr(i, end - i));
    const auto found = words.find(word);
    out += found != words.end() ? found->second : word;
    i = end;
  }
  return out;
}

Sequence withArguments(const Sequence& body, const std::map<std::string, std::string>& words) {
  Sequence out = body;
  for (Op& op : out) {
    const auto own = words.find(op.name);
    if (own != words.end() && !op.called && op.blocks.empty()) op.name = own->second;
    for (Argument& a : op.arguments) a.text = withWords(a.text, words);
    op.size = withWords(op.size, words);
    for (Block& b : op.blocks) {
      for (Part& p : b.parts) {
        p.label = withWords(p.label, words);
        p.body = withArguments(p.body, words);
      }
    }
    op.otherwise = withArguments(op.otherwise, words);
  }
  return out;
}

std::vector<std::string> argumentTexts(std::string_view call) {
  std::vector<std::string> out;
  const size_t open = call.find('(');
  if (open == std::string_view::npos || call.back() != ')') return out;
  const std::string_view inside = call.substr(open + 1, call.size() - open - 2);
  size_t begin = 0;
  int depth = 0;
  for (size_t i = 0; i <= inside.size(); ++i) {
    const char c = i < inside.size() ? inside[i] : ',';
    if (c == '(' || c == '[' || c == '{') ++depth;
    if (c == ')' || c == ']' || c == '}') --depth;
    if (c != ',' || (depth > 0 && i < inside.size())) continue;
    std::string_view one = inside.substr(begin, i - begin);
    while (!one.empty() && one.front() == ' ') one.remove_prefix(1);
    while (!one.empty() && one.back() == ' ') one.remove_suffix(1);
    out.emplace_back(one);
    begin = i + 1;
  }
  if (out.size() == 1 && out[0].empty()) out.clear();
  return out;
}

}  // namespace gable::park
