#include "mutator.h"

#include <algorithm>
#include <iterator>
#include <random>
#include <utility>

namespace anthrob {
namespace fuzz {

namespace {

/// What readers of numbers, lists, tables and XML may trip over.
const char* const kWords[] = {
    "nan",
    "-inf",
    "1e308",
    "-1e308",
    "1e-320",
    "0",
    "-1",
    "4294967295",
    "18446744073709551616",
    "{",
    "}",
    "[",
    "]",
    ":",
    ",",
    "\n",
    "\t",
    "\r",
    "\"",
    "'",
    "<",
    "/>",
    "</",
    "&amp;",
    "&#x",
    "<!--",
    "%YAML",
    "<<:",
    "*a",
    "&a ",
    "#",
    "..",
    "/",
    "",
    "true",
    "0x7f",
    "1,5",
    "- - -",
    "\xff\xfe",
    "\xef\xbb\xbf",
    "~",
    "solid",
    "facet",
    "0 0 0",
};

class Mutation {
 public:
  Mutation(const std::vector<std::string>& sound, std::uint64_t number)
      : sound_(sound), random_(number), text_(sound[below(sound.size())]) {}

  std::string result() {
    const std::size_t count = 1 + below(below(8) == 0 ? 20 : 4);
    for (std::size_t i = 0; i < count; ++i) change();
    return std::move(text_);
  }

 private:
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : random_() % limit; }
  std::size_t place() { return below(text_.size() + 1); }
  std::string piece(const std::string& of, std::size_t longest) {
    const std::size_t begin = below(of.size() + 1);
    return of.substr(begin, below(longest));
  }

  void change() {
    switch (below(8)) {
      case 0:
        if (!text_.empty()) text_[below(text_.size())] ^= static_cast<char>(1 << below(8));
        return;
      case 1:
        if (!text_.empty()) text_[below(text_.size())] = static_cast<char>(below(256));
        return;
      case 2:
        text_.insert(place(), kWords[below(std::size(kWords))]);
        return;
      case 3:
        text_.erase(place(), below(40));
        return;
      case 4:  // a piece twice
        text_.insert(place(), piece(text_, 80));
        return;
      case 5:  // a piece of another file
        text_.insert(place(), piece(sound_[below(sound_.size())], 200));
        return;
      case 6:
        replace_number();
        return;
      default:
        if (below(20) == 0) text_.resize(place());
    }
  }

  /// The next number of the text becomes another word.
  void replace_number() {
    const std::size_t begin = text_.find_first_of("0123456789", place());
    if (begin == std::string::npos) return;
    const std::size_t end =
        std::min(text_.find_first_not_of("0123456789.e+-", begin), text_.size());
    text_.replace(begin, end - begin, kWords[below(std::size(kWords))]);
  }

  const std::vector<std::string>& sound_;
  std::mt19937_64 random_;
  std::string text_;
};

}  // namespace

std::string mutated(const std::vector<std::string>& sound, std::uint64_t number) {
  return Mutation(sound, number).result();
}

}  // namespace fuzz
}  // namespace anthrob
