// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors

#include <algorithm>
#include <cstdio>

#include "commands.h"
#include "json/answers.h"

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
      out += "      " + p.name + " (" + p.type + (p.words ? ": " + *p.words : "") + ")  " + p.doc +
             (p.defaultText ? " Default: " + *p.defaultText + "." : "") + "\n";
    }
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
  return out;
}

std::optional<std::string> textOf(const gable::Builtins& all, const std::string& name) {
  for (const auto* calls : {&all.operations, &all.functions}) {
    for (const gable::BuiltinCall& c : *calls) {
      if (c.name == name) return callText(c);
    }
  }
  for (const gable::BuiltinAttribute& a : all.attributes) {
    if (a.name == name) return a.name + " (" + a.type + ") - " + a.doc + "\n";
  }
  return std::nullopt;
}

}  // namespace

int runOps(const OpsArguments& arguments) {
  const gable::Builtins all = gable::builtins();
  std::optional<std::string> text;
  if (arguments.name.empty())
    text = arguments.json ? gable::builtinsJson(all) : textOfAll(all);
  else
    text = arguments.json ? gable::builtinJson(all, arguments.name) : textOf(all, arguments.name);
  if (!text) {
    std::fprintf(stderr, "gable: nothing built in is called '%s'; 'gable ops' lists all\n",
                 arguments.name.c_str());
    return kExitUsage;
  }
  std::fputs(text->c_str(), stdout);
  return kExitDone;
}
