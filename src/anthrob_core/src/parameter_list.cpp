#include "anthrob_core/parameter_list.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <sstream>

namespace anthrob {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> words;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

bool is_integer(const std::string& word) {
  const std::size_t digits = word.find_first_not_of("0123456789", word[0] == '-' ? 1 : 0);
  return digits == std::string::npos && word != "-" && !word.empty();
}

/// Of "{a, b}" both; else the word alone.
std::vector<std::string> alternatives(const std::string& word) {
  if (word.size() < 2 || word.front() != '{' || word.back() != '}') return {word};
  std::vector<std::string> found = split(word.substr(1, word.size() - 2), ',');
  for (std::string& name : found) {
    const std::size_t begin = name.find_first_not_of(' ');
    const std::size_t end = name.find_last_not_of(' ');
    name = begin == std::string::npos ? "" : name.substr(begin, end - begin + 1);
  }
  return found;
}

/// What a word of a pattern stands for below a node: keys as they stand in a key path.
std::vector<std::string> matches(const std::string& word, const ConfigNode& node) {
  std::vector<std::string> keys;
  if (node.is_map()) {
    for (const auto& [key, child] : node.entries()) keys.push_back(key);
  } else if (node.is_sequence()) {
    for (std::size_t i = 0; i < node.items().size(); ++i) keys.push_back(std::to_string(i));
  }
  if (word == "*") return keys;
  std::vector<std::string> found;
  for (const std::string& name : alternatives(word)) {
    std::string key = name;
    long from_end = 0;  // stays 0 for a number that no list is long enough for
    if (node.is_sequence() && is_integer(name) && name[0] == '-') {
      std::from_chars(name.data(), name.data() + name.size(), from_end);
    }
    if (from_end < 0) key = std::to_string(static_cast<long>(keys.size()) + from_end);
    if (std::count(keys.begin(), keys.end(), key)) found.push_back(key);
  }
  return found;
}

ConfigNode child_of(const ConfigNode& node, const std::string& key) {
  return node.is_map() ? node.at(key) : node.items()[std::stoul(key)];
}

void expand(const ConfigNode& node, const std::vector<std::string>& words, std::size_t depth,
            std::vector<ConfigNode>& found) {
  if (depth == words.size()) {
    if (node.is_scalar()) found.push_back(node);
    return;
  }
  for (const std::string& key : matches(words[depth], node)) {
    expand(child_of(node, key), words, depth + 1, found);
  }
}

/// Each alternative of a pattern must match: one that is misspelt must not be left out.
void check_alternatives(const ConfigNode& entry, const std::vector<std::string>& words,
                        const ConfigNode& model) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::vector<std::string> names = alternatives(words[i]);
    if (names.size() < 2) continue;
    for (const std::string& name : names) {
      std::vector<std::string> one = words;
      one[i] = name;
      std::vector<ConfigNode> numbers;
      expand(model, one, 0, numbers);
      if (!numbers.empty()) continue;
      entry.at("path").fail("'" + name + "' matches no number in " + model.file() +
                            "; expected another name, or if_present: true");
    }
  }
}

/// The list may be marked as read where it belongs to a larger file: each key is looked at here.
void check_keys(const ConfigNode& entry) {
  static const std::set<std::string> kKnown = {"path", "unit", "range",     "low",
                                               "high", "step", "if_present"};
  for (const auto& [key, value] : entry.entries()) {
    if (!kKnown.count(key)) value.fail("unknown key");
  }
  if (entry.has("range") && (entry.has("low") || entry.has("high"))) {
    entry.at("range").fail(
        "given together with low or high; expected either range, or low and high");
  }
}

ModelParameter read_parameter(const ConfigNode& entry, const ConfigNode& number, Outside outside) {
  ModelParameter p;
  p.path = number.path();
  p.unit = entry.text("unit");
  p.initial = number.as_number(Bounds::any(), p.unit);
  p.step = entry.number("step", Bounds::positive(), p.unit);
  if (entry.has("range")) {
    const double range = entry.number("range", Bounds::positive(), p.unit);
    p.lower = p.initial - range;
    p.upper = p.initial + range;
  } else {
    p.lower = entry.number("low", Bounds::any(), p.unit);
    p.upper = entry.number("high", Bounds::any(), p.unit);
    if (!(p.lower < p.upper)) entry.at("high").fail_expected("more than low");
    if (outside == Outside::kWiden) {
      p.lower = std::min(p.lower, p.initial);
      p.upper = std::max(p.upper, p.initial);
    } else if (p.initial < p.lower || p.initial > p.upper) {
      std::ostringstream text;
      text << p.path << " is " << p.initial << " in " << number.file() << ": expected " << p.lower
           << " to " << p.upper << ", its low and high";
      entry.fail(text.str());
    }
  }
  return p;
}

/// A file of anthrob_calibrate may serve, too; what nobody knows is a misspelt key.
void check_file(const ConfigNode& file, std::vector<std::string>* remarks) {
  static const std::set<std::string> kOfCalibration = {"model",    "recordings", "weights",
                                                       "simulate", "optimiser",  "shares"};
  std::string unused;
  for (const auto& [key, value] : file.entries()) {
    if (key == "parameters") continue;
    if (!kOfCalibration.count(key)) value.fail("unknown key");
    unused += (unused.empty() ? "" : ", ") + key;
  }
  if (unused.empty() || !remarks) return;
  remarks->push_back(file.file() + ": ignored: " + unused +
                     " (for anthrob_calibrate); only the list 'parameters' is used here");
}

}  // namespace

std::string ModelParameter::name() const {
  std::vector<std::string> words = split(path, '.');
  if (words.size() > 2 && (words[0] == "muscles" || words[0] == "joints")) {
    words.erase(words.begin());
  }
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i - 1] == "point" && is_integer(words[i])) {
      words[i] = std::string(1, static_cast<char>('x' + std::stoi(words[i])));
      words.erase(words.begin() + static_cast<long>(i) - 1);
    }
  }
  std::string name;
  for (const std::string& word : words) name += (name.empty() ? "" : ".") + word;
  return name;
}

std::vector<ModelParameter> read_parameters(const ConfigNode& list, const ConfigNode& model,
                                            Outside outside) {
  std::vector<ModelParameter> parameters;
  std::set<std::string> taken;
  for (const ConfigNode& entry : list.items()) {
    check_keys(entry);
    const std::string pattern = entry.text("path");
    std::vector<ConfigNode> numbers;
    const std::vector<std::string> words = split(pattern, '.');
    expand(model, words, 0, numbers);
    const bool may_be_absent = entry.has("if_present") && entry.at("if_present").as_bool();
    if (numbers.empty() && !may_be_absent) {
      entry.at("path").fail_expected("the path of a number in " + model.file());
    }
    if (!may_be_absent) check_alternatives(entry, words, model);
    for (const ConfigNode& number : numbers) {
      parameters.push_back(read_parameter(entry, number, outside));
      if (!taken.insert(parameters.back().path).second) {
        entry.at("path").fail("matches " + parameters.back().path +
                              ", which another entry matches already");
      }
    }
  }
  return parameters;
}

std::optional<std::string> calibration_file_of(const std::string& model_file,
                                               const std::string& given) {
  const ConfigNode model = ConfigNode::load(model_file);
  // The robot is named where the folder of its files is.
  const std::string robot_file = model.at("robot").file();
  if (!given.empty()) return given;
  for (const std::string& file : {model_file, robot_file}) {
    const auto beside = std::filesystem::path(file).parent_path() / "calibration.yaml";
    if (std::filesystem::exists(beside)) return beside.string();
  }
  return std::nullopt;
}

std::vector<ModelParameter> ordinary_parameters(const std::string& model_file,
                                                const std::string& calibration_file,
                                                std::vector<std::string>* remarks) {
  const std::optional<std::string> file = calibration_file_of(model_file, calibration_file);
  if (!file) return {};
  const ConfigNode calibration = ConfigNode::load(*file);
  check_file(calibration, remarks);
  return read_parameters(calibration.at("parameters"), ConfigNode::load(model_file),
                         Outside::kWiden);
}

std::map<std::string, double> overrides_of(const std::vector<ModelParameter>& parameters,
                                           const std::vector<double>& values) {
  std::map<std::string, double> overrides;
  for (std::size_t i = 0; i < parameters.size(); ++i) overrides[parameters[i].path] = values[i];
  return overrides;
}

}  // namespace anthrob
