#include <filesystem>
#include <fstream>
#include <iterator>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "require_file.h"

namespace anthrob {

namespace {

/// Without what it extends.
ConfigNode alone(const std::string& file) {
  require_file(file);
  std::ifstream in(file);
  if (!in) throw BadInput(file + ": cannot be read; expected a YAML file");
  return ConfigNode::parse({std::istreambuf_iterator<char>(in), {}}, file);
}

}  // namespace

std::vector<std::string> extended_files(const std::string& file) {
  std::vector<std::string> files = {place_of(file).string()};
  const ConfigNode node = alone(file);
  if (!node.is_map() || !node.has("extends")) return files;
  const ConfigNode extends = node.at("extends");
  for (const ConfigNode& name :
       extends.is_sequence() ? extends.items() : std::vector<ConfigNode>{extends}) {
    const auto base = std::filesystem::path(file).parent_path() / name.as_text();
    const std::vector<std::string> more = extended_files(base.string());
    files.insert(files.end(), more.begin(), more.end());
  }
  return files;
}

}  // namespace anthrob
