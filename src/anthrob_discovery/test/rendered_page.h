#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "anthrob_recording/page.h"

namespace anthrob {

/// The page that a tool makes of these files of a report, by the program and the template that users
/// have, with one space for several spaces and ends of lines, as a browser shows it.
inline std::string rendered_page(const std::string& name, const OutputFiles& files,
                                 const std::string& data) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("anthrob_page_" + std::to_string(getpid()));
  write_files(folder.string(), files);
  const fs::path page = folder / "report.html";
  write_page(name, (folder / data).string(), page.string());
  std::ifstream in(page);
  std::string text;
  for (std::string word; in >> word;) text += (text.empty() ? "" : " ") + word;
  in.close();
  fs::remove_all(folder);
  return text;
}

}  // namespace anthrob
