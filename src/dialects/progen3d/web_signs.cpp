// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Which of the two languages a grammar is written in. The signs are such as the desktop program's
// notation has no use for: conditions, parameters and calls with arguments, rerolls, the bodies and
// sides of the web language, comparisons, and `I ( Cube name number )` with a broken number, which
// there would be quarter turns.

#include <algorithm>
#include <set>

#include "dialects/progen3d/web_grammar.h"

namespace gable::progen3d::web {

namespace {

bool isSideWord(std::string_view word) {
  if (word.starts_with('G')) word.remove_prefix(1);
  return word.size() == 3 && word[0] == 'D' && (word[1] == 'S' || word[1] == 'T') &&
         word[2] >= 'X' && word[2] <= 'Z';
}

class Signs {
 public:
  Signs(std::string_view text, const std::vector<Token>& tokens) : text_(text), tokens_(tokens) {
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (beginsRule(i)) heads_.insert(word(i));
      if (is(i, TokenKind::Name) && is(i + 1, TokenKind::Open) && i > 0 && word(i - 1) == "R") {
        drawn_.insert(word(i));
      }
    }
  }

  bool any() const {
    for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
      if (at(i)) return true;
    }
    return false;
  }

 private:
  std::string_view word(size_t i) const {
    const Token& t = tokens_[i];
    return text_.substr(t.begin, t.end - t.begin);
  }
  bool is(size_t i, TokenKind kind) const { return i < tokens_.size() && tokens_[i].kind == kind; }

  bool at(size_t i) const {
    switch (tokens_[i].kind) {
      case TokenKind::Question: return is(i + 1, TokenKind::Open);
      case TokenKind::Less:
      case TokenKind::LessEqual:
      case TokenKind::Greater:
      case TokenKind::GreaterEqual:
      case TokenKind::Equal:
      case TokenKind::NotEqual: return true;
      case TokenKind::Name: break;
      default: return false;
    }
    if (word(i) == "CubeZ") return true;
    if (word(i) == "R") return isTurn(i) || isReroll(i);
    if (!is(i + 1, TokenKind::Open)) return false;
    return isSideWord(word(i)) || isCall(i) || hasParameters(i) || isBrokenInsert(i);
  }

  // R ( angle axis )
  bool isTurn(size_t i) const { return is(i + 1, TokenKind::Open); }

  // R name without a range, of a variable that has one.
  bool isReroll(size_t i) const {
    return is(i + 1, TokenKind::Name) && !is(i + 2, TokenKind::Open) && !beginsRule(i) &&
           drawn_.count(word(i + 1)) > 0;
  }

  // Name ( ... ), a rule's name that is not its head.
  bool isCall(size_t i) const {
    const bool declared = i > 0 && (word(i - 1) == "R" || is(i - 1, TokenKind::Star));
    return heads_.count(word(i)) > 0 && !beginsRule(i) && !declared;
  }

  // A head with two names or more between brackets.
  bool hasParameters(size_t i) const {
    if (!beginsRule(i)) return false;
    size_t names = 0, k = i + 2;
    for (; is(k, TokenKind::Name) || is(k, TokenKind::Comma); ++k) names += is(k, TokenKind::Name);
    return names >= 2 && is(k, TokenKind::Close);
  }

  // I ( Cube brick 0.35 )
  bool isBrokenInsert(size_t i) const {
    return word(i) == "I" && is(i + 2, TokenKind::Name) && is(i + 3, TokenKind::Name) &&
           is(i + 4, TokenKind::Number) && is(i + 5, TokenKind::Close) &&
           word(i + 4).find('.') != std::string_view::npos;
  }

  // A name first in its line with an arrow behind it.
  bool beginsRule(size_t i) const {
    if (!is(i, TokenKind::Name) || !tokens_[i].firstOfLine) return false;
    for (size_t k = i + 1; k + 1 < tokens_.size() && !tokens_[k].firstOfLine; ++k) {
      if (is(k, TokenKind::Arrow)) return true;
      if (is(k, TokenKind::Push) || is(k, TokenKind::Pipe)) return false;
    }
    return false;
  }

  std::string_view text_;
  const std::vector<Token>& tokens_;
  std::set<std::string_view> heads_, drawn_;
};

}  // namespace

bool isWebLanguage(std::string_view text, const std::vector<Token>& tokens) {
  return Signs(text, tokens).any();
}

}  // namespace gable::progen3d::web
