// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Rule files that others have published mean the same whatever the language learns: their trees are
// compared, by hash, with those of the grammar before it had region blocks and named arguments.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/files.h"
#include "base/hash.h"
#include "lang/testing.h"

namespace gable::lang {
namespace {

struct PublicFile {
  const char* path;
  uint64_t tree;
};

constexpr PublicFile kPublicFiles[] = {
    {"CE-6813-style/rules/r1.cga", 0x61bc32d3ca3d20aa},
    {"FacesHolesVerticesrule/rules/FacesHolesVerticesrule.cga", 0x58332295193d6dfb},
    {"GenAttrs1/rules/r1.cga", 0xc3854fdab470678d},
    {"arrayAttrs/rules/arrayAttrs.cga", 0xa23a37b328be1391},
    {"arrayAttrs2d/rules/arrayAttrs2d.cga", 0x103dd2ac1e2bb6ee},
    {"dynamic_imports/rules/prt3_dynamic_imports/ruleA.cga", 0x5972c00f2dfe60ef},
    {"dynamic_imports/rules/prt3_dynamic_imports/ruleB.cga", 0x28500d17a4adb3af},
    {"extrusion_rule/rules/extrusion_rule.cga", 0x86b7ca0de5270f91},
    {"uvsets/rules/r1.cga", 0x9773780ca1ed6db1},
};

TEST(PublicFiles, keepTheirTrees) {
  const char* shared = std::getenv("GABLE_SHARED");
  const auto folder = std::filesystem::path(shared ? shared : "") / "data/prt/rules";
  if (!shared || !std::filesystem::exists(folder)) {
    GTEST_SKIP() << "the public rule files are not here (set GABLE_SHARED)";
  }
  for (const PublicFile& f : kPublicFiles) {
    const Result<std::string> text = readFile((folder / f.path).string());
    ASSERT_TRUE(text.ok()) << f.path;
    EXPECT_EQ(hashBytes(dump(Parsed(text.value()).tree)), f.tree) << f.path;
  }
}

}  // namespace
}  // namespace gable::lang
