// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>

#include "answer.h"
#include "commands.h"

namespace {

std::string signatureText(const std::string& name, const gable::BuiltinSignature& s) {
  std::string out = name + "(";
  for (size_t i = 0; i < s.parameters.size(); ++i) {
    const gable::BuiltinParameter& p = s.parameters[i];
    out += (i ? ", " : "") + (p.defaultText ? "[" + p.name + "]" : p.name);
  }
  return out + (s.variadic ? ", ...)" : ")");
}

std::string callText(const gable::BuiltinCall& call) {
  std::string out = call.name + " - " + call.summary + "\n\n";
  for (const gable::BuiltinSignature& s : call.signatures) {
    out += "  " + signatureText(call.name, s) + (call.block.empty() ? "" : " ") + call.block + "\n";
    for (const gable::BuiltinParameter& p : s.parameters) {
      const std::string takes = p.words ? *p.words : p.range;
      out += "      " + p.name + " (" + p.type + (takes.empty() ? "" : ": " + takes) + ")  " +
             p.doc + (p.defaultText ? " Default: " + *p.defaultText + "." : "") + "\n";
    }
  }
  if (!call.parts.empty()) out += "\n  Parts of its block\n";
  for (const gable::BuiltinPart& p : call.parts) out += "      " + p.name + "  " + p.doc + "\n";
  if (call.selectors && !call.parts.empty()) {
    out += "      and the selectors of faces and edges; 'gable ops' lists them\n";
  }
  return out;
}

std::string line(const std::string& name, const std::string& text) {
  std::string out = "  " + name;
  out.resize(std::max<size_t>(out.size() + 1, 28), ' ');
  return out + text + "\n";
}

std::string listText(const char* title, const std::vector<gable::BuiltinCall>& calls) {
  std::string out = std::string(title) + "\n";
  for (const gable::BuiltinCall& c : calls) out += line(c.name, c.summary);
  return out + "\n";
}

std::string textOfAll(const gable::Builtins& all) {
  std::string out = listText("Operations", all.operations) + listText("Functions", all.functions);
  out += "Attributes of the shape\n";
  for (const gable::BuiltinAttribute& a : all.attributes) out += line(a.name, a.doc);
  out += "\nSelectors of faces and edges\n";
  for (const gable::BuiltinSelector& s : all.selectors) out += line(s.name, s.doc);
  return out;
}

// Words that the notation itself has.
struct Keyword {
  const char* name;
  const char* text;
};
constexpr Keyword kKeywords[] = {
    {"attr", "attr height = 12: a value that can be set from outside"},
    {"const", "const pi2 = 6.28: a value that cannot be set"},
    {"import", "import roofs : \"roofs.cga\": the rules of another file, called as roofs.Name"},
    {"style", "style Old: declarations up to the next style replace those of the default style"},
    {"extends", "style Newer extends Old: a style on top of another"},
    {"version", "version \"2025.0\": the version of CGA that the file is written for"},
    {"case", "case height > 9 : A case height > 3 : B else : C: the first condition that holds"},
    {"else", "what happens where no condition holds, or no weight is drawn: 30% : A else : B"},
    {"with", "Wall(h) with (n := floor(h / 3)) --> ...: variables of a rule"},
    {"start", "start Lot --> ...: the rule that is meant to begin with"},
    {"extension", "extension Wall --> ...: a rule that an importing file may replace"},
    {"true", "a truth value"},
    {"false", "a truth value"},
    {"NIL", "nothing: the shape is left out"},
};

std::optional<std::string> textOf(const gable::Builtins& all, const std::string& name) {
  for (const auto* calls : {&all.operations, &all.functions}) {
    for (const gable::BuiltinCall& c : *calls) {
      if (c.name == name) return callText(c);
    }
  }
  for (const gable::BuiltinAttribute& a : all.attributes) {
    if (a.name == name) return a.name + " (" + a.type + ") - " + a.doc + "\n";
  }
  for (const gable::BuiltinSelector& s : all.selectors) {
    if (s.name == name) return s.name + " (selector of faces and edges) - " + s.doc + "\n";
  }
  for (const Keyword& k : kKeywords) {
    if (k.name == name) return std::string(k.name) + " (word of the notation) - " + k.text + "\n";
  }
  return std::nullopt;
}

bool equalFolded(const std::string& a, const std::string& b) {
  const auto folded = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return folded(x) == folded(y); });
}

// The built-in name that differs in case at most; else the name itself.
std::string knownName(const gable::Builtins& all, const std::string& name) {
  std::string found = name;
  const auto look = [&](const std::string& other) {
    if (found != name || !equalFolded(other, name)) return;
    found = other;
  };
  if (textOf(all, name)) return name;
  for (const gable::BuiltinCall& c : all.operations) look(c.name);
  for (const gable::BuiltinCall& c : all.functions) look(c.name);
  for (const gable::BuiltinAttribute& a : all.attributes) look(a.name);
  for (const gable::BuiltinSelector& s : all.selectors) look(s.name);
  for (const Keyword& k : kKeywords) look(k.name);
  return found;
}

// All that can be asked for.
std::vector<std::string> namesOf(const gable::Builtins& all) {
  std::vector<std::string> names;
  for (const gable::BuiltinCall& c : all.operations) names.push_back(c.name);
  for (const gable::BuiltinCall& c : all.functions) names.push_back(c.name);
  for (const gable::BuiltinAttribute& a : all.attributes) names.push_back(a.name);
  for (const gable::BuiltinSelector& s : all.selectors) names.push_back(s.name);
  for (const Keyword& k : kKeywords) names.emplace_back(k.name);
  for (const gable::NotationWord& w : gable::notationWords()) names.push_back(w.word);
  return names;
}

// What the word means in other notations, a paragraph each.
std::string notationsOf(const std::string& name) {
  std::string out;
  for (const gable::NotationWord& w : gable::notationWords()) {
    if (!equalFolded(w.word, name)) continue;
    out += "In " + w.notation + ", " + w.extension + " (" + w.guide + "): " + w.call + "\n";
    if (!w.text.empty()) out += "      " + w.text + "\n";
  }
  return out;
}

std::optional<std::string> pageOf(const gable::Builtins& all, const std::string& name) {
  const std::optional<std::string> own = textOf(all, knownName(all, name));
  const std::string others = notationsOf(name);
  if (others.empty()) return own;
  return own ? *own + "\n" + others : others;
}

}  // namespace

int runOps(const OpsArguments& arguments) {
  const gable::Builtins all = gable::builtins();
  std::optional<std::string> text;
  if (arguments.name.empty())
    text = terminal().json ? gable::builtinsJson(all) : textOfAll(all);
  else
    text = terminal().json ? gable::builtinJson(all, knownName(all, arguments.name))
                           : pageOf(all, arguments.name);
  if (!text) {
    const std::string near = gable::suggestion(arguments.name, namesOf(all));
    return fail(kExitUsage, "nothing built in is called '" + arguments.name + "'; " + near +
                                (near.empty() ? "" : " ") + "'gable ops' lists all");
  }
  put(*text);
  answer().members(*text);
  return kExitDone;
}
