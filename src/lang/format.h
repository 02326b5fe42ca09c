#pragma once
#include "base/diagnostic.h"
namespace gable::lang { inline std::string format(const Sources& s, uint32_t f, Diagnostics&) { return std::string(s.text(f)); } }
