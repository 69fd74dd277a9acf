#include "anthrob_calib/report/html.h"

namespace anthrob {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else
      out += c;
  }
  return out;
}

std::string cell(const std::string& text) {
  return "<td>" + escaped(text) + "</td>";
}

std::string folded(const std::string& title, const std::string& content) {
  if (content.empty()) return "";
  return "<details><summary>" + title + "</summary>\n" + content + "</details>\n";
}

}  // namespace anthrob
