#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/folder_lock.h"
#include "anthrob_recording/dataset.h"
#include "protocol.h"
#include "sample.h"

namespace anthrob {

/// The output folder of a session, of which one recorder at a time makes use. Every recording has
/// NAME.bag and NAME.yaml, which has the keys of a dataset folder's meta.yaml. NAME.yaml is written
/// last, so a recording is complete when both exist. Further files:
///   session.yaml       protocol, robot, kind of time, simulated model, first rest posture;
///                      a folder belongs to one session
///   samples.csv        one row per recording: theta, f, q at its end
///   repeatability.csv  how far repeated runs are apart
class RecordingStore {
 public:
  /// Creates the folder, or continues its session; deletes incomplete recordings.
  /// @param time "simulated" or "true": recordings of a simulator and of a robot must not be mixed
  /// @param simulated model file of the simulated robot, which must stay the same; empty: unknown
  /// @throws BadInput if the folder belongs to another session, or another recorder is at work in
  /// it
  /// @throws std::runtime_error if it cannot be written
  RecordingStore(const std::string& folder, std::shared_ptr<const RobotModel> model,
                 const Protocol& protocol, const std::string& time,
                 const std::string& simulated = "");

  /// Names of the recordings of one visit, "E3_run1" or "E0_to_E3_run1" and "E3_to_E0_run1".
  std::vector<std::string> names(const Protocol::Target& target, int repeat) const;
  bool complete(const std::string& name) const;

  /// File to which a bag is written until it is complete.
  std::string partial_bag(const std::string& name) const;
  void discard(const std::string& name) const;
  /// Moves a complete bag to its final name, and writes its description with the sample.
  void finish(const std::string& name, DatasetMeta meta, const Sample& sample);

  const Sample* baseline() const { return baseline_.position.empty() ? nullptr : &baseline_; }
  void set_baseline(const Sample& rest);

  /// Writes samples.csv and repeatability.csv for the complete recordings.
  void summarise();

 private:
  struct Entry {
    std::string name, target;
    Sample sample;
  };
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::string session_text() const;
  std::vector<Entry> entries();
  /// Of a complete recording; each description is read once.
  const Sample& sample_of(const std::string& name);
  void write_samples(const std::vector<Entry>& entries) const;
  void write_repeatability(const std::vector<Entry>& entries) const;

  std::string folder_;
  std::optional<FolderLock> lock_;
  std::shared_ptr<const RobotModel> model_;
  Protocol protocol_;
  std::string time_;
  std::optional<std::string> simulated_;  ///< name and fingerprint, if known
  Sample baseline_;
  std::map<std::string, Sample> samples_;  ///< of recordings, as far as they are known
};

}  // namespace anthrob
