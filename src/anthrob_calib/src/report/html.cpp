#include "anthrob_calib/report/html.h"

#include "anthrob_core/text.h"

namespace anthrob {

std::string cell(const std::string& text) {
  return "<td>" + escaped(text) + "</td>";
}

std::string folded(const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return "<details><summary>" + title + "</summary>\n" + content + "</details>\n";
}

}  // namespace anthrob
