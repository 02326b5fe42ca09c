// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The parser's state and its productions, for the files that implement them: parser.cpp
// (declarations), parse_successors.cpp (bodies of rules), parse_expressions.cpp, and
// parse_foreign.cpp (what is written as in other languages). Not included from anywhere else.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "base/diagnostic.h"
#include "lang/other_languages.h"
#include "lang/parser.h"
#include "lang/token.h"
#include "lang/tree.h"

namespace gable::lang {

class Parser {
 public:
  Parser(std::string_view text, uint32_t file, const Tokens& tokens, Diagnostics& diagnostics);

  Tree run();

 private:
  enum class Head : uint8_t { None, Rule, Function };
  using Nodes = std::vector<NodeId>;

  // A level of nesting. Not ok() when there are too many: the production returns at once.
  class Nest {
   public:
    explicit Nest(Parser& p) : p_(p) {
      if (++p_.nesting_ > kMaxNesting) p_.tooDeep();
    }
    ~Nest() { --p_.nesting_; }
    Nest(const Nest&) = delete;
    Nest& operator=(const Nest&) = delete;
    bool ok() const { return p_.nesting_ <= kMaxNesting; }

   private:
    Parser& p_;
  };

  // What a sequence of successors stands in; decides what ends it.
  struct Place {
    uint32_t blocks = 0;    // open braces and push brackets within the rule
    bool inChoice = false;  // directly in a branch
    bool inOverrides = false;
    bool comparing = false;  // in a condition that compares with '='
    bool open = false;       // in a brace that nothing closes
  };
  class Enter {
   public:
    Enter(Parser& p, Place next) : p_(p), saved_(p.place_) { p_.place_ = next; }
    ~Enter() { p_.place_ = saved_; }
    Enter(const Enter&) = delete;
    Enter& operator=(const Enter&) = delete;

   private:
    Parser& p_;
    Place saved_;
  };

  // --- Tokens (parser.cpp) ---
  const Token& current() const { return tokens_[at_]; }
  const Token& token(size_t index) const {
    return index < tokens_.size() ? tokens_[index] : tokens_.back();
  }
  const Token& ahead(size_t n) const { return token(at_ + n); }
  bool is(TokenKind kind) const { return current().kind == kind; }
  bool is(Keyword keyword) const { return current().keyword == keyword; }
  bool atEnd() const { return is(TokenKind::End); }
  std::string_view textOf(const Token& t) const { return text_.substr(t.begin, t.end - t.begin); }
  void advance() {
    if (!atEnd()) ++at_;
  }
  bool accept(TokenKind kind);
  /// Reports when it is not there: "expected ')' after the arguments".
  bool expect(TokenKind kind, const char* where);
  bool isName(const Token& t) const;
  /// Whether a token is a word, in small letters or capitals.
  bool isWord(const Token& t, std::string_view word) const;
  uint32_t endOfLast() const { return at_ == 0 ? 0 : tokens_[at_ - 1].end; }
  /// The token after an optional "(...)" that starts at `index`; `index` itself if there is none.
  size_t skipBrackets(size_t index) const;
  Head headAt(size_t index) const;
  /// True where a declaration begins. Inside blocks `name =` is a selector, so it does not count.
  bool declarationAt(size_t index, bool insideBlock) const;
  bool declarationHere() const;
  /// Goes on to the next declaration.
  void skipToDeclaration();
  void findUserWords();

  // --- Reports (parser.cpp) ---
  Span spanOf(const Token& t) const { return {file_, t.begin, t.end}; }
  void error(const char* code, Span span, std::string message, std::string hint = {});
  void warning(const char* code, Span span, std::string message, std::string hint = {});
  /// The remedy of the report just made, as an edit; nothing when it was left out.
  void fix(Span span, std::string text);
  Span spanAt(uint32_t offset) const { return {file_, offset, offset}; }
  /// At the current token: "'x' is unexpected here; expected ...".
  void unexpected(const std::string& expected, std::string hint = {});
  /// Where a value is missing: reports a colour without quotes before it, which is a comment.
  bool reportBareColour();
  std::string describe(const Token& t) const;
  void tooDeep();

  // --- Nodes (parser.cpp) ---
  Node node(NodeKind kind, uint32_t begin) const;
  NodeId make(Node n, const Nodes& children);
  NodeId named(NodeKind kind, const Token& t);
  NodeId missing();
  NodeId list(uint32_t begin, const Nodes& items) {
    return make(node(NodeKind::List, begin), items);
  }

  // --- Declarations (parser.cpp) ---
  void parseDeclaration();
  bool reportMissingComma(const std::string& annotation);
  NodeId parseAnnotation();
  NodeId parseAnnotationValue();
  NodeId parseVersion();
  NodeId parseStyle(NodeId annotations);
  bool takeColonOfImport();
  NodeId parsePathOfImport();
  NodeId parseImport(NodeId annotations);
  NodeId parseOverride();
  NodeId parseStyleNames();
  void takeTagName(const Token& first, Node& definition);
  NodeId parseDefinition(NodeId annotations, Keyword keyword);
  NodeId parseParams();
  NodeId parseLocals();
  bool isWithinRule(size_t name) const;
  void reportAfterValue(size_t name);
  bool dashesHere() const;
  bool dashCommentHere();
  size_t usesOf(std::string_view name);
  void skipDashComment();

  // --- Successors (parse_successors.cpp) ---
  NodeId parseSequence();
  bool parseSuccessor(Nodes& items);
  bool weightHere() const;
  bool separatorMissing() const;
  bool parseChoiceInSequence(Nodes& items);
  NodeId parseChoice();
  NodeId parsePercentChoice(NodeId firstWeight, uint32_t begin, bool expressions);
  NodeId parseCaseChoice(bool expressions);
  NodeId parseBranchBody(bool expressions);
  NodeId parseElse(bool expressions, bool told);
  NodeId parseApply();
  NodeId parseOperand();
  NodeId parseMember(const Token& importName, NodeId overrides, NodeKind kind);
  bool memberHere() const;
  NodeId parsePush();
  NodeId parseBlock(bool expressions);
  NodeId parseItem(bool expressions);
  bool headHere() const { return headAfter(at_); }
  bool headAfter(size_t first) const;
  bool bracketedBlockHere() const;
  NodeId parseBracketedBlock();
  void reportUnclosed(const Token& open);
  std::optional<size_t> indentOf(uint32_t at) const;
  void noteDentedCloser(const Token& open);
  bool comparesWithEqual() const;
  bool skipBadSuccessor();
  bool reportBadSuccessor();
  void expectColonOfCondition();
  NodeId parseCaseBranch(bool expressions, bool& told);
  bool caseHere() const { return is(Keyword::Case) || at_ == ifAt_; }
  bool starHere(size_t index) const;
  bool bareArgumentHere() const;
  bool wrongSeparatorHere() const;
  NodeId parseBareArgument(const Token& name);
  bool parseStarHead(NodeId& head);
  bool takeSwappedSize(NodeId& head);

  // --- Expressions (parse_expressions.cpp) ---
  NodeId parseExpression();
  // An operator as it stands in the text: what it is read as, its tokens (0: there is none), and
  // its entry where it is one of another language.
  struct Sign {
    TokenKind kind = TokenKind::End;
    size_t tokens = 0;
    const ForeignWord* foreign = nullptr;
  };
  Sign foreignSignHere() const;
  Sign wordOperatorHere() const;
  Sign operatorHere();
  bool unitAt(size_t at) const;
  void skipUnit();
  bool shareBehindAt(size_t at) const;
  NodeId takeShareBehind(NodeId number);
  bool endsBehind() const;
  bool skipPercent(NodeId left);
  bool notHere() const;
  NodeId parseNot();
  NodeId parseBinary(int minPrecedence);
  NodeId parseUnary();
  NodeId parsePostfix();
  bool commaMissing(bool matched);
  NodeId parsePrimary();
  NodeId parseNameExpression();
  NodeId parseArray();
  NodeId parseRange();
  NodeId parseIndex(NodeId base);
  NodeId parseArguments();
  NodeId parseArgument(bool matched);

  // --- What is written as in other languages (parse_foreign.cpp) ---
  bool isDeclared(std::string_view name);
  const ForeignWord* foreignAt(size_t index, ForeignUse use);
  uint32_t lineEnd(uint32_t at) const;
  /// The number of its line, from 1. Goes through the text before it.
  uint32_t lineOf(const Token& t) const;
  bool beginsLine(const Token& t) const;
  bool onOneLine(const Token& a, const Token& b) const;
  void skipForeign(const Token& first);
  bool loopHere() const;
  bool resultHere() const;
  bool takeForeignStatement();
  bool takeForeignDeclaration();
  bool assignsHere() const;
  void reportAssign(const Token& name, bool hasWord);
  void takeWrittenType(const Token& name);
  bool takeAssignment();
  bool takeForeign();
  size_t behindHead(size_t index) const;
  bool foreignArrowAt(size_t index) const;
  bool arrowOfItemHere();
  void takeArrowOfItem();
  bool acceptArrow();
  void skipTernary();
  std::string hintOfComment(char closer) const;
  size_t conditionEnd(size_t index) const;
  std::string asCase(size_t index, bool expressions, uint32_t& end) const;
  bool takeIf(bool expressions);
  NodeId parseBracedBranch(bool expressions);
  bool elseIfHere() const;
  void takeElseIf(bool told);
  bool otherwiseHere() const;

  std::string_view text_;
  uint32_t file_;
  const std::vector<Token>& tokens_;
  const std::vector<Comment>& comments_;
  Diagnostics& diagnostics_;
  Tree tree_;
  Nodes declarations_;
  Place place_;
  size_t at_ = 0;
  size_t lastErrorAt_ = SIZE_MAX;
  // The word 'if' that is read as 'case'.
  size_t ifAt_ = SIZE_MAX;
  // The part of a block that has an arrow in the place of its colon, and that arrow.
  size_t itemAt_ = SIZE_MAX;
  size_t arrowAt_ = SIZE_MAX;
  // The declaration before which a word of another language has been told of.
  size_t foreignHeadAt_ = SIZE_MAX;
  // Words of other languages that have been looked for, and whether the file declares them.
  std::unordered_map<std::string_view, bool> declaredWords_;
  /// How often each name stands in the file; empty until someone asks.
  std::unordered_map<std::string_view, size_t> nameUses_;
  size_t errors_ = 0;
  bool reported_ = false;
  uint32_t nesting_ = 0;
  // The first brace of the declaration whose closer stands further left than its own line begins:
  // that closer was meant for a brace further out.
  const Token* dented_ = nullptr;
  // Set when the rest of a declaration was given up: productions return without reports.
  bool panic_ = false;
  // Annotations never fail a file: their mistakes are warnings.
  bool inAnnotation_ = false;
  // Rules of the file named like a word that takes an operand.
  bool userWord_[static_cast<size_t>(Keyword::Intersect) + 1] = {};
};

}  // namespace gable::lang
