#pragma once

namespace anthrob {

/// Where a player is in a recording.
class Playback {
 public:
  struct Options {
    double rate = 1.0;  ///< factor of the recorded speed, above 0
    bool loop = true;   ///< begin again at the end
  };
  enum class Step {
    kOn,      ///< from the last position to this one
    kJumped,  ///< to another place: by seek(), or back to the beginning
    kEnded,
  };

  /// @param duration of the recording [s]
  Playback(double duration, const Options& options) : duration_(duration), options_(options) {}

  /// @param position [s] since the beginning; what lies outside is taken to the nearer end
  void seek(double position);
  void pause(bool paused) { paused_ = paused; }
  void set_rate(double rate) { options_.rate = rate; }
  /// @param time that has passed [s], by the clock of whoever looks on
  Step advance(double time);

  double duration() const { return duration_; }
  double position() const { return position_; }
  double rate() const { return options_.rate; }
  bool paused() const { return paused_; }
  bool loops() const { return options_.loop; }

 private:
  double duration_;
  Options options_;
  double position_ = 0.0;
  bool paused_ = false;
  bool jumped_ = true;  ///< to the beginning
};

}  // namespace anthrob
