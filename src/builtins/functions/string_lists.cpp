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

struct List {
  Text list;
  Items items() const { return itemsOf(list.text); }
};

// An item or a pattern beside the list.
struct ListAndItem : List {
  std::string_view item;
};

struct ListAndIndex : List {
  double index;
};

struct Range : List {
  double left, right;
};

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

Value listItem(FunctionCall& call, const ListAndIndex& args) {
  const Items all = args.items();
  const double index = std::trunc(args.index);
  const bool inside = index >= 0 && index < static_cast<double>(all.size());
  return call.result(inside ? std::string_view(all[static_cast<size_t>(index)]) : "");
}

Value listFirst(FunctionCall& call, const List& args) {
  const Items all = args.items();
  return call.result(all.empty() ? "" : all.front());
}

Value listLast(FunctionCall& call, const List& args) {
  const Items all = args.items();
  return call.result(all.empty() ? "" : all.back());
}

Value listSize(FunctionCall&, const List& args) {
  return Value::of(static_cast<double>(args.items().size()));
}

Value listIndex(FunctionCall&, const ListAndItem& args) {
  const Items all = args.items();
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const auto& i) { return matches(i, args.item); });
  return Value::of(at == all.end() ? -1.0 : static_cast<double>(at - all.begin()));
}

Value listCount(FunctionCall&, const ListAndItem& args) {
  const Items all = args.items();
  return Value::of(static_cast<double>(
      std::count_if(all.begin(), all.end(), [&](const auto& i) { return matches(i, args.item); })));
}

Value listRandom(FunctionCall& call, const List& args) {
  const Items all = args.items();
  if (all.empty()) return call.result("");
  const double draw = randomIn(call.randomAddress(0), 0, static_cast<double>(all.size()));
  return call.result(all[std::min(static_cast<size_t>(draw), all.size() - 1)]);
}

Value listRange(FunctionCall& call, const Range& args) {
  const Items all = args.items();
  const double size = static_cast<double>(all.size());
  const auto bound = [&](double index) {
    const double v = std::trunc(index);
    return v > 0 ? static_cast<ptrdiff_t>(std::min(v, size)) : ptrdiff_t{0};
  };
  const ptrdiff_t from = bound(args.left), to = bound(args.right);
  if (from >= to) return call.result("");
  return list(call, Items(all.begin() + from, all.begin() + to));
}

Value listAdd(FunctionCall& call, const ListAndItem& args) {
  Items all = args.items();
  const Items more = itemsOf(args.item);
  all.insert(all.end(), more.begin(), more.end());
  return list(call, all);
}

Value listRemove(FunctionCall& call, const ListAndItem& args) {
  Items all = args.items();
  const auto at =
      std::find_if(all.begin(), all.end(), [&](const auto& i) { return matches(i, args.item); });
  if (at != all.end()) all.erase(at);
  return list(call, all);
}

template <bool keepMatching>
Value filtered(FunctionCall& call, const ListAndItem& args) {
  Items kept;
  for (const std::string_view item : args.items()) {
    if (matches(item, args.item) == keepMatching) kept.push_back(item);
  }
  return list(call, kept);
}

Value listClean(FunctionCall& call, const List& args) {
  Items all = args.items();
  all.erase(std::remove(all.begin(), all.end(), std::string_view()), all.end());
  return list(call, all);
}

Value listTerminate(FunctionCall& call, const List& args) {
  const std::string_view text = args.list.text;
  if (text.empty() || text.back() == ';') return Value::string(args.list.id);
  return call.result(std::string(text) + ";");
}

struct Elements {
  Value array;
};

Value listFromArray(FunctionCall& call, const Elements& args) {
  const ValuePool& pool = call.services().pool();
  const Array& a = pool.array(args.array);
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

Value listToArray(FunctionCall& call, const List& args) {
  const Items all = args.items();
  if (all.size() <= kMaxArraySize) {
    return stringArray({all.begin(), all.end()}, call.services().pool());
  }
  return call.fail("array-too-large", "the list has more items than an array may have",
                   "arrays have up to 100000 elements", stringArray({}, call.services().pool()));
}

constexpr ParamSpec kList = param<&List::list>("stringList", "Items, each ended by a semicolon.");
constexpr ParamSpec kSearch = param<&ListAndItem::item>(
    "searchString", "The item to look for; * at its beginning or end stands for any characters.");
constexpr ValueType kFloat = ValueType::Float, kString = ValueType::String;

constexpr ParamSpec kListParams[] = {kList};
constexpr Signature kTextOfList[] = {{kListParams, kString}};
constexpr Signature kNumberOfList[] = {{kListParams, kFloat}};
constexpr Signature kArrayOfList[] = {{kListParams, ValueType::StringArray}};
constexpr ParamSpec kItemParams[] = {
    kList, param<&ListAndIndex::index>("index", "The number of the item, counted from 0.")};
constexpr Signature kItem[] = {{kItemParams, kString}};
constexpr ParamSpec kSearchParams[] = {kList, kSearch};
constexpr Signature kNumberOfSearch[] = {{kSearchParams, kFloat}};
constexpr Signature kTextOfSearch[] = {{kSearchParams, kString}};
constexpr ParamSpec kRangeParams[] = {
    kList, param<&Range::left>("leftIndex", "The first item to take, counted from 0."),
    param<&Range::right>("rightIndex", "The first item not to take any more.")};
constexpr Signature kRange[] = {{kRangeParams, kString}};
constexpr ParamSpec kAddParams[] = {kList,
                                    param<&ListAndItem::item>("item", "The item to append.")};
constexpr Signature kAdd[] = {{kAddParams, kString}};
constexpr ParamSpec kFloats[] = {
    param<&Elements::array, ParamType::FloatArray>("array", "Numbers.")};
constexpr ParamSpec kBools[] = {
    param<&Elements::array, ParamType::BoolArray>("array", "Truth values.")};
constexpr ParamSpec kStrings[] = {
    param<&Elements::array, ParamType::StringArray>("array", "Texts.")};
constexpr Signature kFromArray[] = {{kFloats, kString}, {kBools, kString}, {kStrings, kString}};

constexpr const char* kFamily = "string lists";
constexpr FunctionSpec kFunctions[] = {
    {"listItem", kFamily, "An item of a list; an empty text outside of it.", kItem,
     typed<listItem>},
    {"listFirst", kFamily, "The first item of a list.", kTextOfList, typed<listFirst>},
    {"listLast", kFamily, "The last item of a list.", kTextOfList, typed<listLast>},
    {"listSize", kFamily, "The number of items of a list.", kNumberOfList, typed<listSize>},
    {"listIndex", kFamily, "The number of the first matching item; -1 when there is none.",
     kNumberOfSearch, typed<listIndex>},
    {"listCount", kFamily, "How many items of a list match.", kNumberOfSearch, typed<listCount>},
    {"listRandom", kFamily, "A random item of a list.", kTextOfList, typed<listRandom>, kRandom},
    {"listRange", kFamily, "The items of a list from one number to before another.", kRange,
     typed<listRange>},
    {"listAdd", kFamily, "A list with an item appended.", kAdd, typed<listAdd>},
    {"listRemove", kFamily, "A list without the first matching item.", kTextOfSearch,
     typed<listRemove>},
    {"listRemoveAll", kFamily, "A list without all matching items.", kTextOfSearch,
     typed<filtered<false>>},
    {"listRetainAll", kFamily, "The matching items of a list.", kTextOfSearch,
     typed<filtered<true>>},
    {"listClean", kFamily, "A list without empty items, each item ended by a semicolon.",
     kTextOfList, typed<listClean>},
    {"listTerminate", kFamily, "A list with a semicolon at its end.", kTextOfList,
     typed<listTerminate>},
    {"listFromArray", kFamily, "The elements of an array as a list.", kFromArray,
     typed<listFromArray>},
    {"listToArray", kFamily, "The items of a list as an array.", kArrayOfList, typed<listToArray>},
};

}  // namespace

extern const FunctionList kFunctions_string_lists;
const FunctionList kFunctions_string_lists = {kFunctions, {}};

}  // namespace gable
