#include "options/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>
#include <vector>

#include "anthrob_core/errors.h"
#include "anthrob_core/nearest_name.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace discovery {

namespace {

/// Looks for the first option that is out of its range.
class RangeCheck {
 public:
  RangeCheck(const std::string& prefix, std::optional<std::string>& invalid)
      : prefix_(prefix), invalid_(invalid) {}

  void operator()(const char* name, const Share& share) const {
    if (!(share.value > 0.0 && share.value <= 1.0)) {
      complain(name, share.value, "a number above 0 and not above 1");
    }
  }
  void operator()(const char* name, double number) const {
    if (!(number > 0.0 && std::isfinite(number))) complain(name, number, "a number above 0");
  }
  void operator()(const char* name, int number) const {
    if (number < 1) complain(name, number, "at least 1");
  }
  void operator()(const char* name, std::size_t number) const {
    if (number < 1) complain(name, 0.0, "at least 1");
  }
  template <std::size_t n>
  void operator()(const char* name, const std::array<double, n>& numbers) const {
    for (const double number : numbers) (*this)(name, number);
  }
  template <typename Group, typename = decltype(&Group::template visit<const Group, RangeCheck>)>
  void operator()(const char* name, const Group& group) const {
    Group::visit(group, RangeCheck(prefix_ + name + ".", invalid_));
  }

 private:
  void complain(const char* name, double number, const std::string& expected) const {
    if (invalid_) return;
    invalid_ = prefix_ + name + ": " + short_number(number) + ": expected " + expected;
  }

  std::string prefix_;
  std::optional<std::string>& invalid_;
};

/// Nothing if the text is no number.
std::optional<double> number_in(const std::string& text) {
  double number = 0.0;
  const char* const end = text.data() + text.size();
  const auto [read, error] = std::from_chars(text.data(), end, number);
  return error == std::errc() && read == end ? std::optional(number) : std::nullopt;
}

/// Sets the number of a name, and remembers the names that there are.
class Setter {
 public:
  Setter(const std::string& prefix, const std::string& name, double value,
         std::vector<std::string>& names)
      : prefix_(prefix), wanted_(name), value_(value), names_(names) {}

  void operator()(const char* name, Share& share) const { set(name, share.value); }
  void operator()(const char* name, double& number) const { set(name, number); }
  void operator()(const char* name, int& number) const { set(name, number); }
  void operator()(const char* name, std::size_t& number) const { set(name, number); }
  template <std::size_t n>
  void operator()(const char*, const std::array<double, n>&) const {}  // lists stay
  template <typename Group, typename = decltype(&Group::template visit<Group, Setter>)>
  void operator()(const char* name, Group& group) const {
    Group::visit(group, Setter(prefix_ + name + ".", wanted_, value_, names_));
  }

 private:
  template <typename Number>
  void set(const char* name, Number& number) const {
    names_.push_back(prefix_ + name);
    if (names_.back() != wanted_) return;
    if (std::is_integral_v<Number> && !(value_ >= 1.0 && value_ == std::floor(value_))) {
      throw BadInput(wanted_ + ": " + short_number(value_) + ": expected a whole number above 0");
    }
    number = static_cast<Number>(value_);
  }

  std::string prefix_;
  const std::string& wanted_;
  double value_;
  std::vector<std::string>& names_;
};

}  // namespace

Options with_option(Options options, const std::string& assignment) {
  const std::size_t sign = assignment.find('=');
  const std::string name = assignment.substr(0, sign);
  const auto value =
      sign == std::string::npos ? std::nullopt : number_in(assignment.substr(sign + 1));
  if (!value) throw BadInput(assignment + ": expected NAME=NUMBER");
  std::vector<std::string> names;
  Options::visit(options, Setter("", name, *value, names));
  if (std::find(names.begin(), names.end(), name) == names.end()) {
    const auto near = nearest_name(name, names);
    throw BadInput(
        name + ": unknown number of discovery; " +
        (near ? "did you mean '" + *near + "'?" : "docs/discovery_method.md lists them"));
  }
  if (const auto invalid = invalid_option(options)) throw BadInput(*invalid);
  return options;
}

std::optional<std::string> invalid_option(const Options& options) {
  std::optional<std::string> invalid;
  Options::visit(options, RangeCheck("", invalid));
  const JudgementOptions& judgement = options.judgement;
  if (!invalid &&
      !(judgement.faint_gap <= judgement.real_gap && judgement.real_gap <= judgement.certain_gap)) {
    invalid = "judgement: expected faint_gap <= real_gap <= certain_gap";
  }
  // Nothing is certain: the quantiles of 1 are infinite.
  if (!invalid && options.fit.intervals.confidence >= 1.0) {
    invalid = "fit.intervals.confidence: 1: expected less than 1";
  }
  if (!invalid && options.detectability.probability >= 1.0) {
    invalid = "detectability.probability: 1: expected less than 1";
  }
  return invalid;
}

}  // namespace discovery
}  // namespace anthrob
