#pragma once

#include <map>
#include <string>

namespace anthrob {

/// How long measurements were missing while a recording ran: each thing that is measured for
/// itself, for one that falls silent hides behind the others.
class GapWatch {
 public:
  /// Expected from `time` on [s].
  void expect(const std::string& what, double time) { last_[what] = time; }
  /// What was not expected is not watched.
  void see(const std::string& what, double stamp);
  /// Nothing more comes of what was recorded until `time`.
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
