#include "foreign/foreign_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "anthrob_core/text.h"
#include "foreign/column_operations.h"

namespace anthrob {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kDeepest = 20;  ///< values in values; no formula of columns needs as many

const std::vector<std::string> kOfMany = {"sum", "product", "difference", "quotient"};
const std::vector<std::string> kOfOne = {"derivative", "integral", "smooth", "clip",
                                         "within",     "unwrap",   "fresh"};

bool is_among(const std::string& word, const std::vector<std::string>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The one operation that a map names.
std::string operation_of(const ConfigNode& node) {
  std::vector<std::string> known = {"column", "place", "constant"};
  append(kOfMany, known);
  append(kOfOne, known);
  std::string operation;
  for (const std::string& word : known) {
    if (!node.has(word)) continue;
    if (!operation.empty()) {
      node.at(word).fail("beside '" + operation + "': expected only one of them");
    }
    operation = word;
  }
  if (operation.empty()) node.fail("expected one of the keys " + joined(known));
  return operation;
}

double combine(const std::string& operation, double a, double b) {
  if (operation == "sum") return a + b;
  if (operation == "product") return a * b;
  if (operation == "difference") return a - b;
  return b == 0.0 ? std::numeric_limits<double>::quiet_NaN() : a / b;
}

}  // namespace

ForeignColumn load_foreign_column(const ConfigNode& node) {
  if (!node.is_map()) return {node.as_text(), 0};
  if (node.has("column") && node.has("place")) {
    node.at("place").fail("beside 'column': expected only one of them");
  }
  if (node.has("place")) return {"", node.at("place").as_integer(1, 100000)};
  return {node.text("column"), 0};
}

ForeignValue ForeignValue::load(const ConfigNode& node) {
  return load(node, 0);
}

ForeignValue ForeignValue::load(const ConfigNode& node, int depth) {
  if (depth > kDeepest) node.fail("more than 20 values in values; expected fewer");
  ForeignValue value(node);
  if (!node.is_map()) {
    value.column_ = load_foreign_column(node);
    return value;
  }
  const std::string operation = operation_of(node);
  if (operation == "column" || operation == "place") {
    value.column_ = load_foreign_column(node);
  } else if (operation == "constant") {
    value.constant_ = node.number("constant", Bounds::any(), "unit of to");
  } else {
    value.load_parts(node.at(operation), depth);
  }
  value.operation_ = operation == "place" ? "column" : operation;
  if (is_among(operation, kOfMany)) {
    const bool two = operation == "difference" || operation == "quotient";
    const std::size_t count = value.parts_.size();
    if (two && count != 2) node.at(operation).fail("expected a list of two columns");
    if (count < 2) node.at(operation).fail("expected a list of at least two columns");
  }
  value.load_numbers();
  return value;
}

void ForeignValue::load_parts(const ConfigNode& list, int depth) {
  if (!list.is_sequence()) return parts_.push_back(load(list, depth + 1));
  for (const ConfigNode& item : list.items()) parts_.push_back(load(item, depth + 1));
}

void ForeignValue::load_numbers() {
  scale_ = node_.number_or("scale", 1.0, Bounds::any(), "1");
  offset_ = node_.number_or("offset", 0.0, Bounds::any(), "unit of the value");
  if (is_among(operation_, kOfOne) && parts_.size() != 1) {
    node_.at(operation_).fail("expected one column");
  }
  if (operation_ == "integral") start_ = node_.number_or("start", 0.0, Bounds::any(), "its unit");
  if (operation_ == "smooth") over_ = node_.number("over", Bounds::positive(), "s");
  if (operation_ == "derivative" && node_.has("over")) {
    over_ = node_.number("over", Bounds::positive(), "s");
  }
  if (operation_ == "unwrap") {
    period_ = node_.number("period", Bounds::positive(), "unit of the column");
  }
  if (operation_ == "clip" || operation_ == "within") {
    low_ = node_.number_or("low", -kInfinity, Bounds::any(), "unit of the column");
    high_ = node_.number_or("high", kInfinity, Bounds::any(), "unit of the column");
    if (low_ == -kInfinity && high_ == kInfinity) node_.fail("expected 'low', 'high' or both");
    if (low_ >= high_) node_.at("low").fail_expected("a number below 'high'");
  }
  if (operation_ == "fresh" && node_.has("when")) parts_.push_back(load(node_.at("when"), 1));
}

void ForeignValue::collect(std::set<ForeignColumn>& columns) const {
  if (operation_ == "column") columns.insert(column_);
  for (const ForeignValue& part : parts_) part.collect(columns);
}

std::vector<double> ForeignValue::of(const ForeignSheet& sheet) const {
  std::vector<double> v = operated(sheet);
  for (double& x : v) x = scale_ * x + offset_;
  return v;
}

std::vector<double> ForeignValue::operated(const ForeignSheet& sheet) const {
  if (operation_ == "column") return sheet.columns.at(column_);
  if (operation_ == "constant") return std::vector<double>(sheet.stamp.size(), constant_);
  if (is_among(operation_, kOfMany)) return combined(sheet);
  const std::vector<double> v = parts_.front().of(sheet);
  if (operation_ == "smooth" || operation_ == "derivative") return smooth(sheet, v);
  if (operation_ == "integral") return integral_of(sheet.times(), v, start_);
  if (operation_ == "unwrap") return unwrapped(v, period_);
  if (operation_ == "fresh") return fresh_of(v, parts_.size() == 2 ? parts_[1].of(sheet) : v);
  return limited(v);
}

std::vector<double> ForeignValue::combined(const ForeignSheet& sheet) const {
  std::vector<double> all = parts_.front().of(sheet);
  for (std::size_t k = 1; k < parts_.size(); ++k) {
    const std::vector<double> v = parts_[k].of(sheet);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = combine(operation_, all[i], v[i]);
  }
  return all;
}

std::vector<double> ForeignValue::smooth(const ForeignSheet& sheet,
                                         const std::vector<double>& v) const {
  const std::vector<double> t = sheet.times();
  if (over_ == 0.0) return derivative_of(t, v);
  LocalFit fit = fit_locally(t, v, over_);
  if (fit.most < 4) {  // three samples have a parabola of their own: nothing is smoothed
    node_.at("over").fail_expected(
        "a window of at least four samples in " + sheet.file + ", which has one every " +
        short_number(t.back() / static_cast<double>(t.size() - 1)) + " s");
  }
  return operation_ == "smooth" ? fit.value : fit.slope;
}

std::vector<double> ForeignValue::limited(std::vector<double> v) const {
  for (double& x : v) {
    if (!std::isfinite(x)) continue;
    const double inside = std::clamp(x, low_, high_);
    if (operation_ == "clip")
      x = inside;
    else if (inside != x)
      x = std::numeric_limits<double>::quiet_NaN();
  }
  return v;
}

}  // namespace anthrob
