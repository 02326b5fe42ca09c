// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Lists inside one text, each item ended by a semicolon: what rules had before there were arrays.

#include <algorithm>
#include <cmath>

#include "builtins/lists.h"
#include "builtins/shared/arrays.h"
#include "shape/op_call.h"

namespace gable {

namespace {

using Items = std::vector<std::string_view>;

Items items(const FunctionCall& call) { return itemsOf(call.text(0)); }
Value list(const FunctionCall& call, const Items& all) { return call.result(listOf(all)); }

// A * at the beginning or the end of the pattern stands for anything.
bool matches(std::string_view item, std::string_view pattern) {
  const bool before = pattern.starts_with('*');
  if (before) pattern.remove_prefix(1);
  const bool after = pattern.ends_with('*');
  if (after) pattern.remove_suffix(1);
  if (before && after) return item.find(pattern) != std::string_view::npos;
  if (before) return item.ends_with(pattern);
  if (after) return item.starts_with(pattern);
  return item == pattern;
}

Value listItem(FunctionCall& call) {
  const Items all = items(call);
  const double index = std::trunc(call.number(1));
  const bool inside = index >= 0 && index < static_cast<double>(all.size());
  return call.result(inside ? std::string_view(all[static_cast<size_t>(index)]) : "");
}

Value listFirst(FunctionCall& call) {
  const Items all = items(call);
  return call.result(all.empty() ? "" : all.front());
}

Value listLast(FunctionCall& call) {
  const Items all = items(call);
  return call.result(all.empty() ? "" : all.back());
}

Value listSize(FunctionCall& call) { return Value::of(static_cast<double>(items(call).size())); }

Value listIndex(FunctionCall& call) {
  const Items all = items(call);
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const auto& i) { return matches(i, call.text(1)); });
  return Value::of(at == all.end() ? -1.0 : static_cast<double>(at - all.begin()));
}

Value listCount(FunctionCall& call) {
  const Items all = items(call);
  return Value::of(static_cast<double>(std::count_if(
      all.begin(), all.end(), [&](const auto& i) { return matches(i, call.text(1)); })));
}

Value listRandom(FunctionCall& call) {
  const Items all = items(call);
  if (all.empty()) return call.result("");
  const double draw = randomIn(call.randomAddress(0), 0, static_cast<double>(all.size()));
  return call.result(all[std::min(static_cast<size_t>(draw), all.size() - 1)]);
}

Value listRange(FunctionCall& call) {
  const Items all = items(call);
  const double size = static_cast<double>(all.size());
  const auto bound = [&](size_t argument) {
    const double v = std::trunc(call.number(argument));
    return v > 0 ? static_cast<ptrdiff_t>(std::min(v, size)) : ptrdiff_t{0};
  };
  const ptrdiff_t from = bound(1), to = bound(2);
  if (from >= to) return call.result("");
  return list(call, Items(all.begin() + from, all.begin() + to));
}

Value listAdd(FunctionCall& call) {
  Items all = items(call);
  const Items more = itemsOf(call.text(1));
  all.insert(all.end(), more.begin(), more.end());
  return list(call, all);
}

Value listRemove(FunctionCall& call) {
  Items all = items(call);
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const auto& i) { return matches(i, call.text(1)); });
  if (at != all.end()) all.erase(at);
  return list(call, all);
}

template <bool keepMatching>
Value filtered(FunctionCall& call) {
  Items kept;
  for (const std::string_view item : items(call)) {
    if (matches(item, call.text(1)) == keepMatching) kept.push_back(item);
  }
  return list(call, kept);
}

Value listClean(FunctionCall& call) {
  Items all = items(call);
  all.erase(std::remove(all.begin(), all.end(), std::string_view()), all.end());
  return list(call, all);
}

Value listTerminate(FunctionCall& call) {
  const std::string_view text = call.text(0);
  if (text.empty() || text.back() == ';') return call.arg(0);
  return call.result(std::string(text) + ";");
}

Value listFromArray(FunctionCall& call) {
  const Array& a = call.array(0);
  const ValuePool& pool = call.services().pool();
  std::vector<std::string> all;
  size_t length = 0;
  for (size_t i = 0; i < a.size() && length <= kMaxTextLength; ++i) {
    const bool text = a.element == ValueType::String;
    all.push_back(text ? std::string(pool.text(a.strings[i]))
                       : pool.str({a.element, Unit::Absolute, 0, a.numbers[i]}));
    length += all.back().size();
  }
  return call.result(listOf(all));
}

Value listToArray(FunctionCall& call) {
  const Items all = items(call);
  if (all.size() <= kMaxArraySize) {
    return stringArray({all.begin(), all.end()}, call.services().pool());
  }
  return call.fail("array-too-large", "the list has more items than an array may have",
                   "arrays have up to 100000 elements", stringArray({}, call.services().pool()));
}

constexpr ParamSpec kList = {"stringList", ParamType::String, "Items, each ended by a semicolon."};
constexpr ParamSpec kSearch = {"searchString", ParamType::String,
                               "The item to look for; * at its beginning or end stands for any "
                               "characters."};
constexpr ValueType kFloat = ValueType::Float, kString = ValueType::String;

constexpr ParamSpec kListParams[] = {kList};
constexpr Signature kTextOfList[] = {{kListParams, kString}};
constexpr Signature kNumberOfList[] = {{kListParams, kFloat}};
constexpr Signature kArrayOfList[] = {{kListParams, ValueType::StringArray}};
constexpr ParamSpec kItemParams[] = {
    kList, {"index", ParamType::Float, "The number of the item, counted from 0."}};
constexpr Signature kItem[] = {{kItemParams, kString}};
constexpr ParamSpec kSearchParams[] = {kList, kSearch};
constexpr Signature kNumberOfSearch[] = {{kSearchParams, kFloat}};
constexpr Signature kTextOfSearch[] = {{kSearchParams, kString}};
constexpr ParamSpec kRangeParams[] = {
    kList,
    {"leftIndex", ParamType::Float, "The first item to take, counted from 0."},
    {"rightIndex", ParamType::Float, "The first item not to take any more."}};
constexpr Signature kRange[] = {{kRangeParams, kString}};
constexpr ParamSpec kAddParams[] = {kList, {"item", ParamType::String, "The item to append."}};
constexpr Signature kAdd[] = {{kAddParams, kString}};
constexpr ParamSpec kFloats[] = {{"array", ParamType::FloatArray, "Numbers."}};
constexpr ParamSpec kBools[] = {{"array", ParamType::BoolArray, "Truth values."}};
constexpr ParamSpec kStrings[] = {{"array", ParamType::StringArray, "Texts."}};
constexpr Signature kFromArray[] = {{kFloats, kString}, {kBools, kString}, {kStrings, kString}};

constexpr const char* kFamily = "string lists";
constexpr FunctionSpec kFunctions[] = {
    {"listItem", kFamily, "An item of a list; an empty text outside of it.", kItem, listItem},
    {"listFirst", kFamily, "The first item of a list.", kTextOfList, listFirst},
    {"listLast", kFamily, "The last item of a list.", kTextOfList, listLast},
    {"listSize", kFamily, "The number of items of a list.", kNumberOfList, listSize},
    {"listIndex", kFamily, "The number of the first matching item; -1 when there is none.",
     kNumberOfSearch, listIndex},
    {"listCount", kFamily, "How many items of a list match.", kNumberOfSearch, listCount},
    {"listRandom", kFamily, "A random item of a list.", kTextOfList, listRandom, kRandom},
    {"listRange", kFamily, "The items of a list from one number to before another.", kRange,
     listRange},
    {"listAdd", kFamily, "A list with an item appended.", kAdd, listAdd},
    {"listRemove", kFamily, "A list without the first matching item.", kTextOfSearch, listRemove},
    {"listRemoveAll", kFamily, "A list without all matching items.", kTextOfSearch,
     filtered<false>},
    {"listRetainAll", kFamily, "The matching items of a list.", kTextOfSearch, filtered<true>},
    {"listClean", kFamily, "A list without empty items, each item ended by a semicolon.",
     kTextOfList, listClean},
    {"listTerminate", kFamily, "A list with a semicolon at its end.", kTextOfList, listTerminate},
    {"listFromArray", kFamily, "The elements of an array as a list.", kFromArray, listFromArray},
    {"listToArray", kFamily, "The items of a list as an array.", kArrayOfList, listToArray},
};

}  // namespace

extern const FunctionList kFunctions_string_lists;
const FunctionList kFunctions_string_lists = {kFunctions, {}};

}  // namespace gable
