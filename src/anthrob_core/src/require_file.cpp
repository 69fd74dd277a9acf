#include "require_file.h"

#include <filesystem>
#include <regex>
#include <set>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

namespace fs = std::filesystem;

/// NAME of model_NAME.yaml; empty for other files.
std::string model_name(const fs::path& file) {
  static const std::regex kModel("model_(.+)\\.yaml");
  std::smatch match;
  const std::string name = file.filename().string();
  return std::regex_match(name, match, kModel) ? match[1].str() : "";
}

/// Separated by commas.
std::string models_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    names.insert(model_name(entry.path()));
  }
  std::string list;
  for (const std::string& name : names) {
    if (!name.empty()) list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

}  // namespace

void require_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw BadInput(path + ": expected a YAML file, not a folder");
  if (status.type() != fs::file_type::not_found) return;
  const bool is_model = !model_name(path).empty();
  const std::string models = is_model ? models_in(fs::absolute(path).parent_path()) : "";
  throw BadInput(path + ": no such file" +
                 (models.empty() ? "" : "; its folder has the models " + models));
}

}  // namespace anthrob
