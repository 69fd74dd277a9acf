#pragma once

#include <tinyxml2.h>

#include <initializer_list>
#include <string>

namespace anthrob {

/// A URDF as XML, with the line of everything in it. What cannot become the robot that was meant,
/// although another reader may take it, is refused: another encoding, a DOCTYPE, a second <robot>.
class UrdfFile {
 public:
  /// @throws BadInput with one line: file, line, what was found, what was expected
  explicit UrdfFile(const std::string& file);
  UrdfFile(const UrdfFile&) = delete;
  UrdfFile& operator=(const UrdfFile&) = delete;

  /// In UTF-8, with line ends "\n".
  const std::string& text() const { return text_; }
  const tinyxml2::XMLElement& robot() const { return *robot_; }

  /// "FILE:LINE: message"
  std::string at(int line, const std::string& message) const;
  /// @throws BadInput always, at()
  [[noreturn]] void fail(int line, const std::string& message) const;

 private:
  void refuse_other_encodings() const;
  void refuse_doctype() const;
  void parse();
  int line_of(std::size_t position) const;

  std::string file_;
  std::string text_;
  tinyxml2::XMLDocument document_;
  const tinyxml2::XMLElement* robot_ = nullptr;
};

/// The attribute as it stands there; empty if there is none.
std::string attribute_of(const tinyxml2::XMLElement& element, const char* name);

/// As messages quote it: blanks and line ends are one blank, and a long text is cut.
std::string in_one_line(const std::string& text);

/// "joint elbow", "link forearm", "origin": how messages call an element.
std::string label_of(const tinyxml2::XMLElement& element);

}  // namespace anthrob
