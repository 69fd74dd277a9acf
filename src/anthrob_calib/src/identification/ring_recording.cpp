#include "identification/ring_recording.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "identification/estimate.h"
#include "identification/number_text.h"
#include "identification/rig_recording.h"
#include "identification/ring_holds.h"

namespace anthrob {
namespace identification {

namespace {

/// Share of its time from which on a hold or a recovery counts as whole.
constexpr double kWhole = 0.95;
/// Share of a recovery, its last, in which the force sensor shows its offset.
constexpr double kQuiet = 0.25;
/// While a ring is held before a test, every so many samples are kept, but all just before the
/// stretch.
constexpr std::size_t kThinning = 50, kKept = 250;

/// How long the ring is to be held and released, if it is known [s].
struct Protocol {
  double hold, recover;
};

class Reader {
 public:
  explicit Reader(const Dataset& recording)
      : data_(recording),
        columns_(read_columns(recording, "ring stretcher", {"ring/position", "ring/force"})) {}

  RingRecording read() {
    result_.name = recording_name(data_);
    result_.period = columns_.period();
    read_meta();
    holds_ = find_holds(columns_.t, position());
    check_holds();
    find_offset();
    for (std::size_t i = 1; i < holds_.size(); ++i) {
      if (!holds_[i].released) add_test(i);
    }
    if (result_.tests.empty()) {
      throw BadInput(result_.name +
                     ": no relaxation test: ring/position is never held beyond its "
                     "lowest value; expected a stretch that is held for at least "
                     "half a second");
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(std::size_t row, const std::string& message) const {
    char time[32];
    std::snprintf(time, sizeof(time), "%.3f", columns_.t[row]);
    throw BadInput(result_.name + ": at t = " + time + " s: " + message);
  }

  void read_meta() {
    const ConfigNode meta = rig_meta(data_);
    const ConfigNode specimen = meta.at("specimen"), rig = meta.at("rig");
    RingSpecimen& ring = result_.specimen;
    ring.ring = specimen.text("ring");
    if (ring.ring.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                    "0123456789_-") != std::string::npos) {
      specimen.at("ring").fail_expected("letters, digits, _ and -, for it names files and springs");
    }
    ring.number = specimen.at("number").as_integer(1, 1000000);
    ring.rest_length = specimen.number("rest_length", Bounds::positive(), "m");
    ring.section_diameter = specimen.number("section_diameter", Bounds::positive(), "m");
    ring.strands = specimen.at("strands").as_integer(1, 100);
    result_.run = meta.at("run").as_integer(1, 1000000);
    radius_ = rig.number("effective_radius", Bounds::positive(), "m");
    start_length_ = rig.number("start_length", Bounds::positive(), "m");
    result_.scale_sigma = rig.number_or("scale_sigma", 0.0, Bounds::between(0.0, 1.0), "1");
    if (rig.has("force_average"))
      result_.force_average = rig.at("force_average").as_integer(1, 10000);
    if (meta.has("protocol")) {
      const ConfigNode protocol = meta.at("protocol");
      protocol_ = {protocol.number("hold", Bounds::positive(), "s"),
                   protocol.number("recover", Bounds::positive(), "s")};
      protocol.refuse_unknown_keys();
    }
    for (const ConfigNode& part : {specimen, rig}) part.refuse_unknown_keys();
  }

  const std::vector<double>& position() const { return columns_.values[0]; }
  const std::vector<double>& force() const { return columns_.values[1]; }

  /// Row in which the ring sets off for a hold.
  std::size_t departure(std::size_t i) const { return i == 0 ? 0 : holds_[i - 1].end; }

  void check_holds() const {
    if (holds_.empty() || !holds_.front().released) {
      fail(0,
           "starts stretched: expected the ring released, and at rest for half a second, before "
           "the first test");
    }
    if (holds_.back().end < position().size()) {
      fail(holds_.back().end, "ends while the ring moves: is the recording cut off?");
    }
    for (std::size_t i = 0; protocol_ && i < holds_.size(); ++i) check_duration(i);
  }

  void check_duration(std::size_t i) const {
    const RingHold& hold = holds_[i];
    // The first release may be shorter, the last may be missing: nothing was before, or comes
    // after.
    if (hold.released && (i == 0 || i + 1 == holds_.size())) return;
    const double due = hold.released ? protocol_->recover : protocol_->hold;
    const double duration = columns_.t[hold.end - 1] - columns_.t[departure(i)] + result_.period;
    if (duration < kWhole * due) {
      char text[96];
      std::snprintf(text, sizeof(text), "%s lasts %.2f s: expected %g s; is the recording cut off?",
                    hold.released ? "this recovery" : "this test", duration, due);
      fail(departure(i), text);
    }
  }

  void find_offset() {
    double sum = 0.0;
    std::size_t count = 0;
    for (const RingHold& hold : holds_) {
      if (!hold.released) continue;
      const auto length = static_cast<double>(hold.end - hold.begin);
      for (auto row = hold.end - static_cast<std::size_t>(std::ceil(kQuiet * length));
           row < hold.end; ++row, ++count) {
        sum += force()[row];
      }
    }
    result_.force_offset = sum / static_cast<double>(count);
  }

  /// Rows before a test that its force depends on: since the ring was last released. All while it
  /// moves, few while it is held.
  std::vector<std::size_t> rows_before(std::size_t test) const {
    std::size_t first = test - 1;
    while (!holds_[first].released) --first;
    const std::size_t begin = departure(test);
    const std::size_t dense = static_cast<std::size_t>(result_.force_average) + kKept;
    std::vector<std::size_t> rows;
    for (std::size_t h = first; h < test; ++h) {
      for (std::size_t row = h == first ? holds_[h].begin : departure(h); row < holds_[h].end;
           ++row) {
        const bool held = row > holds_[h].begin + dense && row + dense < holds_[h].end;
        if (held && row + dense < begin && (row - holds_[h].begin) % kThinning != 0) continue;
        rows.push_back(row);
      }
    }
    return rows;
  }

  void add_test(std::size_t i) {
    const RingHold& hold = holds_[i];
    const std::size_t begin = departure(i);
    std::vector<std::size_t> rows = rows_before(i);
    const std::size_t before = rows.size();
    for (std::size_t row = begin; row < hold.end; ++row) rows.push_back(row);
    RelaxationTest test;
    test.hold = before + (hold.begin - begin);
    const double l0 = result_.specimen.rest_length;
    for (const std::size_t row : rows) {
      test.t.push_back(columns_.t[row] - columns_.t[begin]);
      test.expansion.push_back(start_length_ - l0 + radius_ * position()[row]);
      test.force.push_back(force()[row] - result_.force_offset);
    }
    const std::size_t half = test.hold + (test.t.size() - test.hold) / 2;
    const double held = mean(test.expansion, half, test.expansion.size());
    if (!(held > 0.0)) {
      fail(begin, "the ring is held at " + significant(1000.0 * (held + l0), 3) +
                      " mm, shorter than its rest length of " + significant(1000.0 * l0, 3) +
                      " mm: is rig.start_length right?");
    }
    test.strain = held / l0;
    test.used = test.strain > kEllipseStrain;
    const double pull = mean(test.force, half, test.force.size());
    if (test.used && !(pull > 0.0)) {  // else noise may hide it
      fail(begin, "ring/force: " + significant(pull, 3) +
                      " N more while stretched than released: expected a positive "
                      "number; reverse the sign of the column");
    }
    result_.tests.push_back(std::move(test));
  }

  const Dataset& data_;
  RigColumns columns_;
  RingRecording result_;
  std::vector<RingHold> holds_;
  std::optional<Protocol> protocol_;
  double radius_ = 0.0, start_length_ = 0.0;
};

}  // namespace

double RingSpecimen::area() const {
  return strands * 0.25 * M_PI * section_diameter * section_diameter;
}

RingRecording RingRecording::read(const Dataset& recording) {
  return Reader(recording).read();
}

}  // namespace identification
}  // namespace anthrob
