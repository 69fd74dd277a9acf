#include "require_file.h"

#include <optional>
#include <regex>
#include <set>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargest = 64u << 20;  // [bytes]

/// NAME of model_NAME.yaml; none for other files.
std::optional<std::string> model_name(const fs::path& file) {
  static const std::regex kModel("model_(.+)\\.yaml");
  std::smatch match;
  const std::string name = file.filename().string();
  if (!std::regex_match(name, match, kModel)) return std::nullopt;
  return match[1].str();
}

}  // namespace

void require_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) throw BadInput(path + ": expected a YAML file, not a folder");
  if (fs::exists(status)) {
    // A device, say, has no end.
    if (!fs::is_regular_file(status)) throw BadInput(path + ": expected a YAML file");
    if (fs::file_size(path, error) <= kLargest || error) return;
    throw BadInput(path + ": larger than 64 MB; expected a YAML file");
  }
  const bool is_model = model_name(path).has_value();
  const std::string models = is_model ? models_in(fs::absolute(path).parent_path()) : "";
  throw BadInput(path + ": no such file" +
                 (models.empty() ? "" : "; its folder has the models " + models));
}

std::string models_in(const fs::path& folder) {
  std::set<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (const auto name = model_name(entry.path())) names.insert(*name);
  }
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace anthrob
