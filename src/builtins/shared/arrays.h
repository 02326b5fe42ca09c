// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Small helpers for functions that work on arrays and string lists.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "program/value.h"

namespace gable {

/// A row of strings.
Value stringArray(const std::vector<std::string>& items, ValuePool& pool);
/// The elements of a string array as texts.
std::vector<std::string> stringsOf(const Array& a, const ValuePool& pool);

/// The items of a string list ("a;b;"), parts of its text; an item after the last semicolon counts.
std::vector<std::string_view> itemsOf(std::string_view list);
/// A string list, each item ended by a semicolon; one that grows beyond kMaxTextLength ends there.
std::string listOf(const std::vector<std::string>& items);
std::string listOf(const std::vector<std::string_view>& items);

/// < 0, 0, > 0: numbers, texts by bytes, arrays row by row; of equal rows the shorter is less.
int orderOf(const Value& a, const Value& b, const ValuePool& pool);

/// A text as a number: what stands at its beginning; NaN when that is none.
double numberOf(std::string_view text);
/// Whether a text means yes: all do but "", "f", "false" and zeros.
bool truthOf(std::string_view text);

}  // namespace gable
