#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "scope/live_topics.h"

namespace anthrob {

/// Topics of any type. Messages are read by a thread of their own, so that none is lost while
/// somebody draws; the master is asked by another one, because it may not answer.
class RosTopics final : public LiveTopics {
 public:
  RosTopics();
  ~RosTopics() override;

  MasterView master() const override;
  void hear(const std::set<std::string>& topics) override;
  std::vector<LiveMessage> take() override;
  std::vector<std::string> take_remarks() override;

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;
};

}  // namespace anthrob
