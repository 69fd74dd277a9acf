#pragma once

#include <string>

#include "anthrob_core/text.h"
#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// "3.995": six significant digits.
std::string precise_number(double value);

/// "probability 0.93", or that it is above 0.999 or below 0.001: none is certain.
std::string probability_text(double probability);

/// Its value, with as many digits as its interval is known to.
std::string value_text(const FoundParameter& parameter);

/// "0.04 to 0.06", the interval, or why there is none.
std::string range_text(const FoundParameter& parameter);

/// "0.0421 [0.038, 0.047] Nm"; without unit where there is none.
std::string interval_text(const FoundParameter& parameter);

}  // namespace discovery
}  // namespace anthrob
