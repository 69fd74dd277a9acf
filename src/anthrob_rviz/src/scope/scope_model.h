#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "scope/live_topics.h"
#include "scope/recording_source.h"
#include "scope/samples.h"
#include "scope/series_difference.h"

namespace anthrob {

/// One quantity of one source.
struct Curve {
  Quantity quantity;
  std::size_t source = 0;  ///< place in ScopeModel::sources()
  SampleSpan samples;      ///< valid until the model changes or is polled
  Nanoseconds zero = 0;    ///< where plots have their time 0

  double seconds_of(Nanoseconds t) const { return seconds(t - zero); }
};

/// Where numbers come from.
struct SourceView {
  std::string name;  ///< "live", "run.bag"
  std::string path;  ///< of a recording
  bool live = false;
  bool shown = true;
  double later = 0.0;  ///< [s] shifts its curves to the right
};

/// Which quantities there are, which of them are ticked, and their samples: of a running robot
/// those of the last minute, and of recordings all. A quantity that is ticked is shown of every
/// source that has it, so that recordings lie upon each other.
class ScopeModel {
 public:
  static constexpr Nanoseconds kWindow = 60000000000;  ///< of what is live

  ScopeModel(std::unique_ptr<LiveTopics> live, OpenRecording open);

  /// @throws BadInput with one line, and changes nothing
  void open(const std::string& path);
  /// @param source of a recording
  void close(std::size_t source);
  void show(std::size_t source, bool shown);
  void shift(std::size_t source, double later);

  void tick(const std::set<std::string>& paths, bool ticked);
  const std::set<std::string>& ticked() const { return ticked_; }
  /// A live topic is heard while it is open in the tree, or while something of it is ticked.
  void look_into(const std::set<std::string>& topics);

  /// Takes what came. @return whether there are new samples
  bool poll();
  /// Stops the live curves; what comes meanwhile is shown later.
  void freeze(bool frozen);
  bool frozen() const { return frozen_.has_value(); }

  const std::vector<SourceView>& sources() const { return sources_; }
  MasterView master() const { return live_->master(); }
  /// All quantities of all sources by path. The number changes whenever they do.
  const std::map<std::string, Quantity>& quantities() const { return quantities_; }
  int version() const { return version_; }
  /// Of the ticked quantities and shown sources, by path.
  std::vector<Curve> curves() const;
  std::vector<std::string> take_remarks();
  /// [bytes] of all live samples
  std::size_t live_bytes() const;

 private:
  using Windows = std::unordered_map<std::string, SampleWindow>;
  struct Opened {
    std::unique_ptr<RecordingSource> recording;
    std::map<std::string, std::vector<Sample>> loaded;
  };

  void collect();
  void load_ticked();
  void hear_needed();
  void note(const MessageContents& contents);
  void keep(const LiveMessage& message);
  SampleSpan span_of(std::size_t source, const std::string& path) const;
  Nanoseconds zero_of(std::size_t source) const;

  std::unique_ptr<LiveTopics> live_;
  OpenRecording open_;
  std::vector<SourceView> sources_;  ///< the first one is live
  std::vector<Opened> opened_;       ///< of all others
  Windows windows_;
  std::optional<Windows> frozen_;
  std::optional<Nanoseconds> live_zero_;
  std::map<std::string, Quantity> live_quantities_, quantities_;
  std::map<std::string, std::shared_ptr<const MessageContents>> noted_;
  std::set<std::string> ticked_, looked_into_, left_out_;
  std::vector<std::string> remarks_;
  int version_ = 0;
};

/// How far apart the curves of one quantity are in two sources.
struct CurvePair {
  Curve first, second;
  SeriesDifference comparison;  ///< second - first, at the times of the first
};

/// Of the quantities that the first two shown sources of the curves both have.
std::vector<CurvePair> pairs_of(const std::vector<Curve>& curves);

}  // namespace anthrob
