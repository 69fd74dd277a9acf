#include "anthrob_calib/calibration/parameter_space.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace anthrob {
namespace calibration {

double number_at(const ConfigNode& model, const std::string& path) {
  ConfigNode node = model;
  std::istringstream words(path);
  for (std::string word; std::getline(words, word, '.');) {
    if (!node.is_sequence()) {
      node = node.at(word);
      continue;
    }
    const auto items = node.items();
    const bool is_index =
        !word.empty() && word.find_first_not_of("0123456789") == std::string::npos;
    if (!is_index || std::stoul(word) >= items.size()) node.fail("has no entry " + word);
    node = items[std::stoul(word)];
  }
  return node.as_number(Bounds::any(), "1");
}

ParameterSpace::ParameterSpace(const ConfigNode& config, const ConfigNode& model)
    : parameters_(read_parameters(config.at("parameters"), model)) {
  if (config.has("shares")) {
    for (const ConfigNode& entry : config.at("shares").items()) read_share(entry, model);
  }
  if (parameters_.empty()) config.at("parameters").fail("empty; expected at least one parameter");
}

void ParameterSpace::read_share(const ConfigNode& entry, const ConfigNode& model) {
  static const std::set<std::string> kKnown = {"path", "of", "low", "high", "step"};
  for (const auto& [key, value] : entry.entries()) {
    if (!kKnown.count(key)) value.fail("unknown key");
  }
  ModelParameter p;
  p.path = entry.text("path");
  p.unit = "1";
  p.lower = entry.number("low", Bounds::any(), p.unit);
  p.upper = entry.number("high", Bounds::any(), p.unit);
  if (!(p.lower < p.upper)) entry.at("high").fail_expected("more than low");
  p.step = entry.number("step", Bounds::positive(), p.unit);
  const Share share{parameters_.size(), entry.text("of"), number_at(model, entry.text("of"))};
  const double value = number_at(model, p.path);
  p.initial = share.base != 0.0 ? value / share.base : p.lower;
  if (p.initial < p.lower || p.initial > p.upper || (share.base == 0.0 && value != 0.0)) {
    entry.at("path").fail("in the model, its share of " + entry.text("of") +
                          " lies outside low ... high; expected a range that contains it");
  }
  for (const ModelParameter& other : parameters_) {
    if (other.path == p.path) entry.at("path").fail("already listed; expected each path once");
  }
  parameters_.push_back(p);
  shares_.push_back(share);
}

std::vector<double> ParameterSpace::initial() const {
  std::vector<double> values;
  for (const ModelParameter& p : parameters_) values.push_back(p.initial);
  return values;
}

std::map<std::string, double> ParameterSpace::overrides(const std::vector<double>& values) const {
  std::map<std::string, double> overrides = overrides_of(parameters_, values);
  for (const Share& share : shares_) {
    const auto base = overrides.find(share.of);
    overrides[parameters_[share.parameter].path] *=
        base != overrides.end() ? base->second : share.base;
  }
  return overrides;
}

}  // namespace calibration
}  // namespace anthrob
