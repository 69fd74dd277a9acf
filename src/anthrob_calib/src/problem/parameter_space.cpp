#include "problem/parameter_space.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <sstream>

#include "anthrob_recording/table.h"

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
    std::size_t index = 0;
    const char* const end = word.data() + word.size();
    const auto read = std::from_chars(word.data(), end, index);
    if (read.ec != std::errc() || read.ptr != end || index >= items.size()) {
      node.fail("has no entry " + word);
    }
    node = items[index];
  }
  return node.as_number(Bounds::any(), "1");
}

ParameterSpace::ParameterSpace(const ConfigNode& config, const ConfigNode& model)
    : parameters_(read_parameters(config.at("parameters"), model)) {
  if (config.has("shares")) {
    const std::vector<ConfigNode> entries = config.at("shares").items();
    for (const ConfigNode& entry : entries) read_share(entry, model);
    // What it is a share of would depend on the order of the list.
    for (std::size_t k = 0; k < entries.size(); ++k) {
      for (const Share& share : shares_) {
        if (shares_[k].of != parameters_[share.parameter].path) continue;
        entries[k].at("of").fail_expected("the path of a number that is not a share itself");
      }
    }
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
  // A share that ended at its bound may come back a bit beyond it: (0.8 b) / b.
  const double slack = 1e-12 * std::max(std::abs(p.lower), std::abs(p.upper));
  if (p.initial < p.lower - slack || p.initial > p.upper + slack ||
      (share.base == 0.0 && value != 0.0)) {
    entry.at("path").fail("in the model, its share of " + entry.text("of") + " is " +
                          exact_text(p.initial) + ": expected " + exact_text(p.lower) + " to " +
                          exact_text(p.upper) + ", its low and high");
  }
  p.initial = std::clamp(p.initial, p.lower, p.upper);
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
