#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/errors.h"
#include "scope/scope_model.h"

namespace anthrob {

inline Quantity force_of(const std::string& muscle) {
  return {"/robot/muscle_states/force/" + muscle, "/robot/muscle_states",
          "/robot/muscle_states/force", muscle, "N"};
}

/// What a robot sends, and what was asked of it.
struct FakeTopics {
  MasterView master = {"http://localhost:11311", true, {"/robot/muscle_states"}};
  std::set<std::string> heard;
  std::vector<LiveMessage> messages;

  void send(Nanoseconds t, const std::vector<std::string>& muscles,
            const std::vector<double>& forces) {
    if (heard.count("/robot/muscle_states") == 0) return;
    if (contents_ == nullptr || contents_->quantities.size() != muscles.size()) {
      auto contents = std::make_shared<MessageContents>();
      for (const std::string& muscle : muscles) contents->quantities.push_back(force_of(muscle));
      contents_ = contents;
    }
    messages.push_back({"/robot/muscle_states", t, {t, forces, contents_}});
  }

 private:
  std::shared_ptr<const MessageContents> contents_;
};

class FakeLive final : public LiveTopics {
 public:
  explicit FakeLive(std::shared_ptr<FakeTopics> topics) : topics_(std::move(topics)) {}
  MasterView master() const override { return topics_->master; }
  void hear(const std::set<std::string>& topics) override { topics_->heard = topics; }
  std::vector<LiveMessage> take() override { return std::exchange(topics_->messages, {}); }
  std::vector<std::string> take_remarks() override { return {}; }

 private:
  std::shared_ptr<FakeTopics> topics_;
};

/// Two muscles for 10 s from `begin` on: the force is `force`, and rises by 1 N/s.
class FakeRecording final : public RecordingSource {
 public:
  FakeRecording(Nanoseconds begin, double force) : begin_(begin), force_(force) {}
  const std::vector<Quantity>& quantities() const override { return quantities_; }
  const std::vector<std::string>& remarks() const override { return remarks_; }
  Nanoseconds begin() const override { return begin_; }
  std::map<std::string, std::vector<Sample>> load(const std::set<std::string>& paths) override {
    std::map<std::string, std::vector<Sample>> loaded;
    for (const std::string& path : paths) {
      for (int i = 0; i <= 1000; ++i)
        loaded[path].push_back({begin_ + i * Nanoseconds{10000000}, force_ + 0.01 * i});
    }
    return loaded;
  }

 private:
  Nanoseconds begin_;
  double force_;
  std::vector<Quantity> quantities_ = {force_of("flexor"), force_of("extensor")};
  std::vector<std::string> remarks_;
};

/// "a.bag" begins at 100 s with 1 N, "b.bag" at 5000 s with 3 N; there is nothing else.
inline std::unique_ptr<RecordingSource> open_fake(const std::string& path) {
  if (path == "/data/a.bag") return std::make_unique<FakeRecording>(100000000000, 1.0);
  if (path == "/data/b.bag") return std::make_unique<FakeRecording>(5000000000000, 3.0);
  throw BadInput(path + ": no bag; expected a recording");
}

}  // namespace anthrob
