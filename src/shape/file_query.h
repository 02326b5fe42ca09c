// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Queries for files, as fileSearch and its kin take them.
//
//   windows/*.obj           * stands for any characters, ? for any one
//   $textures/[0-9]+\.png    a regular expression, which has to match the whole path
//   'my facade/*.png'       quotes around what has blanks
//   *.png Name=wall*        blanks join terms that must all hold
//   Name= Ext= Path= Project=   one property of the file; ':' does as well as '='
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/regex.h"
#include "base/result.h"

namespace gable {

class FileQuery {
 public:
  /// Code: bad-query.
  static Result<FileQuery> parse(std::string_view text);

  /// `path` counts from the root of a project, "/assets/a.png"; `project` is its name. Takes time
  /// O(length of the query * length of the path).
  /// A file of the own project is also named by its path from there and from its assets.
  bool matches(std::string_view path, std::string_view project, bool own) const;
  /// Whether files of other projects can match: paths name these only from the workspace on.
  bool leavesTheProject() const;

 private:
  enum class Property : uint8_t { Any, Name, Extension, Path, Project };
  struct Term {
    Property property = Property::Any;
    std::string text;
    /// Empty, or the one regular expression.
    std::vector<Regex> regex;
    bool holds(std::string_view value) const;
  };
  std::vector<Term> terms_;
};

/// Whether a text is what a pattern with * and ? says.
bool matchesWildcards(std::string_view pattern, std::string_view text);

}  // namespace gable
