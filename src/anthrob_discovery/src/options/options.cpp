#include "options/options.h"

#include <cmath>
#include <type_traits>

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

}  // namespace

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
