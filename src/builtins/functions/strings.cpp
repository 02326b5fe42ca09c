// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Texts are UTF-8; positions and lengths count characters, not bytes.

#include <algorithm>
#include <cmath>

#include "base/regex.h"
#include "base/text.h"
#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "shape/op_call.h"

namespace gable {

namespace {

constexpr size_t kNone = std::string_view::npos;

size_t stepAt(std::string_view text, size_t at) {
  return std::max<size_t>(utf8Length(text, at), 1);
}

size_t lengthOf(std::string_view text) {
  size_t n = 0;
  for (size_t at = 0; at < text.size(); at += stepAt(text, at)) ++n;
  return n;
}

// The byte at which a character begins; the end of the text beyond the last.
size_t byteOf(std::string_view text, double character) {
  size_t at = 0;
  for (double n = 0; n + 1 <= character && at < text.size(); ++n) at += stepAt(text, at);
  return at;
}

Value position(std::string_view text, size_t byte) {
  return Value::of(byte == kNone ? -1.0 : static_cast<double>(lengthOf(text.substr(0, byte))));
}

struct Input {
  Text text;
};

Value length(FunctionCall&, const Input& args) {
  return Value::of(static_cast<double>(lengthOf(args.text.text)));
}

// The byte of the n-th match, counted from 0 without overlaps.
size_t findNth(std::string_view text, std::string_view match, double n) {
  if (match.empty() || !(n >= 0)) return kNone;
  size_t at = text.find(match);
  for (double i = 1; i <= n && at != kNone; ++i) at = text.find(match, at + match.size());
  return at;
}

// Looks for one text in another.
struct Search : Input {
  std::string_view match;
};

struct FindNth : Search {
  double n;
};

Value find(FunctionCall&, const FindNth& args) {
  return position(args.text.text, findNth(args.text.text, args.match, args.n));
}

Value count(FunctionCall&, const Search& args) {
  double n = 0;
  const std::string_view text = args.text.text, match = args.match;
  for (size_t at = match.empty() ? kNone : text.find(match); at != kNone;
       at = text.find(match, at + match.size())) {
    ++n;
  }
  return Value::of(n);
}

struct Substring : Input {
  double start, end;
};

Value substring(FunctionCall& call, const Substring& args) {
  const std::string_view text = args.text.text;
  const size_t begin = byteOf(text, args.start), end = byteOf(text, args.end);
  return call.result(begin < end ? text.substr(begin, end - begin) : std::string_view());
}

std::vector<std::string> splitAtText(std::string_view text, std::string_view delimiter) {
  std::vector<std::string> parts;
  if (delimiter.empty()) {
    // Between all characters, and before and after them.
    parts.emplace_back();
    for (size_t at = 0; at < text.size() && parts.size() < kMaxArraySize; at += stepAt(text, at)) {
      parts.emplace_back(text.substr(at, stepAt(text, at)));
    }
    parts.emplace_back();
    return parts;
  }
  size_t from = 0, at = text.find(delimiter);
  while (at != kNone && parts.size() < kMaxArraySize) {
    parts.emplace_back(text.substr(from, at - from));
    from = at + delimiter.size();
    at = text.find(delimiter, from);
  }
  parts.emplace_back(text.substr(from));
  return parts;
}

std::vector<std::string> splitAtRegex(std::string_view text, const Regex& regex) {
  std::vector<std::string> parts;
  size_t from = 0, search = 0, work = 4 * Regex::kMaxWork;
  while (search <= text.size() && parts.size() < kMaxArraySize) {
    const Regex::Match m = regex.search(text, search, &work);
    if (!m.found) break;
    // An empty match at either end of what is left would make empty parts without end.
    if (m.end == m.begin && (m.begin == from || m.begin >= text.size())) {
      search = m.end + 1;
      continue;
    }
    parts.emplace_back(text.substr(from, m.begin - from));
    from = m.end;
    search = std::max(m.end, m.begin + (m.end == m.begin ? 1 : 0));
  }
  parts.emplace_back(text.substr(from));
  return parts;
}

Value splitString(FunctionCall& call, const Search& args) {
  ValuePool& pool = call.services().pool();
  const std::string_view text = args.text.text, delimiter = args.match;
  std::vector<std::string> parts;
  if (delimiter.size() > 1 && delimiter[0] == '$') {
    const Regex regex(delimiter.substr(1));
    if (!regex.valid()) {
      return call.fail("bad-regex",
                       "'" + std::string(delimiter.substr(1)) +
                           "' is not a regular expression: " + regex.error(),
                       "put a backslash before letters with a meaning", stringArray({}, pool));
    }
    parts = splitAtRegex(text, regex);
  } else {
    parts = splitAtText(text, delimiter);
  }
  if (parts.size() > kMaxArraySize) {
    return call.fail("array-too-large", "splitString would make too many parts",
                     "arrays have up to 100000 elements", stringArray({}, pool));
  }
  return stringArray(parts, pool);
}

struct FindFirst {
  Value in, value;
  double epsilon = 0;
};

Value findFirst(FunctionCall& call, const FindFirst& args) {
  const ValuePool& pool = call.services().pool();
  if (!args.in.isArray()) {
    const std::string_view text = pool.text(args.in.id);
    return position(text, findNth(text, pool.text(args.value.id), 0));
  }
  const Array& a = pool.array(args.in);
  for (size_t i = 0; i < a.size(); ++i) {
    const bool equal = a.element == ValueType::String
                           ? a.strings[i] == args.value.id
                           : std::fabs(a.numbers[i] - args.value.number) <= args.epsilon;
    if (equal) return Value::of(static_cast<double>(i));
  }
  return Value::of(-1.0);
}

Value findLast(FunctionCall&, const Search& args) {
  const std::string_view text = args.text.text;
  return position(text, args.match.empty() ? kNone : text.rfind(args.match));
}

Value getPrefix(FunctionCall& call, const Search& args) {
  const std::string_view text = args.text.text;
  const size_t at = findNth(text, args.match, 0);
  return call.result(at == kNone ? std::string_view() : text.substr(0, at));
}

Value getSuffix(FunctionCall& call, const Search& args) {
  const std::string_view text = args.text.text, match = args.match;
  const size_t at = match.empty() ? kNone : text.rfind(match);
  return call.result(at == kNone ? std::string_view() : text.substr(at + match.size()));
}

struct Between : Input {
  std::string_view left, right;
};

Value getRange(FunctionCall& call, const Between& args) {
  const std::string_view text = args.text.text;
  const size_t from = findNth(text, args.left, 0);
  const size_t to = args.right.empty() ? kNone : text.rfind(args.right);
  if (from == kNone || to == kNone || to < from + args.left.size()) return call.result("");
  return call.result(text.substr(from + args.left.size(), to - from - args.left.size()));
}

struct Replace : Input {
  std::string_view old;
  Value by;
};

Value replace(FunctionCall& call, const Replace& args) {
  const std::string_view text = args.text.text, old = args.old;
  if (old.empty()) return Value::string(args.text.id);
  const std::string by = call.services().pool().str(args.by);
  std::string out;
  size_t from = 0;
  for (size_t at = text.find(old); at != kNone; at = text.find(old, from)) {
    out.append(text.substr(from, at - from)).append(by);
    from = at + old.size();
    if (out.size() > kMaxTextLength) break;
  }
  return call.result(out.append(text.substr(from)));
}

constexpr ParamSpec kInput = param<&Input::text>("inputString", "The text to look at.");
constexpr ParamSpec kMatch = param<&Search::match>("matchString", "The text to look for.");
constexpr ValueType kFloat = ValueType::Float, kString = ValueType::String;

constexpr ParamSpec kOneParams[] = {kInput};
constexpr Signature kLen[] = {{kOneParams, kFloat}};
constexpr ParamSpec kFindParams[] = {kInput, kMatch,
                                     param<&FindNth::n>("n", "Which occurrence, counted from 0.")};
constexpr Signature kFind[] = {{kFindParams, kFloat}};
constexpr ParamSpec kMatchParams[] = {kInput, kMatch};
constexpr Signature kNumberOfMatch[] = {{kMatchParams, kFloat}};
constexpr Signature kTextOfMatch[] = {{kMatchParams, kString}};
constexpr ParamSpec kSubstringParams[] = {
    kInput, param<&Substring::start>("startPos", "The first character to take, counted from 0."),
    param<&Substring::end>("endPos", "The first character not to take any more.")};
constexpr Signature kSubstring[] = {{kSubstringParams, kString}};
constexpr ParamSpec kSplitParams[] = {
    kInput, param<&Search::match>(
                "delimiter", "What separates the parts; a regular expression after a leading $.")};
constexpr Signature kSplit[] = {{kSplitParams, ValueType::StringArray}};
constexpr ParamSpec kRangeParams[] = {
    kInput,
    param<&Between::left>("leftMatchString", "The text whose first occurrence comes before."),
    param<&Between::right>("rightMatchString", "The text whose last occurrence comes after.")};
constexpr Signature kRange[] = {{kRangeParams, kString}};

constexpr ParamSpec kOld = param<&Replace::old>("oldString", "The text to replace everywhere.");
template <ParamType type>
constexpr ParamSpec newString(const char* doc) {
  return param<&Replace::by, type>("newString", doc);
}
constexpr ParamSpec kNewText[] = {kInput, kOld,
                                  newString<ParamType::String>("The text to put there.")};
constexpr ParamSpec kNewFloat[] = {kInput, kOld,
                                   newString<ParamType::Float>("A number to put there.")};
constexpr ParamSpec kNewBool[] = {kInput, kOld,
                                  newString<ParamType::Bool>("A truth value to put there.")};
constexpr Signature kReplace[] = {{kNewText, kString}, {kNewFloat, kString}, {kNewBool, kString}};

template <ParamType type>
constexpr ParamSpec firstIn(const char* name, const char* doc) {
  return param<&FindFirst::in, type>(name, doc);
}
template <ParamType type>
constexpr ParamSpec firstValue(const char* name, const char* doc) {
  return param<&FindFirst::value, type>(name, doc);
}
constexpr ParamSpec kFirstText[] = {firstIn<ParamType::String>(kInput.name, kInput.doc),
                                    firstValue<ParamType::String>(kMatch.name, kMatch.doc)};
constexpr ParamSpec kFirstFloat[] = {
    firstIn<ParamType::FloatArray>("array", "Numbers to look through."),
    firstValue<ParamType::Float>("value", "The number to look for."),
    param<&FindFirst::epsilon>("epsilon", "How far a number may be off and still be taken.")};
constexpr ParamSpec kFirstString[] = {
    firstIn<ParamType::StringArray>("array", "Texts to look through."),
    firstValue<ParamType::String>("value", "The text to look for.")};
constexpr ParamSpec kFirstBool[] = {
    firstIn<ParamType::BoolArray>("array", "Truth values to look through."),
    firstValue<ParamType::Bool>("value", "The value to look for.")};
constexpr Signature kFirst[] = {
    {kFirstText, kFloat}, {kFirstFloat, kFloat}, {kFirstString, kFloat}, {kFirstBool, kFloat}};

constexpr Signature kIndex[] = {kFirst[1], kFirst[2], kFirst[3]};

constexpr const char* kFamily = "strings";
constexpr FunctionSpec kFunctions[] = {
    {"len", kFamily, "The number of characters of a text.", kLen, typed<length>},
    {"find", kFamily, "The position of the n-th occurrence of a text; -1 when there is none.",
     kFind, typed<find>},
    {"count", kFamily, "How often a text occurs in another.", kNumberOfMatch, typed<count>},
    {"substring", kFamily, "The characters of a text from one position to before another.",
     kSubstring, typed<substring>},
    {"splitString", kFamily, "The parts of a text between separators.", kSplit, typed<splitString>},
    {"findFirst", kFamily,
     "The position of the first occurrence in a text or an array; -1 when there is none.", kFirst,
     typed<findFirst>},
    {"index", kFamily, "Old name of findFirst, for arrays.", kIndex, typed<findFirst>, kPure, false,
     true},
    {"findLast", kFamily, "The position of the last occurrence of a text; -1 when there is none.",
     kNumberOfMatch, typed<findLast>},
    {"getPrefix", kFamily, "What comes before the first occurrence of a text.", kTextOfMatch,
     typed<getPrefix>},
    {"getSuffix", kFamily, "What comes after the last occurrence of a text.", kTextOfMatch,
     typed<getSuffix>},
    {"getRange", kFamily, "What stands between two texts.", kRange, typed<getRange>},
    {"replace", kFamily, "A text with all occurrences of another one replaced.", kReplace,
     typed<replace>},
};

}  // namespace

extern const FunctionList kFunctions_strings;
const FunctionList kFunctions_strings = {kFunctions, {}};

}  // namespace gable
