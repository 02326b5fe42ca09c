// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Three passes. Spacing looks at neighbouring tokens and says which are written without a blank
// between them. Layout walks the tree and marks the tokens that begin a line, with their indent:
// where the source begins one between two parts of a construct, so does the result, and a part that
// does not fit begins one too. Writing puts the tokens out, comments between them, and breaks what
// is still too long after commas and before operators.

#include "lang/format.h"

#include <algorithm>
#include <vector>

#include "lang/lexer.h"
#include "lang/parser.h"

namespace gable::lang {

namespace {

constexpr size_t kColumns = 120;
constexpr size_t kIndent = 2;

bool endsOperand(const Token& t) {
  switch (t.kind) {
    case TokenKind::Name: return t.keyword != Keyword::Case && t.keyword != Keyword::Else;
    case TokenKind::Number:
    case TokenKind::String:
    case TokenKind::RParen:
    case TokenKind::RBracket:
    case TokenKind::RBrace: return true;
    default: return false;
  }
}

bool isBinarySign(TokenKind k) {
  return k >= TokenKind::Plus && k <= TokenKind::Or && k != TokenKind::Not;
}

class Formatter {
 public:
  Formatter(std::string_view text, const Tokens& tokens, const Tree& tree)
      : text_(text), tokens_(tokens.tokens), comments_(tokens.comments), tree_(tree) {}

  std::string run() {
    const size_t n = tokens_.size();
    marks_.resize(n);
    findCommentsBefore();
    findAskedLines();
    markContexts();
    findSpaces();
    layoutFile();
    return write();
  }

 private:
  struct Mark {
    bool newLine = false;
    bool space = true;  // a blank before the token
    bool unary = false;
    bool softBreak = false;
    bool push = false;           // a bracket of push and pop
    bool attachedColon = false;  // of case, else and weights
    bool repeatStar = false;
    bool annotation = false;  // inside one
    uint32_t indent = 0;
    uint32_t asked = 0;         // lines that the source begins at tokens up to this one
    uint32_t firstComment = 0;  // of those before the token
    uint32_t offset = 0;        // width of all before it, on one line
  };

  // --- Places in the token list ---

  size_t tokenAt(uint32_t offset) const {
    const auto at = std::lower_bound(tokens_.begin(), tokens_.end(), offset,
                                     [](const Token& t, uint32_t o) { return t.begin < o; });
    return static_cast<size_t>(at - tokens_.begin());
  }
  size_t firstOf(NodeId id) const { return tokenAt(tree_[id].begin); }
  // One past the last token.
  size_t endOf(NodeId id) const { return tokenAt(tree_[id].end); }

  void findCommentsBefore() {
    uint32_t c = 0;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      marks_[i].firstComment = c;
      while (c < comments_.size() && comments_[c].begin < tokens_[i].begin) ++c;
    }
  }
  uint32_t commentsEnd(size_t i) const {
    return i + 1 < marks_.size() ? marks_[i + 1].firstComment
                                 : static_cast<uint32_t>(comments_.size());
  }
  void findAskedLines() {
    for (size_t i = 1; i < tokens_.size(); ++i) {
      const bool here = newlinesBetween(tokens_[i - 1].end, tokens_[i].begin) > 0;
      marks_[i].asked = marks_[i - 1].asked + (here ? 1 : 0);
    }
  }

  // --- What the tree knows of single tokens ---

  void markContexts() {
    for (NodeId id = 1; id < tree_.size(); ++id) {
      const NodeKind kind = tree_.kind(id);
      if (kind == NodeKind::Push) {
        marks_[firstOf(id)].push = true;
        marks_[endOf(id) - 1].push = true;
      } else if (kind == NodeKind::Branch) {
        markBranchColon(id);
      } else if (kind == NodeKind::Block && tree_.has(id, kFlagRepeat)) {
        marks_[endOf(id) - 1].repeatStar = true;
      } else if (kind == NodeKind::Annotation) {
        for (size_t i = firstOf(id); i < endOf(id); ++i) marks_[i].annotation = true;
      }
    }
  }

  void markBranchColon(NodeId branch) {
    const NodeId condition = tree_.child(branch, 0);
    size_t i = condition == kNoNode ? firstOf(branch) + 1 : endOf(condition);
    if (i < tokens_.size() && tokens_[i].kind == TokenKind::Percent) ++i;
    if (i < tokens_.size() && tokens_[i].kind == TokenKind::Colon) marks_[i].attachedColon = true;
  }

  // --- Spacing ---

  void findSpaces() {
    std::vector<bool> inRange;  // of the open brackets: do colons make ranges?
    uint32_t width = 0;
    for (size_t i = 0; i < tokens_.size(); ++i) {
      const Token& t = tokens_[i];
      Mark& m = marks_[i];
      const bool afterOperand = i > 0 && endsOperand(tokens_[i - 1]);
      m.unary = t.kind == TokenKind::Not ||
                ((t.kind == TokenKind::Plus || t.kind == TokenKind::Minus) && !afterOperand);
      if (t.kind == TokenKind::LParen || t.kind == TokenKind::LBrace) inRange.push_back(false);
      if (t.kind == TokenKind::LBracket) inRange.push_back(!m.push);
      const bool range = !inRange.empty() && inRange.back();
      m.space = i > 0 && spaceBefore(i, range);
      const bool closes = t.kind == TokenKind::RParen || t.kind == TokenKind::RBracket ||
                          t.kind == TokenKind::RBrace;
      if (closes && !inRange.empty()) inRange.pop_back();
      const bool afterComma = i > 0 && tokens_[i - 1].kind == TokenKind::Comma;
      const bool sign = isBinarySign(t.kind) && !m.unary && !m.repeatStar &&
                        !(t.kind == TokenKind::Percent && tokens_[i + 1].kind == TokenKind::Colon);
      m.softBreak = afterComma || sign || t.kind == TokenKind::Pipe;
      width += (m.space ? 1 : 0);
      m.offset = width;
      width += t.end - t.begin;
    }
  }

  // Between the tokens i - 1 and i; `range`: directly within brackets of an array or index.
  bool spaceBefore(size_t i, bool range) const {
    const Token& a = tokens_[i - 1];
    const Token& b = tokens_[i];
    const bool note = marks_[i].annotation && marks_[i - 1].annotation;
    switch (a.kind) {
      case TokenKind::LParen:
      case TokenKind::At:
      case TokenKind::Tilde:
      case TokenKind::Quote: return false;
      case TokenKind::LBracket: return marks_[i - 1].push;
      case TokenKind::LBrace: return !note;
      case TokenKind::Caret: return false;
      case TokenKind::Equal:
        if (note) return false;
        break;
      case TokenKind::Colon:
        if (range) return false;
        break;
      case TokenKind::Dot:
        // imp(a = 1).Rule
        if (i >= 2 && tokens_[i - 2].kind == TokenKind::RParen && a.end == b.begin &&
            b.kind == TokenKind::Name) {
          return false;
        }
        break;
      default:
        // Two signs in a row would become another sign.
        if (marks_[i - 1].unary) return marks_[i].unary;
        break;
    }
    switch (b.kind) {
      case TokenKind::Comma:
      case TokenKind::Semicolon:
      case TokenKind::RParen:
      case TokenKind::Dot:
      case TokenKind::Caret: return false;
      case TokenKind::RBracket: return marks_[i].push;
      case TokenKind::RBrace: return !note;
      case TokenKind::Colon: return !marks_[i].attachedColon && !range;
      case TokenKind::Equal: return !note;
      case TokenKind::Percent: return tokens_[i + 1].kind != TokenKind::Colon;
      case TokenKind::Star: return !marks_[i].repeatStar;
      case TokenKind::LParen: {
        const bool word =
            a.keyword == Keyword::Case || a.keyword == Keyword::Else || a.keyword == Keyword::With;
        return a.kind != TokenKind::Name || word;
      }
      case TokenKind::LBracket: return marks_[i].push || !endsOperand(a);
      default: return true;
    }
  }

  // --- Layout ---

  size_t width(size_t first, size_t end) const {
    if (end <= first) return 0;
    const Token& last = tokens_[end - 1];
    return marks_[end - 1].offset + (last.end - last.begin) - marks_[first].offset;
  }

  // Whether the source begins a line at a token.
  bool asked(size_t token) const { return marks_[token].asked > marks_[token - 1].asked; }
  bool askedWithin(size_t first, size_t end) const {
    return end > first && marks_[end - 1].asked > marks_[first].asked;
  }

  // One past the closing brackets that follow.
  size_t withClosers(size_t end) const {
    while (end < tokens_.size() &&
           (tokens_[end].kind == TokenKind::RBrace || tokens_[end].kind == TokenKind::RBracket ||
            marks_[end].repeatStar)) {
      ++end;
    }
    return end;
  }

  // Whether the line in hand can go on up to there.
  bool fitsHere(size_t end) const {
    return lineIndent_ + width(lineFirst_, withClosers(end)) <= kColumns;
  }
  // Whether [first, end) stays as it is on the line in hand.
  bool stays(size_t first, size_t end) const { return !askedWithin(first, end) && fitsHere(end); }

  void breakBefore(size_t token, size_t indent) {
    marks_[token].newLine = true;
    marks_[token].indent = static_cast<uint32_t>(indent);
    lineFirst_ = token;
    lineIndent_ = indent;
  }

  // A part of a construct begins a line where the source says so or where it does not fit else.
  void place(size_t first, size_t end, size_t indent) {
    // Behind an opening bracket a new line would give no room.
    const bool atStart = lineIndent_ + width(lineFirst_, first) <= indent;
    if (asked(first) || (!fitsHere(end) && !atStart)) breakBefore(first, indent);
  }
  void placeCloser(size_t token, size_t indent) {
    if (asked(token)) breakBefore(token, indent);
  }

  void layoutFile() {
    size_t previousEnd = 0;
    for (const NodeId id : tree_.children(tree_.root())) {
      size_t first = firstOf(id);
      // The keyword before the name belongs to the declaration.
      if (first > previousEnd && tokens_[first - 1].keyword != Keyword::None &&
          tokens_[first - 1].begin >= (previousEnd ? tokens_[previousEnd - 1].end : 0) &&
          !isPlain(id) && !marks_[first - 1].annotation) {
        --first;
      }
      layoutDeclaration(id, first);
      previousEnd = endOf(id);
    }
    breakBefore(tokens_.size() - 1, 0);
  }

  bool isPlain(NodeId id) const {
    return tree_.kind(id) == NodeKind::Annotation || tree_.kind(id) == NodeKind::Version;
  }

  void layoutDeclaration(NodeId id, size_t first) {
    if (isPlain(id)) return breakBefore(first, 0);
    if (layoutAnnotations(annotationsOf(tree_, id))) {
      place(first, endOf(id), 0);
    } else {
      breakBefore(first, 0);
    }
    switch (tree_.kind(id)) {
      case NodeKind::Import: return layoutImport(id);
      case NodeKind::Rule: return layoutRule(id);
      case NodeKind::Style: return;
      default: return layoutValue(id);
    }
  }

  // @Group speaks for what follows too and stands alone. True when the declaration may go on
  // behind.
  bool layoutAnnotations(NodeId list) {
    bool alone = true;
    for (const NodeId note : tree_.children(list)) {
      const bool group = tree_.text(note) == "Group";
      if (alone || group) {
        breakBefore(firstOf(note), 0);
      } else {
        place(firstOf(note), endOf(note), 0);
      }
      alone = group;
    }
    return !alone;
  }

  void layoutImport(NodeId id) {
    const NodeId overrides = tree_.child(id, 3);
    if (overrides == kNoNode) return;
    for (const NodeId item : tree_.children(overrides)) {
      place(firstOf(item), endOf(item), kIndent);
      if (tree_.kind(item) == NodeKind::Rule) layoutBody(bodyOf(tree_, item), kIndent);
    }
    placeCloser(endOf(overrides) - 1, 0);
  }

  void layoutLocals(NodeId id) {
    const NodeId locals = localsOf(tree_, id);
    if (locals == kNoNode) return;
    for (const NodeId local : tree_.children(locals)) {
      place(firstOf(local), endOf(local), 2 * kIndent);
      layoutExpression(tree_.child(local, 0), 2 * kIndent);
    }
    placeCloser(endOf(locals) - 1, 0);
  }

  void layoutValue(NodeId id) {
    layoutLocals(id);
    const NodeId value = bodyOf(tree_, id);
    if (tree_.kind(value) == NodeKind::Choice) place(firstOf(value), endOf(value), kIndent);
    layoutExpression(value, kIndent);
  }

  void layoutRule(NodeId id) {
    layoutLocals(id);
    const NodeId body = bodyOf(tree_, id);
    const auto parts = tree_.children(body);
    // Choices of a rule have a line for each branch.
    if (parts.size() == 1 && tree_.kind(parts[0]) == NodeKind::Choice) {
      for (const NodeId branch : tree_.children(parts[0])) {
        breakBefore(firstOf(branch), kIndent);
        layoutBody(tree_.child(branch, 1), 2 * kIndent);
      }
      return;
    }
    layoutBody(body, kIndent);
  }

  void layoutBody(NodeId sequence, size_t indent) {
    for (const NodeId s : tree_.children(sequence)) {
      place(firstOf(s), endOf(s), indent);
      if (!stays(firstOf(s), endOf(s))) layoutSuccessor(s, indent);
    }
  }

  void layoutSuccessor(NodeId id, size_t indent) {
    switch (tree_.kind(id)) {
      case NodeKind::Choice: return layoutChoice(id, indent);
      case NodeKind::Push:
        layoutBody(tree_.child(id, 0), indent + kIndent);
        return placeCloser(endOf(id) - 1, indent);
      case NodeKind::Apply: return layoutApply(id, indent);
      default: return;
    }
  }

  void layoutApply(NodeId id, size_t indent) {
    const NodeId args = tree_.child(id, 0);
    for (const NodeId a : tree_.children(args)) layoutExpression(a, indent + kIndent);
    const auto children = tree_.children(id);
    for (size_t i = 1; i < children.size(); ++i) {
      // The operand of `inline` goes on where its word stands.
      if (tree_.has(id, kFlagOperand)) {
        const NodeId item = tree_.child(children[i], 0);
        for (const NodeId s : tree_.children(tree_.child(item, 2))) layoutApply(s, indent);
        continue;
      }
      if (i > 1) place(firstOf(children[i]), endOf(children[i]), indent);
      layoutBlock(children[i], indent);
    }
  }

  // Items behind the first begin with their '|', which stands under the first item of a block that
  // opens on a line of its own.
  void layoutBlock(NodeId block, size_t indent) {
    if (stays(firstOf(block), endOf(block))) return;
    const size_t end = endOf(block) - (tree_.has(block, kFlagRepeat) ? 2 : 1);
    for (const NodeId item : tree_.children(block)) {
      const size_t first = firstOf(item);
      const bool plain =
          tree_.kind(item) == NodeKind::Item && tree_.itemKind(item) == ItemKind::Plain;
      if (tokens_[first - 1].kind == TokenKind::Pipe) {
        placePipe(first - 1, endOf(item), indent + kIndent);
      } else if (!plain) {
        place(first, endOf(item), indent + 2 * kIndent);
      }
      if (plain) {
        layoutBody(tree_.child(item, 2), indent + kIndent);
      } else if (!stays(first, endOf(item))) {
        layoutItem(item, indent + 2 * kIndent);
      }
    }
    // A '|' behind the last item.
    if (end > 0 && tokens_[end - 1].kind == TokenKind::Pipe) placeCloser(end - 1, indent + kIndent);
    placeCloser(end, indent);
  }

  // A line end before or behind a '|' is one before it.
  void placePipe(size_t pipe, size_t end, size_t indent) {
    if (asked(pipe + 1) || asked(pipe) || !fitsHere(end)) breakBefore(pipe, indent);
  }

  void layoutItem(NodeId item, size_t indent) {
    if (tree_.kind(item) == NodeKind::Block) return layoutBlock(item, indent);
    const NodeId body = tree_.child(item, 2);
    if (tree_.kind(body) != NodeKind::Sequence) return layoutExpression(body, indent + kIndent);
    const auto parts = tree_.children(body);
    // A single operation with a block stays behind its head.
    if (parts.size() == 1 && tree_.kind(parts[0]) == NodeKind::Apply &&
        tree_.children(parts[0]).size() > 1) {
      return layoutApply(parts[0], indent);
    }
    layoutBody(body, indent + kIndent);
  }

  void layoutChoice(NodeId choice, size_t indent) {
    for (const NodeId branch : tree_.children(choice)) {
      place(firstOf(branch), endOf(branch), indent);
      const NodeId body = tree_.child(branch, 1);
      if (tree_.kind(body) == NodeKind::Sequence) {
        layoutBody(body, indent + kIndent);
      } else {
        layoutExpression(body, indent + kIndent);
      }
    }
  }

  // Choices and comp blocks in an expression that does not fit.
  void layoutExpression(NodeId id, size_t indent) {
    if (id == kNoNode || stays(firstOf(id), endOf(id))) return;
    const bool bare =
        tree_.kind(id) == NodeKind::Choice && tokens_[firstOf(id)].kind != TokenKind::LParen;
    if (bare) {
      layoutChoice(id, indent);
    } else if (tree_.kind(id) == NodeKind::Block) {
      layoutBlock(id, indent);
    } else {
      for (const NodeId c : tree_.children(id)) layoutExpression(c, indent);
    }
  }

  // --- Writing ---

  size_t newlinesBetween(size_t begin, size_t end) const {
    return static_cast<size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(begin),
                                          text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  }

  void startLine(size_t indent, bool blank) {
    while (!out_.empty() && out_.back() == ' ') out_.pop_back();
    if (!out_.empty()) out_ += blank ? "\n\n" : "\n";
    out_.append(indent, ' ');
    lineStart_ = out_.size() - indent;
    indent_ = indent;
    atLineStart_ = true;
  }

  // Blank lines right inside brackets are dropped.
  bool mayBlank(size_t i) const {
    if (i == 0) return false;
    switch (tokens_[i - 1].kind) {
      case TokenKind::LBrace:
      case TokenKind::LBracket:
      case TokenKind::LParen:
      case TokenKind::Arrow:
      case TokenKind::Pipe:
      case TokenKind::Colon:
      case TokenKind::Equal: return false;
      default: break;
    }
    return tokens_[i].kind != TokenKind::RBrace && tokens_[i].kind != TokenKind::RBracket &&
           tokens_[i].kind != TokenKind::RParen;
  }

  // Writes the comments before token i. True when the token must begin a line.
  bool writeComments(size_t i) {
    bool mustBreak = false;
    uint32_t from = i == 0 ? 0 : tokens_[i - 1].end;
    const size_t indent = marks_[i].newLine ? marks_[i].indent : indent_ + continuation();
    for (uint32_t c = marks_[i].firstComment; c < commentsEnd(i); ++c) {
      const Comment& comment = comments_[c];
      const size_t lines = newlinesBetween(from, comment.begin);
      const bool trailing = lines == 0 && !out_.empty();
      if (trailing) {
        if (!out_.empty() && out_.back() != ' ' && out_.back() != '\n') out_ += ' ';
      } else {
        startLine(indent, !out_.empty() && lines > 1 && mayBlank(i));
      }
      std::string_view body = text_.substr(comment.begin, comment.end - comment.begin);
      while (!body.empty() && (body.back() == ' ' || body.back() == '\t' || body.back() == '\r')) {
        body.remove_suffix(1);
      }
      out_ += body;
      atLineStart_ = false;
      mustBreak = comment.toLineEnd || !trailing;
      from = comment.end;
    }
    afterComment_ = from;
    return mustBreak;
  }

  size_t continuation() const { return broken_ ? 0 : 2 * kIndent; }

  std::string write() {
    const size_t n = tokens_.size() - 1;
    std::vector<size_t> nextBreak(tokens_.size(), n);
    for (size_t i = n; i-- > 0;) {
      const Mark& after = marks_[i + 1];
      nextBreak[i] = after.newLine || after.softBreak ? i + 1 : nextBreak[i + 1];
    }
    for (size_t i = 0; i <= n; ++i) {
      const Mark& m = marks_[i];
      const bool mustBreak = writeComments(i);
      if (i == n) break;
      if (m.newLine) {
        const size_t lines = newlinesBetween(afterComment_, tokens_[i].begin);
        broken_ = false;
        startLine(m.indent, !out_.empty() && lines > 1 && mayBlank(i));
      } else if (mustBreak) {
        breakLine();
      } else if (m.softBreak && tooLong(i, nextBreak[i])) {
        breakLine();
      } else if (m.space && !atLineStart_) {
        out_ += ' ';
      } else if (!m.space && commentsEnd(i) > m.firstComment) {
        out_ += ' ';
      }
      out_ += text_.substr(tokens_[i].begin, tokens_[i].end - tokens_[i].begin);
      atLineStart_ = false;
    }
    while (!out_.empty() && (out_.back() == ' ' || out_.back() == '\n')) out_.pop_back();
    if (!out_.empty()) out_ += '\n';
    return std::move(out_);
  }

  bool tooLong(size_t i, size_t end) const {
    const size_t column = out_.size() - lineStart_;
    return column + (marks_[i].space ? 1 : 0) + width(i, end) > kColumns &&
           column > indent_ + continuation();
  }

  // Goes on with the same construct on a new line.
  void breakLine() {
    const size_t indent = indent_ + continuation();
    startLine(indent, false);
    broken_ = true;
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  const std::vector<Comment>& comments_;
  const Tree& tree_;
  std::vector<Mark> marks_;
  // The line that the layout is filling.
  size_t lineFirst_ = 0;
  size_t lineIndent_ = 0;
  std::string out_;
  size_t lineStart_ = 0;
  size_t indent_ = 0;
  uint32_t afterComment_ = 0;
  bool atLineStart_ = true;
  // The line continues one that was too long: further ones align with it.
  bool broken_ = false;
};

}  // namespace

std::string formatTokens(std::string_view text, const Tokens& tokens, const Tree& tree) {
  return Formatter(text, tokens, tree).run();
}

std::string format(const Sources& sources, uint32_t file, Diagnostics& diagnostics) {
  Diagnostics own;
  const std::string_view text = sources.text(file);
  const Tokens tokens = tokenize(text, file, own);
  const Tree tree = parse(text, file, tokens, own);
  diagnostics.append(own);
  return own.hasErrors() ? std::string(text) : formatTokens(text, tokens, tree);
}

}  // namespace gable::lang
