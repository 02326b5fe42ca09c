// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include "lang/other_languages.h"

#include "base/text.h"

namespace gable::lang {

namespace {

using enum ForeignUse;

constexpr std::string_view kLoops =
    "rules have no loops: split(x) { ~2 : Part }* repeats parts, and a rule may apply itself: "
    "A(n) --> case n > 0 : Part A(n - 1) else : NIL";
constexpr std::string_view kConditions = "conditions are written 'case condition : ... else : ...'";
constexpr std::string_view kFurther =
    "write 'case': it begins each further branch, and only the last begins with 'else'";
constexpr std::string_view kRules =
    "a rule is written 'Name(a) --> operations', a function 'name(a) = value'";
constexpr std::string_view kValues =
    "write 'attr name = value' where users may change it, else 'const name = value'; within a rule "
    "'Name with (name := value) --> ...'";
constexpr std::string_view kSmall =
    "the words before declarations are small: attr, const, import, style";
constexpr std::string_view kResults =
    "a function is its value: name(a) = a * 2; a rule gives no value";
constexpr std::string_view kImports =
    "another rule file is read by: import name : \"file.cga\"; its rules are name.Rule";
constexpr std::string_view kNothing =
    "there is no empty value: write \"\" or 0, and the operation NIL where nothing shall be made";
constexpr std::string_view kPowers = "write pow(a, b) for a power";
constexpr std::string_view kItself =
    "values of the shape stand alone: scope.sx, geometry.area, and attributes by their name";

constexpr ForeignWord kWords[] = {
    {"<>", Operator, "!=", {}, TokenKind::NotEqual},
    {"!==", Operator, "!=", {}, TokenKind::NotEqual},
    {"=>", Operator, ">=", {}, TokenKind::GreaterEqual},
    {"=<", Operator, "<=", {}, TokenKind::LessEqual},
    {"===", Operator, "==", {}, TokenKind::EqualEqual},
    {"is", Operator, "==", {}, TokenKind::EqualEqual},
    {"and", Operator, "&&", {}, TokenKind::And},
    {"&", Operator, "&&", {}, TokenKind::And},
    {"or", Operator, "||", {}, TokenKind::Or},
    {"|", Operator, "||", {}, TokenKind::Or},
    {"mod", Operator, "%", {}, TokenKind::Percent},
    {"**", Operator, {}, kPowers, TokenKind::Star},
    {"^", Operator, {}, kPowers, TokenKind::Star},
    {"//", Operator, {}, "write floor(a / b) for a quotient without rest"},
    {"?", Operator, {}, "choose by case: case a > 2: 10 else: 5"},
    {"+=", Operator, {}, "values stay as they are: set(a, a + 1) gives the shape another one"},
    {"-=", Operator, {}, "values stay as they are: set(a, a - 1) gives the shape another one"},
    {"*=", Operator, {}, "values stay as they are: set(a, a * 2) gives the shape another one"},
    {"/=", Operator, {}, "values stay as they are: set(a, a / 2) gives the shape another one"},
    {":=", Operator, {}, "values stay as they are: set(a, 3) gives the shape another one"},
    {"++", Operator, {}, "values stay as they are: set(a, a + 1) gives the shape another one"},

    {"->", Arrow, "-->", "write '-->' behind the head of a rule, ':' behind a size or a selector"},
    {"==>", Arrow, "-->", "write '-->' behind the head of a rule, ':' behind a size or a selector"},
    {"=>", Arrow, "-->", "write '-->' behind the head of a rule, ':' behind a size or a selector"},

    {"elif", Branch, "case", kFurther},
    {"elseif", Branch, "case", kFurther},
    {"elsif", Branch, "case", kFurther},
    {"else if", Branch, "case", kFurther},
    {"default", Branch, "else"},
    {"otherwise", Branch, "else"},

    {"def", Declaration, {}, kRules},
    {"define", Declaration, {}, kRules},
    {"fn", Declaration, {}, kRules},
    {"func", Declaration, {}, kRules},
    {"function", Declaration, {}, kRules},
    {"rule", Declaration, {}, kRules},
    {"void", Declaration, {}, kRules},
    {"Attr", Declaration, "attr", kSmall},
    {"Const", Declaration, "const", kSmall},
    {"attribute", Declaration, "attr", kValues},
    {"auto", Declaration, "attr", kValues},
    {"bool", Declaration, "attr", kValues},
    {"boolean", Declaration, "attr", kValues},
    {"double", Declaration, "attr", kValues},
    {"float", Declaration, "attr", kValues},
    {"int", Declaration, "attr", kValues},
    {"let", Declaration, "attr", kValues},
    {"number", Declaration, "attr", kValues},
    {"param", Declaration, "attr", kValues},
    {"string", Declaration, "attr", kValues},
    {"val", Declaration, "attr", kValues},
    {"var", Declaration, "attr", kValues},
    {"from", Declaration, {}, kImports},
    {"include", Declaration, {}, kImports},
    {"require", Declaration, {}, kImports},
    {"using", Declaration, {}, kImports},

    {"for", Statement, {}, kLoops},
    {"foreach", Statement, {}, kLoops},
    {"while", Statement, {}, kLoops},
    {"return", Statement, {}, kResults},
    {"if", Statement, "case", kConditions},
    {"switch", Statement, {}, kConditions},

    {"True", Value, "true"},
    {"False", Value, "false"},
    {"None", Value, {}, kNothing},
    {"nil", Value, {}, kNothing},
    {"null", Value, {}, kNothing},
    {"nullptr", Value, {}, kNothing},
    {"undefined", Value, {}, kNothing},
    {"pi", Value, "3.141592653589793",
     "write the number, 3.141592653589793; angles are in degrees"},
    {"self", Value, {}, kItself},
    {"this", Value, {}, kItself},

    {"append", Function, "listAdd"},
    {"fabs", Function, "abs"},
    {"int", Function, "floor"},
    {"length", Function, {}, "write len(text) for a text, size(array) for an array"},
    {"log", Function, "ln"},
    {"not", Function, {}, "write !(...)"},
    {"parseFloat", Function, "float"},
    {"parseInt", Function, {}, "write floor(float(text))"},
    {"randint", Function, {}, "write floor(rand(from, to + 1))"},
    {"random", Function, {}, "write rand(from, to); rand() lies between 0 and 1"},
    {"range", Function, {}, "write [0 : n - 1] for the numbers from 0 to n - 1"},
    {"round", Function, "rint"},
    {"split", Function, "splitString"},
    {"strlen", Function, "len"},
    {"substr", Function, "substring"},
    {"uniform", Function, "rand"},
    {"with", Function, {}, "'with' stands before the '=': f(a) with (b := a) = b + 1"},

    {"component", Operation, {}, "in CGA it is 'comp(f) { side : operations | top : operations }'"},
    {"delete", Operation, {}, "write NIL where nothing shall be made"},
    {"remove", Operation, {}, "write NIL where nothing shall be made"},
    {"rx", Operation, {}, "in CGA it is 'r(angle, 0, 0)'"},
    {"ry", Operation, {}, "in CGA it is 'r(0, angle, 0)'"},
    {"rz", Operation, {}, "in CGA it is 'r(0, 0, angle)'"},
    {"snap", Operation, {}, "CGA has no snap lines; give the parts that shall line up equal sizes"},
    {"subdiv",
     Operation,
     {},
     "in CGA it is 'split(y) { size : operations | ... }': the axis is a word, and each size "
     "stands "
     "before its part"},
    {"insert", Operation, "i"},
    {"move", Operation, "t"},
    {"rotate", Operation, "r"},
    {"scale", Operation, "s"},
    {"size", Operation, "s"},
    {"translate", Operation, "t"},

    {"gable", Selector, {}, "write isTagged(\"roof.side\") for the gables of a roof"},
    {"roof", Selector, {}, "write isTagged(\"roof.top\") for the slopes of a roof"},
    {"slope", Selector, {}, "write isTagged(\"roof.top\") for the slopes of a roof"},
    {"wall", Selector, {}, "write 'side' for the walls of a body"},
    {"walls", Selector, {}, "write 'side' for the walls of a body"},
};

}  // namespace

std::span<const ForeignWord> foreignWords() { return kWords; }

const ForeignWord* foreignWord(ForeignUse use, std::string_view word) {
  for (const ForeignWord& w : kWords) {
    if (w.use == use && equalButForCase(w.word, word)) return &w;
  }
  return nullptr;
}

std::string remedyOf(const ForeignWord& word) {
  if (!word.remedy.empty()) return std::string(word.remedy);
  return "write '" + std::string(word.instead) + "'";
}

std::string_view withoutForeignModule(std::string_view name) {
  const size_t dot = name.find('.');
  if (dot == std::string_view::npos) return {};
  const std::string_view module = name.substr(0, dot);
  for (const std::string_view known : {"math", "np", "numpy", "random", "std", "self", "this"}) {
    if (equalButForCase(module, known)) return name.substr(dot + 1);
  }
  return {};
}

}  // namespace gable::lang
