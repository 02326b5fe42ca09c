// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// How an operation or a function says what it takes: a struct of its own with a field for each
// parameter, and a declaration that binds the two. The C++ type of the field is the type of the
// parameter; nothing else has to agree with it.
//
//   enum class Anchor { Origin, Center };
//   template <> struct WordsOf<Anchor> { static constexpr const char* text = "origin center"; };
//
//   struct Resize { Size x; Anchor anchor; };
//   constexpr ParamSpec kParams[] = {
//       param<&Resize::x>("x", "The size along x."),
//       param<&Resize::anchor>("anchor", "What stays in place.", "origin"),
//   };
//
// What a number or a text must be beyond its type is declared as well, and only here:
// param<&Grid::path>("path", "Width of the paths.", "3").atLeast(0). `gable check` tells a value
// that is written out, bindArguments() any other; the operation gets no value that is not taken.
//
// The analysis chooses the signature, the compiler fills in the defaults, and bindArguments() fills
// the struct. A field that no parameter of the chosen signature names keeps its initialiser: so one
// struct serves all signatures of an operation, and tells them apart.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "program/spec.h"
#include "program/value.h"

namespace gable {

/// A length that may be written as a share of the scope: '0.5.
struct Size {
  double number = 0;
  Unit unit = Unit::Absolute;
  /// In metres, for a scope that measures `whole`.
  double of(double whole) const { return unit == Unit::Relative ? number * whole : number; }
};

/// A size that may be written as a share of what is left over: ~2.
struct FloatingSize : Size {};

/// A text, where its number in the pool is wanted too.
struct Text {
  std::string_view text;
  StringId id = 0;
};

/// A word without quotes, or a text in its place.
struct Word {
  std::string_view text;
  StringId id = 0;
  bool operator==(std::string_view other) const { return text == other; }
};

/// Arrays; never null once bound.
struct Floats {
  const Array* array = nullptr;
};
struct Bools {
  const Array* array = nullptr;
};
struct Strings {
  const Array* array = nullptr;
};

/// Arguments that the operation works out itself, each time it needs them; see shape/argument.h.
struct Drawn {
  Value value = Value::of(0.0);
};
struct DrawnList {
  Value value = Value::of(0.0);
};
struct Selection {
  Value value;
};

/// The words of an enumeration in the order of its values, separated by blanks: specialise it for
/// an enumeration that is used as the type of a field.
template <class E>
struct WordsOf;

/// The place of a word among words separated by blanks; -1 when it is none of them.
int wordIndex(const char* words, std::string_view word);

namespace arguments_detail {

template <class T>
struct FieldType;

template <>
struct FieldType<double> {
  static constexpr ParamType type = ParamType::Float;
  static constexpr const char* words = nullptr;
  static bool read(double& to, const Value& v, const ValuePool&) {
    to = v.number;
    return v.type == ValueType::Float;
  }
};

template <>
struct FieldType<bool> {
  static constexpr ParamType type = ParamType::Bool;
  static constexpr const char* words = nullptr;
  static bool read(bool& to, const Value& v, const ValuePool&) {
    to = v.truth();
    return v.type == ValueType::Bool;
  }
};

template <>
struct FieldType<std::string_view> {
  static constexpr ParamType type = ParamType::String;
  static constexpr const char* words = nullptr;
  static bool read(std::string_view& to, const Value& v, const ValuePool& pool) {
    if (v.type != ValueType::String) return false;
    to = pool.text(v.id);
    return true;
  }
};

template <>
struct FieldType<Text> {
  static constexpr ParamType type = ParamType::String;
  static constexpr const char* words = nullptr;
  static bool read(Text& to, const Value& v, const ValuePool& pool) {
    if (v.type != ValueType::String) return false;
    to = {pool.text(v.id), v.id};
    return true;
  }
};

template <>
struct FieldType<Word> {
  static constexpr ParamType type = ParamType::Selector;
  static constexpr const char* words = nullptr;
  static bool read(Word& to, const Value& v, const ValuePool& pool) {
    if (v.type != ValueType::Selector && v.type != ValueType::String) return false;
    to = {pool.text(v.id), v.id};
    return true;
  }
};

template <>
struct FieldType<Size> {
  static constexpr ParamType type = ParamType::Size;
  static constexpr const char* words = nullptr;
  static bool read(Size& to, const Value& v, const ValuePool&) {
    to = {v.number, v.unit};
    return v.type == ValueType::Float;
  }
};

template <>
struct FieldType<FloatingSize> {
  static constexpr ParamType type = ParamType::FloatingSize;
  static constexpr const char* words = nullptr;
  static bool read(FloatingSize& to, const Value& v, const ValuePool& pool) {
    return FieldType<Size>::read(to, v, pool);
  }
};

template <>
struct FieldType<Value> {
  static constexpr ParamType type = ParamType::Any;
  static constexpr const char* words = nullptr;
  static bool read(Value& to, const Value& v, const ValuePool&) {
    to = v;
    return true;
  }
};

template <class T, ParamType kParam>
struct CodeField {
  static constexpr ParamType type = kParam;
  static constexpr const char* words = nullptr;
  static bool read(T& to, const Value& v, const ValuePool&) {
    to.value = v;
    const bool word = v.type == ValueType::Selector || v.isArray();
    return v.type == ValueType::Float || v.type == ValueType::Code ||
           (kParam == ParamType::Selection && word) ||
           (kParam == ParamType::DrawnList && v.type == ValueType::FloatArray);
  }
};
template <>
struct FieldType<Drawn> : CodeField<Drawn, ParamType::Drawn> {};
template <>
struct FieldType<DrawnList> : CodeField<DrawnList, ParamType::DrawnList> {};
template <>
struct FieldType<Selection> : CodeField<Selection, ParamType::Selection> {};

template <class T, ParamType kParam, ValueType kValue>
struct ArrayField {
  static constexpr ParamType type = kParam;
  static constexpr const char* words = nullptr;
  static bool read(T& to, const Value& v, const ValuePool& pool) {
    if (v.type != kValue) return false;
    to.array = &pool.array(v);
    return true;
  }
};
template <>
struct FieldType<Floats> : ArrayField<Floats, ParamType::FloatArray, ValueType::FloatArray> {};
template <>
struct FieldType<Bools> : ArrayField<Bools, ParamType::BoolArray, ValueType::BoolArray> {};
template <>
struct FieldType<Strings> : ArrayField<Strings, ParamType::StringArray, ValueType::StringArray> {};

/// A parameter that may be missing: what then happens is the operation's own to say.
template <class T>
struct FieldType<std::optional<T>> {
  static constexpr ParamType type = FieldType<T>::type;
  static constexpr const char* words = FieldType<T>::words;
  static bool read(std::optional<T>& to, const Value& v, const ValuePool& pool) {
    if (v.type == ValueType::Null) {
      to.reset();
      return true;
    }
    return FieldType<T>::read(to.emplace(), v, pool);
  }
};

template <class E>
requires std::is_enum_v<E>
struct FieldType<E> {
  static constexpr ParamType type = ParamType::Selector;
  static constexpr const char* words = WordsOf<E>::text;
  static bool read(E& to, const Value& v, const ValuePool& pool) {
    if (v.type != ValueType::Selector && v.type != ValueType::String) return false;
    const int place = wordIndex(words, pool.text(v.id));
    if (place < 0) return false;
    to = static_cast<E>(place);
    return true;
  }
};

template <class T>
struct IsOptional : std::false_type {};
template <class T>
struct IsOptional<std::optional<T>> : std::true_type {};

template <class S, class T>
S structOf(T S::*);
template <class S, class T>
T fieldOf(T S::*);
template <auto Member>
inline constexpr ParamType typeOf = FieldType<decltype(fieldOf(Member))>::type;

// Internal: compilers give instances for members of structs without linkage one name in all files.
template <auto Member, ParamType kType>
static bool store(void* arguments, const Value& v, const ValuePool& pool) {
  using S = decltype(structOf(Member));
  using T = decltype(fieldOf(Member));
  // A field for any value does not know what the parameter takes.
  if constexpr (FieldType<T>::type == ParamType::Any && kType != ParamType::Any) {
    const bool missing = IsOptional<T>::value && v.type == ValueType::Null;
    if (v.type != valueType(kType) && !missing) return false;
  }
  return FieldType<T>::read(static_cast<S*>(arguments)->*Member, v, pool);
}

}  // namespace arguments_detail

/// Declares a parameter. `defaultText` is the default as it is written in a rule; a std::optional
/// field has none, and the text then says in words what happens without it. `words` are those that
/// a Word takes; an enumeration has its own. `kType` is for fields that take more than the
/// parameter does, such as a Value that is a number in one signature and a text in another.
template <auto Member, ParamType kType = arguments_detail::typeOf<Member>>
constexpr ParamSpec param(const char* name, const char* doc, const char* defaultText = nullptr,
                          const char* words = nullptr) {
  using T = decltype(arguments_detail::fieldOf(Member));
  using Field = arguments_detail::FieldType<T>;
  ParamSpec p{name, kType, doc, defaultText, words ? words : Field::words};
  p.store = &arguments_detail::store<Member, kType>;
  p.mayBeMissing = arguments_detail::IsOptional<T>::value;
  return p;
}

/// The same for a Selection, with the terms that it is made of. `single` when one stands alone.
template <auto Member>
constexpr ParamSpec selection(const char* name, const char* doc, std::span<const TermSpec> terms,
                              const char* defaultText = nullptr, bool single = false) {
  ParamSpec p = param<Member>(name, doc, defaultText);
  p.terms = terms;
  p.single = single;
  return p;
}

/// What is wrong with a call when it is run, if anything.
struct ArgumentProblem {
  enum class Kind : uint8_t { None, Count, Type, Value } kind = Kind::None;
  /// Type, Value: which argument, and the parameter that it is for.
  size_t index = 0;
  const ParamSpec* param = nullptr;
};

/// Fills the struct from the values of a call. `form` is the signature that the analysis chose,
/// with a value for each of its parameters; when it is null the values decide among `signatures`,
/// and defaults are filled in. The pool may grow by the texts of defaults.
ArgumentProblem bindArguments(std::span<const Signature> signatures, const Signature* form,
                              std::span<const Value> values, ValuePool& pool, void* arguments);

/// The default of a parameter as a value; Null where there is none to fill in.
Value defaultValue(const ParamSpec& param, ValuePool& pool);

/// A sentence on a problem: "'overhang' of 'roofHip' is a string, not a float".
std::string problemText(const ArgumentProblem& problem, std::string_view callee,
                        std::span<const Value> values, const ValuePool& pool);
/// What to do about it: the words, or what the parameter is.
std::string problemHint(const ArgumentProblem& problem);

/// Whether a value lies in the range of a parameter and has its form. Arguments that the operation
/// works out itself are known only then, and are taken here.
bool isTaken(const ParamSpec& param, const Value& v, const ValuePool& pool);
/// "'path' of 'grid' cannot be -1", for a value that is not taken, and what to do about it.
std::string refusalText(const ParamSpec& param, std::string_view callee, const Value& v,
                        const ValuePool& pool);
std::string refusalHint(const ParamSpec& param);

}  // namespace gable
