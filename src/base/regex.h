// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Regular expressions for texts that rules give: searches of files, splitting of texts. Patterns
// come from strangers, so a search takes time O(length of the pattern * length of the text),
// whatever the pattern, and no recursion.
//
// Understood: literals, . [abc] [^a-z] | ( ) (?: ) * + ? {m} {m,n} and their lazy forms with ?,
// ^ $ \b \B \d \D \w \W \s \S \t \n \r \xhh \uhhhh, (?= ) (?! ) (?<= ) (?<! ). Texts are bytes;
// letters beyond ASCII match as themselves, byte by byte. No back references and no captures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace gable {

class Regex {
 public:
  /// A pattern that cannot be read gives a regex that is not valid() and says why in error().
  explicit Regex(std::string_view pattern);
  ~Regex();
  Regex(Regex&&) noexcept;
  Regex& operator=(Regex&&) noexcept;

  bool valid() const { return error_.empty(); }
  const std::string& error() const { return error_; }

  struct Match {
    bool found = false;
    size_t begin = 0, end = 0;
  };
  /// The leftmost match that begins at `from` or later; alternatives and repeats are tried in their
  /// order, as usual. Not found when the pattern is not valid or the search takes more
  /// than kMaxWork steps. `work`, where given, holds the steps that this and later searches may
  /// take together.
  Match search(std::string_view text, size_t from = 0, size_t* work = nullptr) const;
  bool matchesWhole(std::string_view text) const;

  /// Steps that a search may take; they also bound the memory it needs.
  static constexpr size_t kMaxWork = size_t{1} << 22;

 private:
  struct Program;
  std::unique_ptr<Program> program_;
  std::string error_;
};

}  // namespace gable
