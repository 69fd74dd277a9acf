#include "anthrob_calib/calibration/extended_model.h"

#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace calibration {

namespace fs = std::filesystem;

namespace {

std::string relative_to(const std::string& folder, const fs::path& file) {
  return fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(folder)).string();
}

/// A word as a YAML scalar; quoted where it would otherwise be read as something else.
std::string scalar_text(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
  const bool plain = !word.empty() && word.find_first_not_of(kPlain) == std::string::npos;
  if (plain && word != "-") return word;
  std::string text = "\"";
  for (const char c : word) {
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + "\"";
}

/// A node as YAML flow text, with names of files as seen from another folder.
std::string flow_text(const ConfigNode& node, const std::string& folder) {
  std::string out;
  if (node.is_sequence()) {
    for (const ConfigNode& item : node.items()) {
      out += (out.empty() ? "" : ", ") + flow_text(item, folder);
    }
    return "[" + out + "]";
  }
  if (node.is_map()) {
    for (const auto& [key, value] : node.entries()) {
      const std::string text =
          key == "file" ? scalar_text(relative_to(
                              folder, fs::path(value.file()).parent_path() / value.as_text()))
                        : flow_text(value, folder);
      out += (out.empty() ? "" : ", ") + scalar_text(key) + ": " + text;
    }
    return "{" + out + "}";
  }
  return node.is_scalar() ? scalar_text(node.as_text()) : "null";
}

/// What changes, as a tree of keys down to numbers and lists.
struct Branch {
  std::map<std::string, Branch> children;
  std::string text;  ///< of a leaf
};

void write(const Branch& branch, const std::string& indent, std::ostringstream& out) {
  for (const auto& [key, child] : branch.children) {
    out << indent << scalar_text(key) << ":";
    if (child.children.empty()) {
      out << " " << child.text << "\n";
    } else {
      out << "\n";
      write(child, indent + "  ", out);
    }
  }
}

}  // namespace

std::string extended_model_text(const ConfigNode& model, const std::string& model_file,
                                const std::map<std::string, double>& overrides,
                                const std::string& folder, const std::string& comment) {
  ConfigNode changed = model.clone();
  for (const auto& [path, value] : overrides) changed.set_number(path, value);
  Branch root;
  for (const auto& [path, value] : overrides) {
    ConfigNode node = changed;
    Branch* branch = &root;
    std::istringstream words(path);
    for (std::string word; !node.is_sequence() && std::getline(words, word, '.');) {
      node = node.at(word);
      branch = &branch->children[word];
    }
    // A number as it was computed, a list as it stands.
    branch->text = node.is_sequence() ? flow_text(node, folder) : exact_text(value);
  }
  std::ostringstream out;
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) out << "# " << line << "\n";
  out << "\nextends: " << scalar_text(relative_to(folder, model_file)) << "\n\n";
  write(root, "", out);
  return out.str();
}

}  // namespace calibration
}  // namespace anthrob
