#pragma once

#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// The known name that a misspelt one probably stands for. A letter too many, too few, another one,
/// or two that are swapped count one each; capitals do not count. None if more than every third
/// letter is wrong.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& known);

}  // namespace anthrob
