#pragma once

#include <string>

namespace anthrob {

/// As text of a page, whatever it holds.
std::string escaped(const std::string& text);

}  // namespace anthrob
