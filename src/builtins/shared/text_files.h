// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Text files as rules see them: decoded, with plain line ends, and as tables.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gable {

/// UTF-8 from the bytes of a file: UTF-16 with a byte order mark is converted, a UTF-8 mark
/// dropped, line ends become \n, and other control characters but the tab become ?.
std::string decodedText(std::string_view bytes);

/// The cells of a CSV text, row by row; rows are as long as the longest, filled with empty texts.
/// The delimiter is the one of , ; tab and blank that the first lines agree on. Cells may be in
/// double quotes, "" in them is one quote.
struct TextTable {
  size_t rows = 0, columns = 0;
  std::vector<std::string> cells;
};
TextTable parseTable(std::string_view text);

}  // namespace gable
