#pragma once

#include <string>

namespace anthrob {

/// A cell of a table that holds this text.
std::string cell(const std::string& text);

/// A long passage that is unfolded by a click on its title; nothing if it is empty.
std::string folded(const std::string& title, const std::string& content);

}  // namespace anthrob
