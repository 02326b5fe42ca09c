// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// One pass over the tokens of a declaration with a stack of what is open. A frame says what kind of
// text stands in it; `case` and `with` make expressions of what follows up to the colon.

#include "language/cursor.h"

#include <algorithm>

namespace gable::language {

using lang::Keyword;
using lang::Token;
using lang::TokenKind;

namespace {

struct Frame {
  enum class Kind : uint8_t { Top, Brackets, Block, Push, Array, Annotation } kind = Kind::Top;
  /// What stands here: operations, or an expression.
  bool successors = false;
  /// Between `case` and its colon.
  bool condition = false;
  /// Before the colon of an item: of a split, of a block with selectors.
  bool head = false;
  BlockKind block = BlockKind::None;
  Call call;
  bool hasCall = false;
};

class Reader {
 public:
  Reader(const Lexed& lexed, uint32_t offset, const Catalogue& catalogue)
      : text_(lexed.text.content()),
        tokens_(lexed.tokens.tokens),
        comments_(lexed.tokens.comments),
        catalogue_(catalogue),
        offset_(offset) {}

  Cursor run() {
    out_.wordBegin = out_.wordEnd = offset_;
    if (inComment()) return out_;
    findWord();
    if (inString_) {
      out_.spot = Spot::String;
      read(start(last_), last_);
      finish();
      return out_;
    }
    const size_t from = start(last_);
    read(from, last_);
    finish();
    if (out_.spot == Spot::Nothing) return out_;
    if (startsLine() && frames_.size() == 1 && !frames_[0].condition) {
      out_.spot = Spot::Declaration;
    }
    return out_;
  }

 private:
  std::string_view textOf(const Token& t) const { return text_.substr(t.begin, t.end - t.begin); }

  bool inComment() const {
    const auto at =
        std::upper_bound(comments_.begin(), comments_.end(), offset_,
                         [](uint32_t value, const lang::Comment& c) { return value <= c.begin; });
    if (at == comments_.begin()) return false;
    const lang::Comment& c = *(at - 1);
    return offset_ < c.end || (c.toLineEnd && offset_ == c.end) ||
           (!c.toLineEnd && c.end == text_.size() && !text_.substr(0, c.end).ends_with("*/"));
  }

  // The token at the caret is its word; those before it are what it stands in.
  void findWord() {
    const auto at = std::lower_bound(tokens_.begin(), tokens_.end(), offset_,
                                     [](const Token& t, uint32_t value) { return t.end < value; });
    last_ = static_cast<size_t>(at - tokens_.begin());
    if (at == tokens_.end() || at->begin >= offset_) return;
    if (at->kind == TokenKind::String) {
      const bool closed = at->end - at->begin > 1 && text_[at->end - 1] == '"';
      if (offset_ < at->end || !closed) {
        inString_ = true;
        out_.wordBegin = at->begin + 1;
        out_.wordEnd = closed ? at->end - 1 : at->end;
        out_.typed = text_.substr(out_.wordBegin, offset_ - out_.wordBegin);
        return;
      }
    }
    if (at->kind == TokenKind::Name) {
      out_.wordBegin = at->begin;
      out_.wordEnd = at->end;
      out_.typed = text_.substr(at->begin, offset_ - at->begin);
      return;
    }
    ++last_;
    // "imp." before its rule is there: the dot belongs to the word.
    if (at->kind == TokenKind::Dot && last_ >= 2 && tokens_[last_ - 2].end == at->begin &&
        tokens_[last_ - 2].kind == TokenKind::Name) {
      last_ -= 2;
      out_.wordBegin = tokens_[last_].begin;
      out_.typed = text_.substr(out_.wordBegin, offset_ - out_.wordBegin);
    }
  }

  bool startsLine() const {
    return out_.wordBegin == 0 || text_[out_.wordBegin - 1] == '\n' ||
           text_[out_.wordBegin - 1] == '\r';
  }

  size_t closing(size_t open) const {
    return tokens_[open].match == Token::kNoMatch ? open : tokens_[open].match;
  }

  // The name of a declaration begins at token i: `name(..) with (..) -->` or `name(..) =`.
  bool headAt(size_t i) const {
    if (i >= tokens_.size() || tokens_[i].kind != TokenKind::Name) return false;
    size_t next = i + 1;
    for (int part = 0; part < 2; ++part) {
      if (next < tokens_.size() && tokens_[next].keyword == Keyword::With) ++next;
      if (next >= tokens_.size() || tokens_[next].kind != TokenKind::LParen) break;
      const size_t end = closing(next);
      if (end == next) return false;
      next = end + 1;
    }
    if (next >= tokens_.size()) return false;
    if (tokens_[next].kind == TokenKind::Arrow) return true;
    const uint32_t begin = tokens_[i].begin;
    const bool column0 = begin == 0 || text_[begin - 1] == '\n' || text_[begin - 1] == '\r';
    return column0 && tokens_[next].kind == TokenKind::Equal;
  }

  static bool declares(Keyword k) {
    return k == Keyword::Attr || k == Keyword::Const || k == Keyword::Style ||
           k == Keyword::Import || k == Keyword::Version;
  }

  // The first token of the declaration that the token `at` stands in or before.
  size_t start(size_t at) const {
    for (size_t i = std::min(at, tokens_.size()); i-- > 0;) {
      if (tokens_[i].kind == TokenKind::At) {
        // Behind the annotation's brackets another declaration begins.
        return i;
      }
      if (declares(tokens_[i].keyword) && i + 1 < tokens_.size() &&
          (tokens_[i + 1].kind == TokenKind::Name || tokens_[i + 1].kind == TokenKind::String ||
           i + 1 >= at)) {
        return i;
      }
      if (headAt(i)) return i;
    }
    return 0;
  }

  Frame& top() { return frames_.back(); }

  void push(Frame f) {
    constexpr size_t kDeepest = 2000;
    if (frames_.size() < kDeepest) frames_.push_back(f);
  }

  void pop(TokenKind closer) {
    const auto fits = [&](const Frame& f) {
      switch (f.kind) {
        case Frame::Kind::Brackets:
        case Frame::Kind::Annotation: return closer == TokenKind::RParen;
        case Frame::Kind::Block: return closer == TokenKind::RBrace;
        case Frame::Kind::Push:
        case Frame::Kind::Array: return closer == TokenKind::RBracket;
        case Frame::Kind::Top: break;
      }
      return false;
    };
    for (size_t i = frames_.size(); i-- > 1;) {
      if (!fits(frames_[i])) continue;
      frames_.resize(i);
      return;
    }
  }

  void read(size_t from, size_t to) {
    frames_.assign(1, Frame());
    known_ = false;
    for (size_t i = from; i < to && i < tokens_.size(); ++i) token(i);
  }

  void token(size_t i) {
    const Token& t = tokens_[i];
    switch (t.kind) {
      case TokenKind::LParen: return openBrackets(i);
      case TokenKind::LBracket: {
        Frame f;
        f.successors = top().successors && !top().condition && !top().head;
        f.kind = f.successors ? Frame::Kind::Push : Frame::Kind::Array;
        return push(f);
      }
      case TokenKind::LBrace: return openBlock(i);
      case TokenKind::RParen:
      case TokenKind::RBracket:
      case TokenKind::RBrace: return pop(t.kind);
      case TokenKind::Comma:
        if (top().hasCall) {
          if (top().call.argument == 0 && i > 0) top().call.first = textOf(tokens_[i - 1]);
          ++top().call.argument;
          top().call.named = {};
        }
        return;
      case TokenKind::Pipe:
        top().head = top().block == BlockKind::Split || top().block == BlockKind::Selectors;
        top().condition = false;
        return;
      case TokenKind::Colon:
        if (top().condition) {
          top().condition = false;
        } else {
          top().head = false;
        }
        return;
      case TokenKind::Connect: top().head = false; return;
      case TokenKind::Arrow:
        frames_.resize(1);
        top() = Frame();
        top().successors = true;
        known_ = true;
        return;
      case TokenKind::Equal: return equal(i);
      case TokenKind::At:
        frames_.resize(1);
        top() = Frame();
        known_ = false;
        return;
      default: break;
    }
    if (t.keyword == Keyword::Case) top().condition = true;
    if (t.keyword == Keyword::Else && !top().condition) top().condition = true;
  }

  void equal(size_t i) {
    Frame& f = top();
    if (f.kind == Frame::Kind::Top && !f.successors) {
      known_ = true;  // the value of an attribute, constant or function
    } else if (f.hasCall && i > 0) {
      f.call.named = textOf(tokens_[i - 1]);
    } else if (f.head) {
      f.head = false;
    }
  }

  void openBrackets(size_t i) {
    Frame f;
    f.kind = Frame::Kind::Brackets;
    const bool behindName = i > 0 && tokens_[i - 1].kind == TokenKind::Name;
    const bool annotation = behindName && i > 1 && tokens_[i - 2].kind == TokenKind::At;
    if (annotation) {
      f.kind = Frame::Kind::Annotation;
      f.call.callee = textOf(tokens_[i - 1]);
    } else if (behindName && known_) {
      f.hasCall = true;
      f.call.callee = textOf(tokens_[i - 1]);
      f.call.successor = top().successors && !top().condition && !top().head;
    }
    push(f);
  }

  // The operation that a block belongs to: before its brackets, or before the block before.
  std::string_view calleeBefore(size_t i) const {
    while (i-- > 0) {
      const TokenKind kind = tokens_[i].kind;
      if (kind == TokenKind::Name) return textOf(tokens_[i]);
      const bool closes = kind == TokenKind::RParen || kind == TokenKind::RBrace;
      if (closes && tokens_[i].match != Token::kNoMatch) {
        i = tokens_[i].match;
      } else if (kind != TokenKind::Star) {
        break;
      }
    }
    return {};
  }

  void openBlock(size_t i) {
    Frame f;
    f.kind = Frame::Kind::Block;
    const Frame& outer = top();
    const bool group = outer.kind == Frame::Kind::Block && outer.head &&
                       (i == 0 || tokens_[i - 1].kind == TokenKind::LBrace ||
                        tokens_[i - 1].kind == TokenKind::Pipe);
    f.call.callee = group ? outer.call.callee : calleeBefore(i);
    const OpSpec* op = catalogue_.operation(f.call.callee);
    f.block = group ? outer.block : op ? op->block : BlockKind::Operations;
    f.head = f.block == BlockKind::Split || f.block == BlockKind::Selectors;
    f.successors = outer.successors && !outer.condition;
    if (outer.head && !group) f.successors = false;
    push(f);
  }

  void slots(size_t from, size_t to) {
    // Names right behind "(" or "," in the brackets before the arrow.
    for (size_t i = from + 1; i < to && i < tokens_.size(); ++i) {
      const TokenKind before = tokens_[i - 1].kind;
      if (tokens_[i].kind == TokenKind::Arrow || tokens_[i].kind == TokenKind::Equal) break;
      if (tokens_[i].kind == TokenKind::Name && tokens_[i].keyword != Keyword::With &&
          (before == TokenKind::LParen || before == TokenKind::Comma ||
           (i + 1 < tokens_.size() && tokens_[i + 1].kind == TokenKind::Assign))) {
        out_.slots.push_back(textOf(tokens_[i]));
      }
    }
  }

  void finish() {
    const size_t from = start(last_);
    if (headAt(from) || (from + 1 < tokens_.size() && declares(tokens_[from].keyword))) {
      const size_t name = headAt(from) ? from : from + 1;
      out_.declaration = textOf(tokens_[name]);
      slots(name, last_);
    }
    for (size_t i = frames_.size(); i-- > 0;) {
      if (frames_[i].hasCall && !out_.inCall) {
        out_.inCall = true;
        out_.call = frames_[i].call;
        out_.atArgument = i + 1 == frames_.size();
      }
      if (frames_[i].kind == Frame::Kind::Block && out_.blockOf.empty() && frames_[i].head &&
          i + 1 == frames_.size()) {
        out_.blockOf = frames_[i].call.callee;
      }
    }
    const Frame& f = top();
    if (f.kind == Frame::Kind::Annotation) out_.owner = f.call.callee;
    if (from < tokens_.size() && tokens_[from].keyword == Keyword::Import) out_.owner = "import";
    if (out_.spot == Spot::String) return;
    out_.spot = spot(f);
  }

  Spot spot(const Frame& f) const {
    if (last_ > 0 && tokens_[last_ - 1].kind == TokenKind::At) return Spot::Annotation;
    if (f.kind == Frame::Kind::Annotation) return Spot::AnnotationArgument;
    // Behind a number that is still being written, or a name that is being declared.
    if (last_ > 0 && declares(tokens_[last_ - 1].keyword)) return Spot::Nothing;
    if (!known_) return startsLine() ? Spot::Declaration : Spot::Nothing;
    if (last_ > 0 && tokens_[last_ - 1].kind == TokenKind::Number &&
        tokens_[last_ - 1].end == out_.wordBegin) {
      return Spot::Nothing;
    }
    if (f.condition) return Spot::Value;
    if (f.head) return f.block == BlockKind::Split ? Spot::Size : Spot::Selector;
    return f.successors ? Spot::Successor : Spot::Value;
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  const std::vector<lang::Comment>& comments_;
  const Catalogue& catalogue_;
  uint32_t offset_;
  /// The tokens before the word are those below `last_`.
  size_t last_ = 0;
  bool inString_ = false;
  /// Behind the arrow or the equals sign of the declaration.
  bool known_ = false;
  std::vector<Frame> frames_;
  Cursor out_;
};

}  // namespace

Cursor cursorAt(const Lexed& lexed, uint32_t offset, const Catalogue& catalogue) {
  return Reader(lexed, offset, catalogue).run();
}

}  // namespace gable::language
