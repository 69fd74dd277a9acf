#include "path/collada_check.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "skeleton/urdf_file.h"

namespace anthrob {

namespace {

using tinyxml2::XMLElement;

constexpr std::uint64_t kMostValues = 100'000'000;  ///< of an array: 800 MB

std::optional<std::uint64_t> whole_number(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value > kMostValues)
    return std::nullopt;
  return value;
}

bool is_number(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(value);
}

/// The library that reads the file waits for ever at one that it takes for a part of a number.
std::optional<std::string> control_character(const std::string& text) {
  int line = 1;
  for (const char c : text) {
    if (c == '\n') ++line;
    const auto code = static_cast<unsigned char>(c);
    if (code >= 0x20 || c == '\t' || c == '\n' || c == '\r') continue;
    std::ostringstream fault;
    fault << "line " << line << ": control character " << static_cast<int>(code)
          << ", which XML does not allow";
    return fault.str();
  }
  return std::nullopt;
}

std::vector<std::string> words_of(const XMLElement& element) {
  std::istringstream text(element.GetText() == nullptr ? "" : element.GetText());
  return {std::istream_iterator<std::string>(text), {}};
}

/// Visits every element; throws std::runtime_error at the first fault.
class ColladaCheck {
 public:
  explicit ColladaCheck(const XMLElement& root) {
    note_ids(root);
    check(root);
  }

 private:
  [[noreturn]] static void fail(const XMLElement& element, const std::string& what) {
    throw std::runtime_error("line " + std::to_string(element.GetLineNum()) + ": <" +
                             element.Name() + ">: " + what);
  }

  void note_ids(const XMLElement& element) {
    if (const char* id = element.Attribute("id")) ids_.insert(id);
    for (auto child = element.FirstChildElement(); child; child = child->NextSiblingElement())
      note_ids(*child);
  }

  void check(const XMLElement& element) {
    check_attributes(element);
    check_text(element);
    for (auto child = element.FirstChildElement(); child; child = child->NextSiblingElement())
      check(*child);
    if (std::string_view(element.Name()) == "triangles") check_triangles(element);
  }

  void check_attributes(const XMLElement& element) {
    for (auto attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
      const std::string name = attribute->Name(), value = attribute->Value();
      const bool counts = name == "count" || name == "stride" || name == "offset" || name == "set";
      if (counts && !whole_number(value))
        fail(element, name + "=\"" + in_one_line(value) + "\": expected a whole number");
      // Others, such as those of materials, may lead nowhere: nobody follows them.
      const std::string element_name = element.Name();
      const bool leads =
          name == "source" && (element_name == "input" || element_name == "accessor");
      if (leads && (value[0] != '#' || ids_.count(value.substr(1)) == 0))
        fail(element, name + "=\"" + in_one_line(value) + "\": expected the id of an element");
    }
  }

  static void check_text(const XMLElement& element) {
    const std::string name = element.Name();
    if (name == "float_array") check_numbers(element);
    if (name == "p" || name == "h" || name == "vcount") check_indices(element);
  }

  /// The library ends the program, by an assertion, where there are others than announced.
  static void check_triangles(const XMLElement& element) {
    std::uint64_t stride = 1;
    for (auto input = element.FirstChildElement("input"); input;
         input = input->NextSiblingElement("input")) {
      const char* offset = input->Attribute("offset");
      stride = std::max(stride, 1 + (offset ? whole_number(offset).value_or(0) : 0));
    }
    std::size_t indices = 0;
    for (auto p = element.FirstChildElement("p"); p; p = p->NextSiblingElement("p"))
      indices += words_of(*p).size();
    const char* count = element.Attribute("count");
    if (count == nullptr) fail(element, "expected a count");
    if (3 * stride * whole_number(count).value_or(0) != indices) {
      fail(element, std::string("count=\"") + count + "\": but it has " + std::to_string(indices) +
                        " indices");
    }
  }

  static void check_numbers(const XMLElement& element) {
    const std::vector<std::string> words = words_of(element);
    for (const std::string& word : words)
      if (!is_number(word)) fail(element, "'" + in_one_line(word) + "': expected a number");
    const char* count = element.Attribute("count");
    if (count == nullptr) fail(element, "expected a count");
    if (*whole_number(count) != words.size()) {
      fail(element, std::string("count=\"") + count + "\": but it has " +
                        std::to_string(words.size()) + " numbers");
    }
  }

  static void check_indices(const XMLElement& element) {
    for (const std::string& word : words_of(element))
      if (!whole_number(word))
        fail(element, "'" + in_one_line(word) + "': expected a whole number");
  }

  std::set<std::string> ids_;
};

}  // namespace

std::optional<std::string> fault_of_collada(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  if (const auto fault = control_character(text)) return fault;
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    return "line " + std::to_string(document.ErrorLineNum()) +
           ": not XML: " + tinyxml2::XMLDocument::ErrorIDToName(document.ErrorID());
  }
  try {
    if (const XMLElement* root = document.RootElement()) ColladaCheck{*root};
  } catch (const std::runtime_error& fault) {
    return fault.what();
  }
  return std::nullopt;
}

}  // namespace anthrob
