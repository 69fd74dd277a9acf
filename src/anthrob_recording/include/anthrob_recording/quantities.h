#pragma once

#include <optional>
#include <string>

namespace anthrob {

// Quantities that a recording may contain of a muscle, a ball joint, any other joint, and a link
// that is pushed.
bool is_muscle_quantity(const std::string& quantity);
bool is_ball_quantity(const std::string& quantity);
bool is_joint_quantity(const std::string& quantity);
bool is_push_quantity(const std::string& quantity);

/// Quantities that a column may hold.
bool is_known_quantity(const std::string& quantity);
/// Word for a number of a `mode` or `ecu_state` column, and back; none for an unknown word.
std::string word_of(const std::string& quantity, int value);
std::optional<int> number_of(const std::string& quantity, const std::string& word);
bool holds_words(const std::string& quantity);

}  // namespace anthrob
