// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// The comments of a text in another notation, as comments of Gable's own language. All notations
// have `// ...`, `/* ... */` and `# ...`.
#pragma once

#include <string_view>
#include <vector>

#include "dialects/dialect.h"
#include "lang/print.h"

namespace gable {

/// In the order of the text. Signs in "..." are none. Linear in the text.
std::vector<lang::Remark> remarksOf(std::string_view text);

}  // namespace gable
