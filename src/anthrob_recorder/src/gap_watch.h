#pragma once

#include <map>
#include <string>

namespace anthrob {

/// How long measurements were missing during a recording. Every muscle and joint is watched
/// separately, because the messages of the others would hide one that is no longer measured.
class GapWatch {
 public:
  /// From `time` [s] on, `what` is expected to be measured.
  void expect(const std::string& what, double time) { last_[what] = time; }
  /// `what` was measured at `stamp` [s]. Ignored if it is not expected.
  void see(const std::string& what, double stamp);
  /// The recording ends at `time` [s]: counts the gaps until then.
  void finish(double time);

  double largest() const { return largest_; }           ///< [s]
  const std::string& longest() const { return what_; }  ///< what was missing for so long

 private:
  void note(const std::string& what, double gap);

  std::map<std::string, double> last_;
  double largest_ = 0.0;
  std::string what_;
};

}  // namespace anthrob
