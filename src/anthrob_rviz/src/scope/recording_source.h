#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scope/quantity.h"
#include "scope/samples.h"

namespace anthrob {

/// A recording that was opened. Its numbers stay in the file until they are asked for.
class RecordingSource {
 public:
  virtual ~RecordingSource() = default;

  virtual const std::vector<Quantity>& quantities() const = 0;
  /// What is in it and cannot be shown, one line each.
  virtual const std::vector<std::string>& remarks() const = 0;
  /// Time zero of its plots: its first sample. Topics with a single message, which may be older
  /// than the recording, do not count if there are others.
  virtual Nanoseconds begin() const = 0;
  /// The samples of some of its quantities, by path, in the order of time.
  /// @throws std::runtime_error if the file can no longer be read
  virtual std::map<std::string, std::vector<Sample>> load(const std::set<std::string>& paths) = 0;
};

/// @throws BadInput with one line
using OpenRecording = std::function<std::unique_ptr<RecordingSource>(const std::string& path)>;

}  // namespace anthrob
