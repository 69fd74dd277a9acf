#include "skeleton/urdf_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

using tinyxml2::XMLError;

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw BadInput(file + ": cannot be read; expected a URDF file");
  return {std::istreambuf_iterator<char>(in), {}};
}

bool stands_at(const std::string& text, const std::string& words, std::size_t at = 0) {
  return text.compare(at, words.size(), words) == 0;
}

/// As XML has it: Windows' "\r\n" and the old Mac's "\r" are one line end.
std::string with_plain_line_ends(const std::string& text) {
  std::string plain;
  plain.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      plain += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      plain += '\n';
    }
  }
  return plain;
}

/// What a parser's error means to the writer of a file.
std::string explanation(XMLError error) {
  switch (error) {
    case XMLError::XML_ERROR_EMPTY_DOCUMENT:
      return "the file is empty";
    case XMLError::XML_ERROR_MISMATCHED_ELEMENT:
      return "an element that is closed by another name, or not at all";
    case XMLError::XML_ERROR_PARSING:
      return "an element that is not closed before the file ends";
    case XMLError::XML_ERROR_PARSING_ELEMENT:
      return "expected an element <name ...>";
    case XMLError::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute that appears twice in its element, or is not written name=\"value\"";
    case XMLError::XML_ERROR_PARSING_COMMENT:
      return "a comment that is not closed by -->";
    case XMLError::XML_ERROR_PARSING_DECLARATION:
      return "<?...?> that is not closed, or not at the beginning of the file";
    case XMLError::XML_ELEMENT_DEPTH_EXCEEDED:
      return "nested more than " + std::to_string(TINYXML2_MAX_ELEMENT_DEPTH) + " deep";
    default:
      return std::string("no XML (") + tinyxml2::XMLDocument::ErrorIDToName(error) + ")";
  }
}

}  // namespace

UrdfFile::UrdfFile(const std::string& file) : file_(file), text_(content_of(file)) {
  refuse_other_encodings();
  if (stands_at(text_, "\xEF\xBB\xBF")) text_.erase(0, 3);
  text_ = with_plain_line_ends(text_);
  refuse_doctype();
  parse();
}

std::string UrdfFile::at(int line, const std::string& message) const {
  return file_ + ":" + std::to_string(std::max(1, line)) + ": " + message;
}

void UrdfFile::fail(int line, const std::string& message) const {
  throw BadInput(at(line, message));
}

int UrdfFile::line_of(std::size_t position) const {
  const auto end = text_.begin() + static_cast<std::ptrdiff_t>(position);
  return 1 + static_cast<int>(std::count(text_.begin(), end, '\n'));
}

void UrdfFile::refuse_other_encodings() const {
  const std::string zero(1, '\0');
  if (stands_at(text_, "\xFF\xFE" + zero + zero) || stands_at(text_, zero + zero + "\xFE\xFF")) {
    fail(1, "the text is UTF-32: expected UTF-8: iconv -f UTF-32 -t UTF-8 converts it");
  }
  if (stands_at(text_, "\xFF\xFE") || stands_at(text_, "\xFE\xFF") ||
      stands_at(text_, "<" + zero) || stands_at(text_, zero + "<")) {
    fail(1, "the text is UTF-16: expected UTF-8: iconv -f UTF-16 -t UTF-8 converts it");
  }
  // Readers of C strings end there.
  const std::size_t end = text_.find('\0');
  if (end != std::string::npos) {
    fail(line_of(end), "a byte 0 in the text: expected UTF-8 without it");
  }
}

/// Neither this parser nor urdfdom's knows entities of one's own. A DOCTYPE can only stand before
/// <robot>.
void UrdfFile::refuse_doctype() const {
  std::size_t begin = 0;
  for (;;) {
    begin = text_.find_first_not_of(" \t\n", begin);
    if (begin == std::string::npos) return;
    const bool comment = stands_at(text_, "<!--", begin);
    if (!comment && !stands_at(text_, "<?", begin)) break;
    begin = text_.find(comment ? "-->" : "?>", begin);
    if (begin == std::string::npos) return;
    begin += 2;
    if (comment) ++begin;
  }
  if (stands_at(text_, "<!", begin)) {
    fail(line_of(begin),
         "DOCTYPE and entities are not read: expected <robot> first: delete it, and write what "
         "each &entity; stands for");
  }
}

void UrdfFile::parse() {
  const XMLError error = document_.Parse(text_.c_str(), text_.size());
  if (error != XMLError::XML_SUCCESS) {
    fail(document_.ErrorLineNum(), "not a valid URDF: " + explanation(error));
  }
  for (const tinyxml2::XMLNode* node = document_.FirstChild(); node; node = node->NextSibling()) {
    if (node->ToComment() || node->ToDeclaration()) continue;
    const tinyxml2::XMLElement* element = node->ToElement();
    if (!element) {
      fail(node->GetLineNum(), "not a valid URDF: text outside of <robot>");
    }
    if (robot_) {
      fail(element->GetLineNum(), std::string("<") + element->Name() +
                                      "> after </robot>: expected one <robot> with all in it");
    }
    if (std::string(element->Name()) != "robot") {
      fail(element->GetLineNum(), std::string("not a valid URDF: it begins with <") +
                                      element->Name() + ">: expected <robot>");
    }
    robot_ = element;
  }
  if (!robot_) fail(1, "not a valid URDF: expected <robot>");
}

std::string attribute_of(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

std::string in_one_line(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  std::string line;
  for (const char c : text) {
    const bool blank = c == ' ' || c == '\n' || c == '\t';
    if (!blank) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
    if (line.size() > kLongest) return line + "...";
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

std::string label_of(const tinyxml2::XMLElement& element) {
  const std::string kind = element.Name();
  const std::string name = in_one_line(attribute_of(element, "name"));
  const bool is_named = (kind == "link" || kind == "joint" || kind == "material") && !name.empty();
  return is_named ? kind + " " + name : kind;
}

}  // namespace anthrob
