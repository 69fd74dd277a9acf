#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {
namespace hosts {

/// The processes that mpirun started, or only this one. Create one object per process, at the
/// beginning of main(). What one of them calls, all must call, in the same order.
class MpiSession {
 public:
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Works in every process. If one fails, all throw what the first of them by rank threw.
  /// @throws BadInput, std::runtime_error
  void in_all(const std::function<void()>& work) const;
  /// @return whether all have the same text
  bool all_have(const std::string& text) const;
  /// @return in all processes the bytes of rank 0
  std::string from_first(const std::string& bytes) const;
  /// @return in all processes the bytes of each, by rank
  std::vector<std::string> from_all(const std::string& bytes) const;
  /// Ends all processes, which may wait for this one; rank 0 first has a second to say why.
  [[noreturn]] void abort(int status) const;

  /// A remark if mpirun gives this process fewer processors than the host has.
  std::optional<std::string> remark_on_processors() const;

 private:
  bool started_ = false;
  int rank_ = 0, size_ = 1;
};

}  // namespace hosts
}  // namespace anthrob
