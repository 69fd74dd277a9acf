#pragma once

#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// The known name that a misspelt one probably stands for. A letter too many, too few, another one,
/// or two that are swapped count one each; capitals do not count. Three letters or more at which
/// only one known name begins stand for that. None if more than every third letter is wrong.
std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& known);

/// The end of a message that a name is not known: "; did you mean 'NAME'?", or which are known.
std::string expected_names(const std::string& name, const std::vector<std::string>& known);

}  // namespace anthrob
