#include "give.h"

#include <fstream>
#include <stdexcept>

namespace anthrob {
namespace fuzz {

namespace {

constexpr std::size_t kLongestLine = 3000;

bool is_one_line(const std::string& text) {
  return !text.empty() && text.size() <= kLongestLine && text.find('\n') == std::string::npos;
}

void write(const std::string& file, const std::string& content) {
  std::ofstream(file, std::ios::binary) << content;
}

}  // namespace

void give_sound(const Reader& reader) {
  for (const std::string& sound : reader.sound) {
    write(reader.file, sound);
    reader.read();
  }
}

bool give(const Reader& reader, const std::string& input) {
  write(reader.file, input);
  std::string refusal;
  try {
    reader.read();
    return true;
  } catch (const std::exception& error) {
    refusal = error.what();
  }
  if (!is_one_line(refusal)) {
    throw std::logic_error(reader.name +
                           ": refused otherwise than with one line: " + refusal.substr(0, 400));
  }
  return false;
}

}  // namespace fuzz
}  // namespace anthrob
