// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The pattern becomes instructions for a backtracking machine that remembers each pair of
// instruction and place it has tried: without captures the second visit must fail as the first did
// (R. Cox, "Regular Expression Matching: the Virtual Machine Approach", 2009). Parts that look
// ahead or behind are programs of their own, run in place. Nested groups are read by recursion, to
// a depth that is limited.

#include "base/regex.h"

#include <bitset>
#include <cctype>
#include <unordered_set>
#include <utility>

#include "base/work.h"

namespace gable {

namespace {

using ByteSet = std::bitset<256>;

enum class Code : uint8_t {
  Byte,      // a: the byte
  Set,       // a: number of a set
  Split,     // to a first, then to b
  Jump,      // to a
  Begin,     // of the text
  End,       // of the text
  Boundary,  // of a word; a = 1: no boundary
  Look,      // a: where the part ends; b: bits below
  Match,
};
constexpr uint32_t kBehind = 1, kNegated = 2;

struct Instruction {
  Code code;
  uint32_t a = 0, b = 0;
};

// Patterns are short; repeats of repeats must not make programs that are not.
constexpr size_t kMaxProgram = 20000;
constexpr int kMaxNesting = 64;
constexpr uint32_t kMaxRepeat = 1000;

ByteSet classOf(char letter) {
  ByteSet s;
  for (int c = 0; c < 128; ++c) {
    const bool in = letter == 'd'   ? std::isdigit(c) != 0
                    : letter == 's' ? (c == ' ' || (c >= '\t' && c <= '\r'))
                                    : (std::isalnum(c) != 0 || c == '_');
    if (in) s.set(static_cast<size_t>(c));
  }
  return s;
}

bool wordByte(std::string_view text, size_t at) {
  if (at >= text.size()) return false;
  const auto c = static_cast<unsigned char>(text[at]);
  return std::isalnum(c) || c == '_';
}

}  // namespace

struct Regex::Program {
  std::vector<Instruction> code;
  std::vector<ByteSet> sets;

  struct Run;
};

namespace {

// Reads a pattern; the first mistake stops it.
class Reader {
 public:
  Reader(std::string_view pattern, std::vector<Instruction>& code, std::vector<ByteSet>& sets,
         std::string& error)
      : pattern_(pattern), code_(code), sets_(sets), error_(error) {}

  void read() {
    readAlternatives(0);
    if (ok() && at_ < pattern_.size()) fail("a ')' has no '('");
    emit(Code::Match);
  }

 private:
  bool ok() const { return error_.empty(); }
  void fail(const char* why) {
    if (ok()) error_ = why;
  }
  bool more() const { return at_ < pattern_.size(); }
  bool take(std::string_view token) {
    if (pattern_.substr(at_, token.size()) != token) return false;
    at_ += token.size();
    return true;
  }
  uint32_t here() const { return static_cast<uint32_t>(code_.size()); }
  uint32_t emit(Code code, uint32_t a = 0, uint32_t b = 0) {
    if (code_.size() >= kMaxProgram) {
      fail("the pattern is too long");
    } else {
      code_.push_back({code, a, b});
    }
    return here() - 1;
  }
  void emitSet(const ByteSet& set) {
    sets_.push_back(set);
    emit(Code::Set, static_cast<uint32_t>(sets_.size() - 1));
  }
  // Makes room for a split before what begins at `from`.
  void insertSplit(uint32_t from) {
    if (code_.size() >= kMaxProgram) return fail("the pattern is too long");
    code_.insert(code_.begin() + from, {Code::Split, from + 1, 0});
    for (uint32_t i = from + 1; i < here(); ++i) {
      Instruction& in = code_[i];
      const bool two = in.code == Code::Split, one = in.code == Code::Jump || in.code == Code::Look;
      if ((two || one) && in.a >= from) ++in.a;
      if (two && in.b >= from) ++in.b;
    }
  }

  void readAlternatives(int depth) {
    if (depth > kMaxNesting) return fail("groups are nested too deeply");
    const uint32_t start = here();
    readSequence(depth);
    if (!ok() || !take("|")) return;
    insertSplit(start);
    const uint32_t jump = emit(Code::Jump);
    code_[start].b = here();
    readAlternatives(depth + 1);
    if (ok()) code_[jump].a = here();
  }

  void readSequence(int depth) {
    while (ok() && more() && pattern_[at_] != '|' && pattern_[at_] != ')') readRepeated(depth);
  }

  void readRepeated(int depth) {
    const uint32_t from = here();
    readAtom(depth);
    while (ok() && more()) {
      uint32_t least = 0, most = 0;
      if (take("*")) {
        most = kNoLimit;
      } else if (take("+")) {
        least = 1;
        most = kNoLimit;
      } else if (take("?")) {
        most = 1;
      } else if (!readCounts(least, most)) {
        break;
      }
      repeat(from, least, most, take("?"));
    }
  }

  static constexpr uint32_t kNoLimit = 0xffffffff;

  bool readNumber(uint32_t& n) {
    const size_t from = at_;
    n = 0;
    while (more() && std::isdigit(static_cast<unsigned char>(pattern_[at_])) && n <= kMaxRepeat) {
      n = n * 10 + static_cast<uint32_t>(pattern_[at_++] - '0');
    }
    return at_ > from;
  }

  // {m}, {m,} or {m,n}; any other brace is a letter.
  bool readCounts(uint32_t& least, uint32_t& most) {
    const size_t from = at_;
    if (!take("{") || !readNumber(least)) {
      at_ = from;
      return false;
    }
    most = least;
    if (take(",") && !readNumber(most)) most = kNoLimit;
    if (!take("}")) {
      at_ = from;
      return false;
    }
    if (least > kMaxRepeat || (most != kNoLimit && (most > kMaxRepeat || most < least))) {
      fail("a count in { } is not possible");
    }
    return true;
  }

  // Turns what lies from `from` to the end into as many copies as asked for.
  void repeat(uint32_t from, uint32_t least, uint32_t most, bool lazy) {
    const std::vector<Instruction> body(code_.begin() + from, code_.end());
    code_.resize(from);
    for (uint32_t i = 0; i < least && ok(); ++i) copy(body, from);
    if (most == kNoLimit) {
      const uint32_t split = emit(Code::Split);
      copy(body, from);
      emit(Code::Jump, split);
      if (ok()) direct(split, split + 1, here(), lazy);
      return;
    }
    std::vector<uint32_t> splits;
    for (uint32_t i = least; i < most && ok(); ++i) {
      splits.push_back(emit(Code::Split));
      copy(body, from);
    }
    for (const uint32_t s : splits) {
      if (ok()) direct(s, s + 1, here(), lazy);
    }
  }

  void direct(uint32_t split, uint32_t in, uint32_t out, bool lazy) {
    code_[split].a = lazy ? out : in;
    code_[split].b = lazy ? in : out;
  }

  // Appends a body that was written for place `origin`.
  void copy(const std::vector<Instruction>& body, uint32_t origin) {
    const uint32_t shift = here() - origin;
    for (Instruction in : body) {
      if (in.code == Code::Split) in.b += shift;
      if (in.code == Code::Split || in.code == Code::Jump || in.code == Code::Look) in.a += shift;
      emit(in.code, in.a, in.b);
    }
  }

  void readAtom(int depth) {
    const char c = pattern_[at_++];
    switch (c) {
      case '.': {
        ByteSet any;
        any.set();
        any.reset('\n');
        return emitSet(any);
      }
      case '^': emit(Code::Begin); return;
      case '$': emit(Code::End); return;
      case '(': return readGroup(depth);
      case '[': return readSet();
      case '\\': return readEscape();
      case '*':
      case '+':
      case '?': return fail("there is nothing to repeat");
      default: emit(Code::Byte, static_cast<unsigned char>(c));
    }
  }

  void readGroup(int depth) {
    static constexpr std::pair<std::string_view, uint32_t> kLooks[] = {
        {"?<=", kBehind}, {"?<!", kBehind | kNegated}, {"?=", 0}, {"?!", kNegated}};
    for (const auto& [token, bits] : kLooks) {
      if (!take(token)) continue;
      const uint32_t look = emit(Code::Look, 0, bits);
      readAlternatives(depth + 1);
      emit(Code::Match);
      if (ok()) code_[look].a = here();
      return closeGroup();
    }
    if (!take("?:") && more() && pattern_[at_] == '?') return fail("this kind of group is unknown");
    readAlternatives(depth + 1);
    closeGroup();
  }
  void closeGroup() {
    if (ok() && !take(")")) fail("a '(' is not closed");
  }

  uint32_t readHex(size_t digits) {
    uint32_t v = 0;
    for (size_t i = 0; i < digits; ++i) {
      if (!more() || !std::isxdigit(static_cast<unsigned char>(pattern_[at_]))) {
        fail("a hexadecimal digit is missing");
        return 0;
      }
      const char c = pattern_[at_++];
      v = v * 16 + static_cast<uint32_t>(c <= '9' ? c - '0' : (c | 32) - 'a' + 10);
    }
    return v;
  }

  // The byte that an escaped letter stands for.
  uint32_t escapedByte(char c) {
    switch (c) {
      case 't': return '\t';
      case 'n': return '\n';
      case 'r': return '\r';
      case 'f': return '\f';
      case 'v': return '\v';
      case '0': return 0;
      case 'x': return readHex(2);
      case 'u': return readHex(4);
      default: return static_cast<unsigned char>(c);
    }
  }

  static bool isClass(char c) { return c == 'd' || c == 's' || c == 'w'; }
  static bool isOtherClass(char c) { return c == 'D' || c == 'S' || c == 'W'; }

  void readEscape() {
    if (!more()) return fail("a '\\' stands at the end");
    const char c = pattern_[at_++];
    if (isClass(c)) return emitSet(classOf(c));
    if (isOtherClass(c)) return emitSet(~classOf(static_cast<char>(c | 32)));
    if (c == 'b' || c == 'B') {
      emit(Code::Boundary, c == 'B' ? 1 : 0);
      return;
    }
    emitCodePoint(escapedByte(c));
  }

  void emitCodePoint(uint32_t v) {
    if (v < 0x80) {
      emit(Code::Byte, v);
    } else if (v < 0x800) {
      emit(Code::Byte, 0xc0 | v >> 6);
      emit(Code::Byte, 0x80 | (v & 63));
    } else {
      emit(Code::Byte, 0xe0 | v >> 12);
      emit(Code::Byte, 0x80 | (v >> 6 & 63));
      emit(Code::Byte, 0x80 | (v & 63));
    }
  }

  void readSet() {
    ByteSet set;
    const bool negated = take("^");
    bool first = true;
    while (more() && (first || pattern_[at_] != ']')) {
      first = false;
      char c = pattern_[at_++];
      uint32_t low = static_cast<unsigned char>(c);
      if (c == '\\' && more()) {
        c = pattern_[at_++];
        if (isClass(c) || isOtherClass(c)) {
          const ByteSet in = classOf(static_cast<char>(c | 32));
          set |= isClass(c) ? in : ~in;
          continue;
        }
        low = escapedByte(c) & 0xff;
      }
      uint32_t high = low;
      if (at_ + 1 < pattern_.size() && pattern_[at_] == '-' && pattern_[at_ + 1] != ']') {
        ++at_;
        c = pattern_[at_++];
        high = c == '\\' && more() ? escapedByte(pattern_[at_++]) & 0xff
                                   : static_cast<unsigned char>(c);
        if (high < low) return fail("a range in [ ] runs backwards");
      }
      for (uint32_t v = low; v <= high; ++v) set.set(v);
    }
    if (!take("]")) return fail("a '[' is not closed");
    emitSet(negated ? ~set : set);
  }

  std::string_view pattern_;
  std::vector<Instruction>& code_;
  std::vector<ByteSet>& sets_;
  std::string& error_;
  size_t at_ = 0;
};

}  // namespace

// One search: the pairs of instruction and place that were tried, and the work that is left.
struct Regex::Program::Run {
  const Program& program;
  std::string_view text;
  size_t work = kMaxWork;
  std::unordered_set<uint64_t> tried;
  size_t end = 0;

  static constexpr size_t kAnywhere = ~size_t{0};

  // Whether the part at `start` matches from `from`; at `mustEnd` unless that is kAnywhere.
  bool matches(uint32_t start, size_t from, size_t mustEnd, std::unordered_set<uint64_t>& seen) {
    std::vector<std::pair<uint32_t, size_t>> open{{start, from}};
    while (!open.empty()) {
      auto [pc, at] = open.back();
      open.pop_back();
      while (true) {
        if (work == 0) return false;
        --work;
        gable::work();
        if (!seen.insert(uint64_t{pc} << 40 | at).second) break;
        const Instruction& in = program.code[pc];
        if (in.code == Code::Match) {
          if (mustEnd != kAnywhere && at != mustEnd) break;
          end = at;
          return true;
        }
        if (in.code == Code::Split) {
          open.emplace_back(in.b, at);
          pc = in.a;
        } else if (in.code == Code::Jump) {
          pc = in.a;
        } else if (in.code == Code::Look) {
          if (!looks(pc, at)) break;
          pc = in.a;
        } else {
          if (!step(in, at)) break;
          ++pc;
        }
      }
    }
    return false;
  }

  // An instruction for one byte or one place.
  bool step(const Instruction& in, size_t& at) const {
    switch (in.code) {
      case Code::Byte: return at < text.size() && static_cast<unsigned char>(text[at++]) == in.a;
      case Code::Set:
        return at < text.size() && program.sets[in.a][static_cast<unsigned char>(text[at++])];
      case Code::Begin: return at == 0;
      case Code::End: return at == text.size();
      default: {
        const bool before = at > 0 && wordByte(text, at - 1);
        return (before != wordByte(text, at)) == (in.a == 0);
      }
    }
  }

  bool looks(uint32_t pc, size_t at) {
    const Instruction& in = program.code[pc];
    const size_t outerEnd = end;
    bool found = false;
    if (in.b & kBehind) {
      for (size_t from = at + 1; from-- > 0 && !found && work > 0;) {
        std::unordered_set<uint64_t> seen;
        found = matches(pc + 1, from, at, seen);
      }
    } else {
      std::unordered_set<uint64_t> seen;
      found = matches(pc + 1, at, kAnywhere, seen);
    }
    end = outerEnd;
    return found == ((in.b & kNegated) == 0);
  }
};

Regex::Regex(std::string_view pattern) : program_(std::make_unique<Program>()) {
  Reader(pattern, program_->code, program_->sets, error_).read();
}
Regex::~Regex() = default;
Regex::Regex(Regex&&) noexcept = default;
Regex& Regex::operator=(Regex&&) noexcept = default;

Regex::Match Regex::search(std::string_view text, size_t from, size_t* work) const {
  if (!valid()) return {};
  // What failed from an earlier beginning fails from a later one too, so `tried` is kept.
  Program::Run run{*program_, text};
  const size_t allowed = work ? std::min(*work, kMaxWork) : kMaxWork;
  run.work = allowed;
  Match match;
  for (size_t begin = from; begin <= text.size() && run.work > 0 && !match.found; ++begin) {
    if (run.matches(0, begin, Program::Run::kAnywhere, run.tried)) match = {true, begin, run.end};
  }
  if (work) *work -= allowed - run.work;
  return match;
}

bool Regex::matchesWhole(std::string_view text) const {
  if (!valid()) return false;
  Program::Run run{*program_, text};
  return run.matches(0, 0, text.size(), run.tried);
}

}  // namespace gable
