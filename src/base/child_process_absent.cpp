// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// In place of child_process.cpp where there are no other programs: in a browser.
#include "base/child_process.h"

namespace gable {

std::string programBeside(const std::string&) { return {}; }

Result<std::string> runChild(const std::string& program, const std::vector<std::string>&,
                             std::string_view, const ChildLimits&) {
  return Error{"child-missing", "the program '" + program + "' cannot be started in a browser", {}};
}

}  // namespace gable
