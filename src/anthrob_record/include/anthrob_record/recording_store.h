#pragma once

#include <string>
#include <vector>

#include "anthrob_record/protocol.h"
#include "anthrob_record/sample.h"
#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// The output folder of a session: for every recording NAME.bag, and NAME.yaml as a dataset
/// folder's meta.yaml, which is written last: a recording is there when both are. And
///   session.yaml       protocol, robot, whose time, first rest posture; a folder belongs to one
///                      session
///   samples.csv        one row a recording: theta, f, q at its end
///   repeatability.csv  how far repeated runs are apart
class RecordingStore {
 public:
  /// Makes the folder, or goes on in one; throws half-written recordings away.
  /// @param time whose it is, "simulated" or "true": what a simulator and a robot did is not mixed
  /// @throws BadInput if the folder is another session's, std::runtime_error if it cannot be
  /// written
  RecordingStore(const std::string& folder, std::shared_ptr<const RobotModel> model,
                 const Protocol& protocol, const std::string& time);

  /// Names of the recordings of one visit, "E3_run1" or "E0_to_E3_run1" and "E3_to_E0_run1".
  std::vector<std::string> names(const Protocol::Target& target, int repeat) const;
  bool complete(const std::string& name) const;

  /// Where to write a bag until it is complete.
  std::string partial_bag(const std::string& name) const;
  void discard(const std::string& name) const;
  /// Puts a complete bag in its place, with its sample.
  void finish(const std::string& name, DatasetMeta meta, const Sample& sample);

  const Sample* baseline() const { return baseline_.position.empty() ? nullptr : &baseline_; }
  void set_baseline(const Sample& rest);

  /// Writes samples.csv and repeatability.csv of what is complete.
  void summarise() const;

 private:
  struct Entry {
    std::string name, target;
    Sample sample;
  };
  std::string file(const std::string& name) const { return folder_ + "/" + name; }
  std::string session_text() const;
  std::vector<Entry> entries() const;
  void write_samples(const std::vector<Entry>& entries) const;
  void write_repeatability(const std::vector<Entry>& entries) const;

  std::string folder_;
  std::shared_ptr<const RobotModel> model_;
  Protocol protocol_;
  std::string time_;
  Sample baseline_;
};

}  // namespace anthrob
